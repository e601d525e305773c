// Mat3<T>: three rows; rotation matrices are Mat3<Unit<S>>, tensors Mat3<S>.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/math/quat.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

template <class T> struct Mat3 {
  Vec3<T> rows[3];

  static ISO_INLINE constexpr Mat3 diagonal(Vec3<T> d) {
    return {{{d.x, T(0), T(0)}, {T(0), d.y, T(0)}, {T(0), T(0), d.z}}};
  }
  static ISO_INLINE constexpr Mat3 identity() { return diagonal({T(1), T(1), T(1)}); }
  ISO_INLINE constexpr Vec3<T> column(int i) const { return {rows[0][i], rows[1][i], rows[2][i]}; }

  friend ISO_INLINE constexpr Mat3 operator+(const Mat3& a, const Mat3& b) {
    return {{a.rows[0] + b.rows[0], a.rows[1] + b.rows[1], a.rows[2] + b.rows[2]}};
  }
  ISO_FIELDS(rows)
};

template <class T> ISO_INLINE constexpr Mat3<T> transpose(const Mat3<T>& m) {
  return {{m.column(0), m.column(1), m.column(2)}};
}

/// m v; every component rounded once.
template <class A, class B>
ISO_INLINE constexpr auto operator*(const Mat3<A>& m, Vec3<B> v) -> Vec3<decltype(A{} * B{})> {
  return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}
/// Multiplies v by m transposed: a rotation matrix undone.
template <class A, class B>
ISO_INLINE constexpr auto transposed_times(const Mat3<A>& m, Vec3<B> v) -> Vec3<decltype(A{} * B{})> {
  return {dot(m.column(0), v), dot(m.column(1), v), dot(m.column(2), v)};
}
template <class A, class B>
ISO_INLINE constexpr auto operator*(const Mat3<A>& a, const Mat3<B>& b) -> Mat3<decltype(A{} * B{})> {
  using R = decltype(A{} * B{});
  Mat3<R> result;
  for (int i = 0; i < 3; ++i) {
    result.rows[i] = {dot(a.rows[i], b.column(0)), dot(a.rows[i], b.column(1)), dot(a.rows[i], b.column(2))};
  }
  return result;
}

/// The rotation matrix of a unit quaternion; entries exact before the one rounding. `unit` is one in each lane, of
/// numbers U(1).
template <class U> ISO_INLINE constexpr Mat3<U> to_matrix(Quat<U> q, U unit) {
  const auto xx = product(q.x, q.x), yy = product(q.y, q.y), zz = product(q.z, q.z);
  const auto xy = product(q.x, q.y), xz = product(q.x, q.z), yz = product(q.y, q.z);
  const auto wx = product(q.w, q.x), wy = product(q.w, q.y), wz = product(q.w, q.z);
  const auto one = widen<decltype(product(unit, unit))>(unit);
  // 2 (y^2 + z^2) is 2 at half a turn, which U cannot hold but the exact sum can.
  const auto twice = [](auto sum) ISO_INLINE_LAMBDA { return round_to<U>(sum + sum); };
  const auto rest = [one](auto sum) ISO_INLINE_LAMBDA { return round_to<U>(one - (sum + sum)); };
  return {{{rest(yy + zz), twice(xy - wz), twice(xz + wy)},
           {twice(xy + wz), rest(xx + zz), twice(yz - wx)},
           {twice(xz - wy), twice(yz + wx), rest(xx + yy)}}};
}
template <class U> ISO_INLINE constexpr Mat3<U> to_matrix(Quat<U> q) { return to_matrix(q, U(1)); }

/// v turned by q, each component rounded once. For many vectors the matrix is cheaper, and gives the same bits.
template <class U, class A> ISO_INLINE constexpr auto rotate(Quat<U> q, Vec3<A> v) -> Vec3<decltype(U{} * A{})> {
  return to_matrix(q) * v;
}

/// R diag(d) R^T: a tensor with principal values d, seen from the frame that R leads to. Symmetric bit for bit.
template <class U, class S> ISO_INLINE constexpr Mat3<S> rotate_diagonal(const Mat3<U>& r, Vec3<S> d) {
  const Vec3<S> s0 = scale(d, r.rows[0]), s1 = scale(d, r.rows[1]), s2 = scale(d, r.rows[2]);
  const S xx = dot(s0, r.rows[0]), yy = dot(s1, r.rows[1]), zz = dot(s2, r.rows[2]);
  const S xy = dot(s0, r.rows[1]), xz = dot(s0, r.rows[2]), yz = dot(s1, r.rows[2]);
  return {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
}

}  // namespace isostep
