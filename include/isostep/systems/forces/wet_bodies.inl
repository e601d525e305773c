// Bodies of wet_bodies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/submersion.hpp"
#include "isostep/systems/forces/wet_bodies.hpp"

namespace isostep {

template <class S> void WetBodies<S>::begin_substep() {
  wet_.clear();
  wet_.reserve(zones_.water_count() * state_.awake.states.size());
}

template <class S>
Wet<S> WetBodies<S>::displaced(std::uint32_t row, S density, const detail::WaterSurface<S>& surface) const {
  using U = Unit<S>;
  const BodyProperties<S>& body = bodies_.properties(row);
  const Mat3<U> turn = to_matrix(bodies_.state(row).orientation);
  const Transform<S> origin = {-(turn * body.local_centre), turn};
  Wet<S> wet = {S(0), Vec3<S>::zero(), row, nullptr, Vec3<S>::zero()};
  for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
    if (child.traits.has(part_flag::kSensor)) continue;
    const Transform<S> at = compose(origin, Transform<S>::of(child.pose));
    const ShapeView<S> part = map_.shapes.contents().view(child.primitive);
    const Vec3<U> up = transposed_times(at.rotation, surface.normal);
    const Submersion<S> sunk = submersion<S>(part, up, surface.depth - dot(surface.normal, at.position));
    if (!(U(0) < sunk.share)) continue;
    const S whole = visit_shape(part, [&](const auto& shape) { return shape.mass(density); });
    const S mass = whole * sunk.share;
    if (!(S(0) < mass)) continue;
    wet.mass = saturating_add(wet.mass, mass);
    wet.arm += (at.position + at.rotation * sunk.centre - wet.arm) * divide_to<U>(mass, wet.mass);
  }
  return wet;
}

template <class S> bool WetBodies<S>::is_under_water(std::uint32_t row, Vec3<S> point, Vec3<S>& velocity) const {
  bool under = false;
  velocity = Vec3<S>::zero();
  if (bodies_.gravity() == Vec3<S>::zero()) return false;
  const std::uint32_t category = bodies_.category(row);
  zones_.for_each(state_.records->waters, [&](const Water<S>& water) {
    if ((category & water.mask) == 0) return;
    if (!in_region(water, Aabb<S>{point, point}) || zones_.is_dry(water.priority, category, point)) return;
    const detail::WaterSurface<S> surface = detail::surface_at(water, point, bodies_.gravity(), bodies_.when());
    if (!(S(0) < surface.depth)) return;
    under = true;
    velocity = saturating_add(velocity, surface.velocity);
  });
  velocity = held_within(velocity, Limits<S>::speed());
  return under;
}

}  // namespace isostep
