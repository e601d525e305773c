// A wide box as far as a small solid near it can touch it: the distance of its corners costs no digits.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"

namespace isostep::detail {

/// [1] A box is wide if a half extent is so many times the reach of the other solid. Axes and supports are made of its
/// corners, so the contact loses the digits of their distance: in float 2 cm at 8 km.
inline constexpr double kWideBox = 64;
/// [1] The part of a wide box that is kept about the other solid, in its reaches: more than contacts are deep.
inline constexpr std::int32_t kKeptReaches = 8;

/// The part of a box that is kept.
template <class S> struct CroppedBox {
  Vec3<S> half, middle;  // [m] its half extents, and its middle in the frame of the whole box
};

/// [m] Returns a bound for how far what is inside a box reaches from its middle: the sum of the half extents.
template <class S> ISO_INLINE S reach_of(const Aabb<S>& around) {
  const Vec3<S> size = (around.high - around.low) * S(0.5);
  return size.x + size.y + size.z;
}
/// Crops a box of half extents `half` [m] to what is near `around`, the bounds of another solid in the box's frame.
/// Sides that are cut stay kKeptReaches from the solid's middle and at least twice as far as the nearest side of the
/// whole box, so no axis of theirs is the best.
template <class S> ISO_INLINE CroppedBox<S> cropped(Vec3<S> half, const Aabb<S>& around) {
  const Vec3<S> middle = (around.low + around.high) * S(0.5);
  const Vec3<S> inside = half - Vec3<S>{abs(middle.x), abs(middle.y), abs(middle.z)};
  const S nearest = max(S(0), min(inside.x, min(inside.y, inside.z)));
  const S kept = max(reach_of(around) * S(kKeptReaches), nearest + nearest);
  const Vec3<S> about = {kept, kept, kept}, low = max(-half, middle - about), high = min(half, middle + about);
  if (!(low.x < high.x && low.y < high.y && low.z < high.z)) return {half, Vec3<S>::zero()};
  return {(high - low) * S(0.5), (low + high) * S(0.5)};
}

/// Crops a box, if it is wide, and moves its frame `t` along. Names of sides and corners stay.
template <class S> ISO_INLINE void crop_to(Vec3<S>& half, Transform<S>& t, const Aabb<S>& around) {
  if (max_abs(half) * S(1 / kWideBox) <= reach_of(around)) return;
  const CroppedBox<S> kept = cropped(half, around);
  half = kept.half;
  t.position += t.rotation * kept.middle;
}
/// Crops a wide box, whose frame is `t`, to what is near another solid, whose frame is `there`.
template <class S>
ISO_INLINE void crop_wide_box(Primitive<S>& box, Transform<S>& t, const ShapeView<S>& solid,
                              const Transform<S>& there) {
  if (box.type == ShapeType::box) crop_to(box.half, t, bounds(solid, relative(t, there)));
}

}  // namespace isostep::detail
