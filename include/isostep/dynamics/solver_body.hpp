// Bodies as the solver sees them: rows of velocity and displacement that kernels gather, mass, accelerations asked for.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

/// The six numbers of a body in two groups of four, so that W bodies transpose into lanes by whole registers.
template <class V> struct alignas(8 * sizeof(V)) MotionRow {
  Vec3<V> linear;
  V pad0;
  Vec3<V> angular;
  V pad1;

  static ISO_INLINE constexpr MotionRow zero() { return {Vec3<V>::zero(), V(0), Vec3<V>::zero(), V(0)}; }
  ISO_FIELDS(linear, angular)
};

/// The acceleration by forces, for this step alone.
template <class S> struct Acceleration {
  Vec3<S> linear;   // [m/s^2]
  Vec3<S> angular;  // [rad/s^2]

  ISO_FIELDS(linear, angular)
};

/// Returns the angular speed [rad/s] above which a body spins: its orientation at the start of a step does not hold for
/// the whole step. A sixteenth of a radian a step: with less, a torque is misdirected by three hundredths on average.
template <class S> ISO_INLINE Velocity<S> rapid_angular_speed(std::int32_t hz) {
  return convert<Velocity<S>>(S(hz) * S(1.0 / 16));
}

/// Returns the angular speed [rad/s], an eighth of a radian a sub-step, above which a body with contacts keeps its
/// inertia about the world axes, and arms count as straight. Contacts are prepared once a step: beside joints that
/// follow, a pinched limb is spun up to the limit of angular speeds. Light links of a loaded rope whip that fast, and
/// bending arms would drive them.
template <class S> ISO_INLINE Velocity<S> angular_speed_to_follow(std::int32_t rate) {
  return saturate_to<Velocity<S>>(product(S(rate), S(1.0 / 8)));
}

/// Returns the angular speed [rad/s] above which a body's inertia is renewed in every sub-step, and contacts follow
/// (contact_follow.hpp): seven eighths of a radian a step, a quarter if one axis is sixteen times easier to turn about
/// than another. Old inertia is wrong by the turn times that ratio; contacts take more energy from slower bodies.
template <class S> ISO_INLINE Velocity<S> angular_speed_to_renew(std::int32_t hz, bool slender) {
  return convert<Velocity<S>>(min(Limits<S>::angular_speed(), S(hz)) * (slender ? S(0.25) : S(0.875)));
}

/// The mass that turns an impulse into a change of velocity.
template <class S> struct SolverMass {
  S mass;         // [kg]; 0: immovable
  Mat3<S> kappa;  // [1/m^2] mass times inverse inertia, world axes; 0: does not turn

  ISO_FIELDS(mass, kappa)
};

/// The rows of bodies. Row 0 is everything that does not move; the awake bodies follow in order.
template <class S> struct SolverBodies {
  std::vector<MotionRow<Velocity<S>>> velocity;      // [m/s], [rad/s]
  std::vector<MotionRow<Velocity<S>>> displacement;  // [m], [rad] since the step began
  std::vector<SolverMass<S>> mass;

  ISO_INLINE bool moves(std::uint32_t row) const { return mass[row].mass > S(0); }
};

/// The shares of two bodies in a unit of impulse, which is a velocity change of the reduced mass: a + b = 1 unless
/// neither moves. Ratios replace inverse masses, so that grams and tons are equally exact in fixed point.
template <class S> struct MassShare {
  S a, b;  // [1]

  ISO_FIELDS(a, b)
};
template <class S> ISO_INLINE constexpr MassShare<S> mass_share(S mass_a, S mass_b) {
  if (!(mass_a > S(0))) return {S(0), mass_b > S(0) ? S(1) : S(0)};
  if (!(mass_b > S(0))) return {S(1), S(0)};
  const S half_sum = S(0.5) * mass_a + S(0.5) * mass_b;  // the sum itself may not fit
  const S a = divide_to<S>(S(0.5) * mass_b, half_sum);
  return {a, S(1) - a};
}

}  // namespace isostep
