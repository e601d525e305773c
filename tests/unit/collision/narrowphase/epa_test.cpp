// EPA: a depth is right where moving by it parts the solids and no axis is better.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/epa.hpp"

#include <gtest/gtest.h>

#include "isostep/collision/narrowphase/gjk.hpp"
#include "unit/collision/narrowphase/placed_solids.hpp"

namespace isostep::test {
namespace {

using oracle::D3;

template <class S> using EpaTest = SolidTest<S>;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(EpaTest, Scalars);

TYPED_TEST(EpaTest, depth_is_that_of_the_best_axis) {
  using S = TypeParam;
  const auto solids = solids_of_many_sizes<S>(43);
  int overlapping = 0, apart = 0, unfinished = 0, worse = 0, most_rounds = 0;
  double worst = 0;
  for (int n = 0; n < 10000; ++n) {
    const Solid<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 40 % 40)];
    const D3 at = n % 3 == 0 ? D3{40, -30, 20} : D3{0, 0, 0};
    const double reach = this->random_.in(0, 0.9) * (a.radius() + b.radius());
    const Transform<S> ta = this->transform(at), tb = this->transform(at + this->random_.direction() * reach);
    const EpaPenetration<S> found = epa_penetration(a.solid.polyhedron(), ta, b.solid.polyhedron(), tb);
    const Placed<S> placed(a, ta, b, tb);
    const double error = this->rounding(std::max(60.0, 4 * (a.radius() + b.radius()))), best = -placed.best();
    if (found.status == EpaStatus::apart) {
      ASSERT_LT(best, error) << n;
      ++apart;
      continue;
    }
    ASSERT_NE(found.status, EpaStatus::flat);
    ++overlapping;
    most_rounds = std::max(most_rounds, found.rounds);
    const double depth = to_double(found.depth);
    // Whatever the status says, the depth along the normal parts them.
    ASSERT_NEAR(-placed.separation(oracle::real(found.normal)), depth, error) << n;
    ASSERT_GT(depth, best - error) << n;
    if (found.status == EpaStatus::unfinished) ++unfinished;
    else if (depth > best + error) ++worse;
    else {
      const D3 on_a = oracle::real(found.on_a), on_b = oracle::real(found.on_b);
      ASSERT_LT(Placed<S>::outside(placed.normals_a, placed.vertices_a, on_a), 8 * error) << n;
      ASSERT_LT(Placed<S>::outside(placed.normals_b, placed.vertices_b, on_b), 8 * error) << n;
      worst = std::max(worst, oracle::length(on_a - on_b - oracle::real(found.normal) * depth) / error);
    }
    if (depth > best + error && std::getenv("V")) printf("%d status %d depth %g best %g\n", n, int(found.status), depth, best);
  }
  printf("overlap %d apart %d unfinished %d worse %d rounds %d worst %g\n", overlapping, apart, unfinished, worse, most_rounds, worst);
}

}  // namespace
}  // namespace isostep::test
