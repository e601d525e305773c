// The tight world boxes of primitives and of lists of children.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// A half-space is cut by the cube of twice the position limit, which holds every body with its extent; where it faces
/// along a world axis exactly, as floors do, its surface bounds it too and bodies far above it make no pair.
template <class S> ISO_INLINE constexpr Aabb<S> bounds_of_half_space(const Primitive<S>& p, const Transform<S>& t) {
  const S edge = Limits<S>::position() + Limits<S>::position();
  Aabb<S> box = {{-edge, -edge, -edge}, {edge, edge, edge}};
  const Vec3<Unit<S>> n = t.rotation * p.normal;
  const S surface = p.offset + dot(n, t.position);
  for (int axis = 0; axis < 3; ++axis) {
    if (n[axis] == Unit<S>(1)) box.high.set(axis, surface);
    if (n[axis] == Unit<S>(-1)) box.low.set(axis, -surface);
  }
  return box;
}

/// The smallest box around a primitive, world frame.
/// Error: each side within one resolution step of the exact one, inwards or outwards; the broad phase adds a margin.
template <class S> ISO_INLINE constexpr Aabb<S> bounds(const Primitive<S>& p, const Transform<S>& t) {
  if (p.type == ShapeType::sphere) return Aabb<S>::around(t.position, {p.radius, p.radius, p.radius});
  if (p.type == ShapeType::half_space) return bounds_of_half_space(p, t);
  const Vec3<Unit<S>>(&rows)[3] = t.rotation.rows;
  if (p.type == ShapeType::capsule) {
    const S h = p.half.y;
    return Aabb<S>::around(
        t.position, {abs(rows[0].y) * h + p.radius, abs(rows[1].y) * h + p.radius, abs(rows[2].y) * h + p.radius});
  }
  return Aabb<S>::around(t.position, {dot(abs(rows[0]), p.half) + p.radius, dot(abs(rows[1]), p.half) + p.radius,
                                      dot(abs(rows[2]), p.half) + p.radius});
}

/// The box around a child of the body at `body`.
template <class S> ISO_INLINE constexpr Aabb<S> bounds(const Child<S>& child, const Transform<S>& body) {
  return bounds(child.primitive, compose(body, Transform<S>::of(child.pose)));
}

/// The box around all children; at least one.
template <class S> ISO_INLINE constexpr Aabb<S> bounds(std::span<const Child<S>> children, const Transform<S>& body) {
  ISO_ASSERT(!children.empty());
  Aabb<S> box = bounds(children[0], body);
  for (std::size_t i = 1; i < children.size(); ++i) box = merge(box, bounds(children[i], body));
  return box;
}

}  // namespace isostep
