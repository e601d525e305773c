// Bodies of surroundings.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/solvers/schedule.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/query/surroundings.hpp"

namespace isostep {

namespace detail {
/// [m] A plane that separates by so much separates despite rounding.
template <class S> inline constexpr S kClearlyParted = S(0x1p-9);
/// [m] Boxes are met this much sooner than what is in them. Casts are exact only to `gap_noise`, and the slack of
/// SweepTest follows from the region, beyond which big boxes reach.
template <class S> inline constexpr S kBoxMargin = S(0.015625);
}  // namespace detail

// ---- what is there

template <class S> void Surroundings<S>::begin_step() {
  placed_.clear();
  placed_of_.assign(state_.body_slots.entries().size(), {Range::kUnknown, Range::kUnknown});
}

template <class S>
void Surroundings<S>::begin(ShapeId shape, const Pose<S>& pose, const QueryFilter& filter, const Filter& collides,
                            std::span<const std::uint32_t> passed_kinds) {
  const Child<S>& own = map_.shapes.children_of(shape.slot)[0];
  const Pose<S> turned = {Vec3<S>::zero(), pose.orientation};
  const Transform<S> placed = Transform<S>::of(own.pose.is_identity() ? turned : compose(turned, own.pose));
  filter_ = filter;
  collides_ = own.traits.filter_or(collides);
  passed_kinds_ = passed_kinds;
  shape_ = &own.primitive;
  begin_ = pose.position;
  offset_ = placed.position;
  visit_shape(map_.shapes.contents().view(own.primitive), [&](const auto& solid) ISO_INLINE_LAMBDA {
    if constexpr (kIsSolid<std::remove_cvref_t<decltype(solid)>>) {
      core_.emplace(solid, S(0));
      box_ = solid.bounds(placed);
      const S touch = min(detail::kDeepOverlap<S>, solid.inner_radius() * S(0.25));
      cast_ = {core_->core(), placed, {Vec3<S>::zero(), Unit<S>(1), touch}, false, false};
    }
  });
  round_.reset();
  if (cast_.core.vertices.size() <= 2) round_ = round_core(cast_.core, placed);
  const S edge = Limits<S>::position() * S(2);
  region_ = {{edge, edge, edge}, {-edge, -edge, -edge}};
  parts_.clear();
}

template <class S> void Surroundings<S>::gather(Vec3<S> reach) {
  const Aabb<S> box = box_at(begin_);
  gather_around({saturating_subtract(box.low, reach), saturating_add(box.high, reach)});
}

/// Gathers parts in order of the bodies and their children.
template <class S> void Surroundings<S>::gather_around(const Aabb<S>& box) {
  const S edge = Limits<S>::position() * S(2);
  const Aabb<S> all = merge(region_, box);
  region_ = {held_within(all.low, edge), held_within(all.high, edge)};
  find_bodies_near();
  parts_.clear();
  for (const Near& nearby : near_) {
    for (std::uint32_t i = nearby.parts.first; i < nearby.parts.last; ++i) {
      if (overlap(placed_[i].box, region_) && is_in_the_way(nearby.slot, placed_[i])) parts_.push_back({i, {}});
    }
  }
}

/// Ascending by slot. Looks at parts before it asks the filter, which costs more: fat boxes meet the region oftener.
template <class S> void Surroundings<S>::find_bodies_near() {
  near_.clear();
  proxies_.boxes().query(region_, [&](std::uint32_t slot) {
    const Range parts = parts_of(slot);
    bool meets = false;
    for (std::uint32_t i = parts.first; i < parts.last && !meets; ++i) meets = overlap(placed_[i].box, region_);
    if (meets && sight_.sees(filter_, slot) && collides_with(slot)) near_.push_back({slot, parts});
    return true;
  });
  near_scratch_.resize(near_.size());
  stable_sort(near_.data(), near_scratch_.data(), static_cast<std::uint32_t>(near_.size()), BySlot{});
}

template <class S> auto Surroundings<S>::place(std::uint32_t slot) -> Range {
  const std::uint32_t shape = map_.properties_at(map_.location(slot)).shape;
  if (const ChildTree<S>* const tree = map_.shapes.tree_of(shape)) return place_some(slot, *tree);
  const BodyId body = state_.body_slots.template id_of<BodyId>(slot);
  const Transform<S> origin = Transform<S>::of(map_.origin_pose_at(slot));
  const auto first = static_cast<std::uint32_t>(placed_.size());
  const bool traits = map_.shapes.traits_of(shape).flags != 0;
  for (const Child<S>& child : map_.shapes.children_of(shape)) add_placed(body, origin, child, traits);
  return placed_of_[slot] = {first, static_cast<std::uint32_t>(placed_.size())};
}
/// Places the children in the region, anew for each region.
template <class S> auto Surroundings<S>::place_some(std::uint32_t slot, const ChildTree<S>& tree) -> Range {
  const BodyId body = state_.body_slots.template id_of<BodyId>(slot);
  const Transform<S> origin = Transform<S>::of(map_.origin_pose_at(slot));
  const std::uint32_t shape = map_.properties_at(map_.location(slot)).shape;
  const std::span<const Child<S>> children = map_.shapes.children_of(shape);
  const bool traits = map_.shapes.traits_of(shape).flags != 0;
  children_.clear();
  tree.query(origin, region_, [&](std::uint32_t child) {
    children_.push_back(child);
    return true;
  });
  children_scratch_.resize(children_.size());
  stable_sort(children_.data(), children_scratch_.data(), static_cast<std::uint32_t>(children_.size()), OwnKey{});
  const auto first = static_cast<std::uint32_t>(placed_.size());
  for (const std::uint32_t child : children_) add_placed(body, origin, children[child], traits);
  return {first, static_cast<std::uint32_t>(placed_.size())};
}
template <class S>
void Surroundings<S>::add_placed(BodyId body, const Transform<S>& origin, const Child<S>& child, bool traits) {
  const ShapeView<S> view = map_.shapes.contents().view(child.primitive);
  const Transform<S> at = child.pose.is_identity() ? origin : compose(origin, Transform<S>::of(child.pose));
  placed_.push_back({body, view, at, bounds(view, at), traits ? &child.traits : nullptr});
}

// ---- casts

/// Returns a sweep that is wider than the error by which a hit may pass a part.
template <class S> Sweep<S> Surroundings<S>::sweep_of(Vec3<S> from, Vec3<S> way) const {
  const Vec3<S> half = (box_.high - box_.low) * S(0.5);
  const S margin = detail::cast_margin(max_abs(half) + max_abs(way) + max_abs(way)) + detail::kBoxMargin<S>;
  return {from + box_.low + half, way, half + Vec3<S>{margin, margin, margin}, Unit<S>(1)};
}

/// Finds parts that may be in the way, by boxes and planes. The part that it runs into most comes first: with its hit
/// known, others are too far.
template <class S> void Surroundings<S>::find_candidates(Vec3<S> from, Vec3<S> way) {
  const Sweep<S> sweep = sweep_of(from, way);
  detail::SweepTest<S> test(sweep, region_);
  if (!contains(region_, test.reach)) {
    gather_around(test.reach);
    test = detail::SweepTest<S>(sweep, region_);
  }
  const Vec3<S> start = from + offset_;
  candidates_.clear();
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    const Aabb<S>& box = placed_[part.placed].box;
    if (!overlap(test.reach, box)) continue;
    if (!part.parting.is_known()) {
      if (!test.touches(box)) continue;
      find_parting(part, start);
    }
    const S room = part.parting.least_gap(start, way);
    if (detail::kClearlyParted<S> < room) continue;
    std::size_t place = candidates_.size();
    candidates_.push_back({room, i});
    for (; place > 0 && room < candidates_[place - 1].room; --place) candidates_[place] = candidates_[place - 1];
    candidates_[place] = {room, i};
  }
}

