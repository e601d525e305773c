// Swept cores against surfaces: the least fraction of the triangles that the sweep's box meets.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/time_of_impact.hpp"
#include "isostep/geometry/baked/unit_of_steps.hpp"
#include "isostep/geometry/surfaces.hpp"

namespace isostep::detail {

/// As time_of_impact, against the triangles of a surface at rest whose outward side the core's middle is on at the
/// start. Starting in touch with one of them counts as that of all.
template <class S, class G>
TimeOfImpact<S> surface_impact(const G& surface, const Transform<S>& t, const ConvexCore<S>& core,
                               const CoreMotion<S>& motion, S target) {
  S reach = S(0);
  const Unit<S> share = divide_to<Unit<S>>(S(1), S(static_cast<std::int32_t>(core.vertices.size())));
  Vec3<S> middle = Vec3<S>::zero();
  for (const Vec3<S>& v : core.vertices) {
    reach = max(reach, length(v) + core.radius);
    middle += v * share;
  }
  reach += target;
  const Vec3<S> all = {reach, reach, reach};
  const Vec3<S> from = to_local(t, motion.start.position), to = to_local(t, motion.end.position);
  const Aabb<S> box = merge(Aabb<S>::around(from, all), Aabb<S>::around(to, all));
  const Vec3<S> start = from + transposed_times(t.rotation, rotate(motion.start.orientation, middle));
  MeshBox steps;
  for (int axis = 0; axis < 3; ++axis) {
    steps.low[axis] = floor_scaled(box.low[axis], surface.exponent());
    steps.high[axis] = floor_scaled(box.high[axis], surface.exponent()) + 1;
  }
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
