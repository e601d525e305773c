// Bodies of vehicle_rows.hpp: which wheels there are in a step, how they are steered, and the ground below them.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/dynamics/solver_name.hpp"
#include "isostep/geometry/shapes/sphere.hpp"
#include "isostep/systems/vehicle/vehicle_rows.hpp"

namespace isostep {

template <class S> void VehicleRows<S>::begin_step() {
  runs_.clear();
  groups_.clear();
  near_.clear();
  if (state_.records->wheels.all().empty()) return;
  list_runs();
  list_groups();
  for (Group& group : groups_) {
    join_tracks(group);
    gear_up(group);
    steer(group);
    join_bars(group);
    find_ground(group);
  }
  find_who_ends_early();
}

/// The wheels of awake bodies, sorted by body: counted, then placed.
template <class S> void VehicleRows<S>::list_runs() {
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
    groups_.push_back({row, first_[row], first_[row + 1], kNone, {}, 0, 0, false, {}, false, false, false});
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
    run.next = kNone;
    run.to_leader = run.side = S(1);
    run.inertia = w.inertia;
    run.slot = slot;
    run.row = row;
    run.partner = run.vehicle = kNone;
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

/// Whose wheels each group has, and the order in which a sweep takes them.
template <class S> void VehicleRows<S>::list_groups() {
  for (std::uint32_t g = 0; g < groups_.size(); ++g) {
    for (std::uint32_t i = groups_[g].first; i < groups_[g].end; ++i) runs_[i].group = g;
  }
  const std::vector<VehicleSettings<S>>& vehicles = state_.records->vehicles.all();
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
template <class S> auto VehicleRows<S>::group_of(std::uint32_t row) -> Group* {
  const std::uint32_t end = first_[row];
  const bool has = row != 0 && end != 0 && runs_[end - 1].row == row;
  return has ? &groups_[runs_[end - 1].group] : nullptr;
}

/// Neither those that stand on what moves, nor what they stand on, nor those that a differential's lock or a clutch
/// changes.
template <class S> void VehicleRows<S>::find_who_ends_early() {
  for (Group& group : groups_) {
    const bool locks = group.vehicle != kNone && S(0) < vehicle(group).differential_lock;
    group.ends_early = !locks && group.engine.inertia == S(0);
  }
  for (const Run& run : runs_) {
    if (run.ground == 0) continue;
    groups_[run.group].ends_early = false;
    if (Group* const below = group_of(run.ground)) below->ends_early = false;
  }
}

/// Of wheels with one number the first two.
template <class S> void VehicleRows<S>::join_bars(const Group& group) {
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    for (std::uint32_t j = i + 1; j < group.end && runs_[i].partner == kNone; ++j) {
      const WheelSettings<S>&a = wheel(runs_[i]), &b = wheel(runs_[j]);
      if (a.axle == 0 || a.axle != b.axle || runs_[j].partner != kNone) continue;
      runs_[i].partner = j;
      runs_[j].partner = i;
      runs_[i].anti_roll = runs_[j].anti_roll = max(a.anti_roll, b.anti_roll);
    }
  }
}

/// With d and x of a wheel before and beside the middle of those that are not steered, and the angle a of a wheel at
/// d: its axle points to the centre d / tan a beside that middle, for ackermann 1.
template <class S> void VehicleRows<S>::steer(const Group& group) {
  if (group.vehicle == kNone) return;
  const S turned = input(group).steer, ackermann = vehicle(group).ackermann;
  if (turned == S(0)) return;
  Vec3<S> sum = Vec3<S>::zero();
  int fixed = 0;
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    if (!(wheel(runs_[i]).steer_angle == S(0)) || fixed == 64) continue;
    sum += wheel(runs_[i]).hard_point * S(1.0 / 64);
    ++fixed;
  }
  const Vec3<S> middle = fixed == 0 ? sum : (sum / S(fixed)) * S(64);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const WheelSettings<S>& w = wheel(runs_[i]);
    if (w.steer_angle == S(0)) continue;
    const SinCos<U> a = sin_cos_to<U>(saturate_to<S>(product(turned, w.steer_angle)));
    const Vec3<U> forward = cross(w.suspension, w.axle_direction);
    const Vec3<S> from = fixed == 0 ? Vec3<S>::zero() : w.hard_point - middle;
    const S d = dot(from, forward), x = dot(from, w.axle_direction) * clamp(convert<U>(ackermann), U(0), U(1));
    const bool is_beside = abs(d) < Limits<S>::minimum_size();
    const S before = is_beside ? S(1) : abs(d), beside = is_beside ? S(0) : d < S(0) ? -x : x;
    const S towards = before * a.cos - beside * a.sin, against = before * a.sin;
    runs_[i].axle = normalise(w.axle_direction * towards - forward * against);
    runs_[i].steered = atan2_to<S>(against, towards);
  }
}