/// Finds the plane of a round shape, which is soon found. Casts leave the planes of other shapes.
template <class S> void Surroundings<S>::find_parting(Part& part, Vec3<S> start) {
  const Placed& placed = placed_[part.placed];
  if (round_) part.parting = part_round(*round_, start, placed.shape, placed.at);
}

/// A hit leaves a plane as a miss does: the plane that the two then have in common.
template <class S> bool Surroundings<S>::meet(Part& part, Vec3<S> from, Vec3<S> way, Unit<S> latest, SolidHit<S>& hit) {
  const Placed& placed = placed_[part.placed];
  const bool is_convex = placed.is_convex();
  cast_.start.position = from + offset_;
  cast_.motion.translation = way;
  cast_.motion.latest = latest;
  cast_.motion.parting = is_convex ? &part.parting : nullptr;
  cast_.skip_inside = false;
  if (!cast_solid(cast_, placed.shape, placed.at, hit)) return false;
  if (hit.inside && !(dot(way, hit.normal) < S(0))) {
    cast_.skip_inside = true;
    return !is_convex && cast_solid(cast_, placed.shape, placed.at, hit);
  }
  if (is_convex && Unit<S>(0) < hit.fraction) {
    part.parting = {hit.normal, cast_.start.position + way * hit.fraction, S(0)};
  }
  return true;
}

