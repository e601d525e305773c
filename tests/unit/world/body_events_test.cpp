// Events of bodies: who is inside a sensor, which contacts begin and end, and with what impulse.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace body_events_test {

template <class S> class BodyEvents : public ::testing::Test {};
TYPED_TEST_SUITE(BodyEvents, AllScalars);

TYPED_TEST(BodyEvents, a_sensor_tells_of_coming_and_going_once_each_and_pushes_nothing) {
  using S = TypeParam;
  World<S> w(settings<S>(0)), without(settings<S>(0));
  const BodyId flier = w.create(moving<S>(add_ball(w, 0.5), {-3, 0, 0}, {6, 0, 0}));
  const BodyId twin = without.create(moving<S>(add_ball(without, 0.5), {-3, 0, 0}, {6, 0, 0}));
  BodyDefinition<S> d = still<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0, 0});
  d.sensor = true;
  const BodyId sensor = w.create(d);
  int begins = 0, ends = 0, begin_step = 0, end_step = 0;
  for (int i = 1; i <= 60; ++i) {
    w.step();
    without.step();
    for (const SensorEvent& e : w.events().sensor_begin) {
      EXPECT_EQ(e.sensor, sensor);
      EXPECT_EQ(e.other, flier);
      ++begins;
      begin_step = i;
    }
    for (const SensorEvent& e : w.events().sensor_end) {
      EXPECT_EQ(e.sensor, sensor);
      EXPECT_EQ(e.other, flier);
      ++ends;
      end_step = i;
    }
    EXPECT_TRUE(w.events().contact_begin.empty());
  }
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 1);
  // Surfaces meet at x = -1 and part at x = 1: 20 steps and 40 steps of 1/10 m, seen when the next step begins.
  EXPECT_NEAR(begin_step, 21, 1);
  EXPECT_NEAR(end_step, 41, 1);
  EXPECT_EQ(w.center_of_mass(flier), without.center_of_mass(twin));
  EXPECT_EQ(w.velocity(flier), without.velocity(twin));
}

TYPED_TEST(BodyEvents, what_sleeps_inside_a_sensor_stays_inside_until_either_is_moved) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  BodyDefinition<S> d = still<S>(box, {0, 0.5, 0});
  d.sensor = true;
  const BodyId sensor = w.create(d);
  const BodyId sleeper = w.create(moving<S>(box, {0, 0.5, 0}));
  int begins = 0, ends = 0;
  const auto step = [&] {
    w.step();
    begins += static_cast<int>(w.events().sensor_begin.size());
    ends += static_cast<int>(w.events().sensor_end.size());
  };
  for (int i = 0; i < 90; ++i) step();
  EXPECT_FALSE(w.is_awake(sleeper));
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 0);
  ASSERT_TRUE(w.set_pose(sensor, {vec<S>(5, 0.5, 0), Quat<Unit<S>>::identity()}));
  for (int i = 0; i < 90; ++i) step();
  EXPECT_EQ(begins, 1);
  EXPECT_EQ(ends, 1);
  EXPECT_FALSE(w.is_awake(sleeper));
  ASSERT_TRUE(w.set_pose(sensor, {vec<S>(0, 0.5, 0), Quat<Unit<S>>::identity()}));
  for (int i = 0; i < 3; ++i) step();
  EXPECT_EQ(begins, 2);
  EXPECT_TRUE(w.destroy(sleeper));
  for (int i = 0; i < 3; ++i) step();
  EXPECT_TRUE(w.state().overlaps.empty());
}

TYPED_TEST(BodyEvents, a_contact_begins_once_with_the_impulse_that_stopped_the_body) {
  using S = TypeParam;
  for (const double e : {0.0, 0.5}) {
    World<S> w(settings<S>(0));
    const BodyId ground = add_ground(w);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 1, 0}, {0, -4, 0});
    d.mass = S(3);
    d.material.restitution = num<S>(e);
    const BodyId ball = w.create(d);
    int begins = 0, ends = 0;
    for (int i = 0; i < 30; ++i) {
      w.step();
      for (const ContactBegin<S>& c : w.events().contact_begin) {
        ++begins;
        EXPECT_EQ(c.a, ground);
        EXPECT_EQ(c.b, ball);
        expect_near(real(c.normal), {0, 1, 0}, 1e-4);
        // The push out of the overlap that the ball arrived with comes on top.
        EXPECT_GE(to_double(c.impulse), 0.99 * 3 * 4 * (1 + e));
        EXPECT_LE(to_double(c.impulse), 1.2 * 3 * 4 * (1 + e));
      }
      ends += static_cast<int>(w.events().contact_end.size());
    }
    EXPECT_EQ(begins, 1);
    EXPECT_GE(ends, e > 0 ? 1 : 0);
    EXPECT_LE(ends, 1);
  }
}

TYPED_TEST(BodyEvents, the_impulse_between_two_moving_bodies_is_that_of_their_reduced_mass) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  BodyDefinition<S> d = moving<S>(ball, {-1, 0, 0}, {3, 0, 0});
  d.mass = S(2);
  const BodyId a = w.create(d);
  d = moving<S>(ball, {1, 0, 0}, {-3, 0, 0});
  d.mass = S(6);
  const BodyId b = w.create(d);
  double impulse = 0;
  for (int i = 0; i < 20; ++i) {
    w.step();
    for (const ContactBegin<S>& c : w.events().contact_begin) impulse = to_double(c.impulse);
  }
  EXPECT_NEAR(impulse, 1.5 * 6, 0.05 * 9);
  EXPECT_NEAR(to_double(w.velocity(a).x), -1.5, 0.05);
  EXPECT_NEAR(to_double(w.velocity(b).x), -1.5, 0.05);
}

TYPED_TEST(BodyEvents, contact_events_ascend_by_bodies_and_pair_up) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId ball = add_ball(w, 0.5);
  for (int i = 0; i < 30; ++i)
    w.create(moving<S>(ball, {0.7 * (i % 5) + 0.01 * i, 1.0 + 1.1 * (i / 5), 0.6 * (i % 3)}));
  std::vector<std::pair<BodyId, BodyId>> touching;
  std::size_t total = 0;
  const auto slots = [](auto& e) { return std::uint64_t{e.a.slot} << 32 | e.b.slot; };
  for (int i = 0; i < 240; ++i) {
    w.step();
    const Events<S>& events = w.events();
    for (std::size_t k = 0; k < events.contact_begin.size(); ++k) {
      EXPECT_LT(events.contact_begin[k].a.slot, events.contact_begin[k].b.slot);
      if (k > 0) {
        EXPECT_LT(slots(events.contact_begin[k - 1]), slots(events.contact_begin[k]));
      }
      EXPECT_GE(to_double(events.contact_begin[k].impulse), 0) << "less than the format shows is none";
      touching.emplace_back(events.contact_begin[k].a, events.contact_begin[k].b);
    }
    total += events.contact_begin.size();
    for (std::size_t k = 0; k < events.contact_end.size(); ++k) {
      if (k > 0) {
        EXPECT_LT(slots(events.contact_end[k - 1]), slots(events.contact_end[k]));
      }
      const std::pair<BodyId, BodyId> pair(events.contact_end[k].a, events.contact_end[k].b);
      std::size_t at = 0;
      while (at < touching.size() && touching[at] != pair) ++at;
      ASSERT_LT(at, touching.size()) << "a contact ended that never began";
      touching.erase(touching.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
  EXPECT_GT(total, 40u);
}

}  // namespace body_events_test
}  // namespace isostep::test
