// EPA: a depth is right where moving by it parts the solids and no axis is better.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/epa.hpp"

#include <gtest/gtest.h>

#include "isostep/collision/narrowphase/gjk.hpp"
#include "sample.hpp"
#include "unit/collision/narrowphase/placed_solids.hpp"

namespace isostep::test {
namespace epa_test {

using oracle::D3;

template <class S> using EpaTest = SolidTest<S>;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(EpaTest, Scalars);

TYPED_TEST(EpaTest, depth_is_that_of_the_best_axis) {
  using S = TypeParam;
  const auto solids = solids_of_many_sizes<S>(43);
  int overlapping = 0, apart = 0, unfinished = 0, worse = 0, most_rounds = 0;
  double worst = 0;
  const int pairs = sampled(10000, 2500);
  for (int n = 0; n < pairs; ++n) {
    const Convex<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 40 % 40)];
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
  }
  EXPECT_GT(overlapping, pairs * 6 / 10);
  EXPECT_GT(apart, pairs / 5);
  EXPECT_EQ(unfinished, 0);
  EXPECT_EQ(worse, 0);
  EXPECT_LT(most_rounds, 40);
  EXPECT_LT(worst, 8) << "errors: between the points is the depth along the normal";
}

/// A box and a triangle by all axes there are.
double depth_by_axes(const std::vector<D3>& box, const Transform<double>& at, const std::vector<D3>& triangle) {
  const D3 edges[3] = {oracle::unit(triangle[1] - triangle[0]), oracle::unit(triangle[2] - triangle[1]),
                       oracle::unit(triangle[0] - triangle[2])};
  std::vector<D3> axes = {oracle::unit(cross(edges[0], edges[1]))};
  for (int i = 0; i < 3; ++i) {
    axes.push_back(at.rotation.column(i));
    for (const D3 edge : edges) {
      const D3 across = cross(at.rotation.column(i), edge);
      if (oracle::length(across) > 1e-9) axes.push_back(oracle::unit(across));
    }
  }
  double least = 1e300;
  for (const D3 n : axes) {
    double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
    for (const D3 v : box)
      low_a = std::min(low_a, dot(n, to_world(at, v))), high_a = std::max(high_a, dot(n, to_world(at, v)));
    for (const D3 v : triangle) low_b = std::min(low_b, dot(n, v)), high_b = std::max(high_b, dot(n, v));
    least = std::min({least, high_a - low_b, high_b - low_a});
  }
  return least;
}

/// What is known to mislead EPA: triangles a thousand times as long as the box, and as wide.
TYPED_TEST(EpaTest, long_thin_triangles_give_the_least_depth_or_say_that_it_is_not) {
  using S = TypeParam;
  int overlapping = 0, unfinished = 0, worse = 0;
  double most = 0;
  for (int n = 0; n < 4000; ++n) {
    const double length = this->random_.size(2, 80), width = this->random_.size(0.05, 5);
    const auto turn = this->transform({0, 0, 0});
    const Transform<double> frame = oracle::real(turn);
    std::vector<Vec3<S>> triangle, box;
    std::vector<D3> real_triangle, real_box;
    const auto add = [](std::vector<Vec3<S>>& to, std::vector<D3>& real, D3 v) {
      to.push_back(oracle::made<S>(v));
      real.push_back(oracle::real(to.back()));
    };
    const D3 half = D3{1, 1, 1} * this->random_.size(0.02, 0.5);
    const double along = this->random_.in(-0.4, 0.4) * length;
    add(triangle, real_triangle, frame.rotation * D3{-length / 2 + along, -width / 2, 0});
    add(triangle, real_triangle, frame.rotation * D3{length / 2 + along, -width / 2, 0});
    add(triangle, real_triangle, frame.rotation * D3{this->random_.in(-0.5, 0.5) * length + along, width / 2, 0});
    for (int i = 0; i < 8; ++i)
      add(box, real_box,
          {(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y, (i & 4) != 0 ? half.z : -half.z});
    const Transform<S> at = this->transform(frame.rotation * D3{0, 0, this->random_.in(-1, 1) * half.x});
    const Transform<S> still = {Vec3<S>::zero(), Mat3<Unit<S>>::identity()};
    const EpaPenetration<S> found = epa_penetration(ConvexCore<S>{box, S(0)}, at, ConvexCore<S>{triangle, S(0)}, still);
    if (found.status == EpaStatus::apart) continue;
    ++overlapping;
    const double depth = to_double(found.depth), best = depth_by_axes(real_box, oracle::real(at), real_triangle);
    const double error = this->rounding(length);
    if (found.status != EpaStatus::converged) ++unfinished;
    else if (depth > best + error) ++worse;
    most = std::max(most, (depth - best) / error);
    ASSERT_GT(depth, best - error) << n;
  }
  EXPECT_GT(overlapping, 3000);
  // Of some 3400, in float and double; in the finer digits of Q32.32, near the origin, none.
  EXPECT_LE(unfinished, kIsFixed<S> ? 0 : 20);
  EXPECT_LE(worse, kIsFixed<S> ? 0 : 8);
  EXPECT_LT(most, 4) << "errors, also where it says that it is unfinished";
}

TYPED_TEST(EpaTest, cores_are_round) {
  using S = TypeParam;
  const std::vector<Vec3<S>> point = {Vec3<S>::zero()}, segment = {{S(0), S(-1), S(0)}, {S(0), S(1), S(0)}};
  const Mat3<Unit<S>> upright = Mat3<Unit<S>>::identity();
  const auto depth = [&](double x) {
    return epa_penetration(ConvexCore<S>{point, S(0.5)}, {Vec3<S>::zero(), upright}, ConvexCore<S>{segment, S(0.25)},
                           {{from_double<S>(x), S(0.5), S(0)}, upright});
  };
  const EpaPenetration<S> apart = depth(1), shallow = depth(0.5), deep = depth(0);
  EXPECT_EQ(apart.status, EpaStatus::apart);
  EXPECT_NEAR(to_double(apart.depth), -0.25, 1e-6);
  EXPECT_EQ(shallow.status, EpaStatus::converged);
  EXPECT_NEAR(to_double(shallow.depth), 0.25, 1e-6);
  EXPECT_NEAR(to_double(shallow.on_a.x), 0.5, 1e-6);
  EXPECT_NEAR(to_double(shallow.on_b.x), 0.25, 1e-6);
  // The centre on the segment: no volume of the difference, and any way across will do.
  EXPECT_EQ(deep.status, EpaStatus::flat);
  EXPECT_NEAR(to_double(deep.depth), 0.75, 1e-4);
  EXPECT_NEAR(to_double(deep.normal.y), 0, 1e-4);
}

}  // namespace epa_test
}  // namespace isostep::test
