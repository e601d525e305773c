// RenderPoses alone: where bodies are drawn between two steps.
// SPDX-License-Identifier: MIT

#include "isostep/systems/motion/render_poses.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace render_poses_test {

template <class S> class RenderPosesOf : public ::testing::Test {
 protected:
  RenderPosesOf() : systems(made()) {}
  World<S>& made() {
    ball = world.create(moving<S>(add_ball(world, 0.5), {1, 0, 0}));
    return world;
  }
  void move_to(double x) { systems.awake(ball).centre = vec<S>(x, 0, 0); }
  float drawn_at(float alpha) {
    const std::vector<RenderPose>& drawn = poses.fill(alpha);
    EXPECT_EQ(drawn.size(), 1u);
    EXPECT_EQ(drawn[0].body, ball);
    EXPECT_EQ(drawn[0].orientation[3], 1.0f);
    return drawn[0].position[0];
  }

  World<S> world{settings<S>(0)};
  BodyId ball;
  Systems<S> systems;
  RenderPoses<S> poses{systems.state};
};
TYPED_TEST_SUITE(RenderPosesOf, SystemScalars);

TYPED_TEST(RenderPosesOf, a_body_is_drawn_between_its_start_and_its_end_of_a_step) {
  EXPECT_EQ(this->drawn_at(0.0f), 1.0f) << "no step was made yet";
  this->poses.keep_start();
  this->move_to(3);
  EXPECT_EQ(this->drawn_at(0.0f), 1.0f);
  EXPECT_EQ(this->drawn_at(0.5f), 2.0f);
  EXPECT_EQ(this->drawn_at(1.0f), 3.0f);
  ASSERT_EQ(this->poses.start().size(), 1u);
  EXPECT_EQ(to_double(this->poses.start()[0].position.x), 1);
}

TYPED_TEST(RenderPosesOf, what_a_command_moves_is_drawn_there) {
  this->poses.keep_start();
  this->move_to(3);
  this->poses.start_here(this->systems.awake(this->ball));
  EXPECT_EQ(this->drawn_at(0.0f), 3.0f);
}

TYPED_TEST(RenderPosesOf, after_a_load_bodies_are_drawn_where_they_are) {
  this->poses.keep_start();
  this->move_to(3);
  this->poses.forget();
  EXPECT_EQ(this->drawn_at(0.0f), 3.0f);
}

}  // namespace render_poses_test
}  // namespace isostep::test
