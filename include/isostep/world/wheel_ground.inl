// Bodies of wheel_forces.hpp: which wheels there are in a step, how they are steered, and the ground below them.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/dynamics/solver_name.hpp"
#include "isostep/geometry/shapes/sphere.hpp"
#include "isostep/world/wheel_forces.hpp"

namespace isostep {

template <class S> void WheelForces<S>::begin_step() {
  runs_.clear();
  groups_.clear();
  if (!any()) return;
  list_runs();
  list_groups();
  for (Group& group : groups_) {
    join_tracks(group);
    gear_up(group);
    steer(group);
    join_bars(group);
    for (std::uint32_t i = group.first; i < group.end; ++i) find_ground(runs_[i]);
  }
  find_who_ends_early();
}

/// The wheels of awake bodies, sorted by body: counted, then placed.
template <class S> void WheelForces<S>::list_runs() {
  const std::vector<Wheel<S>>& wheels = state_.force_records->wheels.all();
  first_.assign(state_.awake.states.size() + 2, 0);
  for (const Wheel<S>& w : wheels) {
    if (w.body) ++first_[map_.row_of(w.body.slot) + 1];
  }
  first_[1] = 0;  // row 0: what sleeps
  for (std::uint32_t row = 1; row < first_.size(); ++row) first_[row] += first_[row - 1];
  runs_.resize(first_.back());
  for (std::uint32_t row = 1; row + 1 < first_.size(); ++row) {
    if (first_[row] == first_[row + 1]) continue;
    groups_.push_back({row, first_[row], first_[row + 1], kNone, false, {}, false, false, false});
  }
  const Settings<S>& s = state_.settings;
  const S rate = S(integration_rate(s.solver, s.hz, s.substeps));
  for (std::uint32_t slot = 0; slot < wheels.size(); ++slot) {
    const std::uint32_t row = wheels[slot].body ? map_.row_of(wheels[slot].body.slot) : 0;
    if (row == 0) continue;
    const Wheel<S>& w = wheels[slot];
    Run& run = runs_[first_[row]];
    run = {};
    run.leader = first_[row]++;
    run.next = kNone;
    run.to_leader = run.side = S(1);
    run.inertia = w.inertia;
    run.slot = slot;
    run.row = row;
    run.partner = run.vehicle = kNone;
    run.axle = w.axle_direction;
    run.angle = w.angle;
    run.slip = w.slip;
    const S mass = state_.awake.properties[row - 1].mass;
    run.spin.give = detail::rim_give(mass, w.radius, w.inertia);
    run.spin.rim = saturate_to<V>(product(w.spin, w.radius));
    const auto warm = [&](S force) {
      return divide_to<V>(divide_to<S>(force, mass), rate);
    };
    run.load = warm(w.load);
    run.push_along = warm(w.along);
    run.push_across = warm(w.across);
  }
}

/// Whose wheels each group has, and the order in which an iteration takes them.
template <class S> void WheelForces<S>::list_groups() {
  for (std::uint32_t g = 0; g < groups_.size(); ++g) {
    for (std::uint32_t i = groups_[g].first; i < groups_[g].end; ++i) runs_[i].group = g;
  }
  const std::vector<Vehicle<S>>& vehicles = state_.force_records->vehicles.all();
  for (std::uint32_t slot = 0; slot < vehicles.size(); ++slot) {
    const std::uint32_t row = vehicles[slot].body ? map_.row_of(vehicles[slot].body.slot) : 0;
    Group* const group = group_of(row);
    if (group == nullptr) continue;
    group->vehicle = slot;
    for (std::uint32_t i = group->first; i < group->end; ++i) runs_[i].vehicle = slot;
  }
  order_.clear();
  for (std::uint32_t wheel = 0; order_.size() < runs_.size(); ++wheel) {
    for (const Group& group : groups_) {
      if (group.first + wheel < group.end) order_.push_back(group.first + wheel);
    }
  }
}
/// Null: the body of that row has no wheels. By now first_ tells where its wheels end.
template <class S> auto WheelForces<S>::group_of(std::uint32_t row) -> Group* {
  const std::uint32_t end = first_[row];
  const bool has = row != 0 && end != 0 && runs_[end - 1].row == row;
  return has ? &groups_[runs_[end - 1].group] : nullptr;
}

/// Neither those that stand on what moves, nor what they stand on, nor those that a differential's lock or a clutch
/// changes.
template <class S> void WheelForces<S>::find_who_ends_early() {
  for (Group& group : groups_) {
    const bool locks = group.vehicle != kNone &&
                       S(0) < state_.force_records->vehicles.all()[group.vehicle].differential_lock;
    group.ends_early = !locks && group.engine.inertia == S(0);
  }
  for (const Run& run : runs_) {
    if (run.ground == 0) continue;
    groups_[run.group].ends_early = false;
    if (Group* const below = group_of(run.ground)) below->ends_early = false;
  }
}

/// Of wheels with one number the first two.
template <class S> void WheelForces<S>::join_bars(const Group& group) {
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    for (std::uint32_t j = i + 1; j < group.end && runs_[i].partner == kNone; ++j) {
      const Wheel<S>&a = wheel(runs_[i]), &b = wheel(runs_[j]);
      if (a.axle == 0 || a.axle != b.axle || runs_[j].partner != kNone) continue;
      runs_[i].partner = j;
      runs_[j].partner = i;
      runs_[i].anti_roll = runs_[j].anti_roll = max(a.anti_roll, b.anti_roll);
    }
  }
}

