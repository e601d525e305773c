// Bodies of body_frames.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/narrowphase/hull_pairs.hpp"
#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/baked/box_solid.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/world/body_frames.hpp"

namespace isostep {

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
  return frame.surfaces ? isostep::leaf_at(parts_of(frame), frame.contents, index) : Leaf{index, 0};
}
}  // namespace detail

template <class S> BodyFrame<S> frame_at(const BodyMap<S>& map, Location at) {
  const BodyState<S>& state = map.state_at(at);
  const BodyProperties<S>& body = map.properties_at(at);
  const std::span<const Child<S>> children = map.children_of(body.shape);
  const Mat3<Unit<S>> turn = to_matrix(state.orientation);
  const Primitive<S>& first = children[0].primitive;
  const bool plain = children.size() == 1 && children[0].pose.is_identity();
  return {first.half,
          first.radius,
          state.centre,
          {-(turn * body.local_centre), turn},
          children.data(),
          map.contents(),
          static_cast<std::uint32_t>(children.size()),
          state.slot,
          at.set == Location::kAwake ? at.index + 1 : 0,
          plain ? part_kind_of(first.type) : PartKind::other,
          plain,
          (body.flags & body_flag::kSensor) != 0,
          at.is_asleep(),
          body.type != BodyType::dynamic && detail::has_surfaces(children)};
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

template <class S, class Visit>
ISO_INLINE bool visit_leaves(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                             LeafScratch& scratch, Visit&& visit) {
  scratch.pairs.clear();
  const auto add = [&](std::uint32_t i, std::uint32_t j) { scratch.pairs.push_back(std::uint64_t{i} << 32 | j); };
  const Transform<S> origin_b = origin_beside(a, b);
  bool whole = true;
  std::uint32_t leaf_a = 0;
  for (std::uint32_t i = 0; i < a.child_count && whole; ++i) {
    const ShapeView<S> part_a = detail::part(a, i);
    const Transform<S> ta = detail::placed(a.origin, a.children[i]);
    const bool surface_a = is_surface(part_a.primitive.type);
    std::uint32_t leaf_b = 0;
    for (std::uint32_t j = 0; j < b.child_count && whole; ++j) {
      whole = looks > 0;
      if (!whole) break;
      --looks;
      const ShapeView<S> part_b = detail::part(b, j);
      const Transform<S> tb = detail::placed(origin_b, b.children[j]);
      const bool surface_b = is_surface(part_b.primitive.type);
      if (surface_a && is_bounded(part_b.primitive.type)) {
        visit_triangles_near(part_b, tb, part_a, ta, margin,
                             [&](std::uint32_t triangle) { return add(leaf_a + triangle, leaf_b), true; });
      } else if (surface_b && is_bounded(part_a.primitive.type)) {
        visit_triangles_near(part_a, ta, part_b, tb, margin,
                             [&](std::uint32_t triangle) { return add(leaf_a, leaf_b + triangle), true; });
      } else if (!surface_a && !surface_b && overlap(grow(bounds(part_a, ta), margin), bounds(part_b, tb))) {
        add(leaf_a, leaf_b);
      }
      leaf_b += leaves_of(part_b);
    }
    leaf_a += leaves_of(part_a);
  }
  const auto count = static_cast<std::uint32_t>(scratch.pairs.size());
  if (scratch.sorting.size() < count) scratch.sorting.resize(count);
  stable_sort(scratch.pairs.data(), scratch.sorting.data(), count, OwnKey{});
  for (const std::uint64_t pair : scratch.pairs) {
    if (!visit(static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair))) return false;
  }
  return whole;
}

namespace detail {
/// As collide_parts, where one of the two is a triangle.
template <class S>
ISO_INLINE void collide_leaves(const BodyFrame<S>& a, Leaf i, const BodyFrame<S>& b, Leaf j, S margin,
                               Manifold<S>& out) {
  const ShapeView<S> part_a = part(a, i.child), part_b = part(b, j.child);
  const Transform<S> ta = placed(a.origin, a.children[i.child]);
  const Transform<S> tb = placed(origin_beside(a, b), b.children[j.child]);
  if (is_surface(part_b.primitive.type)) return collide_with_triangle(part_a, ta, part_b, j.triangle, tb, margin, out);
  collide_with_triangle(part_b, tb, part_a, i.triangle, ta, margin, out);
  out.normal = -out.normal;
}
}  // namespace detail

template <class S>
void collide_parts(CollidePolyhedra<S> polyhedra, const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b,
                   std::uint32_t j, S margin, Manifold<S>& out) {
  if (a.surfaces || b.surfaces) {
    const Leaf leaf_a = detail::leaf_at(a, i), leaf_b = detail::leaf_at(b, j);
    i = leaf_a.child;
    j = leaf_b.child;
    if (is_surface(a.children[i].primitive.type) || is_surface(b.children[j].primitive.type))
      return detail::collide_leaves(a, leaf_a, b, leaf_b, margin, out);
  }
  const ShapeView<S> part_a = detail::part(a, i), part_b = detail::part(b, j);
  const Transform<S> origin_b = origin_beside(a, b);
  const Transform<S> ta = a.plain ? a.origin : detail::placed(a.origin, a.children[i]);
  const Transform<S> tb = b.plain ? origin_b : detail::placed(origin_b, b.children[j]);
  const bool hull_a = part_a.primitive.type == ShapeType::hull, hull_b = part_b.primitive.type == ShapeType::hull;
  if (hull_a && hull_b) {
    polyhedra(detail::hull_of(part_a), ta, detail::hull_of(part_b), tb, margin, out);
  } else if (hull_b && part_a.primitive.type == ShapeType::box) {
    polyhedra(BoxSolid<S>(part_a.primitive.half).polyhedron(), ta, detail::hull_of(part_b), tb, margin, out);
  } else if (hull_a && part_b.primitive.type == ShapeType::box) {  // the box is a, as in ShapePairs
    polyhedra(BoxSolid<S>(part_b.primitive.half).polyhedron(), tb, detail::hull_of(part_a), ta, margin, out);
    out.normal = -out.normal;
  } else {
    collide(part_a, ta, part_b, tb, margin, out);
  }
}

template <class S> bool bodies_touch(const BodyMap<S>& map, std::uint32_t slot_a, std::uint32_t slot_b) {
  constexpr S kMargin = detail::kSpeculativeDistance<S>;
  const BodyFrame<S> a = frame_at(map, map.location(slot_a)), b = frame_at(map, map.location(slot_b));
  bool touch = false;
  std::uint64_t looks = ~std::uint64_t{0};
  const auto visit = [&](std::uint32_t i, std::uint32_t j) {
    Manifold<S> manifold;
    collide_parts(collide_polyhedra<S>, a, i, b, j, kMargin, manifold);
    touch = manifold.count > 0;
    return !touch;
  };
  LeafScratch scratch;
  if (a.surfaces || b.surfaces) visit_leaves(a, b, kMargin, looks, scratch, visit);
  else visit_parts(a, b, kMargin, looks, visit);
  return touch;
}

}  // namespace isostep
