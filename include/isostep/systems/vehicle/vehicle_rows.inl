// Bodies of vehicle_rows.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/vehicle/drive_train.inl"
#include "isostep/systems/vehicle/step_wheels.inl"
#include "isostep/systems/vehicle/suspension_rows.inl"
#include "isostep/systems/vehicle/vehicle_rows.hpp"
#include "isostep/systems/vehicle/wheel_ground.inl"
#include "isostep/systems/vehicle/wheel_tracks.inl"

namespace isostep {

template <class S> void VehicleRows<S>::begin_step() {
  wheels_.list();
  ground_.begin_step();
  for (Group& group : wheels_.groups()) {
    tracks_.join(group);
    train_.gear_up(group);
    ground_.find(group);
  }
  wheels_.find_who_ends_early();
}

template <class S> void VehicleRows<S>::place(SolverBodies<S>& bodies, std::int32_t rate) {
  wheels_.begin_substep(bodies, rate);
  suspension_.begin_substep();
  if (ground_.follow()) wheels_.find_who_ends_early();
  for (Group& group : wheels_.groups()) {
    const Mat3<Unit<S>> turn = to_matrix(state_.awake.states[group.row - 1].orientation);
    for (Run& run : wheels_.runs_of(group)) suspension_.place(run, turn);
    train_.drive(group);
  }
}

/// Solves wheels. A group that ends early is done once a sweep changes nothing, since only its own wheels move it.
template <class S> void VehicleRows<S>::solve(int sweeps) {
  for (int i = 0; i < sweeps; ++i) {
    for (Group& group : wheels_.groups()) group.done = i > 0 && group.ends_early && !group.changed;
    sweep(false);
  }
}
/// Relaxes the groups that closed an error by speed, which only the end of travel does. The others are solved already.
template <class S> void VehicleRows<S>::relax() {
  bool any = false;
  for (Group& group : wheels_.groups()) {
    group.done = !closes_errors(group);
    any = any || !group.done;
  }
  if (any) sweep(true);
}
template <class S> bool VehicleRows<S>::closes_errors(const Group& group) {
  for (const Run& run : wheels_.runs_of(group)) {
    if (run.touches && V(0) < run.strut.stop) return true;
  }
  return false;
}
/// Solves all groups that are not done, once.
template <class S> void VehicleRows<S>::sweep(bool relaxes) {
  for (Group& group : wheels_.groups()) {
    if (group.done) continue;
    group.changed = false;
    train_.lock(group);
    train_.engage(group);
  }
  for (const std::uint32_t r : wheels_.order()) {
    Run& run = wheels_.runs()[r];
    Group& group = wheels_.groups()[run.group];
    if (!group.done && run.touches) group.changed |= suspension_.solve(run, relaxes);
  }
}

template <class S> void VehicleRows<S>::end() {
  for (Run& run : wheels_.runs()) suspension_.end(run);
}

template <class S> void VehicleRows<S>::end_step() {
  train_.end_step();
  for (const Run& run : wheels_.runs()) write(run);
}
/// Writes the state of a wheel. A body with a turning wheel does not fall asleep.
template <class S> void VehicleRows<S>::write(const Run& run) {
  WheelState<S>& w = state_.parts.wheel_states[run.slot];
  const S mass = state_.awake.properties[run.row - 1].mass;
  const auto force = [&](V impulse) {
    return saturate_to<S>(product(mass, saturate_to<S>(product(impulse, wheels_.rate()))));
  };
  w.spin = divide_to<S>(run.spin.rim, wheels_.wheel(run).radius);
  w.angle = run.angle;
  w.steered = run.steered;
  w.length = run.length;
  w.slip = run.slip;
  w.contact_body = run.touches ? run.met : BodyId{};
  w.contact_normal = run.touches ? run.normal : Vec3<Unit<S>>::zero();
  w.contact_point = run.touches ? run.at : Vec3<S>::zero();
  w.load = force(run.load);
  w.along = force(run.push_along);
  w.across = force(run.push_across);
  detail::keep_finite(w);
  constexpr V kTurning = V(0.05);
  if (kTurning < abs(run.spin.rim)) state_.awake.states[run.row - 1].sleep_clock = 0;
}

}  // namespace isostep
