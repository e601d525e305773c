// Trees of joints solved side by side: every width, order of batches and plan gives what one tree by itself gives.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "unit/dynamics/joint_world.hpp"

namespace isostep {
namespace joint_trees_test {

/// Whole thousandths in [-size, size].
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : random_(seed) {}
  double operator()(double size) { return size * (static_cast<double>(random_() % 2001) - 1000) / 1000; }
  D3 point(double size) {
    const double x = (*this)(size), y = (*this)(size), z = (*this)(size);
    return {x, y, z};
  }

 private:
  std::mt19937 random_;
};
D3 operator+(D3 a, D3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

template <class S>
std::uint32_t add_part(JointWorld<S>& world, Draw& draw, D3 at, double mass, D3 half = {0.25, 0.3, 0.2}) {
  const std::uint32_t body = world.add_box(at, mass, {half.x * (1 + draw(0.125)), half.y, half.z});
  world.states[body].velocity = JointWorld<S>::velocity(draw.point(1));
  world.states[body].angular_velocity = JointWorld<S>::velocity(draw.point(2));
  return body;
}
/// A trunk with arms of two: joints made inwards and outwards. `arms` up to 4.
template <class S> void add_creature(JointWorld<S>& world, Draw& draw, D3 at, int arms) {
  const std::uint32_t trunk = add_part(world, draw, at, 2 + draw(0.5));
  constexpr D3 kSides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < arms; ++i) {
    const D3 side = kSides[i], half = {side.x / 2, 0, side.z / 2};
    const std::uint32_t upper = add_part(world, draw, at + side, 1 + draw(0.5));
    const std::uint32_t lower = add_part(world, draw, at + side + side, 1 + draw(0.5));
    world.join(JointType::ball, i % 2 == 0 ? trunk : upper, i % 2 == 0 ? upper : trunk, at + half);
    world.join(JointType::ball, upper, lower, at + side + half);
  }
}
/// Links along x from `from` (kNoBody: the world), a weight at the end. Returns the weight. Small links at long arms
/// turn easily: under a weight of 20 their tension is taken implicitly.
template <class S>
std::uint32_t add_chain(JointWorld<S>& world, Draw& draw, std::uint32_t from, D3 at, int links, double weight,
                        double half = 0.25) {
  for (int i = 0; i < links; ++i) {
    const std::uint32_t link =
        add_part(world, draw, at + D3{i + 0.5, 0, 0}, i + 1 < links ? 1 : weight, {half, half, half});
    world.join(JointType::ball, from, link, at + D3{static_cast<double>(i), 0, 0});
    from = link;
  }
  return from;
}

/// Trees of five shapes that kernels solve, in numbers that leave lanes over, and everything that they do not solve.
template <class S> void build_forest(JointWorld<S>& world) {
  Draw draw(11);
  for (int i = 0; i < 21; ++i) add_creature(world, draw, {6.0 * (i % 5), 2, 6.0 * (i / 5)}, 4);
  for (int i = 0; i < 3; ++i) add_creature(world, draw, {6.0 * i, 8, 0}, 3);
  for (int i = 0; i < 5; ++i) add_chain(world, draw, kNoBody, {0, 12, 3.0 * i}, 5, 20, 0.04);
  add_chain(world, draw, kNoBody, {0, 16, 0}, 9, 15, 0.04);
  for (int i = 0; i < 2; ++i) {
    const std::uint32_t end = add_chain(world, draw, kNoBody, {0, 20, 3.0 * i}, 4, 1);
    world.join(JointType::ball, end, kNoBody, {4, 20, 3.0 * i});  // a bridge
  }
  const std::uint32_t rotor = world.add_body({0, 24, 0}, 0, {0, 0, 0});
  world.states[rotor].angular_velocity = JointWorld<S>::velocity({0, 2, 0});
  world.states[rotor].velocity = JointWorld<S>::velocity({0.5, 0, 0});
  for (int i = 0; i < 3; ++i) add_chain(world, draw, rotor, {0.5, 24, 3.0 * i}, 3, 5);
}
constexpr std::uint32_t kPlainTrees = 21 + 3 + 5 + 1 + 2 + 3;

template <class S> void add_others(JointWorld<S>& world) {
  Draw draw(12);
  const std::uint32_t tail = add_chain(world, draw, kNoBody, {0, 28, 0}, 4, 1);
  const auto first = static_cast<std::uint32_t>(world.states.size()) - 4;
  world.join(JointType::ball, tail, first, {2, 28, 0.5});  // a ring
  add_creature(world, draw, {0, 32, 0}, 4);
  world.joints.back().type = JointType::hinge;
  add_creature(world, draw, {8, 32, 0}, 4);
  world.joints.back().flags = joint_flag::kCone;
  world.joints.back().cone = S(0.5);
  const std::uint32_t hub = add_part(world, draw, {0, 36, 0}, 3);
  for (int i = 0; i < 25; ++i) {  // more than a tree may have at one body
    const std::uint32_t spoke = add_part(world, draw, {std::cos(i), 36, std::sin(i)}, 1);
    world.join(JointType::ball, hub, spoke, {std::cos(i) / 2, 36, std::sin(i) / 2});
  }
  add_creature(world, draw, {8, 36, 0}, 2);
  const auto one = static_cast<std::uint32_t>(world.states.size()) - 1;
  add_creature(world, draw, {16, 36, 0}, 2);
  const auto other = static_cast<std::uint32_t>(world.states.size()) - 1;
  JointProperties<S>& rope = world.join(JointType::distance, one, other, {11, 36, 0});  // two trees, tied
  rope.upper = S(8);
}

/// Trees of one shape whose joints have rows and drives, and with which of them every tree does something else: limits
/// that some are at, motors, springs, cones, sliders, ropes. `count` of them, which leaves lanes over.
template <class S> void add_driven(JointWorld<S>& world, int count) {
  Draw draw(13);
  for (int i = 0; i < count; ++i) {
    const D3 at = {8.0 * (i % 4), 44, 8.0 * (i / 4)};
    const std::uint32_t first = static_cast<std::uint32_t>(world.joints.size());
    add_creature(world, draw, at, 4);
    const auto end = static_cast<std::uint32_t>(world.states.size()) - 1;
    const auto joint = [&](std::uint32_t j, JointType type, std::uint32_t flags) -> JointProperties<S>& {
      JointProperties<S>& p = world.joints[first + j];
      p.type = type;
      p.flags = flags;
      p.lower = S(-0.25);
      p.upper = S(0.25);
      return p;
    };
    joint(0, JointType::ball, joint_flag::kLimit | joint_flag::kCone).cone = S(0.25);
    JointProperties<S>& wheel = joint(1, JointType::hinge, joint_flag::kLimit | joint_flag::kMotor);
    wheel.motor_speed = from_double<S>(draw(4));
    wheel.max_force = S(2);
    JointProperties<S>& lift = joint(2, JointType::slider, joint_flag::kLimit | joint_flag::kSpring);
    lift.spring_frequency = S(2);
    lift.spring_damping = S(0.5);
    joint(3, JointType::ball, joint_flag::kCone).cone = S(0.5);
    joint(4, JointType::hinge, joint_flag::kLimit);
    joint(5, JointType::fixed, 0);
    world.join(JointType::distance, end, kNoBody, at + D3{0, 3, -3}).upper = S(3.5);
  }
}

/// A net of boxes that hangs by its upper row. What closes its loops is solved in lanes, turn by turn: points, hinges
/// with a motor and a limit, and ropes, heavy ones below so that tension acts.
template <class S> void add_net(JointWorld<S>& world) {
  constexpr int kSide = 9;
  const auto first = static_cast<std::uint32_t>(world.states.size());
  for (int i = 0; i < kSide * kSide; ++i) {
    const double column = i % kSide, row = i / kSide;
    world.add_box({column, 80 - row, -40}, row + 1 < kSide ? 1 : 4, {0.2, 0.25, 0.1});
  }
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto here = first + static_cast<std::uint32_t>(i);
    const double column = i % kSide, row = i / kSide;
    world.join(JointType::ball, i < kSide ? kNoBody : here - kSide, here, {column, 80.5 - row, -40});
    if (i % kSide == 0) continue;
    JointProperties<S>& across =
        world.join(i % 3 == 0 ? JointType::hinge : JointType::ball, here - 1, here, {column - 0.5, 80 - row, -40});
    if (i % 3 != 0) continue;
    across.flags = joint_flag::kLimit | joint_flag::kMotor;
    across.lower = S(-0.25);
    across.upper = S(0.25);
    across.motor_speed = S(i % 2 == 0 ? 1 : -1);
    across.max_force = S(1);
  }
}

