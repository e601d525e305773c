// Bodies of overlap_queries.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/collision/query/closest_point.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/query/overlap_queries.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE std::uint8_t material_of(const ShapeView<S>& surface, std::uint32_t triangle) {
  return visit_surface(surface, [&](const auto& of) ISO_INLINE_LAMBDA { return of.material(triangle); });
}
/// Returns the children whose boxes meet `box`, ascending.
template <class S>
std::vector<std::uint32_t> children_near(const ChildTree<S>& tree, const Transform<S>& t, const Aabb<S>& box) {
  std::vector<std::uint32_t> nearby;
  tree.query(t, box, [&](std::uint32_t child) {
    nearby.push_back(child);
    return true;
  });
  const auto count = static_cast<std::uint32_t>(nearby.size());
  std::vector<std::uint32_t> scratch(count <= kInsertionSortLimit ? 0 : count);
  stable_sort(nearby.data(), scratch.data(), count, OwnKey{});
  return nearby;
}
}  // namespace detail

/// Calls visit(i, part, at, here) -> bool for the children of a body's shape, ascending, until it returns false. With a
/// tree, it visits only children whose boxes meet the asked shape's. `at` and `here` are the places of the part and of
/// the asked shape, both relative to the latter's position, as the narrow phase needs them.
template <class S>
template <class Visit>
void OverlapQueries<S>::visit_parts_near(const detail::AskedShape<S>& asked, std::uint32_t slot, Visit&& visit) const {
  Pose<S> placed = map_.origin_pose_at(slot);
  placed.position -= asked.pose.position;
  const Transform<S> here = Transform<S>::of({Vec3<S>::zero(), asked.pose.orientation}),
                     there = Transform<S>::of(placed);
  const std::uint32_t shape = map_.properties_at(map_.location(slot)).shape;
  const std::span<const Child<S>> children = map_.shapes.children_of(shape);
  const auto visit_child = [&](std::uint32_t i) {
    const bool is_placed = children[i].pose.is_identity();
    const Transform<S> at = is_placed ? there : compose(there, Transform<S>::of(children[i].pose));
    return visit(i, map_.shapes.contents().view(children[i].primitive), at, here);
  };
  if (const ChildTree<S>* const tree = map_.shapes.tree_of(shape)) {
    for (const std::uint32_t i : detail::children_near(*tree, there, bounds(asked.view(), here))) {
      if (!visit_child(i)) return;
    }
    return;
  }
  for (std::uint32_t i = 0; i < children.size(); ++i) {
    if (!visit_child(i)) return;
  }
}

/// Calls visit(hit) -> bool for the parts of a body that overlap, until it returns false: for every triangle, for the
/// lowest one of each child, or for the lowest of all. Children ascend.
template <class S>
template <class Visit>
void OverlapQueries<S>::visit_overlaps(const detail::AskedShape<S>& asked, const QueryFilter& filter,
                                       std::uint32_t slot, const Visit& visit) const {
  const BodyId body = sight_.id_of(slot);
  const BodyProperties<S>& properties = map_.properties_at(map_.location(slot));
  const std::span<const Child<S>> children = map_.shapes.children_of(properties.shape);
  const bool traits = map_.shapes.traits_of(properties.shape).flags != 0;
  const auto visit_child = [&](std::uint32_t i, const ShapeView<S>& part, const Transform<S>& at,
                               const Transform<S>& here) {  // false: visit wants no more
    if (traits && !sight_.sees_part(filter, properties, children[i].traits)) return true;
    Manifold<S> manifold;
    const bool is_whole = !is_surface(part.primitive.type), each = filter.per == HitPer::triangle;
    std::uint32_t lowest = kNoTriangle;
    const auto touches = [&](std::uint32_t triangle) {
      if (!each && triangle > lowest) return true;
      collide_with_triangle(asked.view(), here, part, triangle, at, S(0), manifold);
      if (manifold.count == 0) return true;
      lowest = min(lowest, triangle);
      return !each || visit(OverlapHit{body, i, triangle, detail::material_of(part, triangle)});
    };
    if (is_whole) {
      collide(asked.view(), here, part, at, S(0), manifold);
      if (manifold.count != 0) lowest = 0;
    } else if (!visit_triangles_near(asked.view(), here, part, at, S(0), touches)) {
      return false;
    }
    if (lowest == kNoTriangle) return true;
    const bool told = each && !is_whole;
    const std::uint8_t material = is_whole ? std::uint8_t{0} : detail::material_of(part, lowest);
    return (told || visit(OverlapHit{body, i, lowest, material})) && filter.per != HitPer::body;
  };
  visit_parts_near(asked, slot, visit_child);
}

namespace detail {
struct BySlotOfId {
  ISO_INLINE std::uint64_t operator()(BodyId body) const { return body.slot; }
};
struct BySlotOfOverlap {
  ISO_INLINE std::uint64_t operator()(const OverlapHit& hit) const { return hit.body.slot; }
};
struct ByPartOfOverlap {
  ISO_INLINE std::uint64_t operator()(const OverlapHit& hit) const {
    return std::uint64_t{hit.child} << 32 | hit.triangle;
  }
};
}  // namespace detail

