// The half-space.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep {

/// All points p with normal . p <= offset, in the body's frame. It is for static bodies.
template <class S = Literal> struct HalfSpace {
  static constexpr ShapeType kType = ShapeType::half_space;
  static constexpr bool kBounded = false;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = true;

  Vec3<Unit<S>> normal;  // [1]
  S offset;              // [m]

  static ISO_INLINE constexpr HalfSpace of(const Primitive<S>& p) { return {p.normal, p.offset}; }
  static ISO_INLINE constexpr HalfSpace of(const HalfSpace<Literal>& space) {
    using U = Unit<S>;
    const Vec3<Literal>& n = space.normal;
    return {{from_literal<U>(n.x), from_literal<U>(n.y), from_literal<U>(n.z)}, from_literal<S>(space.offset)};
  }
  ISO_INLINE constexpr Primitive<S> primitive() const { return {kType, 0, Vec3<S>::zero(), S(0), normal, offset}; }

  ISO_INLINE ShapeFault fault() const {
    if (!detail::nearly_unit(normal.x, normal.y, normal.z, Unit<S>(0))) return ShapeFault::normal_not_unit;
    const bool inside = offset <= Limits<S>::position() && offset >= -Limits<S>::position();
    return inside ? ShapeFault::none : ShapeFault::offset_too_large;
  }
  ISO_INLINE HalfSpace normalised() const {
    if (detail::is_unit(normal.x, normal.y, normal.z, Unit<S>(0))) return *this;
    return {normalise(normal), offset};
  }
  /// The cube of twice the position limit, which holds every body with its extent; a half-space that faces exactly
  /// along a world axis, like a floor, is bounded by its surface too, and bodies far above it make no pair.
  ISO_INLINE constexpr Aabb<S> bounds(const Transform<S>& t) const {
    const S edge = Limits<S>::position() + Limits<S>::position();
    Aabb<S> box = {{-edge, -edge, -edge}, {edge, edge, edge}};
    const Vec3<Unit<S>> n = t.rotation * normal;
    const S surface = offset + dot(n, t.position);
    for (int axis = 0; axis < 3; ++axis) {
      if (n[axis] == Unit<S>(1)) box.high[axis] = surface;
      if (n[axis] == Unit<S>(-1)) box.low[axis] = -surface;
    }
    return box;
  }

  // A half-space has no mass: nothing moves it.
  ISO_INLINE S mass(S) const { return S(0); }
  ISO_INLINE Vec3<S> kappa() const { return Vec3<S>::zero(); }
  ISO_INLINE Unit<S> relative_volume(S) const { return Unit<S>(0); }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S) const { return Vec3<Unit<S>>::zero(); }

  /// Casts in the frame outside: a ray rotated first gains nothing.
  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    const Vec3<Unit<S>> n = t.rotation * normal;
    const auto height = dot_sum(n, origin - t.position) - widen<SumOf<Unit<S>, S>>(offset);
    if (height <= product(Unit<S>(0), S(0))) return detail::inside_hit<S>();
    const S fall = -dot(n, translation);
    const S start = round_to<S>(height);
    if (!(fall > S(0)) || start > fall) return detail::no_hit<S>();
    return {detail::LocalHit<S>::entered, start / fall, normal};
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    const Vec3<Unit<S>> n = t.rotation * normal;
    const S distance = round_to<S>(dot_sum(n, query - t.position) - widen<SumOf<Unit<S>, S>>(offset));
    return {query - n * distance, distance, n};
  }

  /// A square of 8 m with its diagonals, about the point of the surface that is nearest to the origin.
  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    const Tangents<Unit<S>> basis = tangents_of(normal);
    const Vec3<S> middle = normal * offset, u = basis.t * S(4), v = basis.u * S(4);
    const Vec3<S> corners[4] = {middle + u + v, middle + u - v, middle - u - v, middle - u + v};
    for (int i = 0; i < 4; ++i) line(corners[i], corners[(i + 1) % 4]);
    for (int i = 0; i < 2; ++i) line(corners[i], corners[i + 2]);
  }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}  // it has no end
  /// The point of its surface that is nearest to the body's origin.
  ISO_INLINE Pose<S> drawn_at(const Pose<S>& origin, const Pose<S>& pose) const {
    const Vec3<Unit<S>> out = to_matrix(pose.orientation) * normal;
    const S height = dot(origin.position - pose.position, out);
    return {origin.position + out * (offset - height), pose.orientation};
  }
};
HalfSpace(Vec3<Literal>, Literal)->HalfSpace<Literal>;

}  // namespace isostep