template <class S> using Numbers = std::vector<RawBits<S>>;
/// The bits of what moved and of what was pushed.
template <class S> Numbers<S> numbers_of(const JointWorld<S>& world) {
  Numbers<S> out;
  const auto add = [&](auto a) { out.push_back(to_bits(a)); };
  const auto add_vector = [&](auto v) {
    add(v.x);
    add(v.y);
    add(v.z);
  };
  for (const BodyState<S>& state : world.states) {
    add_vector(state.centre);
    add(state.orientation.w);
    add_vector(Vec3<Unit<S>>{state.orientation.x, state.orientation.y, state.orientation.z});
    add_vector(state.velocity);
    add_vector(state.angular_velocity);
  }
  for (const JointState<S>& joint : world.impulses) {
    add_vector(joint.point);
    add_vector(joint.angular);
  }
  return out;
}

struct Way {
  Simd simd = Simd::scalar;
  bool last_batch_first = false;
};
/// Every frame's numbers. In the middle joints go: trees fall apart into others.
template <class S> std::vector<Numbers<S>> play(const Way& way, bool others = true) {
  JointWorld<S> world;
  world.kernels = tree_kernels<S>(way.simd);
  world.last_batch_first = way.last_batch_first;
  build_forest(world);
  if (others) {
    add_others(world);
    add_driven(world, 21);
    add_net(world);
  }
  std::vector<Numbers<S>> frames;
  for (int frame = 0; frame < 24; ++frame) {
    if (frame == 12) {
      for (const std::size_t gone : {std::size_t{200}, std::size_t{90}, std::size_t{14}, std::size_t{3}}) {
        world.joints.erase(world.joints.begin() + static_cast<std::ptrdiff_t>(gone));
        world.impulses.erase(world.impulses.begin() + static_cast<std::ptrdiff_t>(gone));
      }
    }
    world.step();
    frames.push_back(numbers_of(world));
  }
  return frames;
}

