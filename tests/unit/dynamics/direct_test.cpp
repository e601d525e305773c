// The direct solver against forces that statics gives: weights, slopes, loops, and ratios of mass that defeat others.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "unit/dynamics/direct_world.hpp"
#include "unit/dynamics/scalar_name.hpp"

namespace isostep {
namespace direct_test {

template <class S> class Direct : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Direct, Scalars, ScalarName);

/// The number for scalars of 32 or of 64 bits.
template <class S> double narrow_or_wide(double narrow, double wide) { return sizeof(S) == 4 ? narrow : wide; }

TYPED_TEST(Direct, JointsOfAHangingChainBearTheWeightsBelowThem) {
  using S = TypeParam;
  DirectWorld<S> world;
  const double ball = narrow_or_wide<S>(50, 1000);
  std::uint32_t above = kNoBody;
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t link = world.add_box({0, -0.25 - 0.5 * i, 0}, i == 7 ? ball : 1, {0.05, 0.25, 0.05});
    world.join(JointType::ball, above, link, {0, -0.5 * i, 0});
    above = link;
  }
  for (int frame = 0; frame < 30; ++frame) world.step();
  for (std::uint32_t j = 0; j < 8; ++j) {
    const double weight = 10.0 * (ball + 7 - j);
    const std::uint32_t a = world.joints[j].body_a, b = world.joints[j].body_b;
    EXPECT_NEAR(world.force(world.impulses[j].point.y, a, b), weight, narrow_or_wide<S>(5e-3, 1e-4) * weight) << j;
    EXPECT_LT(world.separation(j), narrow_or_wide<S>(2e-4, 1e-6)) << j;
  }
}

TYPED_TEST(Direct, ContactsOfAStackBearTheWeightsAboveThem) {
  using S = TypeParam;
  DirectWorld<S> world;
  std::uint32_t below = kNoBody;
  for (int i = 0; i < 6; ++i) {
    const std::uint32_t box = world.add_box({0, 0.5 + i, 0}, 2, {0.5, 0.5, 0.5});
    world.rest(below, box, 0.5);
    below = box;
  }
  for (int frame = 0; frame < 30; ++frame) world.step();
  for (std::uint32_t c = 0; c < 6; ++c) {
    Velocity<S> total(0);
    for (const Velocity<S> impulse : world.contacts[c].normal_impulse) total += impulse;
    const double weight = 20.0 * (6 - c);
    EXPECT_NEAR(world.force(total, c == 0 ? kNoBody : c - 1, c), weight, narrow_or_wide<S>(1e-2, 1e-3) * weight) << c;
    EXPECT_NEAR(world.centre(c).y, 0.5 + c, narrow_or_wide<S>(1e-3, 1e-4)) << c;
  }
}

/// Thirty boxes on one plank: each of their 90 blocks meets all others, so a factorisation takes 180 000 products.
TYPED_TEST(Direct, AnIslandBeyondItsBudgetIsSweptAndCounted) {
  using S = TypeParam;
  DirectWorld<S> world;
  const std::uint32_t plank = world.add_box({0, 0.5, 0}, 20, {16, 0.5, 0.5});
  world.rest(kNoBody, plank, 0.5);
  world.step();
  EXPECT_EQ(world.solver.unsolved(), 0u);
  for (int i = 0; i < 30; ++i) world.rest(plank, world.add_box({i - 14.5, 1.5, 0}, 1, {0.25, 0.5, 0.25}), 0.5);
  world.rest(kNoBody, world.add_box({0, 0.5, 9}, 1, {0.5, 0.5, 0.5}), 0.5);  // an island of its own
  for (int frame = 0; frame < 10; ++frame) {
    world.step();
    EXPECT_EQ(world.solver.unsolved(), 1u);
  }
  for (std::uint32_t b = 1; b <= 30; ++b) EXPECT_NEAR(world.centre(b).y, 1.5, 0.02) << b;
}

