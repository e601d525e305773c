// A plane that parts a ball or capsule from a ball, capsule or box: soon found, if not the one with the widest gap.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/shape_cast.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/math/segment.hpp"

namespace isostep {

/// The axis of a ball or capsule and the radius around it.
template <class S> struct RoundCore {
  detail::Segment<S> axis;  // [m]
  S radius;                 // [m]
};
/// Returns a core of one or two vertices, in world axes, relative to the position of the frame that `t` leads from.
template <class S> ISO_INLINE RoundCore<S> round_core(const ConvexCore<S>& core, const Transform<S>& t) {
  const Vec3<S> first = t.rotation * core.vertices[0], last = t.rotation * core.vertices[core.vertices.size() - 1];
  const Vec3<S> half = (last - first) * S(0.5);
  const Heading<S> heading = heading_of(half);
  return {{first + half, heading.direction, heading.length}, core.radius};
}

namespace detail {
/// Returns the plane across the shortest way between two axes. `axis` is relative to the position of the mover, `to`
/// [m] leads from there to the other.
template <class S>
ISO_INLINE Parting<S> part_axes(const Segment<S>& axis, S radii, const Segment<S>& other, Vec3<S> to, Vec3<S> at) {
  const Segment<S> there = {other.centre + to, other.direction, other.half};
  const ClosestPair<S> pair = closest_points(axis, there);
  const Vec3<Unit<S>> n = heading_of(axis.at(pair.s) - there.at(pair.t)).direction;
  const S reaches = axis.half * abs(dot(axis.direction, n)) + there.half * abs(dot(there.direction, n));
  return {n, at, dot(axis.centre - there.centre, n) - reaches - radii};
}
/// Returns the plane of the face that the axis lies beyond by most. If it lies beyond none, the plane across the way
/// from the box to the axis' point nearest to the box's middle.
template <class S>
ISO_INLINE Parting<S> part_box(const RoundCore<S>& core, Vec3<S> half, const Transform<S>& t, Vec3<S> at) {
  const Vec3<S> centre = transposed_times(t.rotation, at + core.axis.centre - t.position);
  const Vec3<Unit<S>> d = transposed_times(t.rotation, core.axis.direction);
  const Vec3<S> apart = abs(centre) - abs(d) * core.axis.half - half;
  const int k = apart.x < apart.y ? (apart.y < apart.z ? 2 : 1) : (apart.x < apart.z ? 2 : 0);
  Vec3<Unit<S>> n = Vec3<Unit<S>>::zero();
  n[k] = centre[k] < S(0) ? Unit<S>(-1) : Unit<S>(1);
  S gap = apart[k] - core.radius;
  if (!(S(0) < gap)) {
    const Segment<S> axis = {centre, d, core.axis.half};
    const Vec3<S> nearest = axis.at(axis.nearest(Vec3<S>::zero()));
    const Vec3<Unit<S>> across = heading_of(nearest - max(min(nearest, half), -half)).direction;
    const S wider = dot(centre, across) - axis.half * abs(dot(d, across)) - dot(half, abs(across)) - core.radius;
    if (gap < wider) n = across, gap = wider;
  }
  return {t.rotation * n, at, gap};
}
}  // namespace detail

/// Returns the plane that parts `core`, with its position at `at` [m], from a shape at `t`,
/// half-spaces included. Shapes without a closed form give no plane. Error: the gap [m] is never too
/// wide.
template <class S>
ISO_INLINE Parting<S> part_round(const RoundCore<S>& core, Vec3<S> at, const ShapeView<S>& shape,
                                 const Transform<S>& t) {
  const Primitive<S>& other = shape.primitive;
  Parting<S> plane = {};
  if (other.type == ShapeType::box) {
    plane = detail::part_box(core, other.half, t, at);
  } else if (other.type == ShapeType::sphere || other.type == ShapeType::capsule) {
    const detail::Segment<S> axis = {Vec3<S>::zero(), t.rotation.column(1), other.half.y};
    plane = detail::part_axes(core.axis, core.radius + other.radius, axis, t.position - at, at);
  } else if (other.type == ShapeType::half_space) {
    const Vec3<Unit<S>> n = t.rotation * other.normal;
    const S lowest = dot(at + core.axis.centre - t.position, n) - core.axis.half * abs(dot(core.axis.direction, n));
    plane = {n, at, lowest - other.offset - core.radius};
  }
  const S extent = max_abs(t.position - at) + max_abs(other.half) + other.radius;
  plane.gap -= detail::gap_noise(extent + max_abs(core.axis.centre) + core.axis.half);
  return plane;
}

}  // namespace isostep