template <class S> class JointTreesTest : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(JointTreesTest, Scalars);

TYPED_TEST(JointTreesTest, EveryWidthGivesTheBitsOfOneTreeByItself) {
  using S = TypeParam;
  const auto expected = play<S>({});
  for (const Simd simd : {Simd::best, Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm}) {
    if (tree_kernels<S>(simd) == nullptr) continue;
    const auto frames = play<S>({.simd = simd});
    for (std::size_t f = 0; f < frames.size(); ++f)
      ASSERT_EQ(frames[f], expected[f]) << tree_kernels<S>(simd)->name << " frame " << f;
  }
}

/// So that the widths have something to disagree about: drives of one tree of these are on other pieces than another's.
TYPED_TEST(JointTreesTest, DrivenTreesOfOneShapeAreOnDifferentPieces) {
  using S = TypeParam;
  JointWorld<S> world;
  add_driven(world, 21);
  bool differ = false;
  for (int frame = 0; frame < 24; ++frame) {
    world.step();
    const std::size_t joints = world.joints.size() / 21;
    for (std::size_t i = joints; i < world.joints.size(); ++i)
      differ = differ || world.impulses[i].pieces != world.impulses[i % joints].pieces;
  }
  EXPECT_TRUE(differ);
  if (tree_kernels<S>(Simd::best)->width > 1) {
    EXPECT_LT(world.trees.batch_count(), 21u);
  }
}

TYPED_TEST(JointTreesTest, BatchesMayComeInAnyOrder) {
  using S = TypeParam;
  EXPECT_EQ(play<S>({.simd = Simd::best, .last_batch_first = true}), play<S>({.simd = Simd::best}));
}