/// With d and x of a wheel before and beside the middle of those that are not steered, and the angle a of a wheel at
/// d: its axle points to the centre d / tan a beside that middle, for ackermann 1.
template <class S> void WheelForces<S>::steer(const Group& group) {
  if (group.vehicle == kNone) return;
  const Vehicle<S>& vehicle = state_.force_records->vehicles.all()[group.vehicle];
  if (vehicle.steer == S(0)) return;
  Vec3<S> sum = Vec3<S>::zero();
  int fixed = 0;
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    if (!(wheel(runs_[i]).steer_angle == S(0)) || fixed == 64) continue;
    sum += wheel(runs_[i]).hard_point * S(1.0 / 64);
    ++fixed;
  }
  const Vec3<S> middle = fixed == 0 ? sum : (sum / S(fixed)) * S(64);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const Wheel<S>& w = wheel(runs_[i]);
    if (w.steer_angle == S(0)) continue;
    const SinCos<U> a = sin_cos_to<U>(saturate_to<S>(product(vehicle.steer, w.steer_angle)));
    const Vec3<U> forward = cross(w.suspension, w.axle_direction);
    const Vec3<S> from = fixed == 0 ? Vec3<S>::zero() : w.hard_point - middle;
    const S d = dot(from, forward), x = dot(from, w.axle_direction) * clamp(convert<U>(vehicle.ackermann), U(0), U(1));
    const bool is_beside = abs(d) < Limits<S>::minimum_size();
    const S before = is_beside ? S(1) : abs(d), beside = is_beside ? S(0) : d < S(0) ? -x : x;
    const S towards = before * a.cos - beside * a.sin, against = before * a.sin;
    runs_[i].axle = normalise(w.axle_direction * towards - forward * against);
    runs_[i].steered = atan2_to<S>(against, towards);
  }
}

/// Whether the two would collide.
template <class S> bool WheelForces<S>::bears(std::uint32_t body, BodyId ground) const {
  const BodyProperties<S>&a = state_.awake.properties[body - 1], &b = *map_.properties_of(ground);
  return (b.flags & body_flag::kCollide) != 0 && should_collide(a.filter, b.filter);
}
/// The first that bears, is not held from the start and is not too steep.
template <class S>
template <class Hits>
bool WheelForces<S>::take_ground(Run& run, const Hits& hits, std::size_t count, Vec3<U> down) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto& hit = hits[i];
    if (hit.inside || !bears(run.row, hit.body) || U(-0.5) < dot(hit.normal, down)) continue;
    const Location at = map_.location(hit.body.slot);
    run.met = hit.body;
    run.ground = map_.row_of(hit.body.slot);
    run.point = hit.point;
    run.ground_arm = hit.point - map_.state_at(at).centre;
    run.normal = hit.normal;
    const S friction = map_.properties_at(at).material.friction;
    run.mu_along = sqrt(saturate_to<S>(product(wheel(run).grip_along, friction)));
    run.mu_across = sqrt(saturate_to<S>(product(wheel(run).grip_across, friction)));
    return true;
  }
  return false;
}
template <class S> void WheelForces<S>::find_ground(Run& run) {
  const Wheel<S>& w = wheel(run);
  const BodyState<S>& state = state_.awake.states[run.row - 1];
  const BodyProperties<S>& body = state_.awake.properties[run.row - 1];
  const Vec3<S> hard_point = state.centre + rotate(state.orientation, w.hard_point - body.local_centre);
  const Vec3<U> down = rotate(state.orientation, w.suspension);
  // From a radius above the highest to a radius below the lowest that the wheel's middle gets.
  const S first = w.free_length - w.travel - w.radius, way = w.travel + w.radius + w.radius;
  const Vec3<S> start = hard_point + down * first;
  QueryFilter filter;
  filter.mask = body.filter.mask;
  filter.group = body.filter.group;
  filter.ignore = w.body;
  const ShapeCast<S> cast = {Sphere<S>{w.radius}.primitive(), {start, Quat<U>::identity()}, down * way, filter};
  ShapeCastHit<S> met[kMostMet];
  const std::size_t count = queries_.cast_shape_all(cast, std::span<ShapeCastHit<S>>(met));
  run.length = w.free_length;
  if (count == 0 || take_ground(run, met, count, down)) return;
  RayCastHit<S> struck[kMostMet];
  take_ground(run, struck,
              queries_.cast_ray_all(start, down * (way + w.radius), std::span<RayCastHit<S>>(struck), filter), down);
}

}  // namespace isostep
