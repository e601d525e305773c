// BodyFinisher alone: what is beyond the scalar's range is cut, and counted.
// SPDX-License-Identifier: MIT

#include "isostep/systems/motion/body_finisher.hpp"

#include <limits>

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace body_finisher_test {

template <class S> class BodyFinishers : public ::testing::Test {
 protected:
  BodyFinishers() : systems(made()) {}
  World<S>& made() {
    ball = world.create(moving<S>(add_ball(world, 0.5), {1, 0, 0}));
    return world;
  }
  StepReport finish() {
    StepReport report;
    const Pose<S> start[] = {{vec<S>(1, 0, 0), Quat<Unit<S>>::identity()}};
    finisher.finish(start, {}, {}, report);
    return report;
  }

  World<S> world{settings<S>(0)};
  BodyId ball;
  Systems<S> systems;
  BodyFinisher<S> finisher{systems.state, systems.map, systems.proxies};
};
TYPED_TEST_SUITE(BodyFinishers, SystemScalars);

TYPED_TEST(BodyFinishers, what_is_in_range_stays_and_its_fat_box_is_renewed_when_it_leaves_it) {
  using S = TypeParam;
  BodyState<S>& body = this->systems.awake(this->ball);
  const Aabb<S> fat = body.fat;
  body.centre = vec<S>(1.0625, 0, 0);
  EXPECT_TRUE(this->finish().clean());
  EXPECT_TRUE(body.fat == fat) << "inside the margin of 0.1 m";
  body.centre = vec<S>(2, 0, 0);
  EXPECT_TRUE(this->finish().clean());
  EXPECT_NEAR(to_double(body.fat.low.x), 1.4, 1e-4);
  EXPECT_TRUE(this->systems.proxies.boxes().box(this->ball.slot) == body.fat);
}

TYPED_TEST(BodyFinishers, speed_and_position_are_cut_to_their_limits) {
  using S = TypeParam;
  BodyState<S>& body = this->systems.awake(this->ball);
  const S edge = Limits<S>::position();
  const double most = to_double(Limits<S>::speed());
  body.centre = {edge + S(2), S(3), S(0)};
  body.velocity = vec<Velocity<S>>(1, 1.25 * most, 0);
  const StepReport report = this->finish();
  EXPECT_EQ(report.clamped_speed, 1u);
  EXPECT_EQ(report.clamped_position, 1u);
  EXPECT_EQ(body.centre.x, edge);
  EXPECT_EQ(body.centre.y, S(3));
  EXPECT_EQ(body.velocity.x, Velocity<S>(0)) << "it does not move on";
  EXPECT_LE(to_double(body.velocity.y), most);
  EXPECT_GT(to_double(body.velocity.y), most * (1 - 0x1p-11)) << "along the edge it does";
}

TYPED_TEST(BodyFinishers, a_speed_that_no_axis_shows_is_cut_along_its_way) {
  using S = TypeParam;
  BodyState<S>& body = this->systems.awake(this->ball);
  const double most = to_double(Limits<S>::speed());
  body.velocity = vec<Velocity<S>>(0.75 * most, -0.75 * most, 0.75 * most);
  const StepReport report = this->finish();
  EXPECT_EQ(report.clamped_speed, 1u);
  EXPECT_EQ(report.clamped_position, 0u);
  const D3 v = real(body.velocity);
  EXPECT_LE(length(v), most * (1 + 1e-9));
  EXPECT_GT(length(v), most * (1 - 0x1p-11));
  expect_near(v, D3{1, -1, 1} * (most / std::sqrt(3.0)), most * 0x1p-11);
}

TEST(BodyFinishersOfFloat, a_body_that_is_no_number_goes_back_and_stops) {
  World<float> world(settings<float>(0));
  const BodyId ball = world.create(moving<float>(add_ball(world, 0.5), {1, 0, 0}));
  Systems<float> systems(world);
  BodyFinisher<float> finisher(systems.state, systems.map, systems.proxies);
  BodyState<float>& body = systems.awake(ball);
  body.centre.y = std::numeric_limits<float>::quiet_NaN();
  body.velocity.y = 3;
  Contact<float> contact = {};
  contact.normal_impulse[1] = std::numeric_limits<float>::infinity();
  systems.state.contacts.push_back(contact);
  const Pose<float> start[] = {{{1, 2, 3}, Quat<float>::identity()}};
  StepReport report;
  finisher.finish(start, {}, {}, report);
  EXPECT_EQ(report.stopped, 1u);
  EXPECT_EQ(body.centre.y, 2.0f);
  EXPECT_EQ(body.velocity.y, 0.0f);
  EXPECT_EQ(systems.state.contacts[0].normal_impulse[1], 0.0f);
}

}  // namespace body_finisher_test
}  // namespace isostep::test
