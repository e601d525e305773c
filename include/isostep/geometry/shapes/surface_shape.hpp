// SurfaceShape: the shape that meshes and height fields have in common, all but their blobs.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/baked/surface_queries.hpp"
#include "isostep/geometry/baked/unit_of_steps.hpp"
#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep {
namespace detail {

/// The fault of a surface: all its points must be within the extent of a shape.
template <class S, class G> ISO_INLINE ShapeFault fault_of_surface(const G& surface) {
  const MeshBox box = surface.bounds();
  const std::int64_t extent = floor_scaled(Limits<S>::extent(), surface.exponent());
  for (int axis = 0; axis < 3; ++axis) {
    if (-box.low[axis] > extent || box.high[axis] > extent) return ShapeFault::size_too_large;
  }
  return ShapeFault::none;
}
template <class S> ISO_INLINE Aabb<S> box_of_steps(const MeshBox& box, int exponent) {
  Aabb<S> metres;
  for (int axis = 0; axis < 3; ++axis) {
    metres.low[axis] = from_lattice<S>(box.low[axis], exponent);
    metres.high[axis] = from_lattice<S>(box.high[axis], exponent);
  }
  return metres;
}
/// The box around a box in another frame.
template <class S> ISO_INLINE Aabb<S> turned_box(const Aabb<S>& box, const Transform<S>& t) {
  Vec3<S> low = t.rotation * box.low, high = low;
  for (int corner = 1; corner < 8; ++corner) {
    const Vec3<S> p =
        t.rotation * Vec3<S>{(corner & 1) != 0 ? box.high.x : box.low.x, (corner & 2) != 0 ? box.high.y : box.low.y,
                             (corner & 4) != 0 ? box.high.z : box.low.z};
    low = min(low, p);
    high = max(high, p);
  }
  return {t.position + low, t.position + high};
}
template <class G, class S> ISO_INLINE Aabb<S> bounds_of_surface(const G& surface, const Transform<S>& t) {
  return turned_box(box_of_surface<G, S>(surface), t);
}
template <class S, class G, class Visit> ISO_INLINE void visit_points_of_surface(const G& surface, const Visit& visit) {
  for (std::uint32_t id = 0; id < surface.triangle_count(); ++id) {
    if (!surface.has_triangle(id)) continue;
    const BakedTriangle triangle = surface.triangle(id);
    Vec3<S> points[3];
    for (int i = 0; i < 3; ++i) points[i] = point_of_steps<S>(triangle.points[i], surface.exponent());
    visit(id, points);
  }
}
/// Visits each edge once: by its triangle of the lower id, or by the only one that is there.
template <class S, class G, class Line> ISO_INLINE void visit_lines_of_surface(const G& surface, const Line& line) {
  visit_points_of_surface<S>(surface, [&](std::uint32_t id, const Vec3<S>(&p)[3]) ISO_INLINE_LAMBDA {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t other = surface.neighbour(id, k);
      if (id < other || !surface.has_triangle(other)) line(p[k], p[(k + 1) % 3]);
    }
  });
}

}  // namespace detail

/// A shape of static and kinematic bodies. G is the TriangleMesh or BakedHeightField that its blob holds. It is touched
/// from its outward side alone: a solid with its centre behind a triangle passes it.
template <class S, ShapeType Type, class G> struct SurfaceShape {
  static constexpr ShapeType kType = Type;
  static constexpr bool kBounded = false;
  static constexpr bool kHasBlob = true;
  static constexpr bool kPrincipal = true;
  using Content = SurfaceContent<G>;

  std::uint32_t blob;                // as Primitive has it
  const Content* content = nullptr;  // of a shape of a world

  static ISO_INLINE constexpr SurfaceShape of(const Primitive<S>& p, const Content* content) {
    return {p.blob, content};
  }
  static ISO_INLINE constexpr SurfaceShape of(const SurfaceShape<Literal, Type, G>& shape) { return {shape.blob}; }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, blob, Vec3<S>::zero(), S(0), Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const { return ShapeFault::none; }
  static ISO_INLINE ShapeFault fault_of(const Content& content) {
    return content.surface ? detail::fault_of_surface<S>(*content.surface) : ShapeFault::blob_not_valid;
  }
  ISO_INLINE constexpr SurfaceShape normalised() const { return *this; }
  ISO_INLINE const G& surface() const { return *content->surface; }
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const { return detail::bounds_of_surface(surface(), t); }

  // A surface has no mass: nothing moves it.
  ISO_INLINE S mass(S) const { return S(0); }
  ISO_INLINE Vec3<S> kappa() const { return Vec3<S>::zero(); }
  ISO_INLINE Unit<S> relative_volume(S) const { return Unit<S>(0); }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S) const { return Vec3<Unit<S>>::zero(); }

  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return cast_on_surface(surface(), detail::LocalRay<S>::of(t, origin, translation), RayReach<S>{});
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    const ClosestPoint<S> nearest = nearest_on_surface(surface(), to_local(t, query));
    return {to_world(t, nearest.point), nearest.distance, t.rotation * nearest.normal};
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    detail::visit_lines_of_surface<S>(surface(), line);
  }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle& triangle) const {
    detail::visit_points_of_surface<S>(
        surface(), [&](std::uint32_t, const Vec3<S>(&p)[3]) ISO_INLINE_LAMBDA { triangle(p[0], p[1], p[2]); });
  }
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
};

}  // namespace isostep
