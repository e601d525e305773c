// Queries: what a shape overlaps.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/world/checks.hpp"
#include "isostep/world/queries.hpp"

namespace isostep {

template <class S> FaultReport Queries<S>::fault_of_shape(const QueryShape<S>& shape, const Pose<S>& pose) const {
  const auto kind = [](ShapeFault f) { return f == ShapeFault::not_finite ? Fault::not_finite : Fault::bad_shape; };
  const ShapeFault of_pose = validate(pose);
  const FaultReport bad_pose = {kind(of_pose), "", describe(of_pose), ""};
  if (shape.of_world) {
    const FaultReport of_id = detail::fault_of_id(state_.shape_slots, shape.id, state_.settings.id_space, "shape");
    if (of_id != Fault::none) return of_id;
    const std::span<const Child<S>> children = map_.children_of(shape.id.slot);
    if (children.size() != 1 || is_surface(children[0].primitive.type))
      return {Fault::bad_shape, "", "shape", "one convex part"};
  } else {
    const Child<S> part = {shape.primitive, Pose<S>::identity()};
    const ShapeFault of_shape = validate(std::span<const Child<S>>(&part, 1));
    if (of_shape != ShapeFault::none) return {kind(of_shape), "", describe(of_shape), ""};
  }
  return of_pose == ShapeFault::none ? FaultReport{} : bad_pose;
}

/// Of an accepted shape.
template <class S> auto Queries<S>::asked_of(const QueryShape<S>& shape, const Pose<S>& pose) const -> Asked {
  if (!shape.of_world) return {shape.primitive, nullptr, pose};
  const Child<S>& part = map_.children_of(shape.id.slot)[0];
  return {part.primitive, map_.contents().view(part.primitive).content,
          part.pose.is_identity() ? pose : compose(pose, part.pose)};
}

namespace detail {
template <class S> ISO_INLINE std::uint8_t material_of(const ShapeView<S>& surface, std::uint32_t triangle) {
  return visit_surface(surface, [&](const auto& of) ISO_INLINE_LAMBDA { return of.material(triangle); });
}
/// Ascending.
template <class S>
std::vector<std::uint32_t> children_near(const ChildTree<S>& tree, const Transform<S>& t, const Aabb<S>& box) {
  std::vector<std::uint32_t> near;
  tree.query(t, box, [&](std::uint32_t child) {
    near.push_back(child);
    return true;
  });
  const auto count = static_cast<std::uint32_t>(near.size());
  std::vector<std::uint32_t> scratch(count <= kInsertionSortLimit ? 0 : count);
  stable_sort(near.data(), scratch.data(), count, OwnKey{});
  return near;
}
}  // namespace detail

/// visit(i, part, at, here) -> bool for the children of a body's shape, ascending, until it returns false. Of those of
/// a tree the ones whose boxes meet the shape's, grown by `margin`. `at` and `here` are the places of the part and of
/// the shape asked with, both relative to the latter's position, as the narrow phase wants them.
template <class S>
template <class Visit>
void Queries<S>::visit_parts_near(const Asked& asked, S margin, std::uint32_t slot, const Transform<S>& placed,
                                  Visit&& visit) const {
  const Transform<S> here = Transform<S>::of({Vec3<S>::zero(), asked.pose.orientation}),
                     there = {placed.position - asked.pose.position, placed.rotation};
  const std::uint32_t shape = map_.properties_at(map_.location(slot)).shape;
  const std::span<const Child<S>> children = map_.children_of(shape);
  const auto visit_child = [&](std::uint32_t i) {
    const bool is_placed = children[i].pose.is_identity();
    const Transform<S> at = is_placed ? there : compose(there, Transform<S>::of(children[i].pose));
    return visit(i, map_.contents().view(children[i].primitive), at, here);
  };
  if (const ChildTree<S>* const tree = map_.tree_of(shape)) {
    for (const std::uint32_t i : detail::children_near(*tree, there, grow(bounds(asked.view(), here), margin))) {
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
  const auto visit_child = [&](std::uint32_t i, const ShapeView<S>& part, const Transform<S>& at,
                               const Transform<S>& here) {  // false: visit wants no more
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
  visit_parts_near(asked, S(0), slot, placed_at(slot), visit_child);
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
  if (!journal_.accept_call("overlap_shape", fault_of_shape(shape, pose))) return;
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
  if (!journal_.accept_call("overlap_shape", fault_of_shape(shape, pose))) return;
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
  if (!journal_.accept_call("overlap_first", fault_of_shape(shape, pose))) return {};
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

template <class S>
void Queries<S>::near_contacts_of(const Asked& asked, S margin, std::uint32_t slot, const Transform<S>& placed,
                                  std::vector<NearContact<S>>& out) const {
  Manifold<S> manifold;
  const auto tell = [&] {
    if (manifold.count == 0) return true;
    const ManifoldPoint<S>* deepest = &manifold.points[0];
    for (int i = 1; i < manifold.count; ++i) {
      if (manifold.points[i].separation < deepest->separation) deepest = &manifold.points[i];
    }
    out.push_back({id_of(slot), -manifold.normal, deepest->separation, asked.pose.position + deepest->position});
    return true;
  };
  const auto visit_child = [&](std::uint32_t, const ShapeView<S>& part, const Transform<S>& at,
                               const Transform<S>& here) {
    if (!is_surface(part.primitive.type)) {
      collide(asked.view(), here, part, at, margin, manifold);
      return tell();
    }
    return visit_triangles_near(asked.view(), here, part, at, margin, [&](std::uint32_t triangle) {
      collide_with_triangle(asked.view(), here, part, triangle, at, margin, manifold);
      return tell();
    });
  };
  visit_parts_near(asked, margin, slot, placed, visit_child);
}

template <class S>
void Queries<S>::near_contacts(const QueryShape<S>& shape, const Pose<S>& pose, S margin, NearContacts<S>& out,
                               const QueryFilter& filter, const BodiesNear<S>* near) const {
  out.all.clear();
  out.slots.clear();
  if (!journal_.accept_call("near_contacts", fault_of_shape(shape, pose))) return;
  const Asked asked = asked_of(shape, pose);
  const Aabb<S> box = grow(bounds(asked.view(), Transform<S>::of(asked.pose)), margin);
  if (near != nullptr && near->holds(box)) {
    near->query(box, [&](const typename BodiesNear<S>::Body& body) ISO_INLINE_LAMBDA {
      const bool parted = body.parting.holds(asked.pose.position, Vec3<S>::zero(), margin + detail::kClearlyParted<S>);
      if (parted) return;
      near_contacts_of(asked, margin, body.slot, body.placed, out.all);
    });
    return;
  }
  find_slots_near(box, filter, out.slots, out.scratch);
  for (const std::uint32_t slot : out.slots) near_contacts_of(asked, margin, slot, placed_at(slot), out.all);
}

/// Ascending.
template <class S>
void Queries<S>::find_slots_near(const Aabb<S>& box, const QueryFilter& filter, std::vector<std::uint32_t>& slots,
                                 std::vector<std::uint32_t>& scratch) const {
  slots.clear();
  proxies_.boxes().query(box, [&](std::uint32_t slot) {
    if (sees(filter, slot)) slots.push_back(slot);
    return true;
  });
  scratch.resize(slots.size());
  stable_sort(slots.data(), scratch.data(), static_cast<std::uint32_t>(slots.size()), OwnKey{});
}

/// Of bodies of one part with the box around that: their fat ones hold more.
template <class S>
void Queries<S>::find_bodies_near(const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> reach,
                                  const QueryFilter& filter, BodiesNear<S>& out) const {
  const Asked asked = asked_of(shape, pose);
  const Aabb<S> box = bounds(asked.view(), Transform<S>::of(asked.pose));
  const S edge = Limits<S>::position() * S(2);
  out.begin(
      {held_within(saturating_subtract(box.low, reach), edge), held_within(saturating_add(box.high, reach), edge)});
  find_slots_near(out.region(), filter, out.slots, out.scratch);
  for (const std::uint32_t slot : out.slots) {
    const Transform<S> placed = placed_at(slot);
    const std::span<const Child<S>> children = map_.children_of(map_.properties_at(map_.location(slot)).shape);
    const bool is_one = children.size() == 1;
    const Aabb<S> tight = is_one ? bounds(children, placed, map_.contents()) : proxies_.boxes().box(slot);
    out.add({slot, tight, placed, is_one && !is_surface(children[0].primitive.type), {}});
  }
}

/// By the box of the shape in a frame whose y is that direction.
template <class S> S Queries<S>::reach_of(ShapeId shape, const Quat<Unit<S>>& orientation, Vec3<Unit<S>> along) const {
  const Vec3<Unit<S>> y = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  const Quat<Unit<S>> turned = rotation_between(along, y) * orientation;
  return bounds(asked_of(shape, {Vec3<S>::zero(), turned}).view(), Transform<S>::of({Vec3<S>::zero(), turned})).high.y;
}

}  // namespace isostep