/// Whether parts of the two might collide.
template <class S> bool VehicleRows<S>::bears(std::uint32_t body, std::uint32_t ground) const {
  const BodyProperties<S>&a = state_.awake.properties[body - 1], &b = map_.properties_at(map_.location(ground));
  return (b.flags & body_flag::kCollide) != 0 && should_collide(a.filter, map_.filter_of(b));
}
/// The first that is not held from the start and is not too steep.
template <class S>
template <class Hits>
auto VehicleRows<S>::first_that_bears(const Hits& hits, Vec3<U> down) -> Ground {
  for (const auto& hit : hits) {
    if (!hit.inside && dot(hit.normal, down) <= U(-0.5)) return {hit.body, hit.child, hit.point, hit.normal};
  }
  return {};
}
template <class S> auto VehicleRows<S>::stance_of(const Run& run) const -> Stance {
  const BodyState<S>& state = state_.awake.states[run.row - 1];
  const Vec3<S> local = wheel(run).hard_point - state_.awake.properties[run.row - 1].local_centre;
  return {state.centre + rotate(state.orientation, local), rotate(state.orientation, wheel(run).suspension)};
}
template <class S> auto VehicleRows<S>::search_of(const Run& run, const Stance& at) const -> Search {
  const WheelSettings<S>& w = wheel(run);
  const S first = w.free_length - w.travel - w.radius, way = w.travel + w.radius + w.radius;
  const Vec3<S> start = at.hard_point + at.down * first, along = at.down * way;
  return {start, along, grow(Aabb<S>{min(start, start + along), max(start, start + along)}, w.radius)};
}
/// Adds what is there to what the wheels of a body might stand on.
template <class S> void VehicleRows<S>::look_around(Group& group, const Aabb<S>& box) {
  const BodyProperties<S>& body = state_.awake.properties[group.row - 1];
  QueryFilter filter;
  filter.mask = body.filter.mask;
  filter.group = body.filter.group;
  filter.ignore = wheel(runs_[group.first]).body;
  group.region = box;
  group.first_near = static_cast<std::uint32_t>(near_.size());
  queries_.find_near(box, filter, near_);
  std::size_t kept = group.first_near;
  for (std::size_t i = kept; i < near_.size(); ++i) {
    if (bears(group.row, near_[i])) near_[kept++] = near_[i];
  }
  near_.resize(kept);
  group.end_near = static_cast<std::uint32_t>(kept);
}
/// A sphere looks for it, and a ray where what the sphere meets is not level enough.
template <class S> auto VehicleRows<S>::ground_below(const Run& run, const Stance& at) -> Ground {
  const Search search = search_of(run, at);
  Group& group = groups_[run.group];
  if (!contains(group.region, search.box)) look_around(group, grow(search.box, wheel(run).radius));
  const auto nearby = std::span(near_).subspan(group.first_near, group.end_near - group.first_near);
  const Primitive<S> sphere = Sphere<S>{wheel(run).radius}.primitive();
  ShapeCastHit<S> met[kMostMet];
  const Filter& own = state_.awake.properties[run.row - 1].filter;
  const std::size_t count =
      queries_.cast_among(nearby, search.box, own, {sphere, {search.start, Quat<U>::identity()}, search.way},
                          std::span<ShapeCastHit<S>>(met));
  const Ground ground = first_that_bears(std::span(met, count), at.down);
  if (count == 0 || ground.body) return ground;
  RayCastHit<S> struck[kMostMet];
  const RayCast<S> ray = {search.start, search.way + at.down * wheel(run).radius};
  const std::size_t rays = queries_.ray_among(nearby, search.box, own, ray, std::span<RayCastHit<S>>(struck));
  return first_that_bears(std::span(struck, rays), at.down);
}
template <class S> void VehicleRows<S>::stand_on(Run& run, const Ground& ground) {
  run.met = ground.body;
  run.ground = 0;
  if (!ground.body) return;
  const Location at = map_.location(ground.body.slot);
  run.ground = map_.row_of(ground.body.slot);
  run.point = ground.point;
  run.ground_arm = ground.point - map_.state_at(at).centre;
  run.normal = ground.normal;
  const BodyProperties<S>& body = map_.properties_at(at);
  const S friction = map_.children_of(body.shape)[ground.child].traits.material_or(body.material).friction;
  run.mu_along = sqrt(saturate_to<S>(product(wheel(run).grip_along, friction)));
  run.mu_across = sqrt(saturate_to<S>(product(wheel(run).grip_across, friction)));
}