template <class S>
void OverlapQueries<S>::overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                                      const QueryFilter& filter) const {
  if (!faults_.accept_call("overlap_shape", detail::fault_of_shape(state_, shape, pose))) return;
  const detail::AskedShape<S> asked = detail::asked_of(map_, shape, pose);
  const std::size_t first = out.size();
  QueryFilter any = filter;
  any.per = HitPer::triangle;  // the first that is found will do
  proxies_.boxes().query(bounds(asked.view(), Transform<S>::of(asked.pose)), [&](std::uint32_t slot) {
    if (!sight_.sees(filter, slot)) return true;
    visit_overlaps(asked, any, slot, [&](const OverlapHit& hit) {
      out.push_back(hit.body);
      return false;
    });
    return true;
  });
  const auto count = static_cast<std::uint32_t>(out.size() - first);
  std::vector<BodyId> scratch(count <= kInsertionSortLimit ? 0 : count);
  stable_sort(out.data() + first, scratch.data(), count, detail::BySlotOfId{});
}

template <class S>
void OverlapQueries<S>::overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<OverlapHit>& out,
                                      const QueryFilter& filter) const {
  if (!faults_.accept_call("overlap_shape", detail::fault_of_shape(state_, shape, pose))) return;
  const detail::AskedShape<S> asked = detail::asked_of(map_, shape, pose);
  const std::size_t first = out.size();
  proxies_.boxes().query(bounds(asked.view(), Transform<S>::of(asked.pose)), [&](std::uint32_t slot) {
    if (!sight_.sees(filter, slot)) return true;
    visit_overlaps(asked, filter, slot, [&](const OverlapHit& hit) {
      out.push_back(hit);
      return true;
    });
    return true;
  });
  const auto count = static_cast<std::uint32_t>(out.size() - first);
  std::vector<OverlapHit> scratch(count <= kInsertionSortLimit ? 0 : count);
  stable_sort(out.data() + first, scratch.data(), count, detail::ByPartOfOverlap{});
  stable_sort(out.data() + first, scratch.data(), count, detail::BySlotOfOverlap{});
}

template <class S>
std::optional<OverlapHit> OverlapQueries<S>::overlap_first(const QueryShape<S>& shape, const Pose<S>& pose,
                                                           const QueryFilter& filter) const {
  if (!faults_.accept_call("overlap_first", detail::fault_of_shape(state_, shape, pose))) return {};
  const detail::AskedShape<S> asked = detail::asked_of(map_, shape, pose);
  std::optional<OverlapHit> first;
  QueryFilter of_bodies = filter;
  of_bodies.per = HitPer::body;
  proxies_.boxes().query(bounds(asked.view(), Transform<S>::of(asked.pose)), [&](std::uint32_t slot) {
    if ((first && first->body.slot < slot) || !sight_.sees(filter, slot)) return true;
    visit_overlaps(asked, of_bodies, slot, [&](const OverlapHit& hit) {
      first = hit;
      return false;
    });
    return true;
  });
  return first;
}

template <class S>
std::optional<ClosestBody<S>> OverlapQueries<S>::closest_point(Vec3<S> point, S max_distance,
                                                               const QueryFilter& filter) const {
  const S edge = Limits<S>::position();
  if (!faults_.accept_call("closest_point", detail::Checklist()
                                                .also(detail::fault_of_place(point, "point"))
                                                .finite(max_distance, "max_distance")
                                                .proper(S(0) <= max_distance, "max_distance", "0 or more")
                                                .report()))
    return {};
  std::optional<ClosestBody<S>> best;
  const S reach = min(max_distance, edge);
  proxies_.boxes().query(Aabb<S>::around(point, {reach, reach, reach}), [&](std::uint32_t slot) {
    if (!sight_.sees(filter, slot)) return true;
    const Transform<S> placed = Transform<S>::of(map_.origin_pose_at(slot));
    const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
    const std::span<const Child<S>> children = map_.shapes.children_of(body.shape);
    const bool traits = map_.shapes.traits_of(body.shape).flags != 0;
    for (std::uint32_t i = 0; i < children.size(); ++i) {
      const Child<S>& child = children[i];
      if (traits && !sight_.sees_part(filter, body, child.traits)) continue;
      const ClosestPoint<S> found = isostep::closest_point(map_.shapes.contents().view(child.primitive),
                                                           compose(placed, Transform<S>::of(child.pose)), point);
      if (max_distance < found.distance) continue;
      const bool nearer =
          !best || found.distance < best->distance || (found.distance == best->distance && slot < best->body.slot);
      if (nearer) best = ClosestBody<S>{sight_.id_of(slot), i, found.point, found.normal, found.distance};
    }
    return true;
  });
  return best;
}

template <class S> bool OverlapQueries<S>::accept_box(const Aabb<S>& box) const {
  const S edge = Limits<S>::position() + Limits<S>::position();
  return faults_.accept_call(
      "overlap_aabb",
      detail::Checklist()
          .finite(box.low, "box.low")
          .finite(box.high, "box.high")
          .in_range(detail::within(box.low, edge), "box.low", "coordinates up to 2 Limits::position()")
          .in_range(detail::within(box.high, edge), "box.high", "coordinates up to 2 Limits::position()")
          .proper(min(box.low, box.high) == box.low, "box.low", "no coordinate above one of box.high")
          .report());
}

template <class S>
void OverlapQueries<S>::overlap_aabb(const Aabb<S>& box, std::vector<BodyId>& out, const QueryFilter& filter) const {
  if (!accept_box(box)) return;
  const std::size_t first = out.size();
  proxies_.boxes().query(box, [&](std::uint32_t slot) {
    if (sight_.sees(filter, slot)) out.push_back(sight_.id_of(slot));
    return true;
  });
  const auto count = static_cast<std::uint32_t>(out.size() - first);
  if (count <= kInsertionSortLimit) return insertion_sort(out.data() + first, count, detail::BySlotOfId{});
  std::vector<BodyId> scratch(count);
  stable_sort(out.data() + first, scratch.data(), count, detail::BySlotOfId{});
}

}  // namespace isostep
