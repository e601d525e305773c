// Bodies of body_frames.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/dynamics/contact_friction.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/store/body_frames.hpp"

namespace isostep {

/// Returns true if visit_leaves() must find the pairs of the body.
template <class S> ISO_INLINE bool is_large(const BodyFrame<S>& body) { return body.surfaces || body.tree != nullptr; }

namespace detail {
template <class S> ISO_INLINE Transform<S> placed(const Transform<S>& origin, const Child<S>& child) {
  return child.pose.is_identity() ? origin : compose(origin, Transform<S>::of(child.pose));
}
template <class S> ISO_INLINE ShapeView<S> part(const BodyFrame<S>& frame, std::uint32_t index) {
  return frame.contents.view(frame.children[index].primitive);
}
template <class S> ISO_INLINE std::span<const Child<S>> parts_of(const BodyFrame<S>& frame) {
  return {frame.children, frame.child_count};
}
template <class S> ISO_INLINE bool has_surfaces(std::span<const Child<S>> children) {
  for (const Child<S>& child : children) {
    if (is_surface(child.primitive.type)) return true;
  }
  return false;
}
template <class S> ISO_INLINE Leaf leaf_at(const BodyFrame<S>& frame, std::uint32_t index) {
  if (!frame.surfaces) return {index, 0};
  return isostep::leaf_at(frame.tree, parts_of(frame), frame.contents, index);
}
template <class S> LeafRange leaves_of_part(const BodyFrame<S>& frame, std::uint32_t index) {
  if (!frame.surfaces) return {index, 1};
  const std::uint32_t count = leaves_of<S>(part(frame, index));
  if (frame.tree != nullptr) return {frame.tree->first_leaf(index), count};
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < index; ++i) first += leaves_of<S>(part(frame, i));
  return {first, count};
}
}  // namespace detail

template <class S> BodyFrame<S> frame_at(const BodyMap<S>& map, Location at) {
  const BodyState<S>& state = map.state_at(at);
  const BodyProperties<S>& body = map.properties_at(at);
  const std::span<const Child<S>> children = map.shapes.children_of(body.shape);
  const Mat3<Unit<S>> turn = to_matrix(state.orientation);
  const Primitive<S>& first = children[0].primitive;
  const bool plain = children.size() == 1 && children[0].pose.is_identity();
  const ShapeTraits& parts = map.shapes.traits_of(body.shape);
  const bool traits = parts.flags != 0, sensor = (body.flags & body_flag::kSensor) != 0;
  const ChildTree<S>* const tree = map.shapes.tree_of(body.shape);
  const bool surfaces = body.type != BodyType::dynamic &&  // those have none
                        (tree != nullptr ? tree->has_surfaces() : detail::has_surfaces(children));
  return {first.half,
          first.radius,
          state.centre,
          {-(turn * body.local_centre), turn},
          children.data(),
          map.shapes.contents(),
          tree,
          static_cast<std::uint32_t>(children.size()),
          state.slot,
          at.set == Location::kAwake ? at.index + 1 : 0,
          plain && !traits ? part_kind_of(first.type) : PartKind::other,
          plain,
          sensor,
          sensor || parts.has(part_flag::kSensor),
          at.is_asleep(),
          surfaces,
          traits,
          surfaces || traits,
          (body.flags & body_flag::kReportContacts) != 0 || parts.has(part_flag::kReportContacts),
          mixes_alone(body.material) && parts.mixes_alone};
}

template <class S, class Visit>
ISO_INLINE bool visit_parts(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                            Visit&& visit) {
  if (a.child_count == 1 && b.child_count == 1) return visit(0u, 0u);
  // Most compounds have few children: their boxes are found once, not once for each child of the other.
  constexpr std::uint32_t kFew = 8;
  const Transform<S> origin_b = origin_beside(a, b);
  const auto box_of_b = [&](std::uint32_t j) {
    return bounds(detail::part(b, j), detail::placed(origin_b, b.children[j]));
  };
  Aabb<S> boxes_b[kFew];
  for (std::uint32_t j = 0; j < min(b.child_count, kFew); ++j) boxes_b[j] = box_of_b(j);
  for (std::uint32_t i = 0; i < a.child_count; ++i) {
    const Transform<S> ta = detail::placed(a.origin, a.children[i]);
    const Aabb<S> box_a = grow(bounds(detail::part(a, i), ta), margin);
    for (std::uint32_t j = 0; j < b.child_count; ++j) {
      if (looks == 0) return false;
      --looks;
      if (overlap(box_a, j < kFew ? boxes_b[j] : box_of_b(j)) && !visit(i, j)) return false;
    }
  }
  return true;
}

