// The cylinder.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/revolved.hpp"

namespace isostep {

/// Discs of one radius about local y, at -half_height and +half_height, and what lies between them.
template <class S = Literal> struct Cylinder {
  static constexpr ShapeType kType = ShapeType::cylinder;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = true;

  S radius;       // [m]
  S half_height;  // [m]

  static ISO_INLINE constexpr Cylinder of(const Primitive<S>& p) { return {p.radius, p.half.y}; }
  static ISO_INLINE constexpr Cylinder of(const Cylinder<Literal>& cylinder) {
    return {from_literal<S>(cylinder.radius), from_literal<S>(cylinder.half_height)};
  }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, 0, {S(0), half_height, S(0)}, radius, Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const {
    const ShapeFault fault = detail::fault_of_size(radius);
    return fault != ShapeFault::none ? fault : detail::fault_of_size(half_height);
  }
  ISO_INLINE constexpr Cylinder normalised() const { return *this; }
  ISO_INLINE detail::Revolved<S> revolved() const { return detail::Revolved<S>::cylinder(radius, half_height); }
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const { return revolved().bounds(t); }

  ISO_INLINE S inner_radius() const { return min(radius, half_height); }
  /// A prism of sixteen sides in it: its edges are on the surface, its faces up to 0.0192 radii below.
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    const detail::Revolved<S> smaller = detail::Revolved<S>::cylinder(radius - inset, half_height - inset);
    for (int k = 0; k < 32; ++k) point(smaller.rim_point(k & 1, k / 2));
    return S(0);
  }

  ISO_INLINE Vec3<S> middle() const { return Vec3<S>::zero(); }
  ISO_INLINE Vec3<S> support(Vec3<Unit<S>> n) const {
    return detail::support_of_discs({radius, radius}, half_height, n);
  }
  ISO_INLINE void find_face(Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face) const {
    detail::find_face_of_discs({radius, radius}, half_height, n, flat, face);
  }

  ISO_INLINE S mass(S density) const {
    return detail::saturating_product<S>({density, S(2 * detail::kPi), radius, radius, half_height});
  }
  /// Specific inertia: r^2/2 along the axis, r^2/4 + h^2/3 across it.
  ISO_INLINE Vec3<S> kappa() const {
    using U = Unit<S>;
    const S longer = max(radius, half_height);
    const U r = divide_to<U>(radius, longer), h = divide_to<U>(half_height, longer);
    const S across = detail::quotient<S>(U(0.5), U(0.125) * (r * r) + U(1.0 / 6) * (h * h), longer);
    return {across, S(2) / radius / radius, across};
  }
  ISO_INLINE Unit<S> relative_volume(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale);
    return U(detail::kPi / 4) * divide_to<U>(half_height, scale) * r * r;
  }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale), h = divide_to<U>(half_height, scale);
    const U across = U(0.25) * (r * r) + U(1.0 / 3) * (h * h);
    return {across, U(0.5) * (r * r), across};
  }

  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return detail::cast_revolved(detail::LocalRay<S>::of(t, origin, translation), revolved());
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    return revolved().closest(t, query);
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const { revolved().visit_lines(line); }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}  // its sizes say all
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
};
Cylinder(Literal, Literal)->Cylinder<Literal>;

}  // namespace isostep
