// Random draws against their distributions, noise against its promises, for every scalar.
// SPDX-License-Identifier: MIT
#include "isostep/math/draws.hpp"

#include <array>
#include <vector>

#include "isostep/math/mat3.hpp"
#include "isostep/math/noise.hpp"
#include "oracle.hpp"

namespace isostep {
namespace draws_test {

using namespace test;

constexpr int kMany = 40000;
/// The bound of a mean of kMany numbers of deviation 1: five of its own deviations.
constexpr double kMeanBound = 5.0 / 200;

template <class S> class DrawsTest : public testing::Test {};
TYPED_TEST_SUITE(DrawsTest, Scalars);

TYPED_TEST(DrawsTest, normal_numbers_have_their_moments) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(1);
  double mean = 0, square = 0, fourth = 0, most = 0;
  for (int i = 0; i < kMany; ++i) {
    const double x = to_double(random_normal<S>(random));
    mean += x / kMany, square += x * x / kMany, fourth += x * x * x * x / kMany;
    most = std::max(most, std::abs(x));
  }
  EXPECT_NEAR(mean, 0, kMeanBound);
  EXPECT_NEAR(square, 1, 1.5 * kMeanBound);
  EXPECT_NEAR(fourth, 3, 10 * kMeanBound);
  EXPECT_GT(most, 3.5);
  EXPECT_LT(most, 5.8);
}

TYPED_TEST(DrawsTest, directions_and_rotations_favour_no_side) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(2);
  RealVec mean = RealVec::Zero(), turned = RealVec::Zero();
  RealMat square = RealMat::Zero();
  for (int i = 0; i < kMany; ++i) {
    const RealVec d = real(random_direction<S>(random));
    EXPECT_NEAR(double(d.norm()), 1, 1e-6);
    mean += d / kMany;
    square += d * d.transpose() / kMany;
    turned += real(rotate(random_rotation<S>(random), Vec3<Unit<S>>{Unit<S>(0), Unit<S>(1), Unit<S>(0)})) / kMany;
  }
  expect_near(mean, RealVec::Zero(), kMeanBound);
  expect_near(turned, RealVec::Zero(), kMeanBound);
  expect_near(square, RealMat(RealMat::Identity() / 3), kMeanBound);
}

TYPED_TEST(DrawsTest, balls_discs_and_boxes_are_filled_evenly) {
  using S = TypeParam;
  Lcg random{3};
  double inner_ball = 0, inner_disc = 0;
  RealVec mean = RealVec::Zero();
  for (int i = 0; i < kMany; ++i) {
    const Real from_middle = real(random_in_ball(random, S(4))).norm();
    const Vec3<S> on_disc = random_in_disc(random, S(4));
    EXPECT_LE(double(from_middle), 4.001);
    EXPECT_LE(double(real(on_disc).norm()), 4.001);
    EXPECT_EQ(on_disc.y, S(0));
    inner_ball += from_middle < 2 ? 1.0 / kMany : 0;
    inner_disc += real(on_disc).norm() < 2 ? 1.0 / kMany : 0;
    const Vec3<S> in_box = random_in_box(random, Vec3<S>{S(-1), S(0), S(3)}, Vec3<S>{S(1), S(2), S(5)});
    mean += real(in_box) / kMany;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(in_box[axis], S(2 * axis - 1 - (axis == 1)));
      EXPECT_LE(in_box[axis], S(2 * axis + 1 - (axis == 1)));
    }
  }
  EXPECT_NEAR(inner_ball, 0.125, kMeanBound / 2);
  EXPECT_NEAR(inner_disc, 0.25, kMeanBound / 2);
  expect_near(mean, RealVec(0, 1, 4), kMeanBound);
}

TEST(Shuffle, MakesEveryOrderAsOften) {
  Pcg32 random = Pcg32::seeded(5);
  std::array<int, 27> seen = {};
  for (int i = 0; i < 12000; ++i) {
    int things[3] = {0, 1, 2};
    shuffle(things, 3u, random);
    ++seen[static_cast<std::size_t>(things[0] * 9 + things[1] * 3 + things[2])];
  }
  int orders = 0;
  for (const int times : seen) {
    if (times == 0) continue;
    ++orders;
    EXPECT_NEAR(times, 2000, 200);
  }
  EXPECT_EQ(orders, 6);
}

template <class S> class NoiseTest : public testing::Test {};
TYPED_TEST_SUITE(NoiseTest, Scalars);

TYPED_TEST(NoiseTest, is_smooth_bounded_and_of_its_seed) {
  using S = TypeParam;
  Draw draw(61);
  int different = 0;
  double least = 0, most = 0, square = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> p = draw.vector<S>(i % 2 == 0 ? 3 : 9);
    const Vec3<S> near = p + Vec3<S>{S(0.0009765625), S(0), S(0)};
    const std::uint32_t seed = static_cast<std::uint32_t>(i % 3);
    const double value = to_double(value_noise(p, seed)), gradient = to_double(gradient_noise(p, seed));
    const double fractal = to_double(fractal_noise(p, seed, 5));
    for (const double x : {value, gradient, fractal}) EXPECT_LE(std::abs(x), 1);
    // Slopes: blends rise by at most 1.875 a cell, between values at most 2 apart.
    EXPECT_NEAR(to_double(value_noise(near, seed)), value, 4e-3);
    EXPECT_NEAR(to_double(gradient_noise(near, seed)), gradient, 6e-3);
    EXPECT_NEAR(to_double(fractal_noise(near, seed, 5)), fractal, 16e-3);
    EXPECT_EQ(fractal_noise(p, seed, 1) + fractal_noise(p, seed, 1), gradient_noise(p, seed));
    different += value_noise(p, seed) != value_noise(p, seed + 1);
    least = std::min(least, gradient), most = std::max(most, gradient);
    square += gradient * gradient / kDraws;
  }
  EXPECT_GT(different, kDraws * 99 / 100);
  EXPECT_LT(least, -0.5);
  EXPECT_GT(most, 0.5);
  EXPECT_GT(square, 0.04);
}

TYPED_TEST(NoiseTest, joins_at_the_borders_of_cells) {
  using S = TypeParam;
  Draw draw(62);
  const S hair = kIsFixed<S> ? resolution<S>() : S(0.0000152587890625);
  for (int i = 0; i < kDraws; ++i) {
    Vec3<S> p = draw.vector<S>(3);
    p[i % 3] = S(draw.number<Q32_32>(3) < Q32_32(0) ? -(i % 7) : i % 7);
    Vec3<S> before = p;
    before[i % 3] = before[i % 3] - hair;
    const double slack = 64 * to_double(hair);
    EXPECT_NEAR(to_double(value_noise(p, 9)), to_double(value_noise(before, 9)), slack);
    EXPECT_NEAR(to_double(gradient_noise(p, 9)), to_double(gradient_noise(before, 9)), slack);
    EXPECT_NEAR(to_double(fractal_noise(p, 9, 3)), to_double(fractal_noise(before, 9, 3)), slack);
    const Vec3<S> corner = {S(i % 5), S(i % 7 - 3), S(-i)};
    EXPECT_EQ(gradient_noise(corner, 9), Unit<S>(0));
  }
}

}  // namespace draws_test
}  // namespace isostep
