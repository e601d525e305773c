// V-Clip against GJK: the same distance, from any features, and in few rounds from those of before.
// SPDX-License-Identifier: MIT
#include "isostep/book/v_clip.hpp"

#include <gtest/gtest.h>

#include "isostep/collision/narrowphase/gjk.hpp"
#include "sample.hpp"
#include "unit/collision/narrowphase/placed_solids.hpp"

namespace isostep::test {
namespace v_clip_test {

using oracle::D3;

template <class S> using VClipTest = SolidTest<S>;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(VClipTest, Scalars);

TYPED_TEST(VClipTest, distance_is_that_of_the_nearest_points) {
  using S = TypeParam;
  const auto solids = solids_of_many_sizes<S>(47);
  int apart = 0, overlap = 0, unfinished = 0, wrong = 0, missed = 0, rounds = 0;
  const int pairs = sampled(10000, 2500);
  for (int n = 0; n < pairs; ++n) {
    const Convex<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 40 % 40)];
    const D3 at = n % 3 == 0 ? D3{40, -30, 20} : D3{0, 0, 0};
    const double reach = this->random_.in(0.1, 1.5) * (a.radius() + b.radius());
    const Transform<S> ta = this->transform(at), tb = this->transform(at + this->random_.direction() * reach);
    const Polyhedron<S> pa = a.solid.polyhedron(), pb = b.solid.polyhedron();
    const VClipDistance<S> found = v_clip_distance(pa, ta, pb, tb, {});
    const GjkDistance<double> exact = [&] {
      const Placed<S> placed(a, ta, b, tb);
      const Transform<double> still = {{0, 0, 0}, Mat3<double>::identity()};
      return gjk_distance<double>(ConvexCore<double>{placed.vertices_a, 0}, still,
                                  ConvexCore<double>{placed.vertices_b, 0}, still);
    }();
    const double error = this->rounding(std::max(60.0, 4 * (a.radius() + b.radius())));
    rounds += found.rounds;
    if (found.status == VClipStatus::unfinished) ++unfinished;
    else if (found.status == VClipStatus::overlap) {
      ++overlap;
      if (exact.distance > 2 * error) ++missed;
    } else {
      ++apart;
      if (std::fabs(exact.distance - to_double(found.distance)) > 2 * error) ++wrong;
    }
  }
  EXPECT_GT(apart, pairs * 6 / 10);
  EXPECT_GT(overlap, pairs * 35 / 100);
  EXPECT_EQ(unfinished, 0);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(missed, 0);
  EXPECT_LT(rounds, 12 * pairs);
}

TYPED_TEST(VClipTest, any_features_lead_to_the_same_distance_and_those_of_before_soon) {
  using S = TypeParam;
  const auto solids = solids_of_many_sizes<S>(49);
  int apart = 0, rounds = 0, unfinished = 0;
  for (int n = 0; n < 400; ++n) {
    const Convex<S>&a = *solids[static_cast<std::size_t>(n % 40)], &b = *solids[static_cast<std::size_t>(n / 10 % 40)];
    const Polyhedron<S> pa = a.solid.polyhedron(), pb = b.solid.polyhedron();
    const D3 from = this->random_.direction() * (1.2 * (a.radius() + b.radius()));
    const Transform<S> ta = this->transform({0, 0, 0});
    Transform<S> tb = this->transform(from);
    const double error = this->rounding(4 * (a.radius() + b.radius()));
    FeaturePair features = v_clip_distance(pa, ta, pb, tb, {}).features;
    for (int step = 0; step < 20; ++step) {
      tb.position += oracle::made<S>(this->random_.point(0.01 * (a.radius() + b.radius())));
      const auto any = [&] {
        const auto kind = static_cast<PolyhedronFeature::Kind>(static_cast<int>(this->random_.in(0, 3)));
        return PolyhedronFeature{kind, static_cast<std::uint8_t>(this->random_.in(0, 256))};
      };
      const PolyhedronFeature any_a = any(), any_b = any();
      const VClipDistance<S> found = v_clip_distance(pa, ta, pb, tb, features);
      const VClipDistance<S> again = v_clip_distance(pa, ta, pb, tb, {any_a, any_b});
      features = found.features;
      if (found.status == VClipStatus::unfinished || again.status == VClipStatus::unfinished) ++unfinished;
      if (found.status != VClipStatus::apart || again.status != VClipStatus::apart) continue;
      ++apart;
      rounds += found.rounds;
      ASSERT_NEAR(to_double(found.distance), to_double(again.distance), 2 * error) << n;
    }
  }
  EXPECT_EQ(apart, 8000);
  EXPECT_EQ(unfinished, 0);
  EXPECT_LT(rounds, apart + apart / 10);
}

}  // namespace v_clip_test
}  // namespace isostep::test
