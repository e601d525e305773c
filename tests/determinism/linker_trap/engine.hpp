// The header that the engine's and the user's side of the linker trap both include: sums of products by our headers.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/mat3.hpp"

/// Each is a b + c, by another function; rounded twice it is 0 for the numbers of user.cpp.
struct Sums {
  float product, dot, cross, matrix, quat;
};

ISO_INLINE Sums sums_of(float a, float b, float c) {
  using namespace isostep;
  const Vec3<float> left = {a, c, 0}, right = {b, 1, 0};
  const Mat3<float> rows = {{left, left, left}};
  const Quat<float> p = {0, 0, -c, a}, q = {0, 0, 1, b};
  return {product(a, b) + c, dot(left, right), cross(Vec3<float>{0, a, c}, Vec3<float>{0, -1, b}).x, (rows * right).y,
          (p * q).w};
}

float engine_plain(float a, float b, float c);
Sums engine_ours(float a, float b, float c);
