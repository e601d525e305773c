// Bodies of suspension_rows.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/solvers/schedule.hpp"
#include "isostep/systems/vehicle/suspension_rows.hpp"

namespace isostep {

template <class S> void SuspensionRows<S>::begin_substep() {
  stop_softness_ = detail::contact_softness(wheels_.rate());
}

template <class S> void SuspensionRows<S>::place(Run& run, const Mat3<U>& turn) {
  run.touches = false;
  run.spin.brake = V(0);
  const WheelSettings<S>& w = wheels_.wheel(run);
  run.length = w.free_length;
  if (!run.met) return;
  const bool stands = run.ground == 0;  // the ground
  const Vec3<S> centre = state_.awake.states[run.row - 1].centre;
  const Vec3<S> hard_arm = turn * (w.hard_point - state_.awake.properties[run.row - 1].local_centre);
  const Vec3<U> down = turn * w.suspension;
  const MotionRow<V>& moved = wheels_.bodies().displacement[run.ground];
  const Vec3<S> point =
      stands ? run.point : run.point + convert<S>(moved.linear) + cross(convert<S>(moved.angular), run.ground_arm);
  const U facing = -dot(down, run.normal);
  if (facing < detail::kLeastFacing<U>) return;
  run.lean = divide_to<S>(S(1), facing);
  const S height = dot(centre - point + hard_arm, run.normal);
  const S length = saturate_to<S>(product(height - w.radius, run.lean));
  if (w.free_length <= length) return;
  run.touches = true;
  const Vec3<S> arm = hard_arm + down * length - run.normal * w.radius;
  run.at = centre + arm;
  const Vec3<S> ground_arm = run.at - point + run.ground_arm;
  const Vec3<U> forward = normalise(cross(turn * run.axle, run.normal));
  const SolverMass<S>&body = wheels_.bodies().mass[run.row], &ground = wheels_.bodies().mass[run.ground];
  const auto set = [&](Row& row, Vec3<U> way) ISO_INLINE_LAMBDA {
    if (stands) row.set(way, body, arm);
    else row.set(way, body, arm, ground, ground_arm);
  };
  set(run.up, run.normal);
  set(run.along, forward);
  set(run.across, cross(run.normal, forward));
  compress(run, length);
  MotionRow<V>& motion = wheels_.bodies().velocity[run.row];
  move(run, run.up, motion, run.load);
  move(run, run.along, motion, run.push_along);
  move(run, run.across, motion, run.push_across);
}

/// Computes spring, damper, bar and stop at a length, and the tyre's grip.
template <class S> void SuspensionRows<S>::compress(Run& run, S length) const {
  using detail::times;
  const WheelSettings<S>& w = wheels_.wheel(run);
  const S mass = wheels_.bodies().mass[run.row].mass;
  const S stiffness = divide_to<S>(saturating_add(w.stiffness, run.anti_roll), mass);  // [1/s^2]
  run.length = length;
  const detail::SlipCurve<S> curve = {w.peak_slip, w.peak_grip, w.slide_slip, w.slide_grip};
  const S part = curve.is_flat() ? S(1) : curve.at(run.slip);
  run.grip_along = times(run.mu_along, part);
  run.grip_across = times(run.mu_across, part);
  run.strut.spring = times(stiffness, w.free_length - length);
  run.strut.damping = saturating_add(divide_to<S>(w.damping, mass), stiffness * wheels_.h());
  run.strut.bar = run.partner == Run::kNone ? S(0) : divide_to<S>(run.anti_roll, mass);
  const S firm = times(times(times(run.up.give, run.lean), run.lean), run.strut.damping * wheels_.h());
  run.strut.firm = saturating_add(S(1), firm);
  // The strut is no shorter than its travel leaves after the sub-step. Where it is shorter, it comes out of that as
  // softly as contacts of soft step: at once, it and a joint that holds a load on the body make energy together.
  const S room = divide_to<S>(length - (w.free_length - w.travel), run.lean);
  const S pace = S(0) <= room ? wheels_.rate() : stop_softness_.bias_rate;
  run.strut.stop = min(saturate_to<V>(product(-room, pace)), detail::kPushSpeed<S>);
}

/// [m/s] Returns the speed along a row. Row 0 does not move.
template <class S>
ISO_INLINE Velocity<S> SuspensionRows<S>::speed_of(const Run& run, const Row& row, const MotionRow<V>& body) const {
  return run.ground == 0 ? row.speed(body) : row.speed(body, wheels_.bodies().velocity[run.ground]);
}
/// [m/s] Returns the speed along a row without the row's impulse so far.
template <class S>
ISO_INLINE Velocity<S> SuspensionRows<S>::without(const Run& run, const Row& row, V impulse,
                                                  const MotionRow<V>& body) const {
  return saturating_subtract(speed_of(run, row, body), saturate_to<V>(product(row.give, impulse)));
}
template <class S>
ISO_INLINE void SuspensionRows<S>::move(const Run& run, const Row& row, MotionRow<V>& body, V impulse) {
  if (run.ground == 0) row.push(body, impulse);
  else row.push(body, wheels_.bodies().velocity[run.ground], impulse);
}

/// Solves the strut implicitly: its force follows from the length and speed after the sub-step.
template <class S> ISO_INLINE void SuspensionRows<S>::press(Run& run, MotionRow<V>& body, bool relaxes) {
  using detail::times;
  const V others = without(run, run.up, run.load, body);
  S force = run.strut.spring;  // [m/s^2] along the suspension
  if (run.partner != Run::kNone && wheels_.runs()[run.partner].touches) {
    const Run& other = wheels_.runs()[run.partner];
    const S speed = times(other.lean, convert<S>(speed_of(other, other.up, body)));
    const S pressed = wheels_.wheel(other).free_length - other.length - speed * wheels_.h();
    force = saturating_add(force, -times(run.strut.bar, pressed));
  }
  force = saturating_add(force, -times(run.strut.damping, times(run.lean, convert<S>(others))));
  const S pushed = divide_to<S>(times(force, run.lean), run.strut.firm);  // [m/s^2]
  const V push = relaxes ? min(run.strut.stop, V(0)) : run.strut.stop;    // [m/s] at the end of travel
  V stop = divide_to<V>(push - others, run.up.give);
  if (V(0) < push) stop = saturate_to<V>(product(stop_softness_.mass_scale, stop));
  const V load = max(max(V(0), saturate_to<V>(product(pushed, wheels_.h()))), stop);
  move(run, run.up, body, load - run.load);
  run.load = load;
}

template <class S> ISO_INLINE void SuspensionRows<S>::grip(Run& run, MotionRow<V>& body) {
  const auto most = [&](S mu) ISO_INLINE_LAMBDA { return saturate_to<V>(product(mu, run.load)); };
  const V slip_along = without(run, run.along, run.push_along, body);
  const V slip_across = without(run, run.across, run.push_across, body);
  const detail::TyreImpulse<V> made =
      detail::tyre_impulse<S>(tracks_.spin_of(run), run.along.give, run.across.give, slip_along, slip_across,
                              most(run.grip_along), most(run.grip_across));
  move(run, run.along, body, made.along - run.push_along);
  move(run, run.across, body, made.across - run.push_across);
  run.push_along = made.along;
  run.push_across = made.across;
}

template <class S> bool SuspensionRows<S>::solve(Run& run, bool relaxes) {
  MotionRow<V> body = wheels_.bodies().velocity[run.row];  // no wheel of a body stands on that body
  const V load = run.load, along = run.push_along, across = run.push_across;
  press(run, body, relaxes);
  grip(run, body);
  wheels_.bodies().velocity[run.row] = body;
  const V most = run.load * kSettled;
  return most < abs(run.load - load) || most < abs(run.push_along - along) || most < abs(run.push_across - across);
}

/// Rolls the wheel by its rim speed over the sub-step.
template <class S> void SuspensionRows<S>::roll(Run& run) const {
  constexpr S kTurn = S(6.28318530717958647692);
  const V fastest = convert<V>(min(Limits<S>::surface_speed(), Limits<S>::speed() + Limits<S>::speed()));
  const Run& leader = wheels_.runs()[run.leader];
  run.spin.rim = tracks_.leads(run) ? clamp(tracks_.end_of(run), -fastest, fastest) : leader.spin.rim;
  const S spin = divide_to<S>(run.spin.rim, wheels_.wheel(run).radius);
  run.angle += clamp(spin * wheels_.h(), -kTurn, kTurn);
  if (kTurn <= run.angle) run.angle -= kTurn;
  if (run.angle < S(0)) run.angle += kTurn;
}

/// [1] Returns the mean of the slip in this sub-step and the slip of the sub-steps before.
template <class S> S SuspensionRows<S>::slip_of(const Run& run) const {
  const S before = run.slip * S(0.5);
  if (!run.touches) return before;
  const MotionRow<V>& body = wheels_.bodies().velocity[run.row];
  const V along = speed_of(run, run.along, body), across = speed_of(run, run.across, body);
  return before + convert<S>(detail::tyre_slip(saturating_subtract(along, run.spin.rim), across, along)) * S(0.5);
}

template <class S> void SuspensionRows<S>::end(Run& run) const {
  if (!run.touches) run.load = run.push_along = run.push_across = V(0);
  roll(run);
  run.slip = slip_of(run);
}

}  // namespace isostep
