// Two hulls where a scalar has them, as an oracle in double sees them.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "unit/geometry/hull_recipes.hpp"
#include "unit/geometry/oracle.hpp"

namespace isostep::test {

/// A hull in a scalar, and what an oracle knows of it.
template <class S> struct Convex {
  Convex(const std::vector<GridPoint>& points, int exponent)
      : hull(convex_hull(points).value()), solid(hull, exponent), step(std::ldexp(1.0, -exponent)) {}
  oracle::D3 vertex(std::uint32_t i) const {
    const GridPoint p = hull.vertices[i];
    return oracle::D3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)} * step;
  }
  std::vector<oracle::D3> normals() const {
    std::vector<oracle::D3> normals;
    for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
      const GridVector n = hull.normal(static_cast<std::uint8_t>(f));
      normals.push_back(oracle::unit({static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)}));
    }
    return normals;
  }
  std::vector<oracle::D3> edges() const {
    std::vector<oracle::D3> edges;
    for (std::size_t e = 0; e < hull.half_edges.size(); e += 2)
      edges.push_back(oracle::unit(vertex(hull.half_edges[e + 1].origin) - vertex(hull.half_edges[e].origin)));
    return edges;
  }
  double radius() const {
    double most = 0;
    for (std::uint32_t i = 0; i < hull.vertices.size(); ++i) most = std::max(most, oracle::length(vertex(i)));
    return most;
  }

  ConvexHull hull;
  HullSolid<S> solid;
  double step;  // [m]
};

inline constexpr double kLeastSine = 0.005;

/// Two solids where a scalar has them, in double.
template <class S> class Placed {
 public:
  Placed(const Convex<S>& a, const Transform<S>& ta, const Convex<S>& b, const Transform<S>& tb)
      : ta_(oracle::real(ta)), tb_(oracle::real(tb)) {
    for (std::uint32_t i = 0; i < a.hull.vertices.size(); ++i) vertices_a.push_back(to_world(ta_, a.vertex(i)));
    for (std::uint32_t i = 0; i < b.hull.vertices.size(); ++i) vertices_b.push_back(to_world(tb_, b.vertex(i)));
    for (const oracle::D3 n : a.normals()) normals_a.push_back(ta_.rotation * n);
    for (const oracle::D3 n : b.normals()) normals_b.push_back(tb_.rotation * n);
    for (const oracle::D3 e : a.edges()) edges_a.push_back(ta_.rotation * e);
    for (const oracle::D3 e : b.edges()) edges_b.push_back(tb_.rotation * e);
  }
  /// [m] The separation of the two along n, from a to b.
  double separation(oracle::D3 n) const {
    double low = 1e300, high = -1e300;
    for (const oracle::D3 p : vertices_b) low = std::min(low, dot(n, p));
    for (const oracle::D3 p : vertices_a) high = std::max(high, dot(n, p));
    return low - high;
  }
  /// Along the best axis there is: their depth where they overlap, at most their distance where they do not.
  double best() const {
    return best_where([](oracle::D3) { return true; });
  }
  /// The largest separation along axes that look along one: a face within kNearFace of the best may stand for it, and
  /// one as near to that face.
  double best_along(oracle::D3 chosen) const {
    return best_where([&](oracle::D3 n) { return dot(n, chosen) > 4 * detail::kNearFace - 3; });
  }
  template <class Where> double best_where(const Where& where) const {
    double best = -1e300;
    const auto see = [&](oracle::D3 n) {
      if (where(n)) best = std::max(best, separation(n));
    };
    for (const oracle::D3 n : normals_a) see(n);
    for (const oracle::D3 n : normals_b) see(-n);
    for (const oracle::D3 e : edges_a) {
      for (const oracle::D3 f : edges_b) {
        const oracle::D3 n = cross(e, f);
        if (oracle::length(n) < kLeastSine) continue;  // a face's axis is as good, but for that sine of a length
        see(oracle::unit(n));
        see(-oracle::unit(n));
      }
    }
    return best;
  }
  /// [m] The distance of p from a solid.
  static double outside(const std::vector<oracle::D3>& normals, const std::vector<oracle::D3>& vertices, oracle::D3 p) {
    double most = -1e300;
    for (const oracle::D3 n : normals) {
      double high = -1e300;
      for (const oracle::D3 v : vertices) high = std::max(high, dot(n, v));
      most = std::max(most, dot(n, p) - high);
    }
    return most;
  }

  std::vector<oracle::D3> vertices_a, vertices_b, normals_a, normals_b, edges_a, edges_b;

 private:
  Transform<double> ta_, tb_;
};

/// Places solids, and tells what to expect of a scalar's digits.
template <class S> class SolidTest : public testing::Test {
 protected:
  Transform<S> transform(oracle::D3 at) { return {oracle::made<S>(at), to_matrix(random_.template orientation<S>())}; }
  /// [m] The rounding of what is computed this far from the origin.
  static double rounding(double reach) {
    return 8 * to_double(resolution<S>()) * (kIsFixed<S> ? 1 : 1 + reach) +
           reach * to_double(resolution<Unit<S>>()) * 16;
  }

  oracle::Random random_{1};
};

/// 40 hulls of 20 to 50 cm; among them some of 5 m, some of 3 cm, and chips a hundred times as wide as thick.
template <class S> std::vector<std::unique_ptr<Convex<S>>> solids_of_many_sizes(std::uint32_t seed) {
  scenes::Draws draws(seed);
  std::vector<std::unique_ptr<Convex<S>>> solids;
  for (int n = 0; n < 40; ++n) {
    std::vector<GridPoint> points = drawn_points(n, draws);
    for (GridPoint& p : points) {
      if (n >= 24 && n < 28) p = {p.x / 16, p.y / 16, p.z / 16};
      if (n >= 32) p.y = p.y / 64;
    }
    solids.push_back(std::make_unique<Convex<S>>(points, n >= 20 && n < 24 ? 12 : 16));
  }
  return solids;
}

}  // namespace isostep::test
