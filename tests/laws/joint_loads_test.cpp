// Laws of measured joints: what they report, when they break, whatever the sub-steps and the solver.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "laws/awake.hpp"
#include "random/joint_angles.hpp"

namespace isostep::test {
namespace joint_loads_test {

template <class S> class JointLoads : public ::testing::Test {
 protected:
  static JointId hang(World<S>& w, JointType type, BodyId from, D3 anchor, D3 at, double mass) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.125), at);
    d.mass = num<S>(mass);
    const BodyId body = w.create(d);
    return w.create(w.joint_at(type, from, body, {vec<S>(anchor), Quat<Unit<S>>::identity()}));
  }
  static JointLoad<S> limit(JointId joint, double force, double torque = 0) {
    JointLoad<S> load;
    load.joint = joint;
    load.break_force = num<S>(force);
    load.break_torque = num<S>(torque);
    return load;
  }
  static BodyId body_of(const World<S>& w, JointId joint) {
    return {w.joint(joint)->body_b, w.joint(joint)->generation_b};
  }
};
TYPED_TEST_SUITE(JointLoads, AllScalars);

TYPED_TEST(JointLoads, a_weight_pulls_with_its_weight_and_a_beam_turns_with_its_lever) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (const JointType type : {JointType::ball, JointType::fixed, JointType::hinge, JointType::slider}) {
      World<S> w(awake<S>(solver));
      const bool beam = type == JointType::fixed || type == JointType::slider;
      // A slider's axis is level; a beam's ball is half a metre to the side.
      const JointId joint = this->hang(w, type, {}, {0, 4, 0}, {beam ? 0.5 : 0, beam ? 4.0 : 3.5, 0}, 2);
      const JointLoadId load = w.add(this->limit(joint, 0));
      ASSERT_TRUE(load);
      run(w, 120);
      const std::string what =
          std::string(kSolverNames[static_cast<int>(solver)]) + ", " + kJointNames[static_cast<int>(type)];
      EXPECT_NEAR(to_double(w.state(load)->force), 20, 0.1) << what;
      EXPECT_NEAR(to_double(w.state(load)->torque), beam ? 10 : 0, 0.1) << what;
    }
  }
}

TYPED_TEST(JointLoads, joints_that_lanes_solve_are_measured_like_others) {
  using S = TypeParam;
  World<S> w(awake<S>(SolverName::soft_step));
  std::vector<JointLoadId> loads;
  for (int column = 0; column < 9; ++column) {
    BodyId above;
    for (int link = 0; link < 4; ++link) {
      const double x = column * 2.0, y = 8 - link * 0.5;
      const JointId joint = this->hang(w, JointType::ball, above, {x, y, 0}, {x, y - 0.5, 0}, 1);
      above = this->body_of(w, joint);
      loads.push_back(w.add(this->limit(joint, 0)));
    }
  }
  run(w, 60);
  for (std::size_t i = 0; i < loads.size(); ++i)
    EXPECT_NEAR(to_double(w.state(loads[i])->force), 10.0 * static_cast<double>(4 - i % 4), 0.1) << i;
}

/// A chain of twenty links of a kilogram under a top that bears 1.2 of them, and what happens to it.
template <class S> struct Chain {
  World<S> w;
  std::vector<JointId> joints;

  Chain(SolverName solver, int substeps) : w(awake<S>(solver, -10, substeps)) {
    BodyId above;
    for (int link = 0; link < 20; ++link) {
      const double y = 20 - link * 0.5;
      BodyDefinition<S> d = moving<S>(add_ball(w, 0.125), {0, y - 0.25, 0});
      d.mass = S(1);
      const BodyId body = w.create(d);
      joints.push_back(
          w.create(w.joint_at(JointType::ball, above, body, {vec<S>(0, y, 0), Quat<Unit<S>>::identity()})));
      above = body;
      JointLoad<S> load;
      load.joint = joints.back();
      load.break_force = S(240);
      w.add(load);
    }
  }
  BodyId last() { return {w.joint(joints.back())->body_b, w.joint(joints.back())->generation_b}; }
  /// The first frame in which a joint breaks, and that must be the top one.
  int pull(double force, int most) {
    for (int frame = 0; frame < most; ++frame) {
      w.apply_force(last(), vec<S>(0, -force * (frame + 1) / 60, 0));
      w.step();
      if (w.events().joint_broke.empty()) continue;
      EXPECT_EQ(w.events().joint_broke[0].joint, joints[0]);
      return frame;
    }
    return most;
  }
};

