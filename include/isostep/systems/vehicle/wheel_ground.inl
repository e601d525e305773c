// Bodies of wheel_ground.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/sphere.hpp"
#include "isostep/systems/vehicle/wheel_ground.hpp"

namespace isostep {

/// Returns true if parts of the two bodies may collide.
template <class S> bool WheelGround<S>::bears(std::uint32_t body, std::uint32_t ground) const {
  const BodyProperties<S>&a = state_.awake.properties[body - 1], &b = map_.properties_at(map_.location(ground));
  return (b.flags & body_flag::kCollide) != 0 && should_collide(a.filter, map_.shapes.filter_of(b));
}
/// Returns the first hit that is not inside at the start and not too steep.
template <class S>
template <class Hits>
auto WheelGround<S>::first_that_bears(const Hits& hits, Vec3<U> down) -> Ground {
  for (const auto& hit : hits) {
    if (!hit.inside && dot(hit.normal, down) <= U(-0.5)) return {hit.body, hit.child, hit.point, hit.normal};
  }
  return {};
}
template <class S> auto WheelGround<S>::stance_of(const Run& run) const -> Stance {
  const BodyState<S>& state = state_.awake.states[run.row - 1];
  const Vec3<S> local = wheels_.wheel(run).hard_point - state_.awake.properties[run.row - 1].local_centre;
  return {state.centre + rotate(state.orientation, local), rotate(state.orientation, wheels_.wheel(run).suspension)};
}
template <class S> auto WheelGround<S>::search_of(const Run& run, const Stance& at) const -> Search {
  const WheelSettings<S>& w = wheels_.wheel(run);
  const S first = w.free_length - w.travel - w.radius, way = w.travel + w.radius + w.radius;
  const Vec3<S> start = at.hard_point + at.down * first, along = at.down * way;
  return {start, along, grow(Aabb<S>{min(start, start + along), max(start, start + along)}, w.radius)};
}
/// Lists the bodies in a box on which the wheels of a body might stand.
template <class S> void WheelGround<S>::look_around(Group& group, const Aabb<S>& box) {
  const BodyProperties<S>& body = state_.awake.properties[group.row - 1];
  QueryFilter filter;
  filter.mask = body.filter.mask;
  filter.group = body.filter.group;
  filter.ignore = wheels_.wheel(wheels_.runs()[group.first]).body;
  group.region = box;
  group.first_near = static_cast<std::uint32_t>(near_.size());
  casts_.find_near(box, filter, near_);
  std::size_t kept = group.first_near;
  for (std::size_t i = kept; i < near_.size(); ++i) {
    if (bears(group.row, near_[i])) near_[kept++] = near_[i];
  }
  near_.resize(kept);
  group.end_near = static_cast<std::uint32_t>(kept);
}
/// Finds ground with a sphere, and with a ray if the sphere hits nothing level enough.
template <class S> auto WheelGround<S>::ground_below(const Run& run, const Stance& at) -> Ground {
  const Search search = search_of(run, at);
  Group& group = wheels_.groups()[run.group];
  if (!contains(group.region, search.box)) look_around(group, grow(search.box, wheels_.wheel(run).radius));
  const auto nearby = std::span(near_).subspan(group.first_near, group.end_near - group.first_near);
  const Primitive<S> sphere = Sphere<S>{wheels_.wheel(run).radius}.primitive();
  ShapeCastHit<S> met[kMostMet];
  const Filter& own = state_.awake.properties[run.row - 1].filter;
  const std::size_t count =
      casts_.cast_among(nearby, search.box, own, {sphere, {search.start, Quat<U>::identity()}, search.way},
                        std::span<ShapeCastHit<S>>(met));
  const Ground ground = first_that_bears(std::span(met, count), at.down);
  if (count == 0 || ground.body) return ground;
  RayCastHit<S> struck[kMostMet];
  const RayCast<S> ray = {search.start, search.way + at.down * wheels_.wheel(run).radius};
  const std::size_t rays = casts_.ray_among(nearby, search.box, own, ray, std::span<RayCastHit<S>>(struck));
  return first_that_bears(std::span(struck, rays), at.down);
}
template <class S> void WheelGround<S>::stand_on(Run& run, const Ground& ground) {
  run.met = ground.body;
  run.ground = 0;
  if (!ground.body) return;
  const Location at = map_.location(ground.body.slot);
  run.ground = map_.row_of(ground.body.slot);
  run.point = ground.point;
  run.ground_arm = ground.point - map_.state_at(at).centre;
  run.normal = ground.normal;
  const BodyProperties<S>& body = map_.properties_at(at);
  const S friction = map_.shapes.children_of(body.shape)[ground.child].traits.material_or(body.material).friction;
  run.mu_along = sqrt(saturate_to<S>(product(wheels_.wheel(run).grip_along, friction)));
  run.mu_across = sqrt(saturate_to<S>(product(wheels_.wheel(run).grip_across, friction)));
}

/// [m] Returns the length of the suspension with the wheel on that plane, or free_length without ground.
template <class S> S WheelGround<S>::length_over(const Run& run, const Stance& at, const Ground& ground) const {
  const WheelSettings<S>& w = wheels_.wheel(run);
  const U facing = ground.body ? -dot(at.down, ground.normal) : U(0);
  if (facing < detail::kLeastFacing<U>) return w.free_length;
  const S height = dot(at.hard_point - ground.point, ground.normal) - w.radius;
  return min(w.free_length, divide_to<S>(height, facing));
}
/// [m] Returns the motion of the wheel in this step across the suspension, relative to its ground if that is known.
template <class S> Vec3<S> WheelGround<S>::way_of(const Run& run, const Stance& at) const {
  const BodyState<S>& state = state_.awake.states[run.row - 1];
  Vec3<V> speed = detail::velocity_at<S>(&state, at.hard_point - state.centre);
  if (run.ground != 0) speed -= detail::velocity_at<S>(&state_.awake.states[run.ground - 1], run.ground_arm);
  const Vec3<S> way = convert<S>(speed) / S(state_.settings.hz);
  return way - at.down * dot(way, at.down);
}
/// Returns true if the plane at the start of the step does not hold for the ground further on. At least one look meets
/// a bump higher than a 32nd of the radius, since a wheel is wider than it is long.
template <class S> bool WheelGround<S>::is_uneven(const Run& run, const Stance& at, const Ground& ground) {
  const S radius = wheels_.wheel(run).radius;
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
template <class S> void WheelGround<S>::find(Group& group) {
  const std::span<Run> runs = wheels_.runs_of(group);
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
    run.length = wheels_.wheel(run).free_length;
    stand_on(run, ground);
    run.uneven = is_uneven(run, at, ground);
  }
}
template <class S> bool WheelGround<S>::follow() {
  bool any = false;
  for (Run& run : wheels_.runs()) {
    if (!run.uneven) continue;
    any = true;
    stand_on(run, ground_below(run, stance_of(run)));
    if (run.ground == 0) continue;
    const MotionRow<V>& moved = wheels_.bodies().displacement[run.ground];
    run.point -= convert<S>(moved.linear) + cross(convert<S>(moved.angular), run.ground_arm);
  }
  return any;
}

}  // namespace isostep
