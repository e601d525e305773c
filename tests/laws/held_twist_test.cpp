// Laws of twists beside a free swing that are limited, locked or sprung: they are held wherever the body is thrown, for
// its swing ends before a twist means nothing, and nothing gains energy by it.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "random/joint_angles.hpp"

namespace isostep::test {
namespace held_twist_test {

constexpr double kTwistRange = 0.5;  // [rad] to either side, where it is not locked

enum class HeldTwist { ball, constant_velocity, locked, limited, one_swing, soft };
constexpr HeldTwist kAll[] = {HeldTwist::ball,    HeldTwist::constant_velocity, HeldTwist::locked,
                              HeldTwist::limited, HeldTwist::one_swing,         HeldTwist::soft};

template <class S> class HeldTwists : public ::testing::Test {
 protected:
  /// A box half a metre out along the joint's z axis, thrown past the place where that points backwards.
  struct Thrown {
    World<S> world;
    BodyId body = {};
    JointId joint = {};
  };
  static Thrown throw_on(HeldTwist kind, SolverName solver, double aside) {
    Settings<S> s = settings<S>(0, 60, 8);
    s.solver = solver;
    s.allow_sleep = false;
    Thrown made{World<S>(s)};
    BodyDefinition<S> d = moving<S>(add_box(made.world, 0.25, 0.125, 0.25), {0, 0, 0.5});
    d.collide = false;
    d.angular_velocity = vec<S>(4, aside, 0);
    d.velocity = vec<S>(aside * 0.5, -2, 0);
    made.body = made.world.create(d);
    made.joint = join(made.world, kind, made.body);
    EXPECT_TRUE(made.joint) << describe(made.world.fault());
    return made;
  }
  static JointId join(World<S>& w, HeldTwist kind, BodyId body) {
    const bool is_ball = kind == HeldTwist::ball;
    if (is_ball || kind == HeldTwist::constant_velocity) {
      const JointType type = is_ball ? JointType::ball : JointType::constant_velocity;
      JointProperties<S> p = w.joint_at(type, {}, body, Pose<S>::identity());
      if (is_ball) p.flags = joint_flag::kLimit;
      p.lower = num<S>(-kTwistRange);
      p.upper = num<S>(kTwistRange);
      return w.create(p);
    }
    SixAxisDefinition<S> joint;
    joint.b = body;
    joint.locks = joint_flag::kLockPoint;
    if (kind == HeldTwist::locked) joint.locks |= joint_flag::kLockTwist;
    if (kind == HeldTwist::one_swing) joint.locks |= joint_flag::kLockSwingY;
    if (kind == HeldTwist::locked) return w.create(six_axis(joint));
    AxisDrive<S> twist;
    twist.axis = JointAxis::twist;
    twist.limited = true;
    twist.lower = num<S>(-kTwistRange);
    twist.upper = num<S>(kTwistRange);
    if (kind == HeldTwist::soft) twist.limit_frequency = S(8);
    joint.drives[joint.drive_count++] = twist;
    return w.create(six_axis(joint));
  }
};
TYPED_TEST_SUITE(HeldTwists, AllScalars);

TYPED_TEST(HeldTwists, end_the_swing_and_gain_nothing) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::worst_first})) {
    for (const HeldTwist kind : kAll) {
      const double range = kind == HeldTwist::constant_velocity || kind == HeldTwist::locked ? 0 : kTwistRange;
      for (const double aside : {0.0, 0.25, 1.0}) {
        if (kind == HeldTwist::one_swing && aside != 0) continue;
        auto thrown = this->throw_on(kind, solver, aside);
        const World<S>& w = thrown.world;
        const double start = kinetic_energy(w.view(thrown.body));
        double swing = 0, twist = 0, most = 0;
        for (int frame = 0; frame < 300; ++frame) {
          ASSERT_TRUE(thrown.world.step().clean());
          const JointAngles now = angles_of(w, *w.joint(thrown.joint));
          swing = std::max(swing, now.swing);
          twist = std::max(twist, std::fabs(now.twist) - range);
          most = std::max(most, kinetic_energy(w.view(thrown.body)));
        }
        const std::string what = std::string(kSolverNames[static_cast<int>(solver)]) + ", kind " +
                                 std::to_string(static_cast<int>(kind)) + ", " + std::to_string(aside);
        EXPECT_GT(swing, 2.4) << what;  // else nothing was tried
        EXPECT_LT(swing, 2.65) << what;
        if (kind != HeldTwist::soft) {
          EXPECT_LT(twist, 0.05) << what;
        }
        EXPECT_LT(most, 1.02 * start) << what;
      }
    }
  }
}

}  // namespace held_twist_test
}  // namespace isostep::test
