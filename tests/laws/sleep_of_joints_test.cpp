// Laws of sleep and joints: bodies that a joint still pulls together stay awake, for it closes without velocity.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <functional>

#include "built.hpp"
#include "laws/awake.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace sleep_of_joints_test {

template <class S> class SleepOfJoints : public ::testing::Test {
 protected:
  using Make = std::function<JointId(World<S>&, BodyId, BodyId)>;

  static Pose<S> at(D3 place) { return {vec<S>(place), Quat<Unit<S>>::identity()}; }

  /// Two boxes of half a metre, 4 m apart, on a joint that has to close.
  void closes(const Make& make, const char* name, const std::function<double(World<S>&, JointId)>& open) {
    for (const SolverName solver : kBuiltSolvers) {
      SCOPED_TRACE(named(solver, name));
      Settings<S> settings = awake<S>(solver, 0);
      settings.allow_sleep = true;
      World<S> w(settings);
      const ShapeId box = add_box(w, 0.25, 0.25, 0.25);
      const BodyId a = w.create(moving<S>(box, {0, 0, 0})), b = w.create(moving<S>(box, {4, 0, 0}));
      const JointId joint = make(w, a, b);
      ASSERT_TRUE(joint) << describe(w.fault());
      for (int i = 0; i < 900; ++i) w.step();
      EXPECT_LE(std::fabs(open(w, joint)), 0.03);
      EXPECT_FALSE(w.is_awake(a)) << "nothing moves it any more";
    }
  }
};
TYPED_TEST_SUITE(SleepOfJoints, AllScalars);

TYPED_TEST(SleepOfJoints, that_winches_ropes_rods_and_balls_close) {
  using S = TypeParam;
  const auto error = [](World<S>& w, JointId j) { return to_double(w.joint_error(j)); };
  this->closes(
      [&](auto& w, BodyId a, BodyId b) {
        const JointId j = w.create(rope<S>({.a = a, .b = b, .anchor_b = vec<S>(4, 0, 0), .length = S(4)}));
        w.set_limits(j, S(0), S(1));
        return j;
      },
      "a winch", error);
  this->closes(
      [&](auto& w, BodyId a, BodyId b) {
        return w.create(rod<S>({.a = a, .b = b, .anchor_b = vec<S>(4, 0, 0), .length = S(1)}));
      },
      "a rod", error);
  this->closes(
      [&](auto& w, BodyId a, BodyId b) {
        auto p = w.joint_at(JointType::ball, a, b, this->at({1, 0, 0}));
        p.frame_b.position = vec<S>(-1, 0, 0);
        return w.create(p);
      },
      "a ball joint", error);
}
TYPED_TEST(SleepOfJoints, that_sliders_and_hinges_bring_into_new_limits) {
  using S = TypeParam;
  this->closes(
      [&](auto& w, BodyId a, BodyId) {
        auto p = w.joint_at(JointType::slider, {}, a, this->at({0, 0, 0}));
        const JointId j = w.create(p);
        w.set_limits(j, S(3), S(5));
        return j;
      },
      "a slider", [](World<S>& w, JointId j) { return std::max(0.0, 3 - to_double(w.joint_position(j))); });
  this->closes(
      [&](auto& w, BodyId a, BodyId) {
        const JointId j = w.create(w.joint_at(JointType::hinge, {}, a, this->at({0, 0, 0})));
        w.set_limits(j, S(2), S(3));
        return j;
      },
      "a hinge", [](World<S>& w, JointId j) { return std::max(0.0, 2 - to_double(w.joint_position(j))); });
}

}  // namespace sleep_of_joints_test
}  // namespace isostep::test
