// Bodies of step_wheels.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solver_name.hpp"
#include "isostep/systems/vehicle/step_wheels.hpp"

namespace isostep {

template <class S> void StepWheels<S>::list() {
  runs_.clear();
  groups_.clear();
  if (state_.records->wheels.all().empty()) return;
  list_runs();
  list_groups();
  for (const Group& group : groups_) {
    steer(group);
    join_bars(group);
  }
}

/// Lists the wheels of awake bodies, sorted by body: counts them, then places them.
template <class S> void StepWheels<S>::list_runs() {
  const std::vector<WheelSettings<S>>& wheels = state_.records->wheels.all();
  first_.assign(state_.awake.states.size() + 2, 0);
  for (const WheelSettings<S>& w : wheels) {
    if (w.body) ++first_[map_.row_of(w.body.slot) + 1];
  }
  first_[1] = 0;  // row 0: what sleeps
  for (std::uint32_t row = 1; row < first_.size(); ++row) first_[row] += first_[row - 1];
  runs_.resize(first_.back());
  for (std::uint32_t row = 1; row + 1 < first_.size(); ++row) {
    if (first_[row] == first_[row + 1]) continue;
    groups_.push_back({row, first_[row], first_[row + 1], Run::kNone, {}, 0, 0, false, {}, false, false, false});
  }
  const Settings<S>& s = state_.settings;
  const S rate = S(integration_rate(s.solver, s.hz, s.substeps));
  for (std::uint32_t slot = 0; slot < wheels.size(); ++slot) {
    const std::uint32_t row = wheels[slot].body ? map_.row_of(wheels[slot].body.slot) : 0;
    if (row == 0) continue;
    const WheelSettings<S>& w = wheels[slot];
    const WheelState<S>& was = state_.parts.wheel_states[slot];
    Run& run = runs_[first_[row]];
    run = {};
    run.leader = first_[row]++;
    run.next = Run::kNone;
    run.to_leader = run.side = S(1);
    run.inertia = w.inertia;
    run.slot = slot;
    run.row = row;
    run.partner = run.vehicle = Run::kNone;
    run.axle = w.axle_direction;
    run.angle = was.angle;
    run.slip = was.slip;
    const S mass = state_.awake.properties[row - 1].mass;
    run.spin.give = detail::rim_give(mass, w.radius, w.inertia);
    run.spin.rim = saturate_to<V>(product(was.spin, w.radius));
    const auto warm = [&](S force) { return divide_to<V>(divide_to<S>(force, mass), rate); };
    run.load = warm(was.load);
    run.push_along = warm(was.along);
    run.push_across = warm(was.across);
  }
}

/// Assigns wheels and vehicles to groups, and finds the order in which a sweep solves them.
template <class S> void StepWheels<S>::list_groups() {
  for (std::uint32_t g = 0; g < groups_.size(); ++g) {
    for (Run& run : runs_of(groups_[g])) run.group = g;
  }
  const std::vector<VehicleSettings<S>>& vehicles = state_.records->vehicles.all();
  for (std::uint32_t slot = 0; slot < vehicles.size(); ++slot) {
    const std::uint32_t row = vehicles[slot].body ? map_.row_of(vehicles[slot].body.slot) : 0;
    Group* const group = group_of(row);
    if (group == nullptr) continue;
    group->vehicle = slot;
    for (Run& run : runs_of(*group)) run.vehicle = slot;
  }
  order_.clear();
  for (std::uint32_t wheel = 0; order_.size() < runs_.size(); ++wheel) {
    for (const Group& group : groups_) {
      if (group.first + wheel < group.end) order_.push_back(group.first + wheel);
    }
  }
}
/// Returns the group of a row's body, or null if it has no wheels. By now first_ holds the ends of the bodies' wheels.
template <class S> auto StepWheels<S>::group_of(std::uint32_t row) -> Group* {
  const std::uint32_t end = first_[row];
  const bool has = row != 0 && end != 0 && runs_[end - 1].row == row;
  return has ? &groups_[runs_[end - 1].group] : nullptr;
}

/// Marks groups of which only the own wheels change the result: not groups on moving ground, nor their ground, nor
/// those with a differential lock or a clutch.
template <class S> void StepWheels<S>::find_who_ends_early() {
  for (Group& group : groups_) {
    const bool locks = group.vehicle != Run::kNone && S(0) < vehicle(group).differential_lock;
    group.ends_early = !locks && group.engine.inertia == S(0);
  }
  for (const Run& run : runs_) {
    if (run.ground == 0) continue;
    groups_[run.group].ends_early = false;
    if (Group* const below = group_of(run.ground)) below->ends_early = false;
  }
}

/// Pairs the wheels of an axle by its anti-roll bar: the first two with its number.
template <class S> void StepWheels<S>::join_bars(const Group& group) {
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    for (std::uint32_t j = i + 1; j < group.end && runs_[i].partner == Run::kNone; ++j) {
      const WheelSettings<S>&a = wheel(runs_[i]), &b = wheel(runs_[j]);
      if (a.axle == 0 || a.axle != b.axle || runs_[j].partner != Run::kNone) continue;
      runs_[i].partner = j;
      runs_[j].partner = i;
      runs_[i].anti_roll = runs_[j].anti_roll = max(a.anti_roll, b.anti_roll);
    }
  }
}

/// Steers wheels. A wheel lies d before and x beside the middle of the unsteered ones. For ackermann 1 its axle points
/// to the centre, d / tan a beside that middle, where a is the angle of a wheel at d with x = 0.
template <class S> void StepWheels<S>::steer(const Group& group) {
  if (group.vehicle == Run::kNone) return;
  const S turned = input(group).steer, ackermann = vehicle(group).ackermann;
  if (turned == S(0)) return;
  Vec3<S> sum = Vec3<S>::zero();
  int fixed = 0;
  for (const Run& run : runs_of(group)) {
    if (!(wheel(run).steer_angle == S(0)) || fixed == 64) continue;
    sum += wheel(run).hard_point * S(1.0 / 64);
    ++fixed;
  }
  const Vec3<S> middle = fixed == 0 ? sum : (sum / S(fixed)) * S(64);
  for (Run& run : runs_of(group)) {
    const WheelSettings<S>& w = wheel(run);
    if (w.steer_angle == S(0)) continue;
    const SinCos<U> a = sin_cos_to<U>(saturate_to<S>(product(turned, w.steer_angle)));
    const Vec3<U> forward = cross(w.suspension, w.axle_direction);
    const Vec3<S> from = fixed == 0 ? Vec3<S>::zero() : w.hard_point - middle;
    const S d = dot(from, forward), x = dot(from, w.axle_direction) * clamp(convert<U>(ackermann), U(0), U(1));
    const bool is_beside = abs(d) < Limits<S>::minimum_size();
    const S before = is_beside ? S(1) : abs(d), beside = is_beside ? S(0) : d < S(0) ? -x : x;
    const S towards = before * a.cos - beside * a.sin, against = before * a.sin;
    run.axle = normalise(w.axle_direction * towards - forward * against);
    run.steered = atan2_to<S>(against, towards);
  }
}

}  // namespace isostep
