// VelocityChange<S>: what rows that are solved before a sub-step do to a body, and the motion that they start from.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// A change of the velocity of the body in a row of SolverBodies.
template <class S> struct VelocityChange {
  std::uint32_t row;
  Vec3<Velocity<S>> linear, angular;  // [m/s], [rad/s]
};

namespace detail {

/// Motion of a row as a sub-step of `h` seconds would leave it by gravity and that acceleration, before contacts and
/// joints.
template <class S>
MotionRow<Velocity<S>> next_motion(const WorldState<S>& state, const SolverBodies<S>& bodies,
                                   const std::vector<Acceleration<S>>& accelerations, std::uint32_t row, Step<S> h) {
  using V = Velocity<S>;
  MotionRow<V> motion = bodies.velocity[row];
  if (!bodies.moves(row)) return motion;
  const Acceleration<S>& by = accelerations[row - 1];
  const S scale = state.awake.properties[row - 1].gravity_scale;
  const Vec3<S> pull = scale == S(1) ? state.settings.gravity : state.settings.gravity * scale;
  const auto times = [&](Vec3<S> a) {
    return Vec3<V>{round_to<V>(product(a.x, h)), round_to<V>(product(a.y, h)), round_to<V>(product(a.z, h))};
  };
  motion.linear += times(by.linear + pull);
  motion.angular += times(by.angular);
  return motion;
}

}  // namespace detail

}  // namespace isostep
