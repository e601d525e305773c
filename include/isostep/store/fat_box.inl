// Bodies of fat_box.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/geometry/bounds.hpp"
#include "isostep/store/body_map.inl"
#include "isostep/store/fat_box.hpp"

namespace isostep::detail {

template <class S>
void renew_fat_box(const BodyMap<S>& map, BodyState<S>& state, const BodyProperties<S>& body, bool always) {
  const Transform<S> origin = Transform<S>::of(origin_pose(state, body));
  const Aabb<S> tight = bounds(map.shapes.children_of(body.shape), origin, map.shapes.contents());
  if (always || !contains(state.fat, tight)) state.fat = grow(tight, kFatMargin<S>);
}

template <class S>
Aabb<S> box_without_sensors(const BodyMap<S>& map, const BodyState<S>& state, const BodyProperties<S>& body) {
  const Transform<S> origin = Transform<S>::of(origin_pose(state, body));
  std::optional<Aabb<S>> solid;
  for (const Child<S>& part : map.shapes.children_of(body.shape)) {
    if (part.traits.has(part_flag::kSensor)) continue;
    const Aabb<S> box = bounds(part, origin, map.shapes.contents());
    solid = solid ? merge(*solid, box) : box;
  }
  return grow(*solid, kFatMargin<S>);
}

}  // namespace isostep::detail
