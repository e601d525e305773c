// Convex cores of every kind in a scalar, and what an oracle in double knows of two of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "isostep/collision/narrowphase/gjk.hpp"
#include "unit/geometry/oracle.hpp"

namespace isostep::test {

enum class CoreKind { point, segment, box, hull, triangle };
inline constexpr int kCoreKinds = 5;

/// A core in a scalar, and the same one in double.
template <class S> struct TestCore {
  std::vector<Vec3<S>> vertices;
  std::vector<oracle::D3> real;
  S radius = S(0);
  double size = 0;  // [m] furthest from the origin of its frame

  void add(oracle::D3 v) {
    vertices.push_back(oracle::made<S>(v));
    real.push_back(oracle::real(vertices.back()));
    size = std::max(size, oracle::length(real.back()));
  }
  void thicken(double by) {
    radius = from_double<S>(by);
    size += to_double(radius);
  }
  ConvexCore<S> core() const { return {vertices, radius}; }
  ConvexCore<double> real_core() const { return {real, to_double(radius)}; }
};

template <class S> TestCore<S> box_core(oracle::D3 half) {
  TestCore<S> core;
  for (int i = 0; i < 8; ++i)
    core.add({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y, (i & 4) != 0 ? half.z : -half.z});
  return core;
}
template <class S> TestCore<S> random_core(CoreKind kind, double scale, oracle::Random& random) {
  TestCore<S> core;
  const double x = scale * random.size(0.1, 1), y = scale * random.size(0.1, 1), z = scale * random.size(0.1, 1);
  switch (kind) {
    case CoreKind::point: core.add({0, 0, 0}); break;
    case CoreKind::segment: core.add({0, -y, 0}), core.add({0, y, 0}); break;
    case CoreKind::box: core = box_core<S>({x, y, z}); break;
    case CoreKind::triangle:
      for (int i = 0; i < 3; ++i) core.add(random.point(scale));
      break;
    case CoreKind::hull:
      for (int i = 0; i < 24; ++i) {
        const oracle::D3 v = random.direction();
        core.add({v.x * x, v.y * y, v.z * z});
      }
  }
  const bool round = kind == CoreKind::point || kind == CoreKind::segment;
  if (round || random.in(0, 1) < 0.2) core.thicken(round ? x : 0.2 * x);
  return core;
}

/// [m] The certain bounds of the gap of two cores: a plane of their own parts them by `least`, two of their points are
/// `most` apart.
struct Gap {
  double least, most;
  oracle::D3 normal;  // [1] of the plane; zero where the cores overlap
};
inline double separation_along(oracle::D3 n, const ConvexCore<double>& a, const Transform<double>& ta,
                               const ConvexCore<double>& b, const Transform<double>& tb) {
  double low = 1e300, high = -1e300;
  for (const oracle::D3 v : b.vertices) low = std::min(low, dot(n, to_world(tb, v) - ta.position));
  for (const oracle::D3 v : a.vertices) high = std::max(high, dot(n, ta.rotation * v));
  return low - high - a.radius - b.radius;
}
inline Gap gap_of(const ConvexCore<double>& a, const Transform<double>& ta, const ConvexCore<double>& b,
                  const Transform<double>& tb) {
  const GjkDistance<double> found = gjk_distance(a, ta, b, tb);
  const double radii = a.radius + b.radius;
  if (found.distance == 0) return {-1e300, -radii, {0, 0, 0}};
  const oracle::D3 normal = oracle::unit(found.normal);
  return {separation_along(normal, a, ta, b, tb), oracle::length(found.on_b - found.on_a) - radii, normal};
}

}  // namespace isostep::test
