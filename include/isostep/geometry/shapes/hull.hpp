// The convex hull.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/hull_content.hpp"
#include "isostep/geometry/baked/polyhedron_surface.hpp"
#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep {

/// The vertices that its blob has, see hull_blob.
template <class S = Literal> struct Hull {
  static constexpr ShapeType kType = ShapeType::hull;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = true;
  static constexpr bool kPrincipal = false;
  using Content = HullContent<S>;

  std::uint32_t blob;                // as Primitive has it
  const Content* content = nullptr;  // of a shape of a world

  static ISO_INLINE constexpr Hull of(const Primitive<S>& p, const Content* content) { return {p.blob, content}; }
  static ISO_INLINE constexpr Hull of(const Hull<Literal>& hull) { return {hull.blob}; }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, blob, Vec3<S>::zero(), S(0), Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const { return ShapeFault::none; }
  static ISO_INLINE ShapeFault fault_of(const Content& content) { return content.fault; }
  ISO_INLINE constexpr Hull normalised() const { return *this; }
  /// Without its content a hull has no geometry: who asks for it nevertheless has a bug, which stops the program.
  ISO_INLINE Polyhedron<S> polyhedron() const {
    if (content == nullptr) ISO_TRAP();
    return content->solid.polyhedron();
  }
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const {
    const ColumnsView<S> vertices = polyhedron().vertices;
    Vec3<S> low = t.rotation * vertices[0], high = low;
    for (std::uint32_t i = 1; i < vertices.size(); ++i) {
      const Vec3<S> p = t.rotation * vertices[i];
      low = min(low, p);
      high = max(high, p);
    }
    return {t.position + low, t.position + high};
  }

  ISO_INLINE S inner_radius() const { return polyhedron().inner_radius; }
  /// Smaller, about the mean of the vertices: as deep where its faces are nearest to that, deeper elsewhere.
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    using U = Unit<S>;
    const Polyhedron<S> solid = polyhedron();
    const U part = inset == S(0) ? U(0) : divide_to<U>(inset, solid.inner_radius);
    const U share = divide_to<U>(S(1), S(static_cast<int>(solid.vertices.size())));
    Vec3<S> middle = Vec3<S>::zero();
    for (const Vec3<S> v : solid.vertices) middle += v * share;
    for (const Vec3<S> v : solid.vertices) point(v + (middle - v) * part);
    return S(0);
  }

  ISO_INLINE S mass(S density) const {
    const Vec3<S>& w = content->widths;
    return detail::saturating_product<S>({density, convert<S>(content->filled), w.x, w.y, w.z});
  }
  ISO_INLINE Vec3<S> centre_of_mass() const { return content->centre_of_mass; }
  ISO_INLINE Unit<S> relative_volume(S scale) const {
    using U = Unit<S>;
    const Vec3<S> half = content->widths * S(0.5);
    return content->filled * divide_to<U>(half.x, scale) * divide_to<U>(half.y, scale) * divide_to<U>(half.z, scale);
  }
  ISO_INLINE Mat3<Unit<S>> relative_inertia(S scale) const {
    const Unit<S> ratio = divide_to<Unit<S>>(content->half_width, scale), square = ratio * ratio;
    Mat3<Unit<S>> inertia = content->inertia;
    for (Vec3<Unit<S>>& row : inertia.rows) row = row * square;
    return inertia;
  }

  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return cast_ray(polyhedron(), detail::LocalRay<S>::of(t, origin, translation));
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    const NearestPoint<S> nearest = nearest_on(polyhedron(), to_local(t, query));
    return {to_world(t, nearest.point), nearest.distance, t.rotation * nearest.normal};
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    const Polyhedron<S> solid = polyhedron();
    for (std::uint32_t e = 0; e < solid.half_edges.size(); e += 2)
      line(solid.vertices[solid.origin(e)], solid.vertices[solid.origin(e + 1)]);
  }
  /// Each face as a fan about its lowest vertex.
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle& triangle) const {
    const Polyhedron<S> solid = polyhedron();
    for (const std::uint32_t first : solid.faces) {
      std::uint32_t edge = solid.half_edges[first].next;
      for (std::uint32_t next = solid.half_edges[edge].next; next != first; next = solid.half_edges[next].next) {
        triangle(solid.vertices[solid.origin(first)], solid.vertices[solid.origin(edge)],
                 solid.vertices[solid.origin(next)]);
        edge = next;
      }
    }
  }
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
};

}  // namespace isostep
