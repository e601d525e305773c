// Law: what is off has no say. Limits, motors and springs that a joint or one of its axes does not have may be set to
// anything, and every body moves as before, bit for bit.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <vector>

#include "random/joint_tree.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace idle_settings_test {

constexpr int kTrees = 60, kFrames = 240;
constexpr int kTreesOfDirect = 12;  // which takes ten times as long; the last ones

/// Other numbers where nothing reads them.
template <class S> AxisDrive<S> with_others_idle(AxisDrive<S> d, Dice& dice) {
  const bool sprung = S(0) < d.spring_frequency, yields = d.limited && S(0) < d.limit_frequency;
  if (!d.limited) {
    d.lower = num<S>(dice.in(-1.5, -0.1));
    d.upper = num<S>(dice.in(0.1, 1.5));
    d.limit_frequency = num<S>(dice.in(2, 20));
  }
  if (!yields) d.limit_damping = num<S>(dice.in(0, 2));
  if (!d.motor) d.motor_speed = num<S>(dice.in(-3, 3));
  if (!sprung) {
    d.spring_target = num<S>(dice.in(-0.5, 0.5));
    d.spring_damping = num<S>(dice.in(0, 1));
  }
  if (!sprung && !yields) d.spring_mass = num<S>(dice.in(1, 10));
  if (!sprung && !d.motor) d.max_force = num<S>(dice.in(1, 10));
  return d;
}
template <class S> JointProperties<S> with_others_idle(JointProperties<S> p, Dice& dice) {
  using namespace joint_flag;
  const bool sprung = (p.flags & kSpring) != 0, motor = (p.flags & kMotor) != 0;
  const bool bounded = (p.flags & kLimit) != 0 || (p.type == JointType::distance && !sprung);
  if (!bounded) {
    p.lower = num<S>(p.type == JointType::distance ? dice.in(0.1, 0.5) : dice.in(-1.5, -0.1));
    p.upper = num<S>(dice.in(0.6, 1.5));
  }
  if ((p.flags & kCone) == 0) p.cone = num<S>(dice.in(0.1, 1.5));
  if (!motor) {
    p.motor_speed = num<S>(dice.in(-3, 3));
    p.max_force = num<S>(dice.in(1, 10));
  }
  if (!sprung) {
    p.spring_target = num<S>(dice.in(-0.5, 0.5));
    p.spring_frequency = num<S>(dice.in(0.5, 6));
    p.spring_damping = num<S>(dice.in(0, 1));
  }
  return p;
}

/// Sets every joint and drive, to what it is or to others where idle; the number of those that changed.
template <class S> int set_all(RandomJointTree<S>& tree, bool others, Dice dice) {
  World<S>& w = tree.world;
  int changed = 0;
  for (const JointId id : tree.joints) {
    const JointProperties<S> now = *w.joint(id), next = with_others_idle(now, dice);
    EXPECT_TRUE(w.set_joint(id, others ? next : now)) << w.fault().field << " " << w.fault().expected;
    ++changed;
    for (std::uint32_t axis = 0; axis < kJointAxes; ++axis) {
      const AxisDriveId drive = w.axis_drive(id, static_cast<JointAxis>(axis));
      if (!drive) continue;
      const AxisDrive<S> as_is = *w.find(drive), other = with_others_idle(as_is, dice);
      EXPECT_TRUE(w.set(drive, others ? other : as_is)) << w.fault().field << " " << w.fault().expected;
      ++changed;
    }
  }
  return changed;
}
template <class S> bool moves_alike(const RandomJointTree<S>& a, const RandomJointTree<S>& b) {
  return std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), [&](BodyId x, BodyId y) {
    const BodyState<S>&p = *a.world.view(x).state, &q = *b.world.view(y).state;
    return p.centre == q.centre && p.orientation == q.orientation && p.velocity == q.velocity &&
           p.angular_velocity == q.angular_velocity;
  });
}

template <class S> class IdleSettings : public ::testing::Test {
 protected:
  static void have_no_say(SolverName solver, int all, int sample) {
    const int count = sampled(all, sample);
    int trees = 0;
    double moved = 0;
    for (int seed = kTrees - count; seed < kTrees; ++seed) {
      const auto number = static_cast<std::uint64_t>(seed);
      RandomJointTree<S> a(number, {solver, false}), b(number, {solver, false});
      if (!a.made()) continue;
      ++trees;
      ASSERT_LT(0, set_all(a, false, Dice(number)));
      set_all(b, true, Dice(number));
      const D3 start = real(a.world.center_of_mass(a.bodies.back()));
      for (int frame = 0; frame < kFrames; ++frame) {
        a.world.step();
        b.world.step();
        ASSERT_TRUE(moves_alike(a, b)) << "tree " << seed << ", frame " << frame;
      }
      moved = std::max(moved, length(real(a.world.center_of_mass(a.bodies.back())) - start));
    }
    EXPECT_LT(count / 2, trees);
    EXPECT_LT(0.5, moved);  // [m]
  }
};
TYPED_TEST_SUITE(IdleSettings, AllScalars);

TYPED_TEST(IdleSettings, have_no_say_in_soft_step) { this->have_no_say(SolverName::soft_step, kTrees, 6); }
TYPED_TEST(IdleSettings, have_no_say_in_pgs) { this->have_no_say(SolverName::pgs, kTrees, 6); }
TYPED_TEST(IdleSettings, have_no_say_in_direct) { this->have_no_say(SolverName::direct, kTreesOfDirect, 3); }

}  // namespace idle_settings_test
}  // namespace isostep::test
