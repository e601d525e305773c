// Polyhedra against every axis in double: all faces, all crosses of edges, both ways.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/polyhedra.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "isostep/collision/narrowphase/polyhedra.inl"
#include "isostep/geometry/baked/box_solid.hpp"
#include "unit/collision/narrowphase/placed_solids.hpp"

namespace isostep::test {
namespace polyhedra_test {

using oracle::D3;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

template <class S> class Polyhedra : public SolidTest<S> {
 protected:
  static constexpr double kMargin = 0.02;  // [m]

  struct Tally {
    int apart = 0, beside = 0, faces_a = 0, faces_b = 0, edges = 0, points = 0;
  };
  /// Checks whatever must hold of two solids where they are.
  void check(const Convex<S>& a, const Transform<S>& ta, const Convex<S>& b, const Transform<S>& tb, Tally& tally) {
    Manifold<S> m, swapped;
    collide_polyhedra(b.solid.polyhedron(), tb, a.solid.polyhedron(), ta, from_double<S>(kMargin), swapped);
    collide_polyhedra(a.solid.polyhedron(), ta, b.solid.polyhedron(), tb, from_double<S>(kMargin), m);
    const Placed<S> placed(a, ta, b, tb);
    const double best = placed.best();
    const double inner = to_double(min(a.solid.polyhedron().inner_radius, b.solid.polyhedron().inner_radius));
    const double reach = std::max(oracle::length(oracle::real(ta.position)), a.radius() + b.radius());
    const double error = this->rounding(reach),
                 tolerance = 2 * inner / 128 + 2 * error,                   // faces go before edges, a before b
        slack = detail::edge_slack(inner) + 2 * detail::face_slack(inner);  // and depth_tie
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
    const auto tells_of_best = [&](const Manifold<S>& of) {
      double told = 1e300;
      for (int i = 0; i < of.count; ++i) told = std::min(told, to_double(of.points[i].separation));
      return std::fabs(told - best) <= tolerance + slack;
    };
    EXPECT_TRUE(tells_of_best(m) || placed.best_along(normal) > least) << "no other axis is much better";
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
    const D3 other = -oracle::real(swapped.normal);
    EXPECT_TRUE(tells_of_best(swapped) || placed.best_along(other) > least) << "the other way round";
    if (best < 0) {
      EXPECT_NEAR(deepest, best, tolerance + slack) << "the deepest point is there";
    }
    if ((m.points[0].feature >> 31) == 0) ++tally.edges;
    else ++((m.points[0].feature >> 30 & 1) == 0 ? tally.faces_a : tally.faces_b);
    tally.points += m.count;
  }
};
TYPED_TEST_SUITE(Polyhedra, Scalars);

TYPED_TEST(Polyhedra, agree_with_every_axis) {
  using S = TypeParam;
  const auto solids = solids_of_many_sizes<S>(21);
  typename TestFixture::Tally tally;
  for (int n = 0; n < 10000; ++n) {
    const Convex<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 40 % 40)];
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
  EXPECT_GT(tally.edges, 600);  // of half of the crossings the faces touch
  EXPECT_GT(tally.points, 10000);
}

/// The search that leaves out edges finds what the search of all does.
TYPED_TEST(Polyhedra, leave_out_no_edges_that_decide) {
  using S = TypeParam;
  const auto solids = solids_of_many_sizes<S>(22);
  const S margin = from_double<S>(this->kMargin);
  int overlap = 0, apart = 0, none = 0, open = 0;
  for (int n = 0; n < 8000; ++n) {
    const Convex<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 40 % 40)];
    const double reach = this->random_.in(0.3, 1.0) * (a.radius() + b.radius());
    const Transform<S> ta = this->transform(D3{0, 0, 0}), tb = this->transform(this->random_.direction() * reach);
    const Polyhedron<S> of_a = a.solid.polyhedron(), of_b = b.solid.polyhedron();
    detail::PolyhedronPair<S, 1, isa::Portable> pair(of_a, ta, of_b, tb);
    pair.turn_a();
    const auto face_a = detail::best_face<S, 1, isa::Portable>(of_a, pair.vertices_b, of_b.vertices.size(), margin);
    const auto face_b = detail::best_face<S, 1, isa::Portable>(of_b, pair.vertices_a, of_a.vertices.size(), margin);
    const S best = max(face_a.separation, face_b.separation);
    if (best > margin) continue;
    const auto all = detail::EdgeAxes<S, 1, isa::Portable>(pair).best(best + pair.tolerance, margin);
    const S over_a = detail::height_over<S, 1, isa::Portable>(of_a, pair.vertices_b.at(face_a.vertex));
    if (!(best > S(0))) {
      Manifold<S> m;
      collide_polyhedra(of_a, ta, of_b, tb, margin, m);
      const bool by_edges = m.count == 1 && m.points[0].feature >> 31 == 0;
      // Faces may tell of almost the same gap.
      const double slack = to_double(detail::edge_slack(min(of_a.inner_radius, of_b.inner_radius)));
      double told = 1e9;
      for (int i = 0; i < m.count; ++i) told = std::min(told, to_double(m.points[i].separation));
      const bool crosses = all.found && all.separation <= margin;
      ASSERT_TRUE(by_edges == crosses || (crosses && std::fabs(told - to_double(all.separation)) <= slack)) << n;
    }
    bool is_known = false;
    const auto found = detail::near_edges(pair, face_a, over_a, face_b, margin, is_known).axis;
    if (!is_known) {  // a point of the contact decides, or all edges
      ++open;
      continue;
    }
    if (best > S(0) && !found.found) continue;  // apart: what is over a face is as far from it as they are
    ++(all.found ? (all.separation > S(0) ? apart : overlap) : none);
    ASSERT_EQ(found.found, all.found) << n;
    if (!all.found || (all.separation > margin && found.separation > margin)) continue;
    EXPECT_LE(to_double(abs(found.separation - all.separation)), to_double(pair.tolerance)) << n;
    if (!(all.separation > S(0))) {
      EXPECT_TRUE(found.edge_a == all.edge_a && found.edge_b == all.edge_b && found.normal == all.normal) << n;
    }
  }
  EXPECT_GT(overlap, 500);
  EXPECT_GT(apart, 50);
  EXPECT_GT(none, 500);
  EXPECT_GT(open, 20);
}

