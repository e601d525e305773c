// Vectors, matrices and quaternions as Eigen's, copied or mapped in place.
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <concepts>
#include <type_traits>

#include "isostep/math/mat3.hpp"
#include "isostep/math/quat.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/eigen.hpp"

namespace isostep {

namespace detail {
template <class T> struct EigenOf { using Type = T; };
template <std::floating_point T> struct EigenOf<T> { using Type = Exact<T>; };
template <class E> struct NativeOf { using Type = E; };
template <class T> struct NativeOf<Exact<T>> { using Type = T; };
template <class T> ISO_INLINE constexpr T native(T x) { return x; }
template <class T> ISO_INLINE constexpr T native(Exact<T> x) { return x.value(); }
}  // namespace detail

/// The number type that Eigen sees for T: Exact<float> for float, so that Eigen's packets stay out of it.
template <class T> using EigenScalar = typename detail::EigenOf<T>::Type;
template <class E> using NativeScalar = typename detail::NativeOf<E>::Type;

// Eigen's types are never aligned more than their numbers: its own choice depends on the compiler's flags, and so would
// layouts.
template <class T> using EigenVec3 = Eigen::Matrix<EigenScalar<T>, 3, 1, Eigen::DontAlign>;
template <class T> using EigenMat3 = Eigen::Matrix<EigenScalar<T>, 3, 3, Eigen::DontAlign | Eigen::RowMajor>;
template <class T> using EigenQuat = Eigen::Quaternion<EigenScalar<T>, Eigen::DontAlign>;

template <class T> ISO_INLINE EigenVec3<T> to_eigen(Vec3<T> v) { return {v.x, v.y, v.z}; }
template <class T> ISO_INLINE EigenMat3<T> to_eigen(const Mat3<T>& m) {
  EigenMat3<T> result;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) result(i, k) = m.rows[i][k];
  }
  return result;
}
/// The quaternion keeps the unit format, in which 2 does not fit: Eigen's toRotationMatrix needs a cast to a wider
/// format first.
template <class U> ISO_INLINE EigenQuat<U> to_eigen(Quat<U> q) { return {q.w, q.x, q.y, q.z}; }

template <class D> ISO_INLINE auto vec3_from(const Eigen::MatrixBase<D>& v) -> Vec3<NativeScalar<typename D::Scalar>> {
  EIGEN_STATIC_ASSERT_VECTOR_SPECIFIC_SIZE(D, 3)
  return {detail::native(v.coeff(0)), detail::native(v.coeff(1)), detail::native(v.coeff(2))};
}
template <class D> ISO_INLINE auto mat3_from(const Eigen::MatrixBase<D>& m) -> Mat3<NativeScalar<typename D::Scalar>> {
  EIGEN_STATIC_ASSERT_MATRIX_SPECIFIC_SIZE(D, 3, 3)
  const auto row = [&](int i) ISO_INLINE_LAMBDA { return vec3_from(m.row(i).transpose()); };
  return {{row(0), row(1), row(2)}};
}
template <class D>
ISO_INLINE auto quat_from(const Eigen::QuaternionBase<D>& q) -> Quat<NativeScalar<typename D::Scalar>> {
  return {detail::native(q.x()), detail::native(q.y()), detail::native(q.z()), detail::native(q.w())};
}

namespace detail {
template <class To, class From> ISO_INLINE To* numbers_of(From& object) {
  static_assert(sizeof(From) % sizeof(To) == 0 && alignof(From) == alignof(To) && std::is_trivially_copyable_v<From>);
  return reinterpret_cast<To*>(&object);
}
}  // namespace detail

/// The numbers where they lie, to read and write through Eigen. A quaternion's order, x y z w, is Eigen's own.
template <class T> ISO_INLINE Eigen::Map<EigenVec3<T>> map(Vec3<T>& v) {
  return Eigen::Map<EigenVec3<T>>(detail::numbers_of<EigenScalar<T>>(v));
}
template <class T> ISO_INLINE Eigen::Map<const EigenVec3<T>> map(const Vec3<T>& v) {
  return Eigen::Map<const EigenVec3<T>>(detail::numbers_of<const EigenScalar<T>>(v));
}
template <class T> ISO_INLINE Eigen::Map<EigenMat3<T>> map(Mat3<T>& m) {
  return Eigen::Map<EigenMat3<T>>(detail::numbers_of<EigenScalar<T>>(m));
}
template <class T> ISO_INLINE Eigen::Map<const EigenMat3<T>> map(const Mat3<T>& m) {
  return Eigen::Map<const EigenMat3<T>>(detail::numbers_of<const EigenScalar<T>>(m));
}
template <class U> ISO_INLINE Eigen::Map<Eigen::Quaternion<EigenScalar<U>>> map(Quat<U>& q) {
  return Eigen::Map<Eigen::Quaternion<EigenScalar<U>>>(detail::numbers_of<EigenScalar<U>>(q));
}
template <class U> ISO_INLINE Eigen::Map<const Eigen::Quaternion<EigenScalar<U>>> map(const Quat<U>& q) {
  return Eigen::Map<const Eigen::Quaternion<EigenScalar<U>>>(detail::numbers_of<const EigenScalar<U>>(q));
}

}  // namespace isostep
