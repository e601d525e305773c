// Many joints together: the laws of momentum, trees against one by one, chains under heavy loads, bridges, loops.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "unit/dynamics/joint_world.hpp"
#include "unit/dynamics/scalar_name.hpp"

namespace isostep {
namespace joint_chains_test {

template <class S> class JointChains : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(JointChains, Scalars, ScalarName);

// ---- laws

template <class S> void build_creature(JointWorld<S>& world) {
  const std::uint32_t pelvis = world.add_box({0, 0, 0}, 1, {0.15, 0.1, 0.1});
  const std::uint32_t torso = world.add_box({0, 0.34, 0}, 2, {0.18, 0.22, 0.11});
  const std::uint32_t head = world.add_box({0, 0.7, 0}, 0.5, {0.12, 0.12, 0.12});
  const std::uint32_t left = world.add_box({0.35, 0.48, 0}, 0.25, {0.15, 0.05, 0.05});
  const std::uint32_t right = world.add_box({-0.35, 0.48, 0}, 0.25, {0.15, 0.05, 0.05});
  const std::uint32_t leg = world.add_box({0.09, -0.32, 0}, 0.75, {0.07, 0.2, 0.07});
  world.join(JointType::fixed, pelvis, torso, {0, 0.11, 0});
  world.join(JointType::ball, torso, head, {0, 0.57, 0});
  world.join(JointType::hinge, torso, left, {0.19, 0.48, 0});
  world.join(JointType::ball, torso, right, {-0.19, 0.48, 0});
  world.join(JointType::ball, pelvis, leg, {0.09, -0.11, 0});
  world.states[pelvis].velocity = JointWorld<S>::velocity({1, 0, 0.5});
  world.states[torso].angular_velocity = JointWorld<S>::velocity({0.5, 3, -1});
  world.states[head].velocity = JointWorld<S>::velocity({0, 1, 0});
}

TYPED_TEST(JointChains, JointsWithoutTheWorldConserveMomentum) {
  using S = TypeParam;
  for (const bool one_by_one : {false, true}) {
    JointWorld<S> world;
    world.one_by_one = one_by_one;
    world.gravity = {0, 0, 0};
    build_creature(world);
    // One sub-step's impulses, before bodies move: what their change of inertia does later is not the joints' doing.
    for (int frame = 0; frame < 60; ++frame) {
      for (auto& impulse : world.impulses) impulse.point = JointWorld<S>::velocity({0.1, -0.2, 0.05});
      world.gather();
      const auto before = world.momentum();
      const JointStep<S> sub = world.substep();
      world.warm_start(sub);
      world.solve(sub, false);
      world.solve(sub, true);
      for (std::size_t r = 0; r < world.states.size(); ++r) {
        world.states[r].velocity = world.bodies.velocity[r + 1].linear;
        world.states[r].angular_velocity = world.bodies.velocity[r + 1].angular;
      }
      const auto after = world.momentum();
      EXPECT_LT(norm(after.first - before.first), tolerance<S>(1e-5, 1e-4));
      EXPECT_LT(norm(after.second - before.second), tolerance<S>(1e-5, 1e-3));
      world.step();
    }
  }
}

TYPED_TEST(JointChains, OnePassOverATreeLeavesNoRelativeSpeedAtItsJoints) {
  using S = TypeParam;
  JointWorld<S> world;
  build_creature(world);
  world.join(JointType::ball, kNoBody, 2, {0, 0.8, 0});
  world.gather();
  const JointStep<S> sub = world.substep();
  world.warm_start(sub);
  world.solve(sub, true);
  for (const JointConstraint<S>& joint : world.constraints) {
    const JointMotion<S> m = isostep::gather(world.bodies, joint.row_a, joint.row_b);
    for (std::uint32_t b = 0; b < joint.block_count; ++b) {
      EXPECT_LT(norm(JointWorld<S>::wide_of(speed_along(joint.blocks[b], m))), tolerance<S>(1e-3, 2e-2));
    }
  }
}

TYPED_TEST(JointChains, OneByOneJointsReachTheSameVelocitiesAsATree) {
  using S = TypeParam;
  JointWorld<S> worlds[2];
  for (JointWorld<S>& world : worlds) {
    build_creature(world);
    world.gather();
    const JointStep<S> sub = world.substep();
    world.warm_start(sub);
    if (&world == &worlds[0]) {
      world.solve(sub, true);
    } else {
      warm_start_joints(std::span<JointConstraint<S>>(world.constraints), sub);
      for (int i = 0; i < 400; ++i) solve_joints(std::span<JointConstraint<S>>(world.constraints), sub, true);
    }
  }
  for (std::size_t r = 1; r <= worlds[0].states.size(); ++r) {
    const auto& a = worlds[0].bodies.velocity[r];
    const auto& b = worlds[1].bodies.velocity[r];
    EXPECT_LT(norm(JointWorld<S>::wide_of(a.linear - b.linear)), tolerance<S>(1e-3, 2e-2));
    EXPECT_LT(norm(JointWorld<S>::wide_of(a.angular - b.angular)), tolerance<S>(1e-2, 0.2));
  }
}

// ---- chains, bridges, loops

template <class S> std::uint32_t build_chain(JointWorld<S>& world, int links, double weight, bool hanging) {
  std::uint32_t last = kNoBody;
  const double along = 0.0013, across = 0.016;  // [m^2] of a capsule of radius 0.05 and half height 0.2
  for (int i = 0; i <= links; ++i) {
    const double at = i < links ? 0.25 + 0.5 * i : 0.5 * links + 0.5;
    const bool ball = i == links;
    const D3 inertia = ball ? D3{0.1, 0.1, 0.1} : hanging ? D3{across, along, across} : D3{along, across, across};
    const std::uint32_t body = world.add_body(hanging ? D3{0, 30 - at, 0} : D3{at, 30, 0}, ball ? weight : 1, inertia);
    world.join(JointType::ball, last, body, hanging ? D3{0, 30 - 0.5 * i, 0} : D3{0.5 * i, 30, 0});
    last = body;
  }
  return last;
}

TYPED_TEST(JointChains, ChainOfFiftyLinksBearsAHundredTimesALinksMass) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t ball = build_chain(world, 50, 100, true);
  for (int frame = 0; frame < 300; ++frame) world.step();
  // Too heavy a tree for Q16.16, where springs of a quarter of the sub-step rate bear it: 50 F (2 h / pi)^2 / m.
  const double spring = 50 * 1250.0 / 0.5 / (60 * 60 * 4 * kPi * kPi);
  EXPECT_NEAR(world.centre(ball).y, 30 - 25.5, tolerance<S>(1e-3, 1.2 * spring));
}

TYPED_TEST(JointChains, SwingingChainStaysTogetherAndGainsNoEnergy) {
  using S = TypeParam;
  JointWorld<S> world;
  const bool narrow = std::is_same_v<S, Q16_16>;
  build_chain(world, 50, 100, false);
  const double start = world.energy();
  double worst = 0, highest = start;
  for (int frame = 0; frame < 600; ++frame) {
    world.step();
    worst = std::max(worst, world.worst_separation());
    highest = std::max(highest, world.energy());
  }
  EXPECT_LT(worst, tolerance<S>(0.01, 0.15));
  EXPECT_LT(highest - start, std::abs(start) * 1e-3);
  if (!narrow) {
    EXPECT_GT(world.energy() - start, -20 * 150);  // 20 of 250 J/kg
  }
}

TYPED_TEST(JointChains, ShortChainSwingsWithoutComingApart) {
  using S = TypeParam;
  JointWorld<S> world;
  build_chain(world, 12, 10, false);
  double worst = 0;
  for (int frame = 0; frame < 600; ++frame) {
    world.step();
    worst = std::max(worst, world.worst_separation());
  }
  EXPECT_LT(worst, tolerance<S>(0.02, 0.05));
}

TYPED_TEST(JointChains, BridgeHeldAtBothEndsSagsAndSettles) {
  using S = TypeParam;
  for (const JointType type : {JointType::ball, JointType::hinge}) {
    JointWorld<S> world;
    std::uint32_t last = kNoBody;
    const int planks = 16;  // 8 m of them over 7.6 m, at first as a V
    const double dx = 3.8 / 8, dy = std::sqrt(0.25 - dx * dx);
    const auto height = [&](double i) { return -dy * (8 - std::abs(i - 8)); };
    for (int i = 0; i < planks; ++i) {
      const std::uint32_t plank = world.add_box({dx * (i + 0.5), height(i + 0.5), 0}, 1, {0.25, 0.05, 0.5});
      world.join(type, last, plank, {dx * i, height(i), 0});
      last = plank;
    }
    world.join(type, last, kNoBody, {dx * planks, 0, 0});
    for (int frame = 0; frame < 900; ++frame) world.step();
    // A parabola of length L over a span s sags by about sqrt(3 s (L - s) / 8).
    EXPECT_NEAR(world.centre(planks / 2).y, -std::sqrt(3 * 7.6 * 0.4 / 8), 0.3);
    EXPECT_LT(world.worst_separation(), tolerance<S>(0.01, 0.03));
  }
}

TYPED_TEST(JointChains, RingOfBodiesHoldsThoughItsLastJointIsSolvedApart) {
  using S = TypeParam;
  JointWorld<S> world;
  const int count = 6;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    world.add_box({std::cos(angle), std::sin(angle), 0}, 1, {0.2, 0.2, 0.2});
  }
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * (i + 0.5) / count, r = std::cos(kPi / count);
    world.join(JointType::ball, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>((i + 1) % count),
               {r * std::cos(angle), r * std::sin(angle), 0});
  }
  world.join(JointType::ball, kNoBody, 1, {std::cos(kPi / 3), std::sin(kPi / 3) + 0.2, 0});
  for (int frame = 0; frame < 300; ++frame) {
    world.step();
    EXPECT_LT(world.worst_separation(), 0.02);
  }
}

TYPED_TEST(JointChains, BodyWithMoreJointsThanATreeTakesKeepsThemAll) {
  using S = TypeParam;
  JointWorld<S> world;
  const std::uint32_t hub = world.add_box({0, 0, 0}, 5, {0.3, 0.3, 0.3});
  world.join(JointType::ball, kNoBody, hub, {0, 0.3, 0});
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * kPi * i / 12;
    const std::uint32_t spoke = world.add_box({0.8 * std::cos(angle), 0, 0.8 * std::sin(angle)}, 0.5, {0.2, 0.2, 0.2});
    world.join(JointType::ball, hub, spoke, {0.4 * std::cos(angle), 0, 0.4 * std::sin(angle)});
  }
  for (int frame = 0; frame < 300; ++frame) {
    world.step();
    EXPECT_LT(world.worst_separation(), 0.02);
  }
}

}  // namespace joint_chains_test
}  // namespace isostep
