// Bodies of validate.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/validate.hpp"

namespace isostep {
namespace detail {

template <class S> ISO_INLINE ShapeFault fault_of_size(S size) {
  if (!(size > S(0))) return ShapeFault::size_not_positive;
  if (size < Limits<S>::minimum_size()) return ShapeFault::size_too_small;
  if (size > Limits<S>::extent()) return ShapeFault::size_too_large;
  return ShapeFault::none;
}

/// c^2; a component beyond 9/8 counts as that: enough to be refused, and four of them fit the sum.
template <class U> ISO_INLINE Sum<U> bounded_square(U c) {
  const U bounded = clamp(c, U(-1.125), U(1.125));
  return product(bounded, bounded);
}
template <class U> ISO_INLINE Sum<U> squared_norm(U x, U y, U z, U w) {
  return bounded_square(x) + bounded_square(y) + bounded_square(z) + bounded_square(w);
}
template <class U> ISO_INLINE bool nearly_unit(U x, U y, U z, U w) {
  const Sum<U> norm = squared_norm(x, y, z, w);
  return norm > product(U(1), U(1 - 1.0 / 64)) && norm < product(U(1), U(1 + 1.0 / 64));
}
/// As close to one as the format can say.
template <class U> ISO_INLINE bool is_unit(U x, U y, U z, U w) { return round_to<U>(squared_norm(x, y, z, w)) == U(1); }

template <class S> ISO_INLINE bool is_zero(Vec3<S> v) { return v == Vec3<S>::zero(); }
template <class S> ISO_INLINE bool unused_are_zero(const Primitive<S>& p) {
  if (p.reserved != 0) return false;
  if (p.type == ShapeType::half_space) return is_zero(p.half) && p.radius == S(0);
  if (!is_zero(p.normal) || p.offset != S(0)) return false;
  if (p.type == ShapeType::sphere) return is_zero(p.half);
  if (p.type == ShapeType::capsule) return p.half.x == S(0) && p.half.z == S(0);
  return p.radius == S(0);
}

}  // namespace detail

template <class S> ShapeFault validate(const Primitive<S>& p) {
  if (static_cast<std::uint32_t>(p.type) >= kShapeTypes) return ShapeFault::unknown_type;
  if (!is_finite(p.half) || !is_finite(p.radius) || !is_finite(p.normal) || !is_finite(p.offset)) {
    return ShapeFault::not_finite;
  }
  if (!detail::unused_are_zero(p)) return ShapeFault::unused_field_set;
  if (p.type == ShapeType::half_space) {
    if (!detail::nearly_unit(p.normal.x, p.normal.y, p.normal.z, Unit<S>(0))) return ShapeFault::normal_not_unit;
    const bool inside = p.offset <= Limits<S>::position() && p.offset >= -Limits<S>::position();
    return inside ? ShapeFault::none : ShapeFault::offset_too_large;
  }
  if (p.type != ShapeType::box) {
    const ShapeFault fault = detail::fault_of_size(p.radius);
    if (fault != ShapeFault::none) return fault;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const bool used = p.type == ShapeType::box || (p.type == ShapeType::capsule && axis == 1);
    const ShapeFault fault = used ? detail::fault_of_size(p.half[axis]) : ShapeFault::none;
    if (fault != ShapeFault::none) return fault;
  }
  return ShapeFault::none;
}

template <class S> ShapeFault validate(const Pose<S>& pose) {
  const Quat<Unit<S>> q = pose.orientation;
  if (!is_finite(pose.position) || !is_finite(q.x) || !is_finite(q.y) || !is_finite(q.z) || !is_finite(q.w)) {
    return ShapeFault::not_finite;
  }
  return detail::nearly_unit(q.x, q.y, q.z, q.w) ? ShapeFault::none : ShapeFault::orientation_not_unit;
}

template <class S> ShapeFault validate(std::span<const Child<S>> children) {
  if (children.empty()) return ShapeFault::no_children;
  const S extent = Limits<S>::extent();
  const Aabb<S> room = Aabb<S>::around(Vec3<S>::zero(), {extent, extent, extent});
  for (const Child<S>& child : children) {
    ShapeFault fault = validate(child.primitive);
    if (fault == ShapeFault::none) fault = validate(child.pose);
    if (fault != ShapeFault::none) return fault;
    // The position alone first: only then is the box around the child free of overflow.
    if (!contains(room, Aabb<S>{child.pose.position, child.pose.position})) return ShapeFault::outside_extent;
    if (child.primitive.type == ShapeType::half_space) continue;
    const Child<S> unit = normalised(child);
    if (!contains(room, bounds(unit.primitive, Transform<S>::of(unit.pose)))) return ShapeFault::outside_extent;
  }
  return ShapeFault::none;
}

template <class S> Child<S> normalised(const Child<S>& child) {
  Child<S> result = child;
  const Vec3<Unit<S>> n = child.primitive.normal;
  if (child.primitive.type == ShapeType::half_space && !detail::is_unit(n.x, n.y, n.z, Unit<S>(0))) {
    const auto direction = direction_of(n.x, n.y, n.z);
    result.primitive.normal = {direction.x, direction.y, direction.z};
  }
  const Quat<Unit<S>> q = child.pose.orientation;
  if (!detail::is_unit(q.x, q.y, q.z, q.w)) result.pose.orientation = normalise(q);
  return result;
}

}  // namespace isostep