namespace detail {
template <class S> struct PlacedLeaves {
  ShapeView<S> shape;
  Transform<S> at;
  std::uint32_t first;  // leaf
};
template <class S, class Visit>
ISO_INLINE bool visit_leaves_of(const PlacedLeaves<S>& a, const PlacedLeaves<S>& b, S margin, Visit& visit) {
  const ShapeType type_a = a.shape.primitive.type, type_b = b.shape.primitive.type;
  const bool surface_a = is_surface(type_a), surface_b = is_surface(type_b);
  if (surface_a && is_bounded(type_b)) {
    return visit_triangles_near(b.shape, b.at, a.shape, a.at, margin,
                                [&](std::uint32_t triangle) { return visit(a.first + triangle, b.first); });
  }
  if (surface_b && is_bounded(type_a)) {
    return visit_triangles_near(a.shape, a.at, b.shape, b.at, margin,
                                [&](std::uint32_t triangle) { return visit(a.first, b.first + triangle); });
  }
  if (surface_a || surface_b || !overlap(grow(bounds(a.shape, a.at), margin), bounds(b.shape, b.at))) return true;
  return visit(a.first, b.first);
}
}  // namespace detail

namespace detail {
/// Calls visit(child, its first leaf) -> bool for all children of a body, or for those that its tree finds in a box.
template <class S, class Visit>
ISO_INLINE bool visit_children_near(const BodyFrame<S>& body, const Transform<S>& origin, const Aabb<S>& box,
                                    const Visit& visit) {
  if (body.tree != nullptr) {
    return body.tree->query(origin, box,
                            [&](std::uint32_t i) ISO_INLINE_LAMBDA { return visit(i, body.tree->first_leaf(i)); });
  }
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < body.child_count; ++i) {
    if (!visit(i, first)) return false;
    first += leaves_of(part(body, i));
  }
  return true;
}
/// Calls visit(leaves of outer, of inner) -> bool for children of two bodies. `inner` has a tree, or neither has.
template <class S, class Visit>
ISO_INLINE bool visit_near_children(const BodyFrame<S>& outer, const Transform<S>& of_outer, const BodyFrame<S>& inner,
                                    const Transform<S>& of_inner, S margin, const Visit& visit) {
  Aabb<S> box = {};
  if (outer.tree != nullptr) box = grow(inner.tree->bounds(of_inner), margin);
  return visit_children_near(outer, of_outer, box, [&](std::uint32_t i, std::uint32_t first_i) ISO_INLINE_LAMBDA {
    const PlacedLeaves<S> own = {part(outer, i), placed(of_outer, outer.children[i]), first_i};
    Aabb<S> nearby = {};
    if (inner.tree != nullptr) nearby = grow(bounds(own.shape, own.at), margin);
    return visit_children_near(inner, of_inner, nearby, [&](std::uint32_t j, std::uint32_t first_j) ISO_INLINE_LAMBDA {
      return visit(own, PlacedLeaves<S>{part(inner, j), placed(of_inner, inner.children[j]), first_j});
    });
  });
}
}  // namespace detail

template <class S, class Visit>
ISO_INLINE bool visit_leaves(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                             Visit&& visit) {
  using Leaves = detail::PlacedLeaves<S>;
  const Transform<S> origin_b = origin_beside(a, b);
  const auto look = [&](const Leaves& of_a, const Leaves& of_b) {  // no inline lambda: called from many places
    if (looks == 0) return false;
    --looks;
    return detail::visit_leaves_of(of_a, of_b, margin, visit);
  };
  const bool b_is_inner = b.tree != nullptr || a.tree == nullptr;
  if (b_is_inner) return detail::visit_near_children(a, a.origin, b, origin_b, margin, look);
  return detail::visit_near_children(b, origin_b, a, a.origin, margin,
                                     [&](const Leaves& of_b, const Leaves& of_a) { return look(of_a, of_b); });
}

