// Poses for drawing, as a world gives them.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace drawn_poses_test {

template <class S> class DrawnPoses : public ::testing::Test {};
TYPED_TEST_SUITE(DrawnPoses, AllScalars);

TYPED_TEST(DrawnPoses, render_poses_lie_between_the_last_two_steps) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d =
      moving<S>(add_two_boxes(w, {0.5, 0.5, 0.5}, {0, 0, 0}, {0.5, 0.5, 0.5}, {3, 0, 0}), {1, 2, 3}, {6, 0, 0});
  d.angular_velocity = vec<S>(0, 3, 0);
  const BodyId id = w.create(d);
  w.create(still<S>(add_ball(w, 1), {20, 0, 0}));
  ASSERT_EQ(w.poses_float(0).size(), 1u);
  EXPECT_FLOAT_EQ(w.poses_float(0)[0].position[0], 1);
  w.step();
  const Pose<S> first = w.pose(id);
  w.step();
  const Pose<S> second = w.pose(id);
  const auto expect_at = [&](float alpha, D3 at) {
    const RenderPose pose = w.poses_float(alpha)[0];
    EXPECT_EQ(pose.body, id);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(pose.position[i], at[i], 2e-4);
    double norm = 0;
    for (const float q : pose.orientation) norm += static_cast<double>(q) * q;
    EXPECT_NEAR(norm, 1, 1e-6);
  };
  expect_at(0, real(first.position));
  expect_at(1, real(second.position));
  expect_at(0.5f, (real(first.position) + real(second.position)) * 0.5);
}

TYPED_TEST(DrawnPoses, a_body_new_since_the_last_step_is_drawn_where_it_is) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId old = w.create(moving<S>(ball, {0, 0, 0}, {6, 0, 0}));
  const BodyId gone = w.create(moving<S>(ball, {100, 0, 0}, {6, 0, 0}));
  w.step();
  w.step();
  ASSERT_TRUE(w.destroy(gone));
  const BodyId fresh = w.create(moving<S>(ball, {-100, 0, 0}));
  const std::vector<RenderPose> poses = w.poses_float(0.5f);
  ASSERT_EQ(poses.size(), 2u);
  for (const RenderPose& pose : poses) {
    EXPECT_TRUE(pose.body == fresh || pose.body == old);
    EXPECT_NEAR(pose.position[0], pose.body == fresh ? -100 : 0.15, 1e-3);
  }
}

TYPED_TEST(DrawnPoses, a_teleported_body_is_not_drawn_on_the_way) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  w.step();
  ASSERT_TRUE(w.set_pose(id, {vec<S>(100, 0, 0), Quat<Unit<S>>::identity()}));
  EXPECT_FLOAT_EQ(w.poses_float(0.5f)[0].position[0], 100);
}

}  // namespace drawn_poses_test
}  // namespace isostep::test