/// [m] Of the suspension, where the wheel touches that plane; free_length over no ground.
template <class S> S VehicleRows<S>::length_over(const Run& run, const Stance& at, const Ground& ground) const {
  const WheelSettings<S>& w = wheel(run);
  const U facing = ground.body ? -dot(at.down, ground.normal) : U(0);
  if (facing < kLeastFacing) return w.free_length;
  const S height = dot(at.hard_point - ground.point, ground.normal) - w.radius;
  return min(w.free_length, divide_to<S>(height, facing));
}
/// [m] How far it goes in this step, across the suspension; by its ground's motion if that is known.
template <class S> Vec3<S> VehicleRows<S>::way_of(const Run& run, const Stance& at) const {
  const BodyState<S>& state = state_.awake.states[run.row - 1];
  Vec3<V> speed = detail::velocity_at<S>(&state, at.hard_point - state.centre);
  if (run.ground != 0) speed -= detail::velocity_at<S>(&state_.awake.states[run.ground - 1], run.ground_arm);
  const Vec3<S> way = convert<S>(speed) / S(state_.settings.hz);
  return way - at.down * dot(way, at.down);
}
/// True if the plane found where the step begins is not that of the ground further on. A bump that is higher than a
/// 32nd of the radius is met by one of the looks at least, for a wheel is wider than it is long.
template <class S> bool VehicleRows<S>::is_uneven(const Run& run, const Stance& at, const Ground& ground) {
  const S radius = wheel(run).radius;
  const Vec3<S> way = way_of(run, at);
  const S distant = length(way);
  if (distant < radius * S(0.125)) return false;  // over an edge the plane errs by less than a 128th of the radius
  int looks = 1;
  while (looks < kMostLooks && radius * S(0.5) * S(looks) < distant) ++looks;
  for (int i = looks; i > 0; --i) {
    const Stance there = {at.hard_point + way * divide_to<U>(S(i), S(looks)), at.down};
    const S found = length_over(run, there, ground_below(run, there));
    if (radius * kLevel < abs(found - length_over(run, there, ground))) return true;
  }
  return false;
}
/// Below all wheels of a body, from one look around them.
template <class S> void VehicleRows<S>::find_ground(Group& group) {
  const std::span<Run> runs = std::span(runs_).subspan(group.first, group.end - group.first);
  const S edge = Limits<S>::position() * S(2);
  Aabb<S> region = {{edge, edge, edge}, {-edge, -edge, -edge}};
  for (const Run& run : runs) {
    const Stance at = stance_of(run);
    const Aabb<S> box = search_of(run, at).box;
    const Vec3<S> way = way_of(run, at);
    region = merge(region, merge(box, Aabb<S>{box.low + way, box.high + way}));
  }
  look_around(group, grow(region, kAround));
  for (Run& run : runs) {
    const Stance at = stance_of(run);
    const Ground ground = ground_below(run, at);
    run.length = wheel(run).free_length;
    stand_on(run, ground);
    run.uneven = is_uneven(run, at, ground);
  }
}
/// The ground where the wheel has got to, of those that need it.
template <class S> void VehicleRows<S>::follow_ground() {
  bool any = false;
  for (Run& run : runs_) {
    if (!run.uneven) continue;
    any = true;
    stand_on(run, ground_below(run, stance_of(run)));
    if (run.ground == 0) continue;
    const MotionRow<V>& moved = bodies_->displacement[run.ground];
    run.point -= convert<S>(moved.linear) + cross(convert<S>(moved.angular), run.ground_arm);
  }
  if (any) find_who_ends_early();
}

}  // namespace isostep
