// The cone.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/revolved.hpp"

namespace isostep {

/// A disc about local y at -half_height, the apex at +half_height, and what lies between them. The centre of mass is a
/// quarter of the height above the base: half of half_height below the frame's origin.
template <class S = Literal> struct Cone {
  static constexpr ShapeType kType = ShapeType::cone;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = false;

  S radius;       // [m] of the base
  S half_height;  // [m]

  static ISO_INLINE constexpr Cone of(const Primitive<S>& p) { return {p.radius, p.half.y}; }
  static ISO_INLINE constexpr Cone of(const Cone<Literal>& cone) {
    return {from_literal<S>(cone.radius), from_literal<S>(cone.half_height)};
  }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, 0, {S(0), half_height, S(0)}, radius, Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const {
    const ShapeFault fault = detail::fault_of_size(radius);
    return fault != ShapeFault::none ? fault : detail::fault_of_size(half_height);
  }
  ISO_INLINE constexpr Cone normalised() const { return *this; }
  ISO_INLINE detail::Revolved<S> revolved() const { return detail::Revolved<S>::cone(radius, half_height); }
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const { return revolved().bounds(t); }

  /// About the mean of the core's vertices, a third of the height above the base.
  ISO_INLINE S inner_radius() const {
    const detail::Revolved<S> solid = revolved();
    return min(half_height * S(2.0 / 3), half_height * (solid.up * Unit<S>(kToSide)) * S(4.0 / 3));
  }
  /// A pyramid of sixteen sides in it: its edges are on the surface, its faces up to 0.0192 radii below. Smaller ones
  /// are so about the mean of their vertices, for which the apex counts eightfold.
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    const detail::Revolved<S> solid = revolved();
    const Unit<S> part = inset == S(0) ? Unit<S>(0) : divide_to<Unit<S>>(inset, inner_radius());
    const Vec3<S> mean = middle();
    const auto add = [&](Vec3<S> v) ISO_INLINE_LAMBDA { point(v + (mean - v) * part); };
    for (int k = 0; k < 16; ++k) add(solid.rim_point(0, k));
    for (int k = 0; k < 8; ++k) add(Vec3<S>{S(0), half_height, S(0)});
    return S(0);
  }

  /// [m] The mean of the core's vertices: by it sweeps and contacts tell on which side of a surface it is.
  ISO_INLINE Vec3<S> middle() const { return {S(0), -half_height * S(1.0 / 3), S(0)}; }

  ISO_INLINE Vec3<S> support(Vec3<Unit<S>> n) const { return detail::support_of_discs({radius, S(0)}, half_height, n); }
  ISO_INLINE void find_face(Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face) const {
    detail::find_face_of_discs({radius, S(0)}, half_height, n, flat, face);
  }

  ISO_INLINE S mass(S density) const {
    return detail::saturating_product<S>({density, S(2 * detail::kPi / 3), radius, radius, half_height});
  }
  ISO_INLINE Vec3<S> centre_of_mass() const { return {S(0), half_height * S(-0.5), S(0)}; }
  ISO_INLINE Unit<S> relative_volume(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale);
    return U(detail::kPi / 12) * divide_to<U>(half_height, scale) * r * r;
  }
  /// Specific inertia about the centre of mass: 3/10 r^2 along the axis, 3/20 (r^2 + h^2) across it.
  ISO_INLINE Mat3<Unit<S>> relative_inertia(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale), h = divide_to<U>(half_height, scale);
    const U across = U(0.15) * (r * r) + U(0.15) * (h * h);
    return Mat3<U>::diagonal({across, U(0.3) * (r * r), across});
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

 private:
  static constexpr double kToSide = 0.98;  // cos(pi / 16), rounded down: the core's sides are nearer than the cone's
};
Cone(Literal, Literal)->Cone<Literal>;

}  // namespace isostep
