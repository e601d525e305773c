// The rows that wheels of a body solve in a sub-step, along the suspension and of the tyre, and the tyre's ellipse.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solver_body.hpp"

namespace isostep::detail {

/// A direction at a contact, between a body and its ground. Impulses are changes of the body's velocity.
template <class S> struct WheelRow {
  using U = Unit<S>;
  using V = Velocity<S>;
  Vec3<U> way;                // [1]
  Vec3<S> turn, ground_turn;  // [m] arm x way
  Vec3<S> spun, ground_spun;  // [1/m] angular velocity by a unit of impulse
  S share;                    // [1] the ground's change of velocity, to the body's
  S give;                     // [1] change of `speed` by a unit of impulse: 1 or more

  /// Sets the row for a ground that stands still. Its fields of the ground's motion are then not read.
  ISO_INLINE void set(Vec3<U> direction, const SolverMass<S>& body, Vec3<S> arm) {
    way = direction;
    turn = cross(arm, direction);
    spun = body.kappa * turn;
    share = S(0);
    give = S(1) + saturate_to<S>(dot_sum(turn, spun));
  }
  ISO_INLINE void set(Vec3<U> direction, const SolverMass<S>& body, Vec3<S> arm, const SolverMass<S>& ground,
                      Vec3<S> ground_arm) {
    set(direction, body, arm);
    ground_turn = cross(ground_arm, way);
    ground_spun = Vec3<S>::zero();
    if (!(S(0) < ground.mass)) return;
    share = min(divide_to<S>(body.mass, ground.mass), Limits<S>::mass_ratio());
    ground_spun = ground.kappa * ground_turn;
    const S ground_give = S(1) + saturate_to<S>(dot_sum(ground_turn, ground_spun));
    give = saturating_add(give, saturate_to<S>(product(share, ground_give)));
  }
  /// [m/s] Returns the speed of the body's point.
  ISO_INLINE V speed(const MotionRow<V>& body) const {
    return saturating_add(saturate_to<V>(dot_sum(body.linear, way)), saturate_to<V>(dot_sum(body.angular, turn)));
  }
  /// [m/s] Returns the speed of the body's point relative to the ground's.
  ISO_INLINE V speed(const MotionRow<V>& body, const MotionRow<V>& ground) const {
    const V linear = saturate_to<V>(dot_sum(saturating_subtract(body.linear, ground.linear), way));
    const V turning = saturate_to<V>(dot_sum(body.angular, turn));
    return saturating_subtract(saturating_add(linear, turning), saturate_to<V>(dot_sum(ground.angular, ground_turn)));
  }
  ISO_INLINE void push(MotionRow<V>& body, V impulse) const {
    body.linear = saturating_add(body.linear, times(way, impulse));
    body.angular = saturating_add(body.angular, times(spun, impulse));
  }
  ISO_INLINE void push(MotionRow<V>& body, MotionRow<V>& ground, V impulse) const {
    push(body, impulse);
    if (!(S(0) < share)) return;
    const V shared = saturate_to<V>(product(share, impulse));
    ground.linear = saturating_subtract(ground.linear, times(way, shared));
    ground.angular = saturating_subtract(ground.angular, times(ground_spun, shared));
  }
  template <class A, class B> static ISO_INLINE Vec3<V> times(Vec3<A> v, B s) {
    return {saturate_to<V>(product(v.x, s)), saturate_to<V>(product(v.y, s)), saturate_to<V>(product(v.z, s))};
  }
};

/// The forces of spring, damper, bar and stop in a sub-step, without what the sub-step's motion changes of them.
template <class S> struct Strut {
  S spring;          // [m/s^2] of the body along the suspension
  S damping;         // [1/s] with what the spring gains in the sub-step
  S bar;             // [1/s^2] of the anti-roll bar
  S firm;            // [1] by how much the speed that it leads to makes it less: 1 or more
  Velocity<S> stop;  // [m/s] along the normal, at least: for the end of travel
};

/// The part of a tyre's grip that is left at a slip, or gained: WheelSettings::peak_slip and the others [1].
template <class S> struct SlipCurve {
  S peak_slip, peak_grip, slide_slip, slide_grip;

  ISO_INLINE bool is_flat() const { return peak_grip == S(1) && slide_grip == S(1); }
  ISO_INLINE S at(S slip) const {
    if (slip < peak_slip) return S(1) + (peak_grip - S(1)) * divide_to<Unit<S>>(slip, peak_slip);
    if (slide_slip < slip || !(peak_slip < slide_slip)) return slide_grip;
    return peak_grip + (slide_grip - peak_grip) * divide_to<Unit<S>>(slip - peak_slip, slide_slip - peak_slip);
  }
};
/// [1] Returns the slip: a tyre's sliding speed by the speed of its middle over the ground [m/s].
template <class V> ISO_INLINE V tyre_slip(V slide_along, V slide_across, V speed_along) {
  constexpr V kSlow = V(1);  // [m/s]
  constexpr V kMost = V(4);  // a spinning tyre on the spot; more is all the same
  const V slide = length(Vec3<V>{slide_along, slide_across, V(0)}), speed = max(abs(speed_along), kSlow);
  return slide * V(0.25) < speed ? divide_to<V>(slide, speed) : kMost;
}

/// The spin of a wheel on or off the ground, or of its track, as the speed of its rim [m/s].
template <class S> struct WheelSpin {
  using V = Velocity<S>;
  V rim;    // without tyre and brake
  S give;   // [1] rim_give()
  V brake;  // [m/s] the most that brakes change it by

  /// [m/s] Returns the rim's speed with the brake and with the impulse `along` of the tyre on the body.
  ISO_INLINE V after(V along) const {
    const V driven = saturating_subtract(rim, saturate_to<V>(product(give, along)));
    return driven - clamp(driven, -brake, brake);
  }
};

inline constexpr int kEllipseSteps = 4;  // of Hebden's formula: the direction is right to a hundredth
template <class S> inline constexpr S kEllipseError = S(0x1p-10);  // [1] of the length: no step is taken for less

template <class V> struct TyreImpulse {
  V along, across;  // [m/s]
};

/// Returns true if the ellipse with those radii contains the impulse.
template <class V> ISO_INLINE bool is_within(const TyreImpulse<V>& impulse, V most_along, V most_across) {
  constexpr V kSurely = V(0.6875);  // of both radii: twice its square is below 1
  const V along = abs(impulse.along), across = abs(impulse.across);
  if (along < most_along * kSurely && across < most_across * kSurely) return true;
  if (most_along < along || most_across < across) return false;
  const V a = divide_to<V>(along, most_along), b = divide_to<V>(across, most_across);
  return a * a + b * b <= V(1);
}

/// The slip of a tyre without its impulse, and how far it yields to one.
template <class S> struct TyreSlip {
  Velocity<S> along, across;  // [m/s] of the body's point against the ground, less the rim's speed
  S give_along, give_across;  // [1]
};

/// Returns the impulse on the ellipse with those radii that opposes the slip it leaves: to end the slip takes more.
/// Method:  scaled to a circle of radius R, the impulse is -s_i / (K_i + g), with s the slip, K the yield and g such
///          that its length is R: by steps of Hebden's formula, as of trust regions (More, Sorensen 1983, SIAM J. Sci.
///          Stat. Comput. 4(3), eq. 3.5).
template <class S>
TyreImpulse<Velocity<S>> sliding_impulse(const TyreSlip<S>& slip, Velocity<S> most_along, Velocity<S> most_across) {
  using V = Velocity<S>;
  const S ratio = divide_to<S>(most_along, most_across);
  const V slip_b = divide_to<V>(slip.across, ratio);
  const S give_b = divide_to<S>(divide_to<S>(slip.give_across, ratio), ratio);
  const auto at = [&](S more) {
    return heading_of(Vec3<V>{divide_to<V>(-slip.along, saturating_add(slip.give_along, more)),
                              divide_to<V>(-slip_b, saturating_add(give_b, more)), V(0)});
  };
  Heading<V> way = at(S(0));
  S more = S(0);  // g
  for (int step = 0; step < kEllipseSteps; ++step) {
    const S beyond = divide_to<S>(way.length - most_along, most_along);
    if (abs(beyond) < kEllipseError<S>) break;
    const auto part = [](Unit<S> d, S firm) { return divide_to<Unit<S>>(d * d, max(firm, S(1))); };
    const Unit<S> mean = part(way.direction.x, saturating_add(slip.give_along, more)) +
                         part(way.direction.y, saturating_add(give_b, more));
    if (!(Unit<S>(0) < mean)) break;
    more = max(S(0), saturating_add(more, divide_to<S>(beyond, mean)));
    way = at(more);
  }
  return {round_to<V>(product(way.direction.x, most_along)), round_to<V>(product(way.direction.y, most_across))};
}

/// Returns the impulse of a tyre that ends its slip. Beyond the ellipse with radii most_along and most_across returns
/// that on the ellipse which opposes the slip that it leaves.
/// Input:   `slip_along`, `slip_across` [m/s] of the body's point relative to the ground, without that impulse.
/// Method:  brake and tyre are solved as one along the wheel: the wheel is light, and would pass on little of either in
///          an iteration. Beyond the ellipse: sliding_impulse().
template <class S>
ISO_INLINE TyreImpulse<Velocity<S>> tyre_impulse(const WheelSpin<S>& spin, S give_along, S give_across,
                                                 Velocity<S> slip_along, Velocity<S> slip_across,
                                                 Velocity<S> most_along, Velocity<S> most_across) {
  using V = Velocity<S>;
  if (!(V(0) < most_along) || !(V(0) < most_across)) return {V(0), V(0)};
  // The wheel held by its brake, if that bears it; else turning.
  TyreSlip<S> slip = {slip_along, slip_across, give_along, give_across};
  const V holding = divide_to<V>(-slip_along, give_along);
  TyreImpulse<V> sticking = {holding, divide_to<V>(-slip_across, give_across)};
  const V taken = saturate_to<V>(product(spin.give, clamp(holding, -most_along, most_along)));
  const V driven = saturating_subtract(spin.rim, taken);
  if (driven < -spin.brake || spin.brake < driven) {
    const V braked = saturating_subtract(spin.rim, driven < V(0) ? -spin.brake : spin.brake);
    slip.along = saturating_subtract(slip_along, braked);
    slip.give_along = saturating_add(give_along, spin.give);
    sticking.along = divide_to<V>(-slip.along, slip.give_along);
  }
  return is_within(sticking, most_along, most_across) ? sticking : sliding_impulse(slip, most_along, most_across);
}

}  // namespace isostep::detail