TYPED_TEST(JointLoads, a_chain_holds_under_what_it_bears_and_breaks_at_its_top_under_more) {
  using S = TypeParam;
  int frames[3] = {}, n = 0;
  for (const int substeps : {4, 8, 16}) {
    Chain<S> chain(SolverName::soft_step, substeps);
    for (int i = 0; i < 600; ++i) {
      chain.w.step();
      ASSERT_TRUE(chain.w.events().joint_broke.empty()) << i;
    }
    frames[n++] = chain.pull(60, 120);  // 60 N more in a second: the top bears 40
    EXPECT_FALSE(chain.w.contains(chain.joints[0]));
    EXPECT_TRUE(chain.w.contains(chain.joints[1]));
    EXPECT_EQ(chain.w.state().records->joint_loads.slot_map().count_taken(), 19u);
  }
  EXPECT_NEAR(frames[0], 40, 2);
  EXPECT_NEAR(frames[1], frames[0], 2);
  EXPECT_NEAR(frames[2], frames[0], 2);
}

TYPED_TEST(JointLoads, a_torque_breaks_a_weld_that_bears_the_force) {
  using S = TypeParam;
  World<S> w(awake<S>(SolverName::soft_step));
  const JointId beam = this->hang(w, JointType::fixed, {}, {0, 4, 0}, {0.5, 4, 0}, 2);
  w.add(this->limit(beam, 1000, 12));
  run(w, 60);
  ASSERT_TRUE(w.contains(beam));
  const BodyId body = this->body_of(w, beam);
  w.apply_force(body, Vec3<S>::zero(), vec<S>(0, 0, -3));
  w.step();
  ASSERT_EQ(w.events().joint_broke.size(), 1u);
  const JointBroke<S> broke = w.events().joint_broke[0];
  EXPECT_EQ(broke.b, body);
  EXPECT_FALSE(broke.a);
  EXPECT_NEAR(to_double(broke.torque), 13, 0.2);
  EXPECT_FALSE(w.contains(beam));
  w.step();
  EXPECT_TRUE(w.events().joint_broke.empty());
  EXPECT_LT(to_double(w.velocity(body).y), -0.1);
}

TYPED_TEST(JointLoads, what_breaks_is_rolled_back) {
  using S = TypeParam;
  Chain<S> chain(SolverName::soft_step, 8);
  run(chain.w, 30);
  typename World<S>::Snapshot snapshot;
  chain.w.save(snapshot);
  std::vector<std::uint64_t> hashes;
  const auto play = [&] {
    hashes.clear();
    for (int frame = 0; frame < 40; ++frame) {
      chain.w.apply_force(chain.last(), vec<S>(0, -5.0 * frame, 0));
      chain.w.step();
      hashes.push_back(chain.w.hash());
    }
  };
  play();
  ASSERT_FALSE(chain.w.contains(chain.joints[0]));
  const std::vector<std::uint64_t> first = hashes;
  chain.w.load(snapshot);
  ASSERT_TRUE(chain.w.contains(chain.joints[0]));
  play();
  EXPECT_EQ(hashes, first);
}

TYPED_TEST(JointLoads, refuse_a_second_for_a_joint_and_what_is_no_strength) {
  using S = TypeParam;
  World<S> w(awake<S>(SolverName::soft_step));
  const JointId joint = this->hang(w, JointType::ball, {}, {0, 4, 0}, {0, 3.5, 0}, 2);
  ASSERT_TRUE(w.add(this->limit(joint, 10)));
  const std::uint64_t before = w.hash();
  EXPECT_FALSE(w.add(this->limit(joint, 20)));
  EXPECT_STREQ(w.fault().field, "joint");
  EXPECT_FALSE(w.add(this->limit({7, 1}, 20)));
  EXPECT_STREQ(w.fault().field, "joint");
  EXPECT_FALSE(w.add(this->limit(joint, -1)));
  EXPECT_STREQ(w.fault().field, "break_force");
  EXPECT_FALSE(w.add(this->limit(joint, 1, -1)));
  EXPECT_STREQ(w.fault().field, "break_torque");
  EXPECT_EQ(w.hash(), before);
}

}  // namespace joint_loads_test
}  // namespace isostep::test
