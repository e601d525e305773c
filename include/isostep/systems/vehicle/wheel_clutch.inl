// Bodies of vehicle_rows.hpp: an engine with inertia, and the clutch between it and the wheels.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/vehicle/vehicle_rows.hpp"

namespace isostep {

template <class S> void VehicleRows<S>::begin_engine(Group& group) const {
  const VehicleState<S>& was = state_.parts.vehicle_states[group.vehicle];
  group.engine = {};
  group.engine.inertia = vehicle(group).engine_inertia;
  group.engine.most = times(input(group).clutch, vehicle(group).clutch_torque);
  group.engine.spin = was.engine_spin;
  group.engine.clutch = was.clutch_load;
}

/// [rad/s] The engine's speed after a sub-step of that torque.
template <class S> S VehicleRows<S>::spun(const Engine& engine, S speed, S torque) const {
  const S change = divide_to<S>(saturate_to<S>(product(torque, h_)), engine.inertia);
  return clamp(saturating_add(speed, change), -fastest_engine<S>(), fastest_engine<S>());
}

/// Throttle turns the engine, and the clutch bears what it bore in the sub-step before.
template <class S> void VehicleRows<S>::turn_engine(Group& group) {
  Engine& engine = group.engine;
  const S torque = engine_torque(group, {engine.spin, divide_to<S>(S(1), engine.inertia)});
  const S before = group.geared ? clamp(engine.clutch, -engine.most, engine.most) : S(0);
  engine.free = spun(engine, engine.spin, torque);
  engine.clutch = S(0);
  bear(group, before);
}

/// The clutch bears that torque, in the whole sub-step: the engine loses it, the wheels get it.
template <class S> void VehicleRows<S>::bear(Group& group, S torque) {
  Engine& engine = group.engine;
  const S more = saturating_subtract(torque, engine.clutch);
  engine.clutch = torque;
  engine.spin = spun(engine, engine.free, -torque);
  push_shaft(group, more);
}

/// The torque that ends the clutch's slip, or the most that it bears against that.
/// Method:  a row of engine and shaft as the wheels and their tyres leave it, with what it bears in all held within
///          its bounds. It is solved in turn with the tyres, and begins with what it bore in the sub-step before.
template <class S> void VehicleRows<S>::engage(Group& group) {
  Engine& engine = group.engine;
  if (engine.inertia == S(0) || !group.geared) return;
  const Shaft shaft = shaft_of(group, [&](const Run& run) { return end_of(run); });
  if (!(S(0) < shaft.give)) return;
  const S give = saturating_add(shaft.give, divide_to<S>(S(1), engine.inertia));
  const S slip = saturating_subtract(engine.spin, shaft.speed);
  const S more = times(divide_to<S>(slip, give), S(rate_));
  bear(group, clamp(saturating_add(engine.clutch, more), -engine.most, engine.most));
}

/// Writes what engines do; a body whose engine's speed changes does not fall asleep.
template <class S> void VehicleRows<S>::end_engines() {
  constexpr S kChanging = S(0x1p-6);  // [rad/s] in a step
  for (const Group& group : groups_) {
    if (group.vehicle == kNone || group.engine.inertia == S(0)) continue;
    VehicleState<S>& state = state_.parts.vehicle_states[group.vehicle];
    const S change = saturating_subtract(group.engine.spin, state.engine_spin);
    if (kChanging < abs(change)) state_.awake.states[group.row - 1].sleep_clock = 0;
    state.engine_spin = group.engine.spin;
    state.clutch_load = group.engine.clutch;
    detail::keep_finite(state);
  }
}

}  // namespace isostep
