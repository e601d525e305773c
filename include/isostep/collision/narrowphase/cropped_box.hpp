// A wide box as far as a small solid near it can touch it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"

namespace isostep::detail {

/// [1] A box is wide if a half extent is so many times the reach of the other solid. Axes and supports are made of its
/// corners, so the contact loses the digits of their distance: in float 2 cm at 8 km.
inline constexpr double kWideBox = 64;
/// [1] The part of a wide box that is kept about the other solid, in its reaches: more than contacts are deep.
inline constexpr std::int32_t kKeptReaches = 8;

/// Crops a wide box, whose frame is `t`, to what is near the other solid. Sides that are cut stay at least twice as far
/// from the solid's middle as the nearest side of the whole box, so no axis of theirs is the best. Names of sides and
/// corners stay.
template <class S>
ISO_INLINE void crop_wide_box(Primitive<S>& box, Transform<S>& t, const ShapeView<S>& solid,
                              const Transform<S>& there) {
  if (box.type != ShapeType::box) return;
  const Aabb<S> around = bounds(solid, relative(t, there));
  const Vec3<S> half = box.half, middle = (around.low + around.high) * S(0.5), size = around.high - middle;
  const S reach = size.x + size.y + size.z;
  if (max_abs(half) * S(1 / kWideBox) <= reach) return;
  const Vec3<S> inside = half - Vec3<S>{abs(middle.x), abs(middle.y), abs(middle.z)};
  const S nearest = max(S(0), min(inside.x, min(inside.y, inside.z)));
  const S kept = max(reach * S(kKeptReaches), nearest + nearest);
  const Vec3<S> about = {kept, kept, kept}, low = max(-half, middle - about), high = min(half, middle + about);
  if (!(low.x < high.x && low.y < high.y && low.z < high.z)) return;
  box.half = (high - low) * S(0.5);
  t.position += t.rotation * ((low + high) * S(0.5));
}

}  // namespace isostep::detail
