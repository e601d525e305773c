// A body's fat box: its bounds and a margin, renewed when the body leaves it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"
#include "isostep/world/body_map.hpp"

namespace isostep::detail {

/// [m] added around a body's bounds: a body is looked up anew only when it leaves the margin.
template <class S> inline constexpr S kFatMargin = S(0.1);

/// `always`: also where the body is still inside.
template <class S>
void renew_fat_box(const BodyMap<S>& map, BodyState<S>& state, const BodyProperties<S>& body, bool always) {
  const Transform<S> origin = Transform<S>::of(BodyMap<S>::origin_pose(state, body));
  const Aabb<S> tight = bounds(map.children_of(body.shape), origin);
  if (always || !contains(state.fat, tight)) state.fat = grow(tight, kFatMargin<S>);
}

}  // namespace isostep::detail
