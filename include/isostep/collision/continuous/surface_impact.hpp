// Swept cores against surfaces: the least fraction of the triangles that the sweep's box meets.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/time_of_impact.hpp"
#include "isostep/geometry/baked/unit_of_steps.hpp"
#include "isostep/geometry/surfaces.hpp"

namespace isostep::detail {

/// Returns the box around all that a core passes, in the frame that leads to the world by `t`, grown by `margin`: its
/// boxes at both ends and the bow between them, within the ball in which it turns. The ball of a core far from its
/// body's middle would hold a thousand times the triangles.
template <class S>
Aabb<S> swept_box(const Transform<S>& t, const ConvexCore<S>& core, const CoreMotion<S>& motion, S margin) {
  const Transform<S> from = relative(t, Transform<S>::of(motion.start)), to = relative(t, Transform<S>::of(motion.end));
  S reach = S(0);
  for (const Vec3<S>& v : core.vertices) reach = max(reach, length(v - motion.centre));
  const Aabb<S> ends = grow(merge(box_of(core, from), box_of(core, to)), bow_of(motion, reach));
  const S radius = reach + core.radius;
  const Vec3<S> ball = {radius, radius, radius};
  const Aabb<S> turned =
      merge(Aabb<S>::around(to_world(from, motion.centre), ball), Aabb<S>::around(to_world(to, motion.centre), ball));
  return grown_with_slack<S>({max(ends.low, turned.low), min(ends.high, turned.high)}, margin);
}
template <class S> ISO_INLINE MeshBox steps_of(const Aabb<S>& box, int exponent) {
  MeshBox steps;
  for (int axis = 0; axis < 3; ++axis) {
    steps.low[axis] = floor_scaled(box.low[axis], exponent);
    steps.high[axis] = floor_scaled(box.high[axis], exponent) + 1;
  }
  return steps;
}
template <class S> Vec3<S> middle_of(const ConvexCore<S>& core) {
  const Unit<S> share = divide_to<Unit<S>>(S(1), S(static_cast<std::int32_t>(core.vertices.size())));
  Vec3<S> middle = Vec3<S>::zero();
  for (const Vec3<S>& v : core.vertices) middle += v * share;
  return middle;
}

/// Finds the time of impact with those triangles of a surface at rest whose outward side the core's middle is on at the
/// start. A touch of one of them at the start counts as a touch of all.
template <class S, class G>
TimeOfImpact<S> surface_impact(const G& surface, const Transform<S>& t, const ConvexCore<S>& core,
                               const CoreMotion<S>& motion, S target) {
  const MeshBox steps = steps_of(swept_box(t, core, motion, target), surface.exponent());
  const Vec3<S> start = to_local(t, to_world(Transform<S>::of(motion.start), middle_of(core)));
  TimeOfImpact<S> first = {Impact::none, Unit<S>(1), Vec3<Unit<S>>::zero(), Vec3<S>::zero(), Vec3<S>::zero(), S(0), 0};
  const Pose<S> rest = {t.position, Quat<Unit<S>>::identity()};
  surface.query(steps, [&](std::uint32_t id) {
    const BakedTriangle baked = surface.triangle(id);
    const Vec3<Unit<S>> normal = unit_of_steps<Unit<S>>(baked.normal());
    Vec3<S> points[3];
    for (int i = 0; i < 3; ++i) {
      points[i] = {from_lattice<S>(baked.points[i].x, surface.exponent()),
                   from_lattice<S>(baked.points[i].y, surface.exponent()),
                   from_lattice<S>(baked.points[i].z, surface.exponent())};
    }
    if (dot(normal, start - points[0]) < S(0)) return true;
    for (Vec3<S>& p : points) p = t.rotation * p;
    const TimeOfImpact<S> found = time_of_impact(core, motion, {points, S(0)}, {rest, rest, Vec3<S>::zero()}, target);
    const bool sooner = found.impact == Impact::at_start || found.fraction < first.fraction;
    if (found.impact != Impact::none && sooner) first = found;
    return first.impact != Impact::at_start;
  });
  return first;
}

}  // namespace isostep::detail
