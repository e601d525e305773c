// Queries: what a shape overlaps.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/query/queries.hpp"

namespace isostep {

template <class S> FaultReport Queries<S>::fault_of_shape(const QueryShape<S>& shape, const Pose<S>& pose) const {
  const auto kind = [](ShapeFault f) { return f == ShapeFault::not_finite ? Fault::not_finite : Fault::bad_shape; };
  const ShapeFault of_pose = validate(pose);
  const bool turned = of_pose == ShapeFault::orientation_not_unit;
  const FaultReport bad_pose = {kind(of_pose), "", turned ? "pose.orientation" : "pose", expected_of(of_pose)};
  if (shape.of_world) {
    const FaultReport of_id = detail::fault_of_id(state_.shape_slots, shape.id, state_.settings.id_space, "shape");
    if (of_id != Fault::none) return of_id;
    const std::span<const Child<S>> children = map_.shapes.children_of(shape.id.slot);
    if (children.size() != 1 || is_surface(children[0].primitive.type))
      return {Fault::bad_shape, "", "shape", "one convex part"};
  } else {
    const Child<S> part = {shape.primitive, Pose<S>::identity()};
    FaultReport of_shape = detail::report_of(find_fault(std::span<const Child<S>>(&part, 1)));
    of_shape.child = FaultReport::kNoChild;  // it has one alone
    if (of_shape.fault != Fault::none) return of_shape;
  }
  return of_pose == ShapeFault::none ? FaultReport{} : bad_pose;
}

/// Of an accepted shape.
template <class S> auto Queries<S>::asked_of(const QueryShape<S>& shape, const Pose<S>& pose) const -> Asked {
  if (!shape.of_world) return {shape.primitive, nullptr, pose};
  const Child<S>& part = map_.shapes.children_of(shape.id.slot)[0];
  return {part.primitive, map_.shapes.contents().view(part.primitive).content,
          part.pose.is_identity() ? pose : compose(pose, part.pose)};
}

namespace detail {
template <class S> ISO_INLINE std::uint8_t material_of(const ShapeView<S>& surface, std::uint32_t triangle) {
  return visit_surface(surface, [&](const auto& of) ISO_INLINE_LAMBDA { return of.material(triangle); });
}
/// Ascending.
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

/// visit(i, part, at, here) -> bool for the children of a body's shape, ascending, until it returns false. Of those of
/// a tree the ones whose boxes meet the shape's. `at` and `here` are the places of the part and of the shape asked with
/// both relative to the latter's position, as the narrow phase wants them.
template <class S>
template <class Visit>
void Queries<S>::visit_parts_near(const Asked& asked, std::uint32_t slot, Visit&& visit) const {
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

/// visit(hit) -> bool for the parts of a body that overlap, until it returns false: every triangle, the lowest one of
/// each child, or the lowest of all. Children ascend.
template <class S>
template <class Visit>
void Queries<S>::visit_overlaps(const Asked& asked, const QueryFilter& filter, std::uint32_t slot,
                                const Visit& visit) const {
  const BodyId body = id_of(slot);
  const BodyProperties<S>& properties = map_.properties_at(map_.location(slot));
  const std::span<const Child<S>> children = map_.shapes.children_of(properties.shape);
  const bool traits = map_.shapes.traits_of(properties.shape).flags != 0;
  const auto visit_child = [&](std::uint32_t i, const ShapeView<S>& part, const Transform<S>& at,
                               const Transform<S>& here) {  // false: visit wants no more
    if (traits && !sees_part(filter, properties, children[i].traits)) return true;
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
void Queries<S>::overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out,
                               const QueryFilter& filter) const {
  if (!faults_.accept_call("overlap_shape", fault_of_shape(shape, pose))) return;
  const Asked asked = asked_of(shape, pose);
  const std::size_t first = out.size();
  QueryFilter any = filter;
  any.per = HitPer::triangle;  // the first that is found will do
  proxies_.boxes().query(bounds(asked.view(), Transform<S>::of(asked.pose)), [&](std::uint32_t slot) {
    if (!sees(filter, slot)) return true;
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
void Queries<S>::overlap_shape(const QueryShape<S>& shape, const Pose<S>& pose, std::vector<OverlapHit>& out,
                               const QueryFilter& filter) const {
  if (!faults_.accept_call("overlap_shape", fault_of_shape(shape, pose))) return;
  const Asked asked = asked_of(shape, pose);
  const std::size_t first = out.size();
  proxies_.boxes().query(bounds(asked.view(), Transform<S>::of(asked.pose)), [&](std::uint32_t slot) {
    if (!sees(filter, slot)) return true;
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
std::optional<OverlapHit> Queries<S>::overlap_first(const QueryShape<S>& shape, const Pose<S>& pose,
                                                    const QueryFilter& filter) const {
  if (!faults_.accept_call("overlap_first", fault_of_shape(shape, pose))) return {};
  const Asked asked = asked_of(shape, pose);
  std::optional<OverlapHit> first;
  QueryFilter of_bodies = filter;
  of_bodies.per = HitPer::body;
  proxies_.boxes().query(bounds(asked.view(), Transform<S>::of(asked.pose)), [&](std::uint32_t slot) {
    if ((first && first->body.slot < slot) || !sees(filter, slot)) return true;
    visit_overlaps(asked, of_bodies, slot, [&](const OverlapHit& hit) {
      first = hit;
      return false;
    });
    return true;
  });
  return first;
}

/// By the box of the shape in a frame whose y is that direction.
template <class S> S Queries<S>::reach_of(ShapeId shape, const Quat<Unit<S>>& orientation, Vec3<Unit<S>> along) const {
  const Vec3<Unit<S>> y = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  const Quat<Unit<S>> turned = rotation_between(along, y) * orientation;
  return bounds(asked_of(shape, {Vec3<S>::zero(), turned}).view(), Transform<S>::of({Vec3<S>::zero(), turned})).high.y;
}

}  // namespace isostep
