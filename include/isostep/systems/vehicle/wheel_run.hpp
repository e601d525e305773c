// WheelRun<S>, WheelGroup<S>: a wheel in a step, and the wheels of one body.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/id.hpp"
#include "isostep/dynamics/wheel_rows.hpp"
#include "isostep/math/aabb.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE S times(S a, S b) { return saturate_to<S>(product(a, b)); }
/// [1] The least cosine between the suspension and the ground's normal. A wheel does not stand on steeper ground.
template <class U> inline constexpr U kLeastFacing = U(0.25);
}  // namespace detail

template <class S> struct WheelRun {
  using U = Unit<S>;
  using V = Velocity<S>;
  static constexpr std::uint32_t kNone = ~0u;

  std::uint32_t slot, row, ground;  // of its record; of SolverBodies
  std::uint32_t partner;            // of the anti-roll bar, by run; kNone
  std::uint32_t vehicle;            // slot of its record; kNone
  std::uint32_t group;              // that it is of
  BodyId met;                       // null: no ground
  bool uneven;                      // no plane for the whole step: it is looked for in every sub-step
  Vec3<S> point;                    // [m] of the ground as the step began, world
  Vec3<S> ground_arm;               // [m] that from the ground's centre of mass
  Vec3<U> normal;                   // [1]
  Vec3<U> axle;                     // [1] body frame, steered
  S mu_along, mu_across;            // [1] of tyre and ground, at no slip
  S anti_roll;                      // [N/m]
  std::uint32_t leader, next;       // of its track, by run: itself without one; kNone
  S to_leader;                      // [1] turns of the leader's axle by its own: 1 without a track
  detail::WheelSpin<S> spin;        // of the leader: what all of them share
  S inertia;                        // [kg m^2] likewise, about the leader's axle
  S drive;                          // [1] likewise: turns of the engine's shaft by one of that axle
  S side;                           // [1] likewise: what steering makes of that: 1, or VehicleSettings::track_steer
  bool driven;                      // likewise
  S angle, steered, length;         // [rad], [rad], [m]
  // As the sub-step finds it.
  bool touches;
  Vec3<S> at;  // [m] world
  detail::WheelRow<S> up, along, across;
  S lean;  // [1] length by distance from the ground: 1 or more
  detail::Strut<S> strut;
  S grip_along, grip_across;  // [1] mu at the slip of the sub-step before
  S slip;                     // [1] WheelState::slip
  V load, push_along, push_across;
};

/// An engine behind a clutch, in a sub-step.
template <class S> struct ClutchedEngine {
  S inertia;  // [kg m^2] 0: there is none
  S most;     // [N m] that the clutch can bear
  S free;     // [rad/s] the engine's speed without what the clutch bears
  S spin;     // [rad/s] with it
  S clutch;   // [N m] that it bears, on the gears
};

template <class S> struct WheelGroup {
  std::uint32_t row, first, end, vehicle;
  Aabb<S> region;                      // [m] world, of which all ground is known
  std::uint32_t first_near, end_near;  // of what WheelGround found there
  bool geared;                         // some wheel is driven, and the gear is not neutral
  ClutchedEngine<S> engine;
  bool ends_early;  // nothing but its own wheels changes what they find
  bool changed;     // by the last sweep
  bool done;        // in this pass
};

}  // namespace isostep
