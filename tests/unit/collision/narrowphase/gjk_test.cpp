// GJK: a distance is right where its points lie in the solids, so far apart, and a plane parts the solids by as much.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/gjk.hpp"

#include <gtest/gtest.h>

#include "sample.hpp"
#include "unit/collision/narrowphase/placed_solids.hpp"

namespace isostep::test {
namespace gjk_test {

using oracle::D3;

template <class S> using Gjk = SolidTest<S>;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Gjk, Scalars);

TYPED_TEST(Gjk, points_in_the_solids_and_a_plane_between_them_agree_on_the_distance) {
  using S = TypeParam;
  const auto solids = solids_of_many_sizes<S>(41);
  int apart = 0, overlapping = 0, most_iterations = 0;
  const int pairs = sampled(10000, 2500);
  for (int n = 0; n < pairs; ++n) {
    const Convex<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 40 % 40)];
    const D3 at = n % 3 == 0 ? D3{40, -30, 20} : D3{0, 0, 0};
    const double reach = this->random_.in(0.1, 1.5) * (a.radius() + b.radius());
    const Transform<S> ta = this->transform(at), tb = this->transform(at + this->random_.direction() * reach);
    const GjkDistance<S> found = gjk_distance(a.solid.polyhedron(), ta, b.solid.polyhedron(), tb);
    const Placed<S> placed(a, ta, b, tb);
    const double error = this->rounding(std::max(60.0, 4 * (a.radius() + b.radius()))), best = placed.best();
    most_iterations = std::max(most_iterations, found.iterations);
    ASSERT_LT(found.iterations, 32) << n;
    if (found.distance == S(0)) {
      ASSERT_LT(best, 4 * error) << n << ": overlap";
      ++overlapping;
      continue;
    }
    ++apart;
    const double distance = to_double(found.distance);
    const D3 on_a = oracle::real(found.on_a), on_b = oracle::real(found.on_b), normal = oracle::real(found.normal);
    ASSERT_GT(distance, best - 4 * error) << n << ": no axis parts them by more";
    // Shares of a thin triangle's corners are quotients of short heights.
    const double inside = 8 * error * (1 + a.radius() + b.radius());
    ASSERT_LT(Placed<S>::outside(placed.normals_a, placed.vertices_a, on_a), inside) << n;
    ASSERT_LT(Placed<S>::outside(placed.normals_b, placed.vertices_b, on_b), inside) << n;
    ASSERT_NEAR(oracle::length(on_b - on_a), distance, 2 * inside) << n;
    // Where a vertex and an edge are as near, to the last digit of a distance, directions differ by its root.
    const double slack = 8 * error + (a.radius() + b.radius()) * std::min(1.0, std::sqrt(8 * error / distance));
    ASSERT_GT(placed.separation(normal), distance - slack) << n;
  }
  EXPECT_GT(apart, pairs * 4 / 10);
  EXPECT_GT(overlapping, pairs / 5);
  EXPECT_LT(most_iterations, 24);
}

}  // namespace gjk_test
}  // namespace isostep::test
