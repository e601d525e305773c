// Bodies of closest_point.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"

namespace isostep {
namespace detail {

template <class S>
ISO_INLINE ClosestPoint<S> closest_on_half_space(const Primitive<S>& p, const Transform<S>& t, Vec3<S> query) {
  const Vec3<Unit<S>> n = t.rotation * p.normal;
  const S distance = round_to<S>(dot_sum(n, query - t.position) - widen<SumOf<Unit<S>, S>>(p.offset));
  return {query - n * distance, distance, n};
}

/// All other primitives are a core box thickened by a radius; the core of a sphere is a point, of a capsule a segment.
template <class S> ISO_INLINE ClosestPoint<S> closest_on_core(Vec3<S> half, S radius, Vec3<S> q) {
  using U = Unit<S>;
  Vec3<S> core = max(min(q, half), -half);
  const Vec3<S> out = q - core;
  const Direction<S> d = direction_of(out.x, out.y, out.z);
  if (d.length > S(0)) {
    const Vec3<U> n = {d.x, d.y, d.z};
    return {core + n * radius, d.length - radius, n};
  }
  const Vec3<S> depth = half - abs(q);
  int axis = 0;
  if (depth.y < depth[axis]) axis = 1;
  if (depth.z < depth[axis]) axis = 2;
  const bool negative = q[axis] < S(0);
  core.set(axis, negative ? -half[axis] - radius : half[axis] + radius);
  Vec3<U> n = Vec3<U>::zero();
  n.set(axis, negative ? U(-1) : U(1));
  return {core, -depth[axis] - radius, n};
}

}  // namespace detail

template <class S>
ClosestPoint<S> closest_point(const Primitive<S>& primitive, const Transform<S>& transform, Vec3<S> query) {
  if (primitive.type == ShapeType::half_space) return detail::closest_on_half_space(primitive, transform, query);
  const ClosestPoint<S> local = detail::closest_on_core(primitive.half, primitive.radius, to_local(transform, query));
  return {to_world(transform, local.point), local.distance, transform.rotation * local.normal};
}

}  // namespace isostep
