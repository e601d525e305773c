// Laws of DampingZone: how fast motion fades where, and which zones count where several overlap.
// SPDX-License-Identifier: MIT

#include <limits>

#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace damping_zones_test {

template <class S>
DampingZone<S> zone(double linear, double angular, std::int32_t priority = 0, bool replaces = false) {
  DampingZone<S> z;
  z.linear = num<S>(linear);
  z.angular = num<S>(angular);
  z.priority = priority;
  z.replaces = replaces;
  return z;
}
template <class S> DampingZone<S> around(DampingZone<S> z, D3 at, double half) {
  z.shape = ZoneShape::box;
  z.pose.position = vec<S>(at);
  z.half = vec<S>(half, half, half);
  return z;
}

template <class S> class DampingZones : public ::testing::Test {
 protected:
  BodyId ball(D3 at, D3 velocity, std::uint32_t category = 1) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), at, velocity);
    d.filter.category = category;
    d.allow_sleep = false;
    return w.create(d);
  }
  /// [1/s] The rate at which a body's speed of 1 m/s fades, by what one step leaves of it.
  double rate(BodyId body) {
    w.set_velocity(body, vec<S>(1, 0, 0), Vec3<S>::zero());
    w.step();
    return (1 / std::pow(to_double(w.velocity(body).x), 1.0 / 8) - 1) * 480;
  }

  World<S> w{settings<S>(0)};
  const double bar = pick<S>(1e-3, 1e-8, 0.15, 1e-4);  // [1/s]
};
TYPED_TEST_SUITE(DampingZones, AllScalars);

TYPED_TEST(DampingZones, motion_fades_by_backward_euler_whatever_the_mass) {
  using S = TypeParam;
  BodyDefinition<S> d = moving<S>(add_box(this->w, 1, 0.25, 0.5), {0, 0, 0}, {1, 2, -1});
  d.angular_velocity = vec<S>(0, 1, 0);
  d.mass = S(20);
  const BodyId heavy = this->w.create(d);
  const BodyId light = this->ball({8, 0, 0}, {1, 2, -1});
  ASSERT_TRUE(this->w.add(zone<S>(3, 5)));
  run(this->w, 30);
  const double slower = std::pow(1 / (1 + 3.0 / 480), 240), turning = std::pow(1 / (1 + 5.0 / 480), 240);
  const double near = pick<S>(1e-5, 1e-12, 5e-3, 1e-7);
  for (const BodyId body : {heavy, light}) {
    expect_near(real(this->w.velocity(body)), D3{1, 2, -1} * slower, near);
  }
  EXPECT_NEAR(to_double(this->w.angular_velocity(heavy).y), turning, near);
}

TYPED_TEST(DampingZones, no_rate_turns_a_motion_round_and_many_zones_are_as_stable_as_one) {
  using S = TypeParam;
  for (const double strong : {480.0, 16384.0}) {
    World<S> coarse(settings<S>(0, 60, 1));
    BodyDefinition<S> d = moving<S>(add_ball(coarse, 0.25), {0, 0, 0}, {4, 0, -2});
    d.angular_velocity = vec<S>(0, 4, 0);
    d.mass = S(1);
    d.allow_sleep = false;
    const BodyId body = coarse.create(d);
    BodyDrag<S> drag;
    drag.body = body;
    drag.linear = S(480);
    ASSERT_TRUE(coarse.add(drag));
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(coarse.add(zone<S>(strong, strong)));
    double least = 4;
    for (int i = 0; i < 30; ++i) {
      coarse.step();
      const double x = to_double(coarse.velocity(body).x);
      EXPECT_GE(x, -speed_grain<S>(4)) << strong;
      EXPECT_LE(x, least + speed_grain<S>(4));
      EXPECT_GE(to_double(coarse.angular_velocity(body).y), -speed_grain<S>(4));
      least = x;
    }
    EXPECT_LT(least, 1e-3);
    EXPECT_LT(to_double(coarse.angular_velocity(body).y), 1e-3);
  }
}

TYPED_TEST(DampingZones, what_falls_comes_to_its_terminal_speed) {
  using S = TypeParam;
  this->w.set_gravity(vec<S>(0, -10, 0));
  const BodyId body = this->ball({0, 0, 0}, {0, 0, 0});
  ASSERT_TRUE(this->w.add(zone<S>(5, 0)));
  run(this->w, 240);
  EXPECT_NEAR(to_double(this->w.velocity(body).y), -2, pick<S>(1e-4, 1e-8, 0.02, 1e-5));
}

