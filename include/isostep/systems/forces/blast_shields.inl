// Bodies of blast_shields.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/systems/forces/blast_shields.hpp"

namespace isostep {

template <class S> Vec3<S> BlastShields<S>::exposed_point(std::uint32_t row, Vec3<S> from) const {
  const BodyState<S>& state = bodies_.state(row);
  const BodyProperties<S>& body = bodies_.properties(row);
  const Mat3<Unit<S>> turn = to_matrix(state.orientation);
  const Transform<S> origin = {-(turn * body.local_centre), turn};
  const Vec3<S> query = from - state.centre;
  Vec3<S> nearest = Vec3<S>::zero();
  S least = highest<S>();
  for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
    if (child.traits.has(part_flag::kSensor)) continue;
    const Transform<S> at = compose(origin, Transform<S>::of(child.pose));
    const ClosestPoint<S> found = closest_point<S>(map_.shapes.contents().view(child.primitive), at, query);
    if (!(found.distance < least)) continue;
    least = found.distance;
    nearest = found.point;
  }
  return S(0) < least ? nearest : Vec3<S>::zero();
}

template <class S> bool BlastShields<S>::is_shielded(Vec3<S> from, Vec3<S> to) const {
  using U = Unit<S>;
  bool hit = false;
  const Vec3<S> way = to - from;
  proxies_.boxes().sweep(Sweep<S>{from, way, Vec3<S>::zero(), U(1)}, [&](std::uint32_t slot, U most) {
    const Location location = map_.location(slot);
    if (hit || location.set != Location::kStatic) return most;
    const BodyProperties<S>& body = map_.properties_at(location);
    if (!map_.shapes.has_contacts(body)) return most;
    const Transform<S> placed = Transform<S>::of(origin_pose(map_.state_at(location), body));
    for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
      if (child.traits.has(part_flag::kSensor)) continue;
      RayHit<S> found;
      const Transform<S> at = compose(placed, Transform<S>::of(child.pose));
      hit = hit || (ray_cast<S>(map_.shapes.contents().view(child.primitive), at, from, way, S(1), found, true) &&
                    !found.inside);
    }
    return most;
  });
  return hit;
}

}  // namespace isostep