template <class View> bool same(const View& a, const View& b) {
  bool all = a.size() == b.size();
  for (std::uint32_t i = 0; all && i < a.size(); ++i) all = a[i] == b[i];
  return all;
}

TYPED_TEST(Polyhedra, a_box_is_the_hull_of_its_corners) {
  using S = TypeParam;
  const GridPoint half = {40000, 12000, 77000};
  std::vector<GridPoint> corners;
  for (int corner = 0; corner < 8; ++corner) {
    corners.push_back({(corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                       (corner & 4) != 0 ? half.z : -half.z});
  }
  const HullSolid<S> hull(convex_hull(corners).value(), 16);
  const BoxSolid<S> box({S(40000.0 / 65536), S(12000.0 / 65536), S(77000.0 / 65536)});
  const Polyhedron<S> a = hull.polyhedron(), b = box.polyhedron();
  EXPECT_TRUE(same(a.vertices, b.vertices) && same(a.half_edges, b.half_edges) && same(a.faces, b.faces));
  EXPECT_TRUE(same(a.spokes, b.spokes));
  EXPECT_TRUE(same(a.normals, b.normals) && same(a.offsets, b.offsets) && same(a.directions, b.directions));
  EXPECT_NEAR(to_double(a.inner_radius), to_double(b.inner_radius), 1e-4);
}

TYPED_TEST(Polyhedra, lie_on_a_half_space_with_the_face_that_looks_down_most) {
  using S = TypeParam;
  scenes::Draws draws(23);
  int apart = 0, four = 0;
  for (int n = 0; n < 2000; ++n) {
    const Convex<S> solid(drawn_points(n, draws), 16);
    const D3 at = n % 3 == 0 ? D3{40, -30, 20} : D3{0, 0, 0};
    const Transform<S> tb = this->transform(at);
    const Transform<S> ta = this->transform(at + this->random_.point(0.6));
    const Vec3<Unit<S>> normal = oracle::made<Unit<S>>(this->random_.direction());
    const S offset = from_double<S>(this->random_.in(-0.3, 0.3));
    Manifold<S> m;
    collide_polyhedron_half_space(solid.solid.polyhedron(), ta, normal, offset, tb, from_double<S>(this->kMargin), m);
    const Transform<double> a = oracle::real(ta), b = oracle::real(tb);
    const D3 up = b.rotation * oracle::real(normal);
    const double error = this->rounding(60);
    double lowest = 1e300;
    std::uint32_t deepest = 0;
    const auto height_of = [&](std::uint32_t i) {
      return dot(up, to_world(a, solid.vertex(i)) - b.position) - to_double(offset);
    };
    for (std::uint32_t i = 0; i < solid.hull.vertices.size(); ++i) {
      if (height_of(i) < lowest) lowest = height_of(i), deepest = i;
    }
    const Polyhedron<S> p = solid.solid.polyhedron();
    const D3 up_in_a = transposed_times(a.rotation, up);
    double facing = 1;
    std::uint32_t face = 0;
    p.visit_spokes(deepest, [&](std::uint32_t edge) {
      const double along = dot(oracle::real(p.normals[p.half_edges[edge].face]), up_in_a);
      if (along < facing) facing = along, face = p.half_edges[edge].face;
    });
    int near = 0;
    for (std::uint32_t edge = p.faces[face], first = edge, begun = 0; begun == 0 || edge != first; begun = 1) {
      near += height_of(p.origin(edge)) < this->kMargin - error ? 1 : 0;
      edge = p.half_edges[edge].next;
    }
    ASSERT_GE(m.count, std::min(near, 4)) << n;
    if (m.count == 0) {
      ++apart;
      continue;
    }
    double least = 1e300;
    for (int i = 0; i < m.count; ++i) {
      const D3 vertex = to_world(a, solid.vertex(m.points[i].feature)), on = oracle::real(m.points[i].position);
      const double height = dot(up, vertex - b.position) - to_double(offset);
      ASSERT_NEAR(to_double(m.points[i].separation), height, error) << n;
      ASSERT_LT(oracle::length(vertex - up * (height / 2) - on), 4 * error) << n;
      least = std::min(least, height);
    }
    ASSERT_NEAR(least, lowest, error + to_double(solid.solid.polyhedron().inner_radius) / 512) << n;
    ASSERT_LT(oracle::length(oracle::real(m.normal) + up), 8 * error);
    four += m.count == 4 ? 1 : 0;
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(four, 500);
}

/// A face that is preferred to a better one may have nothing above it: then no vertex far from the other solid touches.
TYPED_TEST(Polyhedra, touch_where_both_of_them_are) {
  using S = TypeParam;
  const BoxSolid<S> small({S(0.05), S(0.05), S(0.05)}), large({S(0.5), S(0.5), S(0.5)}), plate({S(4), S(0.1), S(4)});
  const auto turned = [](D3 at, D3 axis, double angle) {
    const D3 v = oracle::unit(axis) * isostep::sin(angle / 2);
    using U = Unit<S>;
    return Transform<S>{oracle::made<S>(at),
                        to_matrix(Quat<U>{from_double<U>(v.x), from_double<U>(v.y), from_double<U>(v.z),
                                          from_double<U>(isostep::cos(angle / 2))})};
  };
  const Transform<S> still = turned({0, 0, 0}, {0, 1, 0}, 0);
  int touching = 0;
  for (int step = -40; step <= 40; ++step) {
    for (const double over : {0.0, 0.15}) {  // beside each other, and one above the other
      Manifold<S> m;
      const double gap = step * 1e-5;
      const D3 corner = {-0.45 + over, 0.55 + gap, -0.45 + over}, side = {4.5 - over, 0.6 + gap, 0};
      collide_polyhedra(small.polyhedron(), still, large.polyhedron(), turned(corner, {0, 1, 0}, 0.3), S(0), m);
      for (int i = 0; i < m.count; ++i) ASSERT_LT(oracle::length(oracle::real(m.points[i].position)), 0.1) << step;
      touching += m.count;
      collide_polyhedra(large.polyhedron(), still, plate.polyhedron(), turned(side, {1, 0, 0.3}, -0.001), S(0), m);
      for (int i = 0; i < m.count; ++i) ASSERT_LT(std::fabs(to_double(m.points[i].position.z)), 0.51) << step;
      touching += m.count;
    }
  }
  EXPECT_GT(touching, 100);
}

}  // namespace polyhedra_test
}  // namespace isostep::test