TYPED_TEST(DampingZones, rates_add_up_but_below_the_highest_that_replaces) {
  using S = TypeParam;
  const BodyId inside = this->ball({0, 0, 0}, {0, 0, 0}), outside = this->ball({8, 0, 0}, {0, 0, 0}),
               other = this->ball({0, 1, 0}, {0, 0, 0}, 2);
  this->w.add(zone<S>(2, 0));
  this->w.add(zone<S>(1, 0, 5));
  EXPECT_NEAR(this->rate(inside), 3, this->bar);
  DampingZone<S> clears = around(zone<S>(0.5, 0, 2, true), {0, 0, 0}, 2);
  clears.mask = 1;
  const DampingZoneId id = this->w.add(clears);
  ASSERT_TRUE(id) << describe(this->w.fault());
  this->w.add(around(zone<S>(4, 0, 2), {0, 0, 0}, 2));
  this->w.add(around(zone<S>(8, 0, 1), {0, 0, 0}, 2));
  EXPECT_NEAR(this->rate(inside), 1 + 0.5 + 4, this->bar) << "of one priority both count";
  EXPECT_NEAR(this->rate(outside), 3, this->bar);
  EXPECT_NEAR(this->rate(other), 2 + 1 + 4 + 8, this->bar) << "of a category that the zone leaves alone";
  this->w.remove(id);
  this->w.add(around(zone<S>(0, 0, 9, true), {0, 0, 0}, 2));
  EXPECT_EQ(this->rate(inside), 0) << "a place free of others";
}

TYPED_TEST(DampingZones, only_what_is_inside_a_sphere_is_slowed) {
  using S = TypeParam;
  DampingZone<S> sphere = zone<S>(4, 0);
  sphere.shape = ZoneShape::sphere;
  sphere.half = vec<S>(2, 0, 0);
  ASSERT_TRUE(this->w.add(sphere));
  const BodyId inside = this->ball({0, 1.75, 0}, {0, 0, 0}), outside = this->ball({0, 2.25, 0}, {0, 0, 0});
  EXPECT_NEAR(this->rate(inside), 4, this->bar);
  EXPECT_EQ(this->rate(outside), 0);
}

TYPED_TEST(DampingZones, a_change_wakes_what_sleeps) {
  using S = TypeParam;
  this->w.set_gravity(vec<S>(0, -10, 0));
  add_ground(this->w);
  const BodyId body = this->w.create(moving<S>(add_ball(this->w, 0.25), {0, 0.25, 0}));
  ASSERT_TRUE(settle(this->w));
  const DampingZoneId id = this->w.add(zone<S>(1, 1));
  EXPECT_TRUE(this->w.is_awake(body));
  ASSERT_TRUE(settle(this->w));
  ASSERT_TRUE(this->w.remove(id));
  EXPECT_TRUE(this->w.is_awake(body));
}

TYPED_TEST(DampingZones, bad_numbers_are_named) {
  using S = TypeParam;
  const auto refused = [&](const char* field, const auto& change) {
    DampingZone<S> z = zone<S>(1, 1);
    change(z);
    const std::uint64_t before = this->w.hash();
    EXPECT_FALSE(this->w.add(z)) << field;
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before);
  };
  refused("shape", [](auto& z) { z.shape = static_cast<ZoneShape>(3); });
  refused("pose.position", [](auto& z) { z.pose.position.x = highest<S>(); });
  refused("pose.orientation", [](auto& z) { z.pose.orientation.w = Unit<S>(0.5); });
  refused("half", [](auto& z) { z.half.y = S(-1); });
  refused("half", [](auto& z) { z.half.y = highest<S>(); });
  for (const double bad : {-1.0, 16385.0}) {
    refused("linear", [&](auto& z) { z.linear = num<S>(bad); });
    refused("angular", [&](auto& z) { z.angular = num<S>(bad); });
  }
  if constexpr (!kIsFixed<S>) {
    const S nan = std::numeric_limits<S>::quiet_NaN();
    refused("half", [&](auto& z) { z.half.x = nan; });
    refused("linear", [&](auto& z) { z.linear = nan; });
    refused("angular", [&](auto& z) { z.angular = nan; });
  }
}

TYPED_TEST(DampingZones, it_is_state) {
  using S = TypeParam;
  this->w.set_gravity(vec<S>(0, -10, 0));
  add_ground(this->w);
  for (int i = 0; i < 8; ++i) this->ball({i * 0.25, 0.5 + i * 0.5, 0}, {1, 0, 0.5});
  const DampingZoneId id = this->w.add(around(zone<S>(4, 2, 1, true), {0, 1, 0}, 1));
  this->w.add(zone<S>(0.5, 0.5));
  expect_exact_rollback(this->w, 90, [&](World<S>& world, int i) {
    if (i % 15 == 7) world.set(id, around(zone<S>(i * 0.25, 2, 1, i % 2 == 0), {0, 1, 0}, 1));
  });
}

}  // namespace damping_zones_test
}  // namespace isostep::test
