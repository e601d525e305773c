// Laws of ForceZone with priorities: which zones act where several overlap.
// SPDX-License-Identifier: MIT

#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace ranked_zones_test {

template <class S> ForceZone<S> zone(D3 acceleration, std::int32_t priority, std::uint32_t replaces, double half = 0) {
  ForceZone<S> z;
  z.acceleration = vec<S>(acceleration);
  z.priority = priority;
  z.replaces = replaces;
  if (half > 0) {
    z.shape = ZoneShape::box;
    z.half = vec<S>(half, half, half);
  }
  return z;
}

template <class S> class RankedZones : public ::testing::Test {
 protected:
  BodyId ball(D3 at, std::uint32_t category = 1) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), at);
    d.filter.category = category;
    return w.create(d);
  }
  /// [m/s^2] The acceleration of a body that was at rest, by one step.
  D3 acceleration(BodyId body) {
    w.set_velocity(body, vec<S>(0, 0, 0), vec<S>(0, 0, 0));
    w.step();
    return real(w.velocity(body)) * 60.0;
  }
  void expect(BodyId body, D3 expected) { expect_near(acceleration(body), expected, 1e-2); }

  World<S> w{settings<S>(0)};
};
TYPED_TEST_SUITE(RankedZones, AllScalars);

TYPED_TEST(RankedZones, zones_that_replace_nothing_add_up) {
  using S = TypeParam;
  const BodyId body = this->ball({0, 0, 0});
  ForceZone<S> plain;
  plain.acceleration = vec<S>(1, 0, 0);
  this->w.add(plain);
  this->w.add(zone<S>({0, 2, 0}, 5, 0));
  this->w.add(zone<S>({0, 0, 3}, -5, 0));
  this->expect(body, {1, 2, 3});
}

TYPED_TEST(RankedZones, the_highest_rank_that_replaces_hides_what_is_below_and_nothing_beside_or_above) {
  using S = TypeParam;
  const BodyId inside = this->ball({0, 0, 0}), outside = this->ball({8, 0, 0}), other = this->ball({0, 1, 0}, 2);
  ForceZone<S> plain;
  plain.acceleration = vec<S>(1, 0, 0);
  this->w.add(plain);
  this->w.add(zone<S>({0, 4, 0}, 1, zone_effect::kAcceleration, 2));
  ForceZone<S> middle = zone<S>({0, 2, 0}, 2, zone_effect::kAcceleration, 2);
  middle.mask = 1;
  const ForceZoneId id = this->w.add(middle);
  this->w.add(zone<S>({0, 0, 1}, 2, zone_effect::kAcceleration, 2));
  this->w.add(zone<S>({0, 0, 2}, 3, 0, 2));
  this->expect(inside, {0, 2, 3});
  this->expect(outside, {1, 0, 0});
  this->expect(other, {0, 0, 3});
  ASSERT_TRUE(this->w.remove(id));
  this->expect(inside, {0, 0, 3});
}

TYPED_TEST(RankedZones, a_zone_may_replace_the_gravity_of_the_world) {
  using S = TypeParam;
  this->w.set_gravity(vec<S>(0, -10, 0));
  const BodyId inside = this->ball({0, 0, 0}), outside = this->ball({8, 0, 0});
  this->w.set_motion(inside, num<S>(0.75), S(0), S(0), 0);
  this->w.add(zone<S>({0, 0, 0}, -1, zone_effect::kGravity, 2));
  this->w.add(zone<S>({3, 0, 0}, 0, zone_effect::kGravity, 2));
  EXPECT_EQ(this->acceleration(inside).y, 0) << "exactly, and once for both";
  this->expect(inside, {3, 0, 0});
  this->expect(outside, {0, -10, 0});
}

TYPED_TEST(RankedZones, wind_is_replaced_by_wind_alone) {
  using S = TypeParam;
  const BodyId body = this->ball({0, 0, 0});
  this->w.add(BodyDrag<S>{body, num<S>(100), S(0), S(0)});
  ForceZone<S> low = zone<S>({0, 0, 0}, 0, 0), high = zone<S>({0, 0, 0}, 1, zone_effect::kWind, 4);
  low.wind = vec<S>(1, 0, 0);
  high.wind = vec<S>(0, 0, 1);
  this->w.add(low);
  run(this->w, 60);
  expect_near(real(this->w.velocity(body)), {1, 0, 0}, 0.02);
  this->w.add(zone<S>({0, 0, 0}, 2, zone_effect::kAcceleration));
  this->w.add(high);
  run(this->w, 60);
  expect_near(real(this->w.velocity(body)), {0, 0, 1}, 0.02);
}

TYPED_TEST(RankedZones, a_zone_that_changes_wakes_what_it_may_reach) {
  using S = TypeParam;
  this->w.set_gravity(vec<S>(0, -10, 0));
  add_ground(this->w);
  const BodyId body = this->ball({0, 0.25, 0});
  ASSERT_TRUE(settle(this->w));
  const ForceZoneId id = this->w.add(zone<S>({0, 12, 0}, 0, 0));
  EXPECT_TRUE(this->w.is_awake(body));
  run(this->w, 30);
  EXPECT_GT(to_double(this->w.center_of_mass(body).y), 0.4);
  EXPECT_FALSE(this->w.set(id, zone<S>({0, 12, 0}, 0, zone_effect::kAll + 1)));
  EXPECT_STREQ(this->w.fault().field, "replaces");
}

TYPED_TEST(RankedZones, priorities_are_state) {
  using S = TypeParam;
  for (int i = 0; i < 4; ++i) this->ball({i * 1.0, 0, 0});
  this->w.add(zone<S>({1, 0, 0}, 0, 0));
  const ForceZoneId id = this->w.add(zone<S>({0, 1, 0}, 1, zone_effect::kAcceleration, 2));
  expect_exact_rollback(this->w, 60, [&](World<S>& world, int i) {
    if (i % 10 == 4) world.set(id, zone<S>({0, 1, 0}, i % 20 == 4 ? -1 : 1, zone_effect::kAcceleration, 2));
  });
}

}  // namespace ranked_zones_test
}  // namespace isostep::test