template <class S> std::optional<ObstacleHit<S>> Surroundings<S>::cast(Vec3<S> from, Vec3<S> way) {
  find_candidates(from, way);
  const Vec3<S> start = from + offset_;
  SolidHit<S> first, hit;
  first.fraction = Unit<S>(1);
  const Candidate* met = nullptr;
  for (const Candidate& candidate : candidates_) {
    Part& part = parts_[candidate.part];
    if (met != nullptr && part.parting.holds(start, way * first.fraction, detail::kClearlyParted<S>)) continue;
    if (!meet(part, from, way, first.fraction, hit)) continue;
    const bool sooner = met == nullptr || hit.fraction < first.fraction ||
                        (hit.fraction == first.fraction && candidate.part < met->part);
    if (sooner) first = hit, met = &candidate;
  }
  if (met == nullptr) return {};
  return ObstacleHit<S>{placed_[parts_[met->part].placed].body, first.point, first.normal, first.fraction};
}

template <class S> std::optional<Vec3<Unit<S>>> Surroundings<S>::cast_ray(Vec3<S> from, Vec3<S> way) {
  const S margin = detail::kBoxMargin<S>;
  const Sweep<S> sweep = {from, way, {margin, margin, margin}, Unit<S>(1)};
  cover(detail::SweepTest<S>(sweep, region_).reach);
  const detail::SweepTest<S> test(sweep, region_);
  RayHit<S> first, hit;
  first.fraction = S(1);
  bool met = false;
  for (const Part& part : parts_) {
    const Placed& placed = placed_[part.placed];
    if (!test.touches(placed.box) || !ray_cast(placed.shape, placed.at, from, way, first.fraction, hit)) continue;
    if (!met || hit.fraction < first.fraction) first = hit, met = true;
  }
  if (!met || first.inside) return {};
  return first.normal;
}

// ---- contacts

template <class S> bool Surroundings<S>::is_parted(Part& part, Vec3<S> at, S margin) {
  const Vec3<S> start = at + offset_;
  if (!part.parting.is_known()) find_parting(part, start);
  return part.parting.holds(start, Vec3<S>::zero(), margin + detail::kClearlyParted<S>);
}

template <class S> S Surroundings<S>::distance(Vec3<S> at, Vec3<S> point) const {
  const Transform<S> placed = {at + offset_, cast_.start.rotation};
  return closest_point<S>(map_.shapes.contents().view(*shape_), placed, point).distance;
}

template <class S> void Surroundings<S>::find_contacts(Vec3<S> at, S margin, std::vector<NearContact<S>>& out) {
  out.clear();
  const Aabb<S> box = grow(box_at(at), margin);
  cover(box);
  for (Part& part : parts_) {
    const Placed& placed = placed_[part.placed];
    if (overlap(placed.box, box) && !is_parted(part, at, margin)) add_contacts_of(placed, at, margin, out);
  }
}

template <class S>
void Surroundings<S>::add_contacts_of(const Placed& part, Vec3<S> at, S margin,
                                      std::vector<NearContact<S>>& out) const {
  const Vec3<S> origin = at + offset_;
  const ShapeView<S> shape = map_.shapes.contents().view(*shape_);
  const Transform<S> here = {Vec3<S>::zero(), cast_.start.rotation},
                     there = {part.at.position - origin, part.at.rotation};
  Manifold<S> manifold;
  const auto add = [&] {
    if (manifold.count == 0) return true;
    const ManifoldPoint<S>* deepest = &manifold.points[0];
    for (int i = 1; i < manifold.count; ++i) {
      if (manifold.points[i].separation < deepest->separation) deepest = &manifold.points[i];
    }
    out.push_back({part.body, -manifold.normal, deepest->separation, origin + deepest->position});
    return true;
  };
  if (part.is_convex()) {
    collide(shape, here, part.shape, there, margin, manifold);
    add();
    return;
  }
  visit_triangles_near(shape, here, part.shape, there, margin, [&](std::uint32_t triangle) {
    collide_with_triangle(shape, here, part.shape, triangle, there, margin, manifold);
    return add();
  });
}

}  // namespace isostep