TYPED_TEST(Direct, AHeavyBoxDoesNotSinkIntoALightOne) {
  using S = TypeParam;
  DirectWorld<S> world;
  world.rest(kNoBody, world.add_box({0, 0.5, 0}, 1, {0.5, 0.5, 0.5}), 0.5);
  const double ratio = narrow_or_wide<S>(100, 400);
  world.rest(0, world.add_box({0, 2, 0}, ratio, {1, 1, 1}), 0.5);
  for (int frame = 0; frame < 120; ++frame) world.step();
  EXPECT_NEAR(world.centre(0).y, 0.5, 2e-3);
  EXPECT_NEAR(world.centre(1).y, 2, 2e-3);
}

TYPED_TEST(Direct, ABoxRestsBelowTheAngleOfFrictionAndSlidesAboveIt) {
  using S = TypeParam;
  for (const double share : {0.9, 1.1}) {
    DirectWorld<S> world;
    const double friction = 0.5, angle = std::atan(share * friction);
    world.gravity = {10 * std::sin(angle), -10 * std::cos(angle), 0};
    world.rest(kNoBody, world.add_box({0, 0.5, 0}, 1, {0.5, 0.5, 0.5}), friction);
    for (int frame = 0; frame < 60; ++frame) world.step();
    const double speed = to_double(world.states[0].velocity.x);
    const double wanted = share < 1 ? 0 : 10 * (std::sin(angle) - friction * std::cos(angle));
    EXPECT_NEAR(speed, wanted, share < 1 ? narrow_or_wide<S>(1e-3, 1e-4) : 0.02 * wanted) << share;
    EXPECT_NEAR(world.centre(0).y, 0.5, 1e-3);
  }
}

TYPED_TEST(Direct, AFourBarClosedThroughItsBodiesStaysClosed) {
  using S = TypeParam;
  DirectWorld<S> world;
  world.substeps = 4;
  const std::uint32_t top = world.add_box({0, 0, 0}, 1, {0.5, 0.05, 0.05});
  const std::uint32_t right = world.add_box({0.5, -0.5, 0}, 1, {0.05, 0.5, 0.05});
  const std::uint32_t bottom = world.add_box({0, -1, 0}, 1, {0.5, 0.05, 0.05});
  const std::uint32_t left = world.add_box({-0.5, -0.5, 0}, 1, {0.05, 0.5, 0.05});
  world.join(JointType::hinge, top, right, {0.5, 0, 0});
  world.join(JointType::hinge, right, bottom, {0.5, -1, 0});
  world.join(JointType::hinge, bottom, left, {-0.5, -1, 0});
  world.join(JointType::hinge, left, top, {-0.5, 0, 0});
  world.join(JointType::hinge, kNoBody, top, {0.5, 0, 0});  // swings
  double worst = 0;
  for (int frame = 0; frame < 120; ++frame) {
    world.step();
    for (std::size_t j = 0; j < 5; ++j) worst = std::max(worst, world.separation(j));
  }
  EXPECT_LT(worst, narrow_or_wide<S>(1e-2, 5e-3));
  EXPECT_LT(world.centre(top).y, -0.1);
}

TYPED_TEST(Direct, AMotorGivesItsTorqueAndALimitHolds) {
  using S = TypeParam;
  DirectWorld<S> world;
  world.gravity = {0, 0, 0};
  const std::uint32_t door = world.add_box({0.5, 0, 0}, 3, {0.5, 0.1, 0.1});
  JointProperties<S>& hinge = world.join(JointType::hinge, kNoBody, door, {0, 0, 0});
  hinge.flags = joint_flag::kMotor | joint_flag::kLimit;
  hinge.lower = S(-1);
  hinge.upper = S(0.5);
  hinge.motor_speed = S(10);
  hinge.max_force = S(2);
  const double inertia = 3 * (0.25 + (0.25 + 0.01) / 3);
  for (int frame = 0; frame < 15; ++frame) world.step();
  EXPECT_NEAR(to_double(world.states[door].angular_velocity.z), 2 / inertia * 0.25, 0.02);
  for (int frame = 0; frame < 120; ++frame) world.step();
  EXPECT_NEAR(world.centre(door).y, 0.5 * std::sin(0.5), 2e-3);
  EXPECT_NEAR(to_double(world.states[door].angular_velocity.z), 0, 1e-2);
}

}  // namespace direct_test
}  // namespace isostep
