// A shape for the tests alone: a truncated cone, as a file in shapes/ would declare it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/revolved.hpp"

namespace isostep {

/// A disc about local y at -half_height, one of half its radius at half_height, and what lies between them.
template <class S = Literal> struct Probe {
  static constexpr ShapeType kType = ShapeType::probe;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = false;

  S radius;       // [m] of the base
  S half_height;  // [m]

  static ISO_INLINE constexpr Probe of(const Primitive<S>& p) { return {p.radius, p.half.y}; }
  static ISO_INLINE constexpr Probe of(const Probe<Literal>& probe) {
    return {from_literal<S>(probe.radius), from_literal<S>(probe.half_height)};
  }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, 0, {S(0), half_height, S(0)}, radius, Vec3<Unit<S>>::zero(), S(0)};
  }
  ISO_INLINE constexpr ShapeFault fault() const {
    const ShapeFault fault = detail::fault_of_size(radius);
    return fault != ShapeFault::none ? fault : detail::fault_of_size(half_height);
  }
  ISO_INLINE constexpr Probe normalised() const { return *this; }
  ISO_INLINE S top() const { return radius * S(0.5); }
  ISO_INLINE detail::Revolved<S> revolved() const {
    const Direction<S> d = direction_of(half_height + half_height, radius - top(), S(0));
    return {half_height, {radius, top()}, d.x, d.y, d.length * S(0.5)};
  }
  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const { return revolved().bounds(t); }

  ISO_INLINE S inner_radius() const {
    return min(half_height, radius * S(0.75) * revolved().out * Unit<S>(0.98));  // of sixteen sides
  }
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    const detail::Revolved<S> solid = revolved();
    const Unit<S> part = inset == S(0) ? Unit<S>(0) : divide_to<Unit<S>>(inset, inner_radius());
    for (int k = 0; k < 32; ++k) {
      const Vec3<S> v = solid.rim_point(k & 1, k / 2);
      point(v - v * part);
    }
    return S(0);
  }
  ISO_INLINE Vec3<S> middle() const { return Vec3<S>::zero(); }
  ISO_INLINE Vec3<S> support(Vec3<Unit<S>> n) const {
    return detail::support_of_discs({radius, top()}, half_height, n);
  }
  ISO_INLINE void find_face(Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face) const {
    detail::find_face_of_discs({radius, top()}, half_height, n, flat, face);
  }

  ISO_INLINE S mass(S density) const {
    return detail::saturating_product<S>({density, S(detail::kPi * 7 / 6), radius, radius, half_height});
  }
  ISO_INLINE Vec3<S> centre_of_mass() const { return {S(0), half_height * S(-3.0 / 14), S(0)}; }
  ISO_INLINE Unit<S> relative_volume(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale);
    return U(detail::kPi * 7 / 48) * divide_to<U>(half_height, scale) * r * r;
  }
  /// Specific inertia about the centre of mass: 93/280 r^2 along the axis; across it 93/560 r^2 and 291/980 h^2.
  ISO_INLINE Mat3<Unit<S>> relative_inertia(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale), h = divide_to<U>(half_height, scale);
    const U across = U(93.0 / 560) * (r * r) + U(291.0 / 980) * (h * h);
    return Mat3<U>::diagonal({across, U(93.0 / 280) * (r * r), across});
  }
  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return detail::cast_revolved(detail::LocalRay<S>::of(t, origin, translation), revolved());
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {  // of the truncated cone
    return revolved().closest(t, query);
  }
  template <class Line> ISO_INLINE void visit_lines(const Line& line) const { revolved().visit_lines(line); }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
};
Probe(Literal, Literal)->Probe<Literal>;

}  // namespace isostep
