// Laws of add_ragdoll: figures hold together as they fall, rest, hold a pose, and are not pushed by their own overlaps.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "isostep/effects/ragdoll.hpp"
#include "random/dice.hpp"
#include "random/joint_angles.hpp"

namespace isostep::test {
namespace ragdoll_builder_test {

struct Part {
  int parent;
  double x, y;    // [m] of the middle
  double rx, hy;  // [m] a capsule's radius and half height; hy 0: a ball
  bool sideways;  // along x
  double mass;    // [kg]
  double jx, jy;  // [m] of the joint to the parent
  D3 axis;        // [1] z of the joint
  bool hinge;
  double swing_x, swing_y, lower, upper;  // [rad]
};
/// S20's figure, of capsules and balls; its shoulders and hips swing in ellipses.
const Part kParts[] = {{-1, 0, 0, 0.12, 0.08, true, 1.0, 0, 0, {0, 1, 0}, false, 0, 0, 0, 0},
                       {0, 0, 0.34, 0.15, 0.12, false, 2.0, 0, 0.11, {0, 1, 0}, false, 0.5, 0.5, -0.4, 0.4},
                       {1, 0, 0.70, 0.12, 0, false, 0.5, 0, 0.57, {0, 1, 0}, false, 0.6, 0.6, -0.7, 0.7},
                       {1, 0.35, 0.48, 0.05, 0.10, true, 0.2, 0.19, 0.48, {1, 0, 0}, false, 1.3, 0.9, -0.6, 0.6},
                       {1, -0.35, 0.48, 0.05, 0.10, true, 0.2, -0.19, 0.48, {-1, 0, 0}, false, 1.3, 0.9, -0.6, 0.6},
                       {3, 0.655, 0.48, 0.045, 0.10, true, 0.15, 0.505, 0.48, {0, 1, 0}, true, 0, 0, -2.4, 0},
                       {4, -0.655, 0.48, 0.045, 0.10, true, 0.15, -0.505, 0.48, {0, 1, 0}, true, 0, 0, 0, 2.4},
                       {0, 0.09, -0.32, 0.07, 0.13, false, 0.7, 0.09, -0.11, {0, -1, 0}, false, 0.9, 0.5, -0.5, 0.5},
                       {0, -0.09, -0.32, 0.07, 0.13, false, 0.7, -0.09, -0.11, {0, -1, 0}, false, 0.9, 0.5, -0.5, 0.5},
                       {7, 0.09, -0.74, 0.06, 0.14, false, 0.4, 0.09, -0.53, {1, 0, 0}, true, 0, 0, 0, 2.4},
                       {8, -0.09, -0.74, 0.06, 0.14, false, 0.4, -0.09, -0.53, {1, 0, 0}, true, 0, 0, 0, 2.4}};

/// A turn that lays z onto an axis of the world.
template <class S> Quat<Unit<S>> onto(D3 axis) {
  if (axis.x != 0) return turn<S>({0, 1, 0}, axis.x * kPi / 2);
  return turn<S>({1, 0, 0}, -axis.y * kPi / 2);
}

template <class S> class Ragdolls : public ::testing::Test {
 protected:
  static std::vector<RagdollBone<S>> skeleton(World<S>& w, D3 origin, Quat<Unit<S>> turned) {
    std::vector<RagdollBone<S>> bones;
    const Mat3<Unit<S>> axes = to_matrix(turned);
    const auto place = [&](double x, double y) { return vec<S>(origin) + axes * vec<S>(D3{x, y, 0}); };
    for (const Part& p : kParts) {
      RagdollBone<S> bone;
      bone.parent = p.parent;
      bone.shape = p.hy == 0 ? add_ball(w, p.rx) : w.add_shape(Capsule<S>{num<S>(p.rx), num<S>(p.hy)});
      bone.pose = {place(p.x, p.y), p.sideways ? normalise(turned * turn<S>({0, 0, 1}, -kPi / 2)) : turned};
      bone.mass = num<S>(p.mass);
      bone.joint = {place(p.jx, p.jy), normalise(turned * onto<S>(p.axis))};
      bone.hinge = p.hinge;
      bone.swing_x = num<S>(p.swing_x);
      bone.swing_y = num<S>(p.swing_y);
      bone.lower = num<S>(p.lower);
      bone.upper = num<S>(p.upper);
      bones.push_back(bone);
    }
    return bones;
  }
  static double worst_error(const World<S>& w, const Ragdoll<S>& figure) {
    double worst = 0;
    for (const JointId joint : figure.joints) {
      if (joint) worst = std::max(worst, to_double(w.joint_error(joint)));
    }
    return worst;
  }
  static Settings<S> with(SolverName solver, double gravity = -10) {
    Settings<S> s = settings<S>(gravity, 60, 8);
    s.solver = solver;
    return s;
  }
};
/// Not Q16.16: forearms of 0.15 kg on a figure of 7 kg are beyond its ratios.
using WideScalars = ::testing::Types<float, double, Q32_32>;
TYPED_TEST_SUITE(Ragdolls, WideScalars);

TYPED_TEST(Ragdolls, hold_together_whatever_side_they_fall_on) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step));
  add_ground(w);
  std::vector<Ragdoll<S>> all;
  Dice dice(26);
  for (int i = 0; i < 10; ++i) {
    RagdollSettings<S> limp;
    if (i % 2 == 0) limp.friction = num<S>(0.1);
    all.push_back(add_ragdoll<S>(w, this->skeleton(w, {4.0 * i, 2.5, 0}, dice.template orientation<S>()), limp));
    ASSERT_EQ(all.back().bodies.size(), std::size(kParts)) << describe(w.first_fault());
  }
  double worst = 0, fastest = 0;
  for (int frame = 0; frame < 300; ++frame) {
    ASSERT_TRUE(w.step().clean()) << frame;
    for (const Ragdoll<S>& figure : all) {
      worst = std::max(worst, this->worst_error(w, figure));
      for (const BodyId b : figure.bodies) fastest = std::max(fastest, length(real(w.velocity(b))));
    }
  }
  double end = 0;
  for (const Ragdoll<S>& figure : all) end = std::max(end, this->worst_error(w, figure));
  EXPECT_LT(worst, 0.05);
  EXPECT_LT(end, 0.005);
  EXPECT_LT(fastest, 12);  // a fall of 3 m, and limbs that whip
}

