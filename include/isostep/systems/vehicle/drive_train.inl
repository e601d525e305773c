// Bodies of drive_train.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/vehicle/drive_train.hpp"

namespace isostep {

/// [1] Returns the factor by which steering scales the drive of a track.
template <class S> S DriveTrain<S>::side_of(const Run& run, const Group& group) const {
  const WheelSettings<S>& w = wheels_.wheel(run);
  if (w.track == 0) return S(1);
  const S left = dot(w.hard_point - state_.awake.properties[run.row - 1].local_centre, w.axle_direction);
  const S steer = wheels_.input(group).steer;
  const bool is_inner = steer < S(0) ? left < S(0) : S(0) < left;
  return is_inner ? S(1) - detail::times(wheels_.vehicle(group).track_steer, abs(steer)) : S(1);
}
template <class S> void DriveTrain<S>::gear_up(Group& group) {
  if (group.vehicle == Run::kNone) return;
  const VehicleSettings<S>& set = wheels_.vehicle(group);
  S shares = S(0);
  for (const Run& run : wheels_.runs_of(group)) shares = saturating_add(shares, wheels_.wheel(run).drive_share);
  const S most = Limits<S>::mass_ratio();
  const S ratio = clamp(detail::times(set.gears[wheels_.input(group).gear], set.final_drive), -most, most);
  group.geared = S(0) < shares && !(ratio == S(0));
  begin_engine(group);
  for (Run& run : wheels_.runs_of(group)) {
    Run& leader = wheels_.runs()[run.leader];
    const S share = wheels_.wheel(run).drive_share;
    if (tracks_.leads(run)) run.side = side_of(run, group);
    leader.driven = leader.driven || S(0) < share;
    if (!group.geared) continue;
    const S part = detail::times(detail::times(divide_to<S>(share, shares), ratio), leader.side);
    leader.drive = tracks_.leads(run) ? part : saturating_add(leader.drive, detail::times(part, run.to_leader));
  }
}
template <class S> void DriveTrain<S>::begin_engine(Group& group) const {
  const VehicleState<S>& was = state_.parts.vehicle_states[group.vehicle];
  group.engine = {};
  group.engine.inertia = wheels_.vehicle(group).engine_inertia;
  group.engine.most = detail::times(wheels_.input(group).clutch, wheels_.vehicle(group).clutch_torque);
  group.engine.spin = was.engine_spin;
  group.engine.clutch = was.clutch_load;
}

/// Changes the speed of a rim by a torque over the sub-step.
template <class S> void DriveTrain<S>::turn(const Run& run, V& rim, S torque) const {
  const S rate = detail::times(torque, divide_to<S>(wheels_.wheel(run).radius, run.inertia));  // [m/s^2]
  rim = saturating_add(rim, saturate_to<V>(product(rate, wheels_.h())));
}

/// Sets the impulse that the brakes can apply.
template <class S> void DriveTrain<S>::set_brakes(const Group& group) {
  using detail::times;
  const VehicleSettings<S>& set = wheels_.vehicle(group);
  const VehicleInput<S>& asked = wheels_.input(group);
  for (const Run& run : wheels_.runs_of(group)) {
    const WheelSettings<S>& w = wheels_.wheel(run);
    const S torque = saturating_add(times(times(asked.brake, set.brake_torque), w.brake_share),
                                    times(times(asked.handbrake, set.handbrake_torque), w.handbrake_share));
    Run& leader = wheels_.runs()[run.leader];
    turn(leader, leader.spin.brake, tracks_.leads(run) ? torque : times(torque, run.to_leader));
  }
}

/// Returns the shaft for wheels with the rim speeds rim_of(run) [m/s].
template <class S>
template <class Rim>
auto DriveTrain<S>::shaft_of(const Group& group, const Rim& rim_of) const -> Shaft {
  Shaft shaft = {S(0), S(0)};
  for (const Run& run : wheels_.runs_of(group)) {
    if (!tracks_.leads(run)) continue;
    const S spin = divide_to<S>(rim_of(run), wheels_.wheel(run).radius);
    shaft.speed = saturating_add(shaft.speed, detail::times(run.drive, spin));
    shaft.give = saturating_add(shaft.give, divide_to<S>(detail::times(run.drive, run.drive), run.inertia));
  }
  return shaft;
}

/// Returns the torque of the throttle, or that which brings the shaft to engine_speed in the sub-step if it is less.
template <class S> S DriveTrain<S>::engine_torque(const Group& group, const Shaft& shaft) const {
  const VehicleSettings<S>& set = wheels_.vehicle(group);
  const S throttle = wheels_.input(group).throttle;
  const S asked = detail::times(throttle, set.engine_torque);
  const S end = throttle < S(0) ? -set.engine_speed : set.engine_speed;
  const S rest = saturating_subtract(end, shaft.speed);
  const S limit = S(0) < shaft.give ? detail::times(divide_to<S>(rest, shaft.give), wheels_.rate()) : asked;
  return throttle < S(0) ? min(S(0), max(asked, limit)) : max(S(0), min(asked, limit));
}

template <class S> void DriveTrain<S>::push_shaft(const Group& group, S torque) {
  for (Run& run : wheels_.runs_of(group)) {
    if (tracks_.leads(run)) turn(run, run.spin.rim, detail::times(torque, run.drive));
  }
}

template <class S> void DriveTrain<S>::drive(Group& group) {
  if (group.vehicle == Run::kNone) return;
  set_brakes(group);
  if (S(0) < group.engine.inertia) return turn_engine(group);
  if (!group.geared || wheels_.input(group).throttle == S(0)) return;
  push_shaft(group, engine_torque(group, shaft_of(group, [](const Run& run) { return run.spin.rim; })));
}

template <class S> void DriveTrain<S>::lock(const Group& group) {
  if (group.vehicle == Run::kNone) return;
  using detail::times;
  const S locked = wheels_.vehicle(group).differential_lock;
  if (!(S(0) < locked)) return;
  const auto is_driven = [&](const Run& run) { return tracks_.leads(run) && run.driven; };
  const auto speed_of = [&](const Run& run) { return divide_to<S>(tracks_.end_of(run), wheels_.wheel(run).radius); };
  S inertia = S(0), mean = S(0);
  for (const Run& run : wheels_.runs_of(group)) {
    if (is_driven(run)) inertia = saturating_add(inertia, times(times(run.side, run.side), run.inertia));
  }
  if (!(S(0) < inertia)) return;
  for (const Run& run : wheels_.runs_of(group)) {
    if (!is_driven(run)) continue;
    mean = saturating_add(mean, times(times(run.side, speed_of(run)), divide_to<S>(run.inertia, inertia)));
  }
  for (Run& run : wheels_.runs_of(group)) {
    if (!is_driven(run)) continue;
    const S change = times(locked, saturating_subtract(times(run.side, mean), speed_of(run)));
    run.spin.rim = saturating_add(run.spin.rim, saturate_to<V>(product(change, wheels_.wheel(run).radius)));
  }
}

/// [rad/s] Returns the engine's speed after a sub-step with that torque.
template <class S> S DriveTrain<S>::spun(const Engine& engine, S speed, S torque) const {
  const S change = divide_to<S>(saturate_to<S>(product(torque, wheels_.h())), engine.inertia);
  return clamp(saturating_add(speed, change), -fastest_engine<S>(), fastest_engine<S>());
}

/// Turns the engine by the throttle, and warm starts the clutch with its torque of the last sub-step.
template <class S> void DriveTrain<S>::turn_engine(Group& group) {
  Engine& engine = group.engine;
  const S torque = engine_torque(group, {engine.spin, divide_to<S>(S(1), engine.inertia)});
  const S before = group.geared ? clamp(engine.clutch, -engine.most, engine.most) : S(0);
  engine.free = spun(engine, engine.spin, torque);
  engine.clutch = S(0);
  bear(group, before);
}

/// Sets the torque that the clutch bears over the whole sub-step: the engine loses it, the wheels get it.
template <class S> void DriveTrain<S>::bear(Group& group, S torque) {
  Engine& engine = group.engine;
  const S more = saturating_subtract(torque, engine.clutch);
  engine.clutch = torque;
  engine.spin = spun(engine, engine.free, -torque);
  push_shaft(group, more);
}

/// Method:  a row between engine and shaft, with the wheels as their tyres leave them. Its total impulse stays within
///          its bounds. It is solved in turn with the tyres, and warm starts from the last sub-step.
template <class S> void DriveTrain<S>::engage(Group& group) {
  Engine& engine = group.engine;
  if (engine.inertia == S(0) || !group.geared) return;
  const Shaft shaft = shaft_of(group, [&](const Run& run) { return tracks_.end_of(run); });
  if (!(S(0) < shaft.give)) return;
  const S give = saturating_add(shaft.give, divide_to<S>(S(1), engine.inertia));
  const S slip = saturating_subtract(engine.spin, shaft.speed);
  const S more = detail::times(divide_to<S>(slip, give), wheels_.rate());
  bear(group, clamp(saturating_add(engine.clutch, more), -engine.most, engine.most));
}

/// Writes the engine states. A body whose engine changes speed does not fall asleep.
template <class S> void DriveTrain<S>::end_step() {
  constexpr S kChanging = S(0x1p-6);  // [rad/s] in a step
  for (const Group& group : wheels_.groups()) {
    if (group.vehicle == Run::kNone || group.engine.inertia == S(0)) continue;
    VehicleState<S>& state = state_.parts.vehicle_states[group.vehicle];
    const S change = saturating_subtract(group.engine.spin, state.engine_spin);
    if (kChanging < abs(change)) state_.awake.states[group.row - 1].sleep_clock = 0;
    state.engine_spin = group.engine.spin;
    state.clutch_load = group.engine.clutch;
    detail::keep_finite(state);
  }
}

}  // namespace isostep