template <class S>
void collide_parts(CollidePolyhedra<S> polyhedra, const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b,
                   std::uint32_t j, S margin, Manifold<S>& out) {
  const Leaf leaf_a = detail::leaf_at(a, i), leaf_b = detail::leaf_at(b, j);
  const Transform<S> origin_b = origin_beside(a, b);
  const Transform<S> ta = a.plain ? a.origin : detail::placed(a.origin, a.children[leaf_a.child]);
  const Transform<S> tb = b.plain ? origin_b : detail::placed(origin_b, b.children[leaf_b.child]);
  const LeafView<S> part_a = {detail::part(a, leaf_a.child), leaf_a.triangle};
  const LeafView<S> part_b = {detail::part(b, leaf_b.child), leaf_b.triangle};
  collide_leaves(part_a, ta, part_b, tb, margin, out, polyhedra);
}

template <class S> bool is_sensor_leaf(const BodyFrame<S>& body, std::uint32_t i) {
  return body.sensor || (body.senses && body.children[detail::leaf_at(body, i).child].traits.has(part_flag::kSensor));
}
template <class S>
PartMeeting meeting_of(const BodyMap<S>& map, const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b,
                       std::uint32_t j) {
  if (!a.traits && !b.traits) return a.sensor || b.sensor ? PartMeeting::sensed : PartMeeting::solid;
  const bool senses_a = is_sensor_leaf(a, i), senses_b = is_sensor_leaf(b, j);
  if (senses_a && senses_b) return PartMeeting::none;
  const BodyProperties<S>& of_a = map.properties_at(map.location(a.slot));
  const BodyProperties<S>& of_b = map.properties_at(map.location(b.slot));
  const auto filter = [](const BodyFrame<S>& body, std::uint32_t leaf, const BodyProperties<S>& of) {
    return body.children[detail::leaf_at(body, leaf).child].traits.filter_or(of.filter);
  };
  if (!should_collide(filter(a, i, of_a), filter(b, j, of_b))) return PartMeeting::none;
  return senses_a || senses_b ? PartMeeting::sensed : PartMeeting::solid;
}

namespace detail {
/// Returns the overlap of two leaves, one of which is a sensor's.
template <class S>
SensorOverlap overlap_of(const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b, std::uint32_t j) {
  const std::uint32_t child_a = leaf_at(a, i).child, child_b = leaf_at(b, j).child;
  return is_sensor_leaf(a, i) ? SensorOverlap{a.slot, b.slot, child_a, child_b}
                              : SensorOverlap{b.slot, a.slot, child_b, child_a};
}
}  // namespace detail

template <class S, class Visit>
void visit_meetings(const BodyMap<S>& map, const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, Visit&& visit) {
  std::uint64_t looks = ~std::uint64_t{0};
  const auto visit_leaf_pair = [&](std::uint32_t i, std::uint32_t j) {
    const PartMeeting meeting = meeting_of(map, a, i, b, j);
    return meeting == PartMeeting::none || visit(i, j, meeting);
  };
  if (is_large(a) || is_large(b)) visit_leaves(a, b, margin, looks, visit_leaf_pair);
  else visit_parts(a, b, margin, looks, visit_leaf_pair);
}

template <class S> Material<S> material_of_leaf(const BodyFrame<S>& body, std::uint32_t i, const Material<S>& own) {
  const Leaf leaf = detail::leaf_at(body, i);
  const Material<S>& of_part = body.children[leaf.child].traits.material_or(own);
  const SurfaceMaterial* const listed = listed_material(detail::part(body, leaf.child), leaf.triangle);
  if (listed == nullptr) return of_part;
  Material<S> material = of_part;
  material.friction = from_lattice<S>(listed->friction, SurfaceMaterial::kBits);
  material.restitution = from_lattice<S>(listed->restitution, SurfaceMaterial::kBits);
  material.static_friction = S(0);
  material.kind = 0;
  return material;
}

template <class S>
bool bodies_touch(const BodyMap<S>& map, std::uint32_t slot_a, std::uint32_t slot_b, ByParts by, S margin) {
  const BodyFrame<S> a = frame_at(map, map.location(slot_a)), b = frame_at(map, map.location(slot_b));
  bool touch = false;
  visit_meetings(map, a, b, margin, [&](std::uint32_t i, std::uint32_t j, PartMeeting meeting) {
    if (by == ByParts::solid && meeting != PartMeeting::solid) return true;
    Manifold<S> manifold;
    collide_parts(collide_polyhedra<S>, a, i, b, j, margin, manifold);
    touch = manifold.count > 0;
    return !touch;
  });
  return touch;
}

}  // namespace isostep
