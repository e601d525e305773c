// What the wheels of a body solve in a sub-step: rows along the suspension and of the tyre, and the tyre's ellipse.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solver_body.hpp"

namespace isostep::detail {

/// A direction at a contact, between a body and its ground. Impulses are changes of the body's velocity.
template <class S> struct WheelRow {
  using U = Unit<S>;
  using V = Velocity<S>;
  Vec3<U> way;                 // [1]
  Vec3<S> turn, ground_turn;   // [m] arm x way
  Vec3<S> spun, ground_spun;   // [1/m] angular velocity by a unit of impulse
  S share;                     // [1] the ground's change of velocity, to the body's
  S give;                      // [1] change of `speed` by a unit of impulse: 1 or more

  static ISO_INLINE WheelRow of(Vec3<U> way, const SolverMass<S>& body, Vec3<S> arm, const SolverMass<S>& ground,
                                Vec3<S> ground_arm) {
    WheelRow row = {way, cross(arm, way), cross(ground_arm, way), {}, Vec3<S>::zero(), S(0), S(1)};
    row.spun = body.kappa * row.turn;
    row.give = S(1) + saturate_to<S>(dot_sum(row.turn, row.spun));
    if (!(S(0) < ground.mass)) return row;
    row.share = min(divide_to<S>(body.mass, ground.mass), Limits<S>::mass_ratio());
    row.ground_spun = ground.kappa * row.ground_turn;
    const S ground_give = S(1) + saturate_to<S>(dot_sum(row.ground_turn, row.ground_spun));
    row.give = saturating_add(row.give, saturate_to<S>(product(row.share, ground_give)));
    return row;
  }
  /// [m/s] Of the body's point against the ground's.
  ISO_INLINE V speed(const MotionRow<V>& body, const MotionRow<V>& ground) const {
    const V linear = saturate_to<V>(dot_sum(saturating_subtract(body.linear, ground.linear), way));
    const V turning = saturate_to<V>(dot_sum(body.angular, turn));
    return saturating_subtract(saturating_add(linear, turning), saturate_to<V>(dot_sum(ground.angular, ground_turn)));
  }
  ISO_INLINE void push(MotionRow<V>& body, MotionRow<V>& ground, V impulse) const {
    body.linear = saturating_add(body.linear, times(way, impulse));
    body.angular = saturating_add(body.angular, times(spun, impulse));
    if (!(S(0) < share)) return;
    const V shared = saturate_to<V>(product(share, impulse));
    ground.linear = saturating_subtract(ground.linear, times(way, shared));
    ground.angular = saturating_subtract(ground.angular, times(ground_spun, shared));
  }
  template <class A, class B> static ISO_INLINE Vec3<V> times(Vec3<A> v, B s) {
    return {saturate_to<V>(product(v.x, s)), saturate_to<V>(product(v.y, s)), saturate_to<V>(product(v.z, s))};
  }
};

/// [1] m r^2 / I: what an impulse at the rim does to its speed, to what it does to that of the body.
template <class S> ISO_INLINE S rim_give(S mass, S radius, S inertia) {
  return saturate_to<S>(product(radius, saturate_to<S>(product(mass, divide_to<S>(radius, inertia)))));
}
/// The spin of a wheel that meets the ground or does not, as speed of its rim [m/s].
template <class S> struct WheelSpin {
  using V = Velocity<S>;
  V rim;    // without tyre and brake
  S give;   // [1] rim_give()
  V brake;  // [m/s] the most that brakes change it by

  /// With an impulse of the tyre on the body.
  ISO_INLINE V after(V along) const {
    const V driven = rim - saturate_to<V>(product(give, along));
    return driven - clamp(driven, -brake, brake);
  }
};

inline constexpr int kEllipseSteps = 4;  // of Hebden's formula: the direction is right to a hundredth

template <class V> struct TyreImpulse {
  V along, across;  // [m/s]
};

/// The impulse of a tyre that ends its slip, or that of the ellipse with radii most_along and most_across whose
/// slip is left against it.
/// Input:   `slip_along`, `slip_across` [m/s] of the body's point against the ground without that impulse.
/// Method:  along the wheel brake and tyre are solved as one: the wheel is light, and would pass on little of either in
///          an iteration. Beyond the ellipse, scaled to a circle of radius R, the impulse is -s_i / (K_i + g), with s
///          the slip, K what gives way and g such that its length is R: by steps of Hebden's formula, as of trust
///          regions (More, Sorensen 1983, SIAM J. Sci. Stat. Comput. 4(3), eq. 3.5).
template <class S>
TyreImpulse<Velocity<S>> tyre_impulse(const WheelSpin<S>& spin, S give_along, S give_across, Velocity<S> slip_along,
                                      Velocity<S> slip_across, Velocity<S> most_along, Velocity<S> most_across) {
  using V = Velocity<S>;
  if (!(V(0) < most_along) || !(V(0) < most_across)) return {V(0), V(0)};
  // The wheel held by its brake, if that bears it; else turning.
  V slip = slip_along;
  S give = give_along;
  const V held = clamp(divide_to<V>(-slip_along, give_along), -most_along, most_along);
  const V driven = spin.rim - saturate_to<V>(product(spin.give, held));
  if (driven < -spin.brake || spin.brake < driven) {
    slip = slip_along - (spin.rim - (driven < V(0) ? -spin.brake : spin.brake));
    give = saturating_add(give_along, spin.give);
  }
  const S ratio = divide_to<S>(most_along, most_across);
  const V slip_b = divide_to<V>(slip_across, ratio);
  const S give_b = divide_to<S>(divide_to<S>(give_across, ratio), ratio);
  const auto at = [&](S more) {
    return heading_of(Vec3<V>{divide_to<V>(-slip, saturating_add(give, more)),
                              divide_to<V>(-slip_b, saturating_add(give_b, more)), V(0)});
  };
  Heading<V> way = at(S(0));
  if (!(most_along < way.length)) return {divide_to<V>(-slip, give), divide_to<V>(-slip_across, give_across)};
  S more = S(0);  // g
  for (int step = 0; step < kEllipseSteps; ++step) {
    const auto part = [](Unit<S> d, S firm) { return divide_to<Unit<S>>(d * d, max(firm, S(1))); };
    const Unit<S> mean = part(way.direction.x, saturating_add(give, more)) +
                         part(way.direction.y, saturating_add(give_b, more));
    if (!(Unit<S>(0) < mean)) break;
    const S beyond = divide_to<S>(way.length - most_along, most_along);
    more = max(S(0), saturating_add(more, divide_to<S>(beyond, mean)));
    way = at(more);
  }
  return {round_to<V>(product(way.direction.x, most_along)), round_to<V>(product(way.direction.y, most_across))};
}

}  // namespace isostep::detail
