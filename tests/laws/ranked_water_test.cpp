// Laws of Water with priorities: which water a body has where several overlap.
// SPDX-License-Identifier: MIT

#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace ranked_water_test {

/// Water of `density` [kg/m^3]: some hundred, which Q16.16 can count too.
template <class S> Water<S> water(double height, double density, std::int32_t priority, D3 at, D3 half) {
  Water<S> w;
  w.surface_height = num<S>(height);
  w.density = num<S>(density);
  w.linear_drag = w.angular_drag = S(4);
  w.priority = priority;
  w.replaces = true;
  w.middle = vec<S>(at);
  w.half = vec<S>(half);
  return w;
}

template <class S> class RankedWaters : public ::testing::Test {
 protected:
  BodyId box(D3 at, std::uint32_t category = 1) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), at);
    d.mass = S(25);  // of half a cubic metre
    d.filter.category = category;
    d.allow_sleep = false;
    return w.create(d);
  }
  void fill_sea(double height = 0, double drag = 4) {
    Water<S> sea;
    sea.surface_height = num<S>(height);
    sea.density = S(100);
    sea.linear_drag = sea.angular_drag = num<S>(drag);
    ASSERT_TRUE(w.add(sea));
  }
  /// [m/s^2] The acceleration of a body that was at rest, by one step without drag.
  double rise(BodyId body) {
    w.set_velocity(body, Vec3<S>::zero(), Vec3<S>::zero());
    w.step();
    return to_double(w.velocity(body).y) * 60;
  }
  double height(BodyId id) const { return to_double(w.center_of_mass(id).y); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(RankedWaters, AllScalars);

TYPED_TEST(RankedWaters, a_tank_in_the_sea_has_its_own_level_and_density) {
  using S = TypeParam;
  this->fill_sea();
  ASSERT_TRUE(this->w.add(water<S>(2, 200, 1, {8, 0, 0}, {2, 4, 2}))) << describe(this->w.fault());
  ASSERT_TRUE(this->w.add(water<S>(-3, 100, 2, {0, 0, 8}, {2, 8, 2})));
  const BodyId at_sea = this->box({0, 0, 0}), in_tank = this->box({8, 2, 0}), in_dock = this->box({0, -3, 8});
  run(this->w, 600);
  const double bar = pick<S>(1e-4, 1e-8, 1e-2, 1e-5);
  EXPECT_NEAR(this->height(at_sea), 0, bar);
  EXPECT_NEAR(this->height(in_tank), 2 + 0.125, bar) << "a quarter of it is wet";
  EXPECT_NEAR(this->height(in_dock), -3, bar) << "the sea above its level is not there";
}

TYPED_TEST(RankedWaters, the_highest_rank_counts_and_waters_of_one_rank_add_up) {
  using S = TypeParam;
  const D3 half = {2, 2, 2};
  const BodyId inside = this->box({0, -1, 0}), other = this->box({0, -1, 1.5}, 2), outside = this->box({8, -1, 0});
  this->fill_sea(4, 0);
  const double bar = 0.05;  // [m/s^2]
  EXPECT_NEAR(this->rise(inside), 10, bar);
  Water<S> high = water<S>(4, 75, 2, {0, 0, 0}, half);
  high.mask = ~2u;
  high.linear_drag = S(0);
  const WaterId id = this->w.add(high);
  Water<S> low = water<S>(4, 150, 1, {0, 0, 0}, half);
  low.linear_drag = S(0);
  this->w.add(low);
  this->w.add(water<S>(4, 100, -1, {0, 0, 0}, half));
  EXPECT_NEAR(this->rise(inside), 10 * (0.75 * 2 - 1), bar);
  EXPECT_NEAR(this->rise(other), 10 * (1.5 * 2 - 1), bar) << "of a category that the highest leaves alone";
  EXPECT_NEAR(this->rise(outside), 10, bar);
  Water<S> twice = high;
  twice.density = S(25);
  this->w.add(twice);
  EXPECT_NEAR(this->rise(inside), 10 * (1.0 * 2 - 1), bar);
  high.priority = 0;
  ASSERT_TRUE(this->w.set(id, high));
  EXPECT_NEAR(this->rise(inside), 10 * (0.25 * 2 - 1), bar);
}

TYPED_TEST(RankedWaters, of_two_regions_side_by_side_a_body_has_one) {
  using S = TypeParam;
  ASSERT_TRUE(this->w.add(water<S>(4, 75, 1, {-2, 0, 0}, {2, 2, 2})));
  ASSERT_TRUE(this->w.add(water<S>(4, 75, 2, {2, 0, 0}, {2, 2, 2})));
  const BodyId left = this->box({-0.125, -1, 0}), right = this->box({0.125, -1, 1.25});
  EXPECT_NEAR(this->rise(left), 5, 0.4);
  EXPECT_NEAR(this->rise(right), 5, 0.4);
}

TYPED_TEST(RankedWaters, a_zone_keeps_out_what_ranks_below_it) {
  using S = TypeParam;
  ForceZone<S> bell;
  bell.shape = ZoneShape::box;
  bell.half = vec<S>(4, 4, 4);
  bell.priority = 2;
  bell.replaces = zone_effect::kWater;
  ASSERT_TRUE(this->w.add(bell));
  Water<S> pool = water<S>(4, 75, 1, {0, 0, 0}, {2, 2, 2});
  const WaterId id = this->w.add(pool);
  const BodyId body = this->box({0, -1, 0});
  EXPECT_NEAR(this->rise(body), -10, 0.02);
  pool.priority = 3;
  ASSERT_TRUE(this->w.set(id, pool));
  EXPECT_NEAR(this->rise(body), 5, 0.4);
}

TYPED_TEST(RankedWaters, keels_feel_the_water_that_they_are_in) {
  using S = TypeParam;
  this->fill_sea(4);
  const BodyId boat = this->box({0, -1, 0});
  AeroSurface<S> keel;
  keel.body = boat;
  keel.tensor = Mat3<S>::diagonal(vec<S>(0, 0, -400));
  keel.is_under_water = true;
  ASSERT_TRUE(this->w.add(keel));
  Water<S> dock = water<S>(-4, 100, 1, {0, 0, 0}, {2, 2, 2});
  const WaterId id = this->w.add(dock);
  const auto left = [&] {
    this->w.set_velocity(boat, vec<S>(0, 0, 1), Vec3<S>::zero());
    this->w.step();
    return to_double(this->w.velocity(boat).z);
  };
  EXPECT_NEAR(left(), 1, 1e-3) << "above the level of its own water";
  dock.surface_height = S(2);
  ASSERT_TRUE(this->w.set(id, dock));
  EXPECT_LT(left(), 0.9);
}

TYPED_TEST(RankedWaters, bad_numbers_are_those_of_water) {
  using S = TypeParam;
  Water<S> bad = water<S>(0, 100, 1, {0, 0, 0}, {2, 2, 2});
  bad.density = S(-1);
  const std::uint64_t before = this->w.hash();
  EXPECT_FALSE(this->w.add(bad));
  EXPECT_STREQ(this->w.fault().field, "density");
  bad = water<S>(0, 100, 1, {0, 0, 0}, {2, -2, 2});
  EXPECT_FALSE(this->w.add(bad));
  EXPECT_STREQ(this->w.fault().field, "half");
  EXPECT_EQ(this->w.hash(), before);
}

TYPED_TEST(RankedWaters, it_is_state) {
  using S = TypeParam;
  this->fill_sea();
  for (int i = 0; i < 6; ++i) this->box({i * 1.25 - 3, 0.5 * i - 1, 0});
  Water<S> lock = water<S>(0.5, 100, 1, {0, 0, 0}, {2, 4, 2});
  lock.wave_height = num<S>(0.125);
  const WaterId id = this->w.add(lock);
  expect_exact_rollback(this->w, 90, [&](World<S>& world, int i) {
    if (i % 15 != 7) return;
    lock.surface_height = num<S>((i % 30) * 0.0625 - 1);
    lock.priority = i % 2 == 0 ? 1 : -1;
    world.set(id, lock);
  });
}

}  // namespace ranked_water_test
}  // namespace isostep::test
