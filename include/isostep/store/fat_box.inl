// Bodies of fat_box.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"
#include "isostep/store/body_map.inl"
#include "isostep/store/fat_box.hpp"

namespace isostep::detail {

template <class S>
void renew_fat_box(const BodyMap<S>& map, BodyState<S>& state, const BodyProperties<S>& body, bool always) {
  const Transform<S> origin = Transform<S>::of(BodyMap<S>::origin_pose(state, body));
  const Aabb<S> tight = bounds(map.children_of(body.shape), origin, map.contents());
  if (always || !contains(state.fat, tight)) state.fat = grow(tight, kFatMargin<S>);
}

}  // namespace isostep::detail
