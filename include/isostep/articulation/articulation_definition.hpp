// The definition of an articulation.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/articulation/articulation_link.hpp"
#include "isostep/core/fields.hpp"

namespace isostep {

/// The step rate of an articulation, the place where it hangs, and gravity.
template <class S> struct ArticulationSettings {
  std::int32_t hz = 60;                    // [1/s] steps, 10..10000
  std::int32_t substeps = 8;               // per step, 1..64, hz * substeps <= kMaxRate
  Vec3<S> gravity = {S(0), S(-10), S(0)};  // [m/s^2] along the world's axes
  Pose<S> base = Pose<S>::identity();      // [m] in the world: the frame a link without a parent is joined to

  ISO_FIELDS(hz, substeps, gravity, base)
};

/// A tree: every parent comes before its children.
template <class S> struct ArticulationDefinition {
  ArticulationSettings<S> settings = {};
  std::vector<ArticulationLink<S>> links = {};  // 1 to kMostArticulationLinks
};
inline constexpr std::uint32_t kMostArticulationLinks = 4096;

}  // namespace isostep
