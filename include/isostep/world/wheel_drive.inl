// Bodies of wheel_forces.hpp: engine, differential and brakes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/wheel_forces.hpp"

namespace isostep {

/// The rim's change of speed by a torque in a sub-step.
template <class S> void WheelForces<S>::turn(const Run& run, V& rim, S torque) const {
  const Wheel<S>& w = wheel(run);
  const S rate = saturate_to<S>(product(torque, divide_to<S>(w.radius, w.inertia)));  // [m/s^2]
  rim = saturating_add(rim, saturate_to<V>(product(rate, h_)));
}

/// Torque on the driven wheels, and how much the brakes can do. The engine's torque is what brings its shaft to
/// engine_speed within the sub-step, where that is less.
template <class S> void WheelForces<S>::drive(const Group& group) {
  if (group.vehicle == kNone) return;
  const Vehicle<S>& vehicle = state_.force_records->vehicles.all()[group.vehicle];
  const auto times = [](S a, S b) { return saturate_to<S>(product(a, b)); };
  S shares = S(0);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Wheel<S>& w = wheel(runs_[i]);
    shares = saturating_add(shares, w.drive_share);
    runs_[i].spin.brake = V(0);
    turn(runs_[i], runs_[i].spin.brake,
         saturating_add(times(times(vehicle.brake, vehicle.brake_torque), w.brake_share),
                        times(times(vehicle.handbrake, vehicle.handbrake_torque), w.handbrake_share)));
  }
  const S ratio = times(vehicle.gears[vehicle.gear], vehicle.final_drive);
  if (!(S(0) < shares) || ratio == S(0) || vehicle.throttle == S(0)) return;
  S speed = S(0), give = S(0);  // of the engine's shaft [rad/s]; [1 / kg m^2]
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Wheel<S>& w = wheel(runs_[i]);
    const S part = times(divide_to<S>(w.drive_share, shares), ratio);
    speed = saturating_add(speed, times(part, divide_to<S>(runs_[i].spin.rim, w.radius)));
    give = saturating_add(give, divide_to<S>(times(part, part), w.inertia));
  }
  const S asked = times(vehicle.throttle, vehicle.engine_torque);
  const S end = vehicle.throttle < S(0) ? -vehicle.engine_speed : vehicle.engine_speed;
  const S rest = saturating_add(end, -speed);
  const S limit = S(0) < give ? times(divide_to<S>(rest, give), S(rate_)) : asked;
  const S torque = vehicle.throttle < S(0) ? min(S(0), max(asked, limit)) : max(S(0), min(asked, limit));
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const S part = times(divide_to<S>(wheel(runs_[i]).drive_share, shares), ratio);
    turn(runs_[i], runs_[i].spin.rim, times(torque, part));
  }
}

/// Takes of the driven wheels' differences in speed; what they have together stays.
template <class S> void WheelForces<S>::lock(const Group& group) {
  if (group.vehicle == kNone) return;
  const S locked = state_.force_records->vehicles.all()[group.vehicle].differential_lock;
  if (!(S(0) < locked)) return;
  const auto speed_of = [&](const Run& run) {
    const V rim = run.touches ? run.spin.after(run.push_along) : run.spin.after(V(0));
    return divide_to<S>(rim, wheel(run).radius);
  };
  S inertia = S(0), mean = S(0);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Wheel<S>& w = wheel(runs_[i]);
    if (S(0) < w.drive_share) inertia = saturating_add(inertia, w.inertia);
  }
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Wheel<S>& w = wheel(runs_[i]);
    if (S(0) < w.drive_share)
      mean = saturating_add(mean, saturate_to<S>(product(speed_of(runs_[i]), divide_to<S>(w.inertia, inertia))));
  }
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Wheel<S>& w = wheel(runs_[i]);
    if (!(S(0) < w.drive_share)) continue;
    const S change = saturate_to<S>(product(locked, saturating_add(mean, -speed_of(runs_[i]))));
    runs_[i].spin.rim = saturating_add(runs_[i].spin.rim, saturate_to<V>(product(change, w.radius)));
  }
}

}  // namespace isostep
