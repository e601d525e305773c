// The common part of the tests of worlds: numbers in and out of a scalar, short definitions, tolerances by scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "isostep/geometry/limits.hpp"
#include "isostep/store/state.hpp"
#include "isostep/world/world.hpp"

namespace isostep::test {

#if defined(ISOSTEP_TEST_SCALARS)  // a sample of them
using AllScalars = ::testing::Types<ISOSTEP_TEST_SCALARS>;
#else
using AllScalars = ::testing::Types<float, double, Q16_16, Q32_32>;
#endif
using IeeeScalars = ::testing::Types<float, double>;
using FixedScalars = ::testing::Types<Q16_16, Q32_32>;
using D3 = Vec3<double>;

inline constexpr double kPi = 3.14159265358979323846;

template <class S> S num(double value) { return from_double<S>(value); }
template <class S> Vec3<S> vec(double x, double y, double z) { return {num<S>(x), num<S>(y), num<S>(z)}; }
template <class S> Vec3<S> vec(D3 v) { return vec<S>(v.x, v.y, v.z); }
template <class T> D3 real(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
inline double length(D3 v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// A turn by `angle` [rad] about a unit axis.
template <class S> Quat<Unit<S>> turn(D3 axis, double angle) {
  using U = Unit<S>;
  const double s = isostep::sin(angle / 2), c = isostep::cos(angle / 2);
  return normalise(Quat<U>{num<U>(axis.x * s), num<U>(axis.y * s), num<U>(axis.z * s), num<U>(c)});
}
/// A vector of the body's frame in the world's.
template <class S> D3 rotated(const Quat<Unit<S>>& q, D3 v) {
  const D3 u = {to_double(q.x), to_double(q.y), to_double(q.z)};
  const D3 t = cross(u, v) * 2.0;
  return v + t * to_double(q.w) + cross(u, t);
}

template <class S> Settings<S> settings(double gravity = -10, std::int32_t hz = 60, std::int32_t substeps = 8) {
  Settings<S> s;
  s.hz = hz;
  s.substeps = substeps;
  s.gravity = vec<S>(0, gravity, 0);
  return s;
}

template <class S> BodyDefinition<S> moving(ShapeId shape, D3 position, D3 velocity = {0, 0, 0}) {
  BodyDefinition<S> d;
  d.type = BodyType::dynamic;
  d.shape = shape;
  d.position = vec<S>(position);
  d.velocity = vec<S>(velocity);
  d.report_contacts = true;
  return d;
}
template <class S> BodyDefinition<S> still(ShapeId shape, D3 position = {0, 0, 0}) {
  BodyDefinition<S> d = moving<S>(shape, position);
  d.type = BodyType::static_;
  return d;
}
template <class S> ShapeId add_box(World<S>& world, double x, double y, double z) {
  return world.add_shape(Box<S>{vec<S>(x, y, z)});
}
template <class S> ShapeId add_ball(World<S>& world, double radius) {
  return world.add_shape(Sphere<S>{num<S>(radius)});
}
template <class S> Child<S> part_at(const Primitive<S>& primitive, D3 at) {
  return {primitive, {vec<S>(at), Quat<Unit<S>>::identity()}};
}
template <class S> ShapeId add_two_boxes(World<S>& w, D3 half_a, D3 at_a, D3 half_b, D3 at_b) {
  const Child<S> parts[] = {part_at(primitive_of(Box<S>{vec<S>(half_a)}), at_a),
                            part_at(primitive_of(Box<S>{vec<S>(half_b)}), at_b)};
  return w.add_shape(std::span<const Child<S>>(parts));
}

/// All points below y = 0.
template <class S> BodyId add_ground(World<S>& world, double friction = 0.6) {
  BodyDefinition<S> d = still<S>(world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
  d.material.friction = num<S>(friction);
  return world.create(d);
}
template <class S> void run(World<S>& world, int steps) {
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(world.step().clean());
}
/// Steps until no body is awake; false when that takes longer than `most`.
template <class S> bool settle(World<S>& world, int most = 600) {
  for (int i = 0; i < most; ++i) {
    if (world.counts().awake == 0) return true;
    world.step();
  }
  return world.counts().awake == 0;
}

/// The smallest step of positions near `size`, and of speeds near `size`.
template <class S> double grain(double size = 1) {
  return kIsFixed<S> ? to_double(resolution<S>()) : to_double(resolution<S>()) * std::fabs(size);
}
template <class S> double speed_grain(double size = 1) {
  return kIsFixed<S> ? to_double(resolution<Velocity<S>>()) : to_double(resolution<S>()) * std::fabs(size);
}
/// One of four numbers: float, double, Q16_16, Q32_32.
template <class S> double pick(double f, double d, double q16, double q32) {
  if constexpr (std::is_same_v<S, float>) return f;
  if constexpr (std::is_same_v<S, double>) return d;
  if constexpr (std::is_same_v<S, Q16_16>) return q16;
  return q32;
}
inline void expect_near(D3 a, D3 b, double tolerance, const char* what = "") {
  EXPECT_NEAR(a.x, b.x, tolerance) << what;
  EXPECT_NEAR(a.y, b.y, tolerance) << what;
  EXPECT_NEAR(a.z, b.z, tolerance) << what;
}

/// Bit for bit the same state, by the portable form.
template <class S> std::vector<std::uint8_t> bytes_of(const World<S>& world) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  world.write_portable(writer);
  return bytes;
}

}  // namespace isostep::test
