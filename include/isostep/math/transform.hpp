// Transform<S>: a rigid motion, rotation matrix and translation, from a local frame to the frame outside it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

/// A pose as it is stored: position [m] and orientation.
template <class S> struct Pose {
  Vec3<S> position;
  Quat<Unit<S>> orientation;

  static ISO_INLINE constexpr Pose identity() { return {Vec3<S>::zero(), Quat<Unit<S>>::identity()}; }
  ISO_INLINE constexpr bool is_identity() const {
    return position == Vec3<S>::zero() && orientation == Quat<Unit<S>>::identity();
  }

  ISO_FIELDS(position, orientation)
};

/// A pose as it is used: the rotation unpacked once, applied often.
template <class S> struct Transform {
  Vec3<S> position;  // [m]
  Mat3<Unit<S>> rotation;

  ISO_FIELDS(position, rotation)

  static ISO_INLINE constexpr Transform of(const Pose<S>& pose) { return {pose.position, to_matrix(pose.orientation)}; }
};

template <class S> ISO_INLINE constexpr Vec3<S> to_world(const Transform<S>& t, Vec3<S> local) {
  return t.position + t.rotation * local;
}
template <class S> ISO_INLINE constexpr Vec3<S> to_local(const Transform<S>& t, Vec3<S> world) {
  return transposed_times(t.rotation, world - t.position);
}
/// Returns the motion `inner` followed by `outer`: a child's transform in the frame outside its parent.
template <class S> ISO_INLINE constexpr Transform<S> compose(const Transform<S>& outer, const Transform<S>& inner) {
  return {to_world(outer, inner.position), outer.rotation * inner.rotation};
}
/// Returns `b` in `a`'s frame.
template <class S> ISO_INLINE constexpr Transform<S> relative(const Transform<S>& a, const Transform<S>& b) {
  return {transposed_times(a.rotation, b.position - a.position), transpose(a.rotation) * b.rotation};
}
template <class S> ISO_INLINE Pose<S> compose(const Pose<S>& outer, const Pose<S>& inner) {
  return {outer.position + to_matrix(outer.orientation) * inner.position,
          normalise(outer.orientation * inner.orientation)};
}

}  // namespace isostep