TYPED_TEST(Ragdolls, with_friction_in_their_joints_fall_asleep) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step));
  add_ground(w);
  RagdollSettings<S> limp;
  limp.friction = num<S>(0.1);
  std::vector<BodyId> all;
  for (int i = 0; i < 4; ++i) {
    const Ragdoll<S> figure =
        add_ragdoll<S>(w, this->skeleton(w, {4.0 * i, 1.5, 0}, turn<S>({1, 0, 0}, 0.1 + i)), limp);
    all.insert(all.end(), figure.bodies.begin(), figure.bodies.end());
  }
  int asleep_at = -1;
  for (int frame = 0; frame < 480 && asleep_at < 0; ++frame) {
    w.step();
    if (std::none_of(all.begin(), all.end(), [&](BodyId b) { return w.is_awake(b); })) asleep_at = frame;
  }
  EXPECT_GT(asleep_at, 30);
}

TYPED_TEST(Ragdolls, with_servos_hold_their_pose_from_a_fixed_pelvis) {
  using S = TypeParam;
  for (const SolverName solver : {SolverName::soft_step, SolverName::direct}) {
    World<S> w(this->with(solver));
    RagdollSettings<S> posed;
    posed.pose = {.frequency = S(5), .damping = S(1), .max_force = S(30)};
    const std::vector<RagdollBone<S>> bones = this->skeleton(w, {0, 2, 0}, Quat<Unit<S>>::identity());
    const Ragdoll<S> figure = add_ragdoll<S>(w, bones, posed);
    ASSERT_EQ(figure.bodies.size(), bones.size()) << describe(w.first_fault());
    ASSERT_TRUE(w.create(fixed<S>({.b = figure.bodies[0], .frame = bones[0].pose})));
    for (int i = 0; i < 300; ++i) ASSERT_TRUE(w.step().clean());
    for (std::size_t i = 0; i < bones.size(); ++i) {
      const Quat<double> now = joint_angles_detail::wide(w.pose(figure.bodies[i]).orientation),
                         then = joint_angles_detail::wide(bones[i].pose.orientation);
      const Quat<double> off = conjugate(then) * now;
      // Every bone bears what hangs on it: its servo gives by that, and so do those before it.
      EXPECT_LT(2 * std::hypot(off.x, off.y, off.z), 0.15) << kSolverNames[static_cast<int>(solver)] << i;
      EXPECT_LT(length(real(w.angular_velocity(figure.bodies[i]))), 0.01) << i;
      if (!figure.joints[i]) continue;
      const JointAngles joint = angles_of(w, *w.joint(figure.joints[i]));
      EXPECT_LT(std::max(std::fabs(joint.twist), joint.swing), 0.05) << i;
    }
  }
}

