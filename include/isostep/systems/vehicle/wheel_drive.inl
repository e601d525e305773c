// Bodies of vehicle_rows.hpp: engine, differential and brakes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/vehicle/vehicle_rows.hpp"

namespace isostep {

/// The rim's change of speed by a torque in a sub-step.
template <class S> void VehicleRows<S>::turn(const Run& run, V& rim, S torque) const {
  const S rate = times(torque, divide_to<S>(wheel(run).radius, run.inertia));  // [m/s^2]
  rim = saturating_add(rim, saturate_to<V>(product(rate, h_)));
}

/// How much the brakes can do.
template <class S> void VehicleRows<S>::set_brakes(const Group& group) {
  const VehicleSettings<S>& set = vehicle(group);
  const VehicleInput<S>& asked = input(group);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const WheelSettings<S>& w = wheel(runs_[i]);
    const S torque = saturating_add(times(times(asked.brake, set.brake_torque), w.brake_share),
                                    times(times(asked.handbrake, set.handbrake_torque), w.handbrake_share));
    Run& leader = runs_[runs_[i].leader];
    turn(leader, leader.spin.brake, leads(runs_[i]) ? torque : times(torque, runs_[i].to_leader));
  }
}

/// With rims of that speed: rim_of(run) [m/s].
template <class S>
template <class Rim>
auto VehicleRows<S>::shaft_of(const Group& group, const Rim& rim_of) const -> Shaft {
  Shaft shaft = {S(0), S(0)};
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Run& run = runs_[i];
    if (!leads(run)) continue;
    const S spin = divide_to<S>(rim_of(run), wheel(run).radius);
    shaft.speed = saturating_add(shaft.speed, times(run.drive, spin));
    shaft.give = saturating_add(shaft.give, divide_to<S>(times(run.drive, run.drive), run.inertia));
  }
  return shaft;
}

/// What throttle asks for, or what brings the shaft to engine_speed within the sub-step, where that is less.
template <class S> S VehicleRows<S>::engine_torque(const Group& group, const Shaft& shaft) const {
  const VehicleSettings<S>& set = vehicle(group);
  const S throttle = input(group).throttle;
  const S asked = times(throttle, set.engine_torque);
  const S end = throttle < S(0) ? -set.engine_speed : set.engine_speed;
  const S rest = saturating_subtract(end, shaft.speed);
  const S limit = S(0) < shaft.give ? times(divide_to<S>(rest, shaft.give), S(rate_)) : asked;
  return throttle < S(0) ? min(S(0), max(asked, limit)) : max(S(0), min(asked, limit));
}

template <class S> void VehicleRows<S>::push_shaft(const Group& group, S torque) {
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    Run& run = runs_[i];
    if (leads(run)) turn(run, run.spin.rim, times(torque, run.drive));
  }
}

/// Torque on the driven wheels or on the engine, and brakes.
template <class S> void VehicleRows<S>::drive(Group& group) {
  if (group.vehicle == kNone) return;
  set_brakes(group);
  if (S(0) < group.engine.inertia) return turn_engine(group);
  if (!group.geared || input(group).throttle == S(0)) return;
  push_shaft(group, engine_torque(group, shaft_of(group, [](const Run& run) { return run.spin.rim; })));
}

/// Takes of the differences in speed of driven wheels and tracks; the torque that does it acts between them, and what
/// steering does not gear otherwise keeps what it turns with together.
template <class S> void VehicleRows<S>::lock(const Group& group) {
  if (group.vehicle == kNone) return;
  const S locked = vehicle(group).differential_lock;
  if (!(S(0) < locked)) return;
  const auto is_driven = [&](const Run& run) { return leads(run) && run.driven; };
  const auto speed_of = [&](const Run& run) { return divide_to<S>(end_of(run), wheel(run).radius); };
  S inertia = S(0), mean = S(0);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Run& run = runs_[i];
    if (is_driven(run)) inertia = saturating_add(inertia, times(times(run.side, run.side), run.inertia));
  }
  if (!(S(0) < inertia)) return;
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Run& run = runs_[i];
    if (!is_driven(run)) continue;
    mean = saturating_add(mean, times(times(run.side, speed_of(run)), divide_to<S>(run.inertia, inertia)));
  }
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    Run& run = runs_[i];
    if (!is_driven(run)) continue;
    const S change = times(locked, saturating_subtract(times(run.side, mean), speed_of(run)));
    run.spin.rim = saturating_add(run.spin.rim, saturate_to<V>(product(change, wheel(run).radius)));
  }
}

}  // namespace isostep
