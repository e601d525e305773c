// The triangle mesh.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/surface_parts.hpp"

namespace isostep {

/// The triangles that its blob has, see mesh_blob. For static bodies. It is touched from its
/// outward side alone: what has its centre behind a triangle passes it.
template <class S = Literal> struct Mesh {
  static constexpr ShapeType kType = ShapeType::mesh;
  static constexpr bool kBounded = false;
  static constexpr bool kHasBlob = true;
  static constexpr bool kPrincipal = true;
  using Content = MeshContent;

  std::uint32_t blob;                // as Primitive has it
  const Content* content = nullptr;  // of a shape of a world

  static ISO_INLINE constexpr Mesh of(const Primitive<S>& p, const Content* content) { return {p.blob, content}; }
  static ISO_INLINE constexpr Mesh of(const Mesh<Literal>& shape) { return {shape.blob}; }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, blob, Vec3<S>::zero(), S(0), Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const { return ShapeFault::none; }
  static ISO_INLINE ShapeFault fault_of(const Content& content) { return detail::fault_of_surface<S>(content); }
  ISO_INLINE constexpr Mesh normalised() const { return *this; }
  ISO_INLINE const auto& surface() const { return *content->surface; }
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const { return detail::bounds_of_surface(surface(), t); }

  // Nothing moves it.
  ISO_INLINE S mass(S) const { return S(0); }
  ISO_INLINE Vec3<S> kappa() const { return Vec3<S>::zero(); }
  ISO_INLINE Unit<S> relative_volume(S) const { return Unit<S>(0); }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S) const { return Vec3<Unit<S>>::zero(); }

  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return cast_on_surface(surface(), detail::LocalRay<S>::of(t, origin, translation));
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    const ClosestPoint<S> nearest = nearest_on_surface(surface(), to_local(t, query));
    return {to_world(t, nearest.point), nearest.distance, t.rotation * nearest.normal};
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    detail::visit_lines_of_surface<S>(surface(), line);
  }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle& triangle) const {
    detail::visit_points_of_surface<S>(surface(), [&](std::uint32_t, const Vec3<S>(&p)[3]) ISO_INLINE_LAMBDA {
      triangle(p[0], p[1], p[2]);
    });
  }
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
};

}  // namespace isostep
