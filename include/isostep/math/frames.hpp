// Frames of reference: a basis from two vectors, a tensor seen from elsewhere, left and right hands.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

/// Leads from a frame whose axes are the columns to the frame that they are given in. Right-handed.
template <class U> struct Basis {
  Mat3<U> to_world;
  bool is_valid;  // false: to_world is the identity
};
/// x along a, y in the plane of a and b, on b's side, z along a x b. Not valid where a or b is 0 or both are parallel,
/// to sixteen steps of the format of directions.
template <class S> Basis<Unit<S>> basis_of(Vec3<S> a, Vec3<S> b);

/// The matrix whose product with a vector is v x that vector.
template <class T> ISO_INLINE constexpr Mat3<T> skew_of(Vec3<T> v) {
  return {{{T(0), -v.z, v.y}, {v.z, T(0), -v.x}, {-v.y, v.x, T(0)}}};
}
/// R m R^T: a map or a tensor m of a local frame as the frame sees it that the rotation R leads to.
template <class S> Mat3<S> change_of_basis(const Mat3<Unit<S>>& r, const Mat3<S>& m);

// Right-handed frames to left-handed ones and back: the z axis turns round, so forces, positions, ... negate z, what
// turns negates the rest. The same function leads both ways, exactly, but for a component that has no negative.

template <class T> ISO_INLINE constexpr Vec3<T> other_hand(Vec3<T> v) { return {v.x, v.y, -v.z}; }
/// Mirrors an axial vector: an angular velocity, a torque or another product of two vectors.
template <class T> ISO_INLINE constexpr Vec3<T> other_hand_axial(Vec3<T> v) { return {-v.x, -v.y, v.z}; }
template <class U> ISO_INLINE constexpr Quat<U> other_hand(Quat<U> q) { return {-q.x, -q.y, q.z, q.w}; }
template <class T> ISO_INLINE constexpr Mat3<T> other_hand(const Mat3<T>& m) {
  return {{other_hand(m.rows[0]), other_hand(m.rows[1]), -other_hand(m.rows[2])}};
}
template <class S> ISO_INLINE constexpr Pose<S> other_hand(const Pose<S>& p) {
  return {other_hand(p.position), other_hand(p.orientation)};
}
template <class S> ISO_INLINE constexpr Transform<S> other_hand(const Transform<S>& t) {
  return {other_hand(t.position), other_hand(t.rotation)};
}

#define ISO_FRAMES_OF(KEYWORD, S)                             \
  KEYWORD template Basis<Unit<S>> basis_of(Vec3<S>, Vec3<S>); \
  KEYWORD template Mat3<S> change_of_basis<S>(const Mat3<Unit<S>>&, const Mat3<S>&);
#define ISO_EXTERN_FRAMES(S) ISO_FRAMES_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN_FRAMES)
#undef ISO_EXTERN_FRAMES

}  // namespace isostep