TYPED_TEST(JointTreesTest, WhatSharesNoBodyWithATreeChangesNothingOfIt) {
  using S = TypeParam;
  const auto whole = play<S>({.simd = Simd::best}), alone = play<S>({.simd = Simd::best}, false);
  JointWorld<S> forest;
  build_forest(forest);
  const std::size_t bodies = forest.states.size() * 13;
  for (std::size_t f = 0; f < alone.size(); ++f) {
    for (std::size_t i = 0; i < bodies; ++i) ASSERT_EQ(alone[f][i], whole[f][i]) << "frame " << f;
  }
}

TYPED_TEST(JointTreesTest, TreesOfOneShapeShareBatchesAndTheRestIsOne) {
  using S = TypeParam;
  JointWorld<S> world;
  world.kernels = tree_kernels<S>(Simd::scalar);
  build_forest(world);
  world.gather();
  EXPECT_EQ(world.trees.batch_count(), kPlainTrees);
  world.kernels = tree_kernels<S>(Simd::best);
  world.gather();
  const auto width = static_cast<std::uint32_t>(world.kernels->width);
  const auto blocks = [width](std::uint32_t trees) { return (trees + width - 1) / width; };
  EXPECT_EQ(world.trees.batch_count(), blocks(21) + blocks(3) + blocks(5) + 1 + blocks(2) + blocks(3));
  add_others(world);
  world.gather();
  // A hinge, a cone and a rope between two make shapes of their own; what loops and what is too many at a body, and all
  // that shares bodies with it, is one batch.
  EXPECT_EQ(world.trees.batch_count(), blocks(21) + blocks(3) + blocks(5) + 1 + blocks(2) + blocks(3) + 3 + 1);
  world.joints.clear();
  world.gather();
  EXPECT_EQ(world.trees.batch_count(), 0u);
}

/// [rad] The turn of a body's `axis` in a step that begins with its joint free of its limit and the body flying past
/// the joint: in the first sub-step it turns by 0.65 rad, unless the limit stops it. Axes of cones begin 0.25 rad
/// apart: aligned ones have no row.
template <class S> double turned_in_a_step(Simd simd, JointType type, std::uint32_t flags, D3 velocity, int axis) {
  JointWorld<S> world;
  world.kernels = tree_kernels<S>(simd);
  world.gravity = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {  // side by side; the last flies
    const D3 at = {0, 4.0 * i, 0};
    const std::uint32_t body = world.add_box(at + D3{0.5, 0, 0}, 1, {0.1, 0.1, 0.1});
    if (i == 2) world.states[body].velocity = JointWorld<S>::velocity(velocity);
    JointProperties<S>& p = world.join(type, kNoBody, body, at);
    p.flags = flags;
    p.lower = S(-0.5);
    p.upper = S(0.5);
    p.cone = S(0.5);
    if (flags == joint_flag::kCone) p.frame_b.orientation = rotation<S>({Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(-0.25));
  }
  const D3 before = world.axis(2, axis);
  world.step();
  const D3 now = world.axis(2, axis);
  EXPECT_LT(norm(world.axis(1, axis) - before), 1e-3) << "neighbours stay";
  return std::acos(before.x * now.x + before.y * now.y + before.z * now.z);
}

/// What is out of reach as a sub-step begins, and by no more than its speeds then tell, is judged by those that it ends
/// with.
TYPED_TEST(JointTreesTest, LimitsStopWhatIsTurnedTowardsThemWithinASubstep) {
  using S = TypeParam;
  for (const Simd simd : {Simd::scalar, Simd::best}) {
    const auto turned = [simd](JointType type, std::uint32_t flags, D3 velocity, int axis) {
      return turned_in_a_step<S>(simd, type, flags, velocity, axis);
    };
    EXPECT_NEAR(turned(JointType::hinge, joint_flag::kLimit, {0, 80, 0}, 0), 0.5, 0.02);
    EXPECT_NEAR(turned(JointType::hinge, joint_flag::kLimit, {0, -80, 0}, 0), 0.5, 0.02);
    EXPECT_NEAR(turned(JointType::ball, joint_flag::kLimit, {0, 80, 0}, 0), 0.5, 0.02);
    EXPECT_NEAR(turned(JointType::ball, joint_flag::kCone, {0, 0, 80}, 2), 0.25, 0.02);
    EXPECT_GT(turned(JointType::ball, 0, {0, 80, 0}, 0), 1.5);
  }
}

}  // namespace joint_trees_test
}  // namespace isostep
