// Polyhedra against every axis in double: all faces, all crosses of edges, both ways.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/polyhedra.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "unit/geometry/hull_recipes.hpp"
#include "unit/geometry/oracle.hpp"

namespace isostep::test {
namespace {

using oracle::D3;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

/// A hull in a scalar, and what an oracle knows of it.
template <class S> struct Solid {
  Solid(const std::vector<GridPoint>& points, int exponent)
      : hull(convex_hull(points).value()), solid(hull, exponent), step(std::ldexp(1.0, -exponent)) {}
  D3 vertex(std::uint32_t i) const {
    const GridPoint p = hull.vertices[i];
    return D3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)} * step;
  }
  std::vector<D3> normals() const {
    std::vector<D3> normals;
    for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
      const GridVector n = hull.normal(static_cast<std::uint8_t>(f));
      normals.push_back(oracle::unit({static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)}));
    }
    return normals;
  }
  std::vector<D3> edges() const {
    std::vector<D3> edges;
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

constexpr double kLeastSine = 0.005;

/// Two solids where a scalar has them, in double.
template <class S> class Placed {
 public:
  Placed(const Solid<S>& a, const Transform<S>& ta, const Solid<S>& b, const Transform<S>& tb)
      : ta_(oracle::real(ta)), tb_(oracle::real(tb)) {
    for (std::uint32_t i = 0; i < a.hull.vertices.size(); ++i) vertices_a.push_back(to_world(ta_, a.vertex(i)));
    for (std::uint32_t i = 0; i < b.hull.vertices.size(); ++i) vertices_b.push_back(to_world(tb_, b.vertex(i)));
    for (const D3 n : a.normals()) normals_a.push_back(ta_.rotation * n);
    for (const D3 n : b.normals()) normals_b.push_back(tb_.rotation * n);
    for (const D3 e : a.edges()) edges_a.push_back(ta_.rotation * e);
    for (const D3 e : b.edges()) edges_b.push_back(tb_.rotation * e);
  }
  /// [m] of the two along n, from a to b.
  double separation(D3 n) const {
    double low = 1e300, high = -1e300;
    for (const D3 p : vertices_b) low = std::min(low, dot(n, p));
    for (const D3 p : vertices_a) high = std::max(high, dot(n, p));
    return low - high;
  }
  /// Along the best axis there is: their depth where they overlap, at most their distance where they do not.
  double best() const {
    double best = -1e300;
    for (const D3 n : normals_a) best = std::max(best, separation(n));
    for (const D3 n : normals_b) best = std::max(best, separation(-n));
    for (const D3 e : edges_a) {
      for (const D3 f : edges_b) {
        const D3 n = cross(e, f);
        if (oracle::length(n) < kLeastSine) continue;  // a face's axis is as good, but for that sine of a length
        best = std::max({best, separation(oracle::unit(n)), separation(-oracle::unit(n))});
      }
    }
    return best;
  }
  /// [m] by how much p is outside of a solid.
  static double outside(const std::vector<D3>& normals, const std::vector<D3>& vertices, D3 p) {
    double most = -1e300;
    for (const D3 n : normals) {
      double high = -1e300;
      for (const D3 v : vertices) high = std::max(high, dot(n, v));
      most = std::max(most, dot(n, p) - high);
    }
    return most;
  }

  std::vector<D3> vertices_a, vertices_b, normals_a, normals_b, edges_a, edges_b;

 private:
  Transform<double> ta_, tb_;
};

template <class S> class Polyhedra : public testing::Test {
 protected:
  static constexpr double kMargin = 0.02;  // [m]

  Transform<S> transform(D3 at) { return {oracle::made<S>(at), to_matrix(random_.template orientation<S>())}; }
  static double rounding(double reach) {
    return 8 * to_double(resolution<S>()) * (kIsFixed<S> ? 1 : 1 + reach) +
           reach * to_double(resolution<Unit<S>>()) * 16;
  }

  struct Tally {
    int apart = 0, beside = 0, faces_a = 0, faces_b = 0, edges = 0, points = 0;
  };
  /// Whatever must hold of two solids where they are.
  void check(const Solid<S>& a, const Transform<S>& ta, const Solid<S>& b, const Transform<S>& tb, Tally& tally) {
    Manifold<S> m, swapped;
    collide_polyhedra(b.solid.polyhedron(), tb, a.solid.polyhedron(), ta, from_double<S>(kMargin), swapped);
    collide_polyhedra(a.solid.polyhedron(), ta, b.solid.polyhedron(), tb, from_double<S>(kMargin), m);
    const Placed<S> placed(a, ta, b, tb);
    const double best = placed.best();
    const double inner = to_double(min(a.solid.polyhedron().inner_radius, b.solid.polyhedron().inner_radius));
    const double reach = std::max(oracle::length(oracle::real(ta.position)), a.radius() + b.radius());
    const double error = rounding(reach), tolerance = 2 * inner / 128 + 2 * error;  // faces go before edges, a before b
    if (m.count == 0) {
      ASSERT_GT(best, -error);
      ++(best < kMargin - error ? tally.beside : tally.apart);
      return;
    }
    ASSERT_LT(best, kMargin + error);
    const D3 normal = oracle::real(m.normal);
    EXPECT_NEAR(oracle::length(normal), 1, 8 * to_double(resolution<Unit<S>>()) + 1e-15);
    // Where they are apart, crosses of edges that have nothing to do with each other may by chance be better.
    const double least = std::min(best, 0.0) - tolerance;
    EXPECT_GT(placed.separation(normal), least) << "no other axis is much better";
    double deepest = 1e300;
    std::set<std::uint32_t> features;
    for (int i = 0; i < m.count; ++i) {
      const double separation = to_double(m.points[i].separation);
      deepest = std::min(deepest, separation);
      features.insert(m.points[i].feature);
      const D3 at = oracle::real(m.points[i].position);
      const double near = std::fabs(separation) + tolerance;  // midway between the two surfaces
      EXPECT_LT(Placed<S>::outside(placed.normals_a, placed.vertices_a, at), near);
      EXPECT_LT(Placed<S>::outside(placed.normals_b, placed.vertices_b, at), near);
    }
    EXPECT_EQ(features.size(), static_cast<std::size_t>(m.count));
    ASSERT_GT(swapped.count, 0);
    EXPECT_GT(placed.separation(-oracle::real(swapped.normal)), least) << "the other way round";
    if (best < 0) {
      EXPECT_NEAR(deepest, best, tolerance) << "the deepest point is there";
    }
    if ((m.points[0].feature >> 31) == 0) ++tally.edges;
    else ++((m.points[0].feature >> 30 & 1) == 0 ? tally.faces_a : tally.faces_b);
    tally.points += m.count;
  }

  oracle::Random random_{1};
};
TYPED_TEST_SUITE(Polyhedra, Scalars);

TYPED_TEST(Polyhedra, agree_with_every_axis) {
  using S = TypeParam;
  // Of 20 to 50 cm; among them some of 5 m, some of 3 cm, and chips a hundred times as wide as thick.
  HullDraws draws(21);
  std::vector<std::unique_ptr<Solid<S>>> solids;
  for (int n = 0; n < 40; ++n) {
    std::vector<GridPoint> points = drawn_hull(n, draws);
    for (GridPoint& p : points) {
      if (n >= 24 && n < 28) p = {p.x / 16, p.y / 16, p.z / 16};
      if (n >= 32) p.y = p.y / 64;
    }
    solids.push_back(std::make_unique<Solid<S>>(points, n >= 20 && n < 24 ? 12 : 16));
  }
  typename TestFixture::Tally tally;
  for (int n = 0; n < 10000; ++n) {
    const Solid<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 40 % 40)];
    const D3 at = n % 3 == 0 ? D3{40, -30, 20} : D3{0, 0, 0};
    const double reach = this->random_.in(0.1, 1.05) * (a.radius() + b.radius());
    const Transform<S> ta = this->transform(at), tb = this->transform(at + this->random_.direction() * reach);
    this->check(a, ta, b, tb, tally);
    ASSERT_FALSE(testing::Test::HasFailure()) << n;
  }
  EXPECT_GT(tally.apart, 2000);
  EXPECT_LT(tally.beside, 200) << "within the margin along every axis, but not one above the other";
  EXPECT_GT(tally.faces_a, 1000);
  EXPECT_GT(tally.faces_b, 1000);
  EXPECT_GT(tally.edges, 1500);
  EXPECT_GT(tally.points, 10000);
}

}  // namespace
}  // namespace isostep::test