TYPED_TEST(Ragdolls, leave_no_part_where_one_is_refused) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step));
  std::vector<RagdollBone<S>> bones = this->skeleton(w, {0, 2, 0}, Quat<Unit<S>>::identity());
  bones[6].lower = S(5);
  EXPECT_TRUE(add_ragdoll<S>(w, bones).bodies.empty());
  EXPECT_EQ(w.bodies().size(), 0u);
  EXPECT_STREQ(w.first_fault().field, "lower") << describe(w.first_fault());
}

TYPED_TEST(Ragdolls, say_by_name_what_makes_no_figure_and_leave_the_world_as_it_was) {
  using S = TypeParam;
  World<S> w(this->with(SolverName::soft_step));
  const std::vector<RagdollBone<S>> bones = this->skeleton(w, {0, 2, 0}, Quat<Unit<S>>::identity());
  const std::uint64_t before = w.hash();
  const auto refused = [&](const char* field, auto&& change, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    std::vector<RagdollBone<S>> parts = bones;
    RagdollSettings<S> how;
    change(parts, how);
    const Ragdoll<S> figure = add_ragdoll<S>(w, parts, how);
    EXPECT_TRUE(figure.bodies.empty() && figure.joints.empty());
    EXPECT_EQ(w.hash(), before);
    EXPECT_EQ(w.fault(), Fault::bad_argument);
    EXPECT_STREQ(w.fault().command, "add_ragdoll");
    EXPECT_STREQ(w.fault().field, field);
  };
  refused("parent", [](auto& parts, auto&) { parts[0].parent = 0; });
  refused("parent", [](auto& parts, auto&) { parts[3].parent = 4; });
  refused("parent", [](auto& parts, auto&) { parts[3].parent = 100; });
  refused("parent", [](auto& parts, auto&) { parts[3].parent = -2; });
  refused("friction", [](auto&, auto& how) { how.friction = S(-1); });
  refused("friction", [](auto&, auto& how) {
    how.friction = num<S>(0.1);
    how.pose.max_force = S(30);
  });
  refused("pose.max_force", [](auto&, auto& how) { how.pose.max_force = S(-1); });
  refused("pose.target", [](auto&, auto& how) {
    how.pose.max_force = S(30);
    how.pose.target = num<S>(0.25);
  });
  refused("pose.mass", [](auto&, auto& how) { how.pose.mass = S(1); });
  refused("pose.frequency", [](auto&, auto& how) {
    how.pose.max_force = S(30);
    how.pose.frequency = S(0);
  });
  EXPECT_EQ(add_ragdoll<S>(w, bones).bodies.size(), bones.size());
}

}  // namespace ragdoll_builder_test
}  // namespace isostep::test
