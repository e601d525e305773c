// The oracle of the math tests: the same operation by Eigen over long double, and how far a format may be from it.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>

#include "isostep/math/transform.hpp"
#include "random/splitmix64.hpp"

namespace isostep::test {

/// 64 bits of significand on x86, 113 elsewhere: every 64-bit fixed-point number is one of them. Where it is a mere
/// double the bounds below widen by themselves.
using Real = long double;
using RealVec = Eigen::Matrix<Real, 3, 1>;
using RealMat = Eigen::Matrix<Real, 3, 3>;
using RealQuat = Eigen::Quaternion<Real>;
constexpr Real kRealEpsilon = std::numeric_limits<Real>::epsilon();

template <class T> Real real(T x) {
  if constexpr (kIsFixed<T>) {
    return std::ldexp(static_cast<Real>(x.raw()), -T::kFracBits);
  } else {
    return x;
  }
}
template <class T> RealVec real(Vec3<T> v) { return {real(v.x), real(v.y), real(v.z)}; }
template <class T> RealQuat real(Quat<T> q) { return {real(q.w), real(q.x), real(q.y), real(q.z)}; }
template <class T> RealMat real(const Mat3<T>& m) {
  RealMat result;
  result << real(m.rows[0]).transpose(), real(m.rows[1]).transpose(), real(m.rows[2]).transpose();
  return result;
}

/// Half a unit in the last place of a number of format T and at most this size.
template <class T> Real half_ulp(Real size) {
  if constexpr (kIsFixed<T>) return std::ldexp(Real(0.5), -T::kFracBits);
  if constexpr (!kIsFixed<T>) return size * std::numeric_limits<T>::epsilon() / 2;
}
/// The greatest error of an operation whose exact sums fixed point rounds `fixed` times and float `floating` times,
/// every number on the way at most `size`. The oracle's own rounding is on top.
template <class T> Real bound(int fixed, int floating, Real size) {
  return half_ulp<T>(size) * (kIsFixed<T> ? fixed : floating) * Real(1.0001) + 16 * kRealEpsilon * size;
}

/// Deterministic draws that fill every bit of a format.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() { return splitmix64(state_); }
  /// A number in [-2^exponent, 2^exponent].
  template <class T> T number(int exponent) {
    const auto word = static_cast<std::int64_t>(bits());
    if constexpr (kIsFixed<T>) {
      return T::from_raw(static_cast<typename T::Raw>(word >> (63 - T::kFracBits - exponent)));
    } else {
      return static_cast<T>(std::ldexp(static_cast<double>(word), exponent - 63));
    }
  }
  template <class T> Vec3<T> vector(int exponent) {
    const T x = number<T>(exponent), y = number<T>(exponent), z = number<T>(exponent);
    return {x, y, z};
  }
  template <class S> Vec3<Unit<S>> direction() {
    const Vec3<S> v = vector<S>(2);
    const Direction<S> d = direction_of(v.x, v.y, v.z);
    return {d.x, d.y, d.z};
  }
  template <class S> Quat<Unit<S>> rotation() {
    using U = Unit<S>;
    const U x = number<U>(-1), y = number<U>(-1), z = number<U>(-1), w = number<U>(-1);
    return normalise(Quat<U>{x, y, z, w});
  }

 private:
  std::uint64_t state_;
};

inline void expect_near(const RealVec& a, const RealVec& b, Real tolerance) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(a[i] - b[i]), 0, static_cast<double>(tolerance)) << "row " << i;
  }
}
inline void expect_near(const RealMat& a, const RealMat& b, Real tolerance) {
  for (int i = 0; i < 3; ++i) expect_near(RealVec(a.row(i)), RealVec(b.row(i)), tolerance);
}
inline void expect_near(const RealQuat& a, const RealQuat& b, Real tolerance) {
  for (int i = 0; i < 4; ++i) {
    const auto difference = static_cast<double>(a.coeffs()[i] - b.coeffs()[i]);
    EXPECT_NEAR(difference, 0, static_cast<double>(tolerance)) << "component " << i;
  }
}

using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
constexpr int kDraws = 2000;

}  // namespace isostep::test
