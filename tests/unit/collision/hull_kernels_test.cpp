// Hulls over lanes: every instruction set has the bits that collide_polyhedra() has.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "sample.hpp"
#include "unit/collision/kernel_cases.hpp"
#include "unit/collision/narrowphase/placed_solids.hpp"

namespace isostep::test {
namespace hull_kernels_test {

template <class S> class HullKernels : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(HullKernels, Scalars);

/// A prism or, with its middles for ends, a bipyramid: `sides` from 3 up to 42, whose prism has 126 edges.
std::vector<GridPoint> drum(int sides, bool pyramids) {
  std::vector<GridPoint> points;
  for (int i = 0; i < sides; ++i) {
    const double turn = 2 * std::acos(-1.0) * i / sides;
    const auto x = static_cast<std::int32_t>(30000 * isostep::cos(turn));
    const auto z = static_cast<std::int32_t>(30000 * isostep::sin(turn));
    points.push_back({x, pyramids ? 0 : 20000, z});
    if (!pyramids) points.push_back({x, -20000, z});
  }
  if (pyramids) points.insert(points.end(), {{0, 25000, 0}, {0, -25000, 0}});
  return points;
}

TYPED_TEST(HullKernels, hulls_whose_corners_edges_and_faces_fill_blocks_of_lanes_or_do_not) {
  using S = TypeParam;
  auto solids = solids_of_many_sizes<S>(31);
  for (int sides = 3; sides <= 42; ++sides)
    solids.push_back(std::make_unique<Convex<S>>(drum(sides, sides % 2 != 0), 16));
  oracle::Random random(7);
  const auto place = [&](oracle::D3 at) {
    const auto orientation = random.template orientation<S>();
    return Transform<S>{oracle::made<S>(at), to_matrix(orientation)};
  };
  int touching = 0, edges = 0, largest = 0;
  const int pairs = sampled(6000, 1500);
  for (int n = 0; n < pairs; ++n) {
    const Convex<S>& a = *solids[static_cast<std::size_t>(n % 80)];
    const Convex<S>& b = *solids[static_cast<std::size_t>(n * 7 / 80 % 80)];
    const double reach = random.in(0.2, 1.0) * (a.radius() + b.radius());
    const Transform<S> ta = place({0, 0, 0});
    const Transform<S> tb = place(random.direction() * reach);
    Manifold<S> alone;
    collide_polyhedra(a.solid.polyhedron(), ta, b.solid.polyhedron(), tb, from_double<S>(0.02), alone);
    for (const Simd simd : kSets) {
      Manifold<S> wide;
      pair_kernels<S>(simd)->polyhedra(a.solid.polyhedron(), ta, b.solid.polyhedron(), tb, from_double<S>(0.02), wide);
      ASSERT_TRUE(same_bits(alone, wide)) << "set " << static_cast<int>(simd) << " pair " << n;
    }
    touching += alone.count > 0 ? 1 : 0;
    edges += alone.count == 1 && alone.points[0].feature >> 31 == 0 ? 1 : 0;
    largest = std::max(largest, static_cast<int>(a.hull.half_edges.size() / 2));
  }
  EXPECT_GT(touching, pairs / 3);
  EXPECT_GT(edges, pairs / 20);
  EXPECT_EQ(largest, 126);
}

}  // namespace hull_kernels_test
}  // namespace isostep::test
