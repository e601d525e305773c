// The sphere.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep {

/// Centre at the local origin.
template <class S = Literal> struct Sphere {
  static constexpr ShapeType kType = ShapeType::sphere;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = true;

  S radius;  // [m]

  static ISO_INLINE constexpr Sphere of(const Primitive<S>& p) { return {p.radius}; }
  static ISO_INLINE constexpr Sphere of(const Sphere<Literal>& s) { return {from_literal<S>(s.radius)}; }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, 0, Vec3<S>::zero(), radius, Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const { return detail::fault_of_size(radius); }
  ISO_INLINE constexpr Sphere normalised() const { return *this; }
  ISO_INLINE constexpr Aabb<S> bounds(const Transform<S>& t) const {
    return Aabb<S>::around(t.position, {radius, radius, radius});
  }

  ISO_INLINE S inner_radius() const { return radius; }
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    point(Vec3<S>::zero());
    return radius - inset;
  }

  ISO_INLINE Vec3<S> middle() const { return Vec3<S>::zero(); }
  ISO_INLINE Vec3<S> support(Vec3<Unit<S>>) const { return Vec3<S>::zero(); }
  ISO_INLINE void find_face(Vec3<Unit<S>>, Unit<S>, SolidFace<S>& face) const { face.add(Vec3<S>::zero(), 0); }

  ISO_INLINE S mass(S density) const {
    return detail::saturating_product<S>({density, S(4.188790204786391), radius, radius, radius});
  }
  ISO_INLINE Vec3<S> kappa() const {
    const S kappa = S(2.5) / radius / radius;
    return {kappa, kappa, kappa};
  }
  ISO_INLINE Unit<S> relative_volume(S scale) const {
    const Unit<S> r = divide_to<Unit<S>>(radius, scale);
    return Unit<S>(detail::kPi / 6) * r * r * r;
  }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S scale) const {
    const Unit<S> r = divide_to<Unit<S>>(radius, scale), inertia = Unit<S>(0.4) * (r * r);
    return {inertia, inertia, inertia};
  }

  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return detail::cast_sphere(detail::LocalRay<S>::of(t, origin, translation), Vec3<S>::zero(), radius);
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    return detail::closest_on_core(Vec3<S>::zero(), radius, t, query);
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    for (int axis = 0; axis < 3; ++axis)
      detail::visit_arc(line, Vec3<S>::zero(), radius, (axis + 1) % 3, (axis + 2) % 3);
  }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}  // its sizes say all
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
};
Sphere(Literal)->Sphere<Literal>;

}  // namespace isostep
