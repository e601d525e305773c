// The capsule.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep {

namespace detail {
/// A capsule as fractions of its height h + r: a = h / (h + r), b = r / (h + r); the cylinder holds 1.5 a / d of the
/// volume and the two hemispheres b / d.
template <class U> struct CapsuleParts { U a, b, d; };
/// Specific inertia across the axis, with height h and radius r in any one unit: cylinder r^2/4 + h^2/3, hemispheres
/// 2/5 r^2 + h^2 + 3/4 h r, weighted by volume, times d.
template <class U> ISO_INLINE U capsule_across(CapsuleParts<U> parts, U h, U r) {
  const U cylinder = U(0.25) * (r * r) + U(1.0 / 3) * (h * h);
  const U ends = U(0.4) * (r * r) + h * h + U(0.75) * (h * r);
  return U(1.5) * (parts.a * cylinder) + parts.b * ends;
}
/// Specific inertia about the axis, over r^2, times d: cylinder r^2/2, sphere 2/5 r^2.
template <class U> ISO_INLINE U capsule_along(CapsuleParts<U> parts) { return U(0.75) * parts.a + U(0.4) * parts.b; }

/// In the plane across the axis the capsule is a disc. Where the ray enters the endless cylinder decides: between the
/// ends it is the side that is hit, beyond an end only that end's sphere can be.
template <class S> ISO_INLINE LocalHit<S> cast_capsule(const LocalRay<S>& ray, S h, S r) {
  using U = Unit<S>;
  const Vec3<S> o = ray.origin;
  const Vec3<S> from_core = {o.x, o.y - clamp(o.y, -h, h), o.z};
  if (dot_sum(from_core, from_core) <= product(r, r)) return inside_hit<S>();
  const Vec3<S> flat = {o.x, S(0), o.z};
  S y = o.y;
  if (dot_sum(flat, flat) > product(r, r)) {
    const Direction<S> across = direction_of(ray.translation.x, S(0), ray.translation.z);
    const Vec3<U> w = {across.x, U(0), across.z};
    S distance;
    if (!enter_sphere(flat, w, r, distance) || distance > across.length) return no_hit<S>();
    y = o.y + ray.translation.y * divide_to<U>(distance, across.length);
    if (abs(y) <= h) return {LocalHit<S>::entered, distance / across.length, normalise(flat + w * distance)};
  }
  return cast_sphere(ray, Vec3<S>{S(0), y > S(0) ? h : -h, S(0)}, r);
}
}  // namespace detail

/// A segment along local y from -half_height to +half_height, thickened by radius.
template <class S = Literal> struct Capsule {
  static constexpr ShapeType kType = ShapeType::capsule;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = true;

  S radius;       // [m]
  S half_height;  // [m] of the cylinder alone

  static ISO_INLINE constexpr Capsule of(const Primitive<S>& p) { return {p.radius, p.half.y}; }
  static ISO_INLINE constexpr Capsule of(const Capsule<Literal>& capsule) {
    return {from_literal<S>(capsule.radius), from_literal<S>(capsule.half_height)};
  }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, 0, core(), radius, Vec3<Unit<S>>::zero(), S(0)};
  }

  ISO_INLINE constexpr ShapeFault fault() const {
    const ShapeFault fault = detail::fault_of_size(radius);
    return fault != ShapeFault::none ? fault : detail::fault_of_size(half_height);
  }
  ISO_INLINE constexpr Capsule normalised() const { return *this; }
  ISO_INLINE constexpr Aabb<S> bounds(const Transform<S>& t) const {
    const Vec3<Unit<S>>(&rows)[3] = t.rotation.rows;
    const S h = half_height;
    return Aabb<S>::around(t.position,
                           {abs(rows[0].y) * h + radius, abs(rows[1].y) * h + radius, abs(rows[2].y) * h + radius});
  }

  ISO_INLINE S inner_radius() const { return radius; }
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    point(-core());
    point(core());
    return radius - inset;
  }

  ISO_INLINE Vec3<S> middle() const { return Vec3<S>::zero(); }
  ISO_INLINE Vec3<S> support(Vec3<Unit<S>> n) const { return n.y < Unit<S>(0) ? -core() : core(); }
  ISO_INLINE void find_face(Vec3<Unit<S>>, Unit<S>, SolidFace<S>& face) const {
    face.add(-core(), 0);
    face.add(core(), 1);
  }

  ISO_INLINE S mass(S density) const {
    const S length = half_height + half_height + S(4.0 / 3) * radius;
    return detail::saturating_product<S>({density, S(detail::kPi), radius, radius, length});
  }
  ISO_INLINE Vec3<S> kappa() const {
    const detail::CapsuleParts<Unit<S>> parts = fractions();
    const S across = detail::quotient<S>(parts.d, capsule_across(parts, parts.a, parts.b), half_height + radius);
    return {across, detail::quotient<S>(parts.d, capsule_along(parts), radius), across};
  }
  ISO_INLINE Unit<S> relative_volume(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale), y = divide_to<U>(half_height, scale);
    return (U(detail::kPi / 4) * y + U(detail::kPi / 6) * r) * r * r;
  }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S scale) const {
    using U = Unit<S>;
    const U r = divide_to<U>(radius, scale), y = divide_to<U>(half_height, scale);
    const detail::CapsuleParts<U> parts = fractions();
    const U across = divide_to<U>(capsule_across(parts, y, r), parts.d);
    return {across, divide_to<U>(capsule_along(parts) * (r * r), parts.d), across};
  }

  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return detail::cast_capsule(detail::LocalRay<S>::of(t, origin, translation), half_height, radius);
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    return detail::closest_on_core(core(), radius, t, query);
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    const Vec3<S> top = {S(0), half_height, S(0)};
    for (const Vec3<S>& end : {top, -top}) {
      const int begin = end.y > S(0) ? 0 : 8;
      detail::visit_arc(line, end, radius, 0, 2);
      detail::visit_arc(line, end, radius, 0, 1, begin, begin + 8);
      detail::visit_arc(line, end, radius, 2, 1, begin, begin + 8);
    }
    for (const Vec3<S>& side : {Vec3<S>{radius, S(0), S(0)}, Vec3<S>{S(0), S(0), radius}}) {
      line(side - top, side + top);
      line(-side - top, -side + top);
    }
  }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}  // its sizes say all
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }

 private:
  ISO_INLINE constexpr Vec3<S> core() const { return {S(0), half_height, S(0)}; }
  ISO_INLINE detail::CapsuleParts<Unit<S>> fractions() const {
    using U = Unit<S>;
    const U b = divide_to<U>(radius, half_height + radius);
    const U a = U(1) - b;
    return {a, b, U(1) + U(0.5) * a};
  }
};
Capsule(Literal, Literal)->Capsule<Literal>;

}  // namespace isostep
