// The state of an articulation, beside its definition: what is saved, hashed, written and compared.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/articulation/articulation_link.hpp"
#include "isostep/core/fields.hpp"

namespace isostep {

/// Forces asked for since the last step.
template <class S> struct LinkLoad {
  Vec3<S> force;   // [N] world, at the centre of mass
  Vec3<S> torque;  // [N m] world

  ISO_FIELDS(force, torque)
};
static_assert(kHasNoPadding<LinkLoad<float>> && kHasNoPadding<LinkLoad<double>>);

/// The arrays go by joint, in the order of links: a hinge and a slider have one coordinate and one speed, a ball a
/// rotation and three speeds, a free link three coordinates, a rotation and six speeds, the linear ones first.
template <class S> struct ArticulationState {
  std::uint64_t tick = 0;                    // steps taken
  std::vector<S> coordinates;                // q: [rad], [m]
  std::vector<Quat<Unit<S>>> rotations;      // q of balls: [1] frame b in frame a
  std::vector<S> speeds;                     // dq: [rad/s], [m/s], along the axes of frame a
  std::vector<ArticulationDrive<S>> drives;  // one a link
  std::vector<LinkLoad<S>> loads;            // one a link

  /// All of it, in the order of the hash and of the portable form: see state/members.hpp.
  template <class Visitor, class Self> static ISO_INLINE void members(Visitor&& visit, Self&& self) {
    visit("tick", self.tick);
    visit("coordinates", self.coordinates);
    visit("rotations", self.rotations);
    visit("speeds", self.speeds);
    visit("drives", self.drives);
    visit("loads", self.loads);
  }
};
static_assert(kHasNoPadding<ArticulationDrive<float>> && kHasNoPadding<ArticulationDrive<double>>);

}  // namespace isostep
