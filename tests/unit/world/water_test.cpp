// Bodies of water: what floats, how deep, on which side, and what waves and currents do with it.
// SPDX-License-Identifier: MIT

#include "isostep/geometry/submersion.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace water_test {

template <class S> class Waters : public ::testing::Test {
 protected:
  explicit Waters() : world_(settings<S>()) {}

  BodyId body(ShapeId shape, D3 at, double mass, double turned = 0) {
    BodyDefinition<S> d = moving<S>(shape, at);
    d.orientation = turn<S>({0, 0, 1}, turned);
    d.mass = num<S>(mass);
    d.allow_sleep = sleeps_;
    return world_.create(d);
  }
  /// A pond of 100 kg a cubic metre, which Q16.16 can count too.
  static Water<S> pond(double drag = 4) {
    Water<S> water;
    water.density = S(100);
    water.linear_drag = num<S>(drag);
    water.angular_drag = num<S>(drag);
    return water;
  }
  void fill(const Water<S>& water) { ASSERT_TRUE(world_.add(water)) << world_.fault().field; }
  D3 centre(BodyId id) const { return real(world_.center_of_mass(id)); }
  D3 velocity(BodyId id) const { return real(world_.velocity(id)); }
  double leaning(BodyId id) const { return rotated<S>(world_.pose(id).orientation, {0, 1, 0}).y; }

  World<S> world_;
  bool sleeps_ = false;
};
TYPED_TEST_SUITE(Waters, AllScalars);

TYPED_TEST(Waters, bodies_float_as_deep_as_they_weigh) {  // O21
  using S = TypeParam;
  const BodyId box = this->body(add_box(this->world_, 0.5, 0.25, 0.75), {0, 0.5, 0}, 30);
  const BodyId ball = this->body(add_ball(this->world_, 0.5), {4, 0.25, 0}, 100 * 4.0 / 3 * kPi * 0.125 / 2);
  const BodyId stone = this->body(add_ball(this->world_, 0.5), {8, 0, 0}, 80);
  this->fill(this->pond());
  run(this->world_, 900);
  const double bar = pick<S>(1e-4, 1e-8, 1e-2, 1e-6);
  EXPECT_NEAR(this->centre(box).y, 0.25 - 30.0 / (100 * 1 * 1.5), bar);
  EXPECT_NEAR(this->centre(ball).y, 0, bar);
  EXPECT_LT(this->centre(stone).y, -2);
  EXPECT_NEAR(length(this->velocity(box)), 0, bar);
}

TYPED_TEST(Waters, every_solid_displaces_its_weight) {
  using S = TypeParam;
  World<S>& w = this->world_;
  const std::vector<std::vector<Child<S>>> shapes = {
      {part_at(primitive_of(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0, 0})},
      {part_at(primitive_of(Cylinder<S>{num<S>(0.5), num<S>(0.25)}), {0, 0, 0})},
      {part_at(primitive_of(Cone<S>{num<S>(0.5), num<S>(0.5)}), {0, 0, 0})},
      {part_at(primitive_of(Box<S>{vec<S>(0.5, 0.125, 0.5)}), {0, 0, 0}),
       part_at(primitive_of(Box<S>{vec<S>(0.125, 0.25, 0.125)}), {0, 0.375, 0})}};
  std::vector<BodyId> bodies;
  for (const std::vector<Child<S>>& parts : shapes) {
    const ShapeId shape = w.add_shape(std::span<const Child<S>>(parts));
    bodies.push_back(this->body(shape, {4.0 * static_cast<double>(bodies.size()), 0.125, 0}, 10));
  }
  this->fill(this->pond());
  run(w, 1200);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    double displaced = 0;
    const Pose<S> pose = w.pose(bodies[i]);
    for (const Child<S>& child : shapes[i]) {
      const Transform<S> at = compose(Transform<S>::of(pose), Transform<S>::of(child.pose));
      const Vec3<Unit<S>> up = transposed_times(at.rotation, Vec3<Unit<S>>{Unit<S>(0), Unit<S>(1), Unit<S>(0)});
      const double share = to_double(submersion<S>(child.primitive, up, -at.position.y).share);
      displaced += share * to_double(visit_shape(child.primitive, [](const auto& s) { return s.mass(S(100)); }));
    }
    EXPECT_NEAR(displaced, 10, pick<S>(1e-2, 1e-4, 0.2, 1e-4)) << "shape " << i;
  }
}

TYPED_TEST(Waters, boxes_turn_over_where_the_metacentre_says) {
  // Half as heavy as water, the metacentre of a long box of width w and height h is above its centre of mass where
  // (w / h)^2 > 3 / 2: w^2 / (6 h) from the centre of buoyancy, which is h / 4 below.
  for (const double width : {1.16, 1.29}) {
    const BodyId box = this->body(add_box(this->world_, width / 2, 0.5, 2), {0, 0, 0}, 50 * width * 4, 0.03);
    const WaterId water = this->world_.add(this->pond(0.5));
    double least = 1;
    for (int i = 0; i < 1200; ++i) {
      EXPECT_TRUE(this->world_.step().clean());
      least = std::min(least, this->leaning(box));
    }
    if (width < 1.22) EXPECT_LT(least, 0.9) << "it stays upright";
    else EXPECT_GT(least, 0.99) << "it turns over";
    this->world_.destroy(box);
    this->world_.remove(water);
  }
}

TYPED_TEST(Waters, bobbing_has_the_period_of_its_stiffness_and_never_grows) {  // O21
  const BodyId box = this->body(add_box(this->world_, 0.75, 0.25, 0.75), {0, 0.1, 0}, 56.25);
  this->fill(this->pond(0));
  const double omega = std::sqrt(100 * 2.25 * 10 / 56.25);  // rho A g / m
  int crossings = 0;
  double last = 0.1, largest = 0, first = 0, latest = 0;
  for (int i = 1; i <= 1800; ++i) {
    EXPECT_TRUE(this->world_.step().clean());
    const double y = this->centre(box).y;
    if (i > 1680) largest = std::max(largest, std::fabs(y));
    if ((y > 0) != (last > 0)) {
      latest = (i - 1 + last / (last - y)) / 60;
      if (crossings++ == 0) first = latest;
    }
    last = y;
  }
  EXPECT_NEAR((latest - first) / (crossings - 1), kPi / omega, 0.005 * kPi / omega);
  EXPECT_NEAR(largest, 0.1, 0.003);
}

TYPED_TEST(Waters, currents_carry_and_regions_end) {
  using S = TypeParam;
  const BodyId in = this->body(add_box(this->world_, 0.25, 0.25, 0.25), {0, 0, 0}, 6);
  const BodyId out = this->body(add_box(this->world_, 0.25, 0.25, 0.25), {0, 0, 20}, 6);
  Water<S> river = this->pond();
  river.current = vec<S>(1, 0, 0);
  river.half = vec<S>(40, 4, 4);
  this->fill(river);
  run(this->world_, 300);
  EXPECT_NEAR(this->velocity(in).x, 1, 0.01);
  EXPECT_NEAR(this->velocity(in).y, 0, 0.01);
  EXPECT_LT(this->centre(out).y, -50);
  this->world_.set_gravity(Vec3<S>::zero());
  run(this->world_, 60);
  EXPECT_NEAR(this->velocity(in).x, 1, 0.01) << "without gravity no water holds anything";
}

TYPED_TEST(Waters, waves_lift_what_floats_on_them) {
  using S = TypeParam;
  Water<S> sea = this->pond(2);
  sea.wave_height = num<S>(0.5);
  sea.wave_length = S(40);
  sea.wave_period = S(5);
  const BodyId raft = this->body(add_box(this->world_, 0.5, 0.125, 0.5), {8, 0, 0}, 12.5);
  this->fill(sea);
  double highest = -9, lowest = 9, worst = 0;
  for (int i = 1; i <= 1200; ++i) {
    EXPECT_TRUE(this->world_.step().clean());
    if (i < 600) continue;
    const D3 at = this->centre(raft);
    const double surface = 0.5 * std::sin(2 * kPi * (at.x / 40 - i / 60.0 / 5));
    highest = std::max(highest, at.y), lowest = std::min(lowest, at.y);
    worst = std::max(worst, std::fabs(at.y - surface));
  }
  EXPECT_NEAR(highest, 0.5, 0.05);
  EXPECT_NEAR(lowest, -0.5, 0.05);
  EXPECT_LT(worst, 0.06);
}

TYPED_TEST(Waters, still_water_lets_sleep_and_waves_do_not) {
  using S = TypeParam;
  this->sleeps_ = true;
  const BodyId box = this->body(add_box(this->world_, 0.5, 0.25, 0.5), {0, 0.125, 0}, 25);
  const WaterId water = this->world_.add(this->pond());
  ASSERT_TRUE(settle(this->world_));
  Water<S> sea = this->pond();
  sea.wave_height = num<S>(0.25);
  sea.wave_period = S(60);  // slower than what counts as rest
  ASSERT_TRUE(this->world_.set(water, sea));
  EXPECT_TRUE(this->world_.is_awake(box));
  run(this->world_, 300);
  EXPECT_TRUE(this->world_.is_awake(box));
}

TYPED_TEST(Waters, keels_feel_the_water_alone) {
  using S = TypeParam;
  const BodyId wet = this->body(add_box(this->world_, 0.5, 0.25, 0.5), {0, 0, 0}, 25);
  const BodyId dry = this->body(add_box(this->world_, 0.5, 0.25, 0.5), {0, 30, 8}, 25);
  this->fill(this->pond(0));
  ForceZone<S> storm;
  storm.wind = vec<S>(0, 0, 20);
  ASSERT_TRUE(this->world_.add(storm));
  for (const BodyId id : {wet, dry}) {
    AeroSurface<S> keel;
    keel.body = id;
    keel.point = vec<S>(0, -0.5, 0);
    keel.tensor = Mat3<S>::diagonal(vec<S>(0, 0, -400));
    keel.is_under_water = true;
    ASSERT_TRUE(this->world_.add(keel));
    this->world_.set_velocity(id, vec<S>(1, 0, 1), Vec3<S>::zero());
  }
  run(this->world_, 30);
  EXPECT_LT(this->velocity(wet).z, 0.5);
  EXPECT_GT(this->velocity(wet).x, 0.9);
  EXPECT_NEAR(this->velocity(dry).z, 1, 1e-3);
}

TYPED_TEST(Waters, a_zone_of_higher_rank_keeps_it_out) {
  using S = TypeParam;
  const ShapeId box = add_box(this->world_, 0.5, 0.25, 0.5);
  const BodyId inside = this->body(box, {0, -8, 0}, 25), outside = this->body(box, {8, -8, 0}, 25),
               other = this->body(box, {0, -8, 1.5}, 25);
  ASSERT_TRUE(this->world_.set_filter(other, {2, 0xffffffffu, 0}));
  this->fill(this->pond());
  ForceZone<S> cabin;
  cabin.shape = ZoneShape::box;
  cabin.pose.position = vec<S>(0, -8, 0);
  cabin.half = vec<S>(2, 2, 2);
  cabin.mask = ~2u;
  cabin.replaces = zone_effect::kWater;
  const ForceZoneId id = this->world_.add(cabin);
  ASSERT_TRUE(id) << describe(this->world_.fault());
  const auto rise_in_a_step = [&](BodyId body) {
    this->world_.set_velocity(body, Vec3<S>::zero(), Vec3<S>::zero());
    this->world_.step();
    return this->velocity(body).y * 60;  // [m/s^2]
  };
  EXPECT_GT(rise_in_a_step(inside), 5) << "of the rank that water has";
  cabin.priority = 1;
  ASSERT_TRUE(this->world_.set(id, cabin));
  EXPECT_NEAR(rise_in_a_step(inside), -10, 0.02);
  EXPECT_GT(rise_in_a_step(outside), 5);
  EXPECT_GT(rise_in_a_step(other), 5) << "of a category that the zone leaves alone";
  cabin.replaces = zone_effect::kAcceleration | zone_effect::kWind;
  ASSERT_TRUE(this->world_.set(id, cabin));
  EXPECT_GT(rise_in_a_step(inside), 5);
}

TYPED_TEST(Waters, keels_in_a_dry_zone_feel_nothing) {
  using S = TypeParam;
  const BodyId boat = this->body(add_box(this->world_, 0.5, 0.25, 0.5), {0, 0, 0}, 25);
  this->fill(this->pond(0));
  AeroSurface<S> keel;
  keel.body = boat;
  keel.point = vec<S>(0, -0.5, 0);
  keel.tensor = Mat3<S>::diagonal(vec<S>(0, 0, -400));
  keel.is_under_water = true;
  ASSERT_TRUE(this->world_.add(keel));
  ForceZone<S> dock;  // around the keel alone: the hull above it floats
  dock.shape = ZoneShape::box;
  dock.pose.position = vec<S>(0, -2.25, 0);
  dock.half = vec<S>(4, 2, 4);
  dock.priority = 1;
  dock.replaces = zone_effect::kWater;
  const ForceZoneId id = this->world_.add(dock);
  ASSERT_TRUE(id) << describe(this->world_.fault());
  const auto push = [&] { this->world_.set_velocity(boat, vec<S>(0, 0, 1), Vec3<S>::zero()); };
  push();
  this->world_.step();
  EXPECT_NEAR(this->velocity(boat).z, 1, 1e-3);
  ASSERT_TRUE(this->world_.remove(id));
  push();
  this->world_.step();
  EXPECT_LT(this->velocity(boat).z, 0.9);
}

TYPED_TEST(Waters, bad_numbers_are_named) {
  using S = TypeParam;
  const auto refused = [&](const char* field, const auto& change, Fault fault = Fault::bad_argument) {
    Water<S> water;
    change(water);
    EXPECT_FALSE(this->world_.add(water));
    EXPECT_STREQ(this->world_.fault().field, field);
    EXPECT_EQ(this->world_.fault().fault, fault) << field;
  };
  const S far = highest<S>();
  refused("density", [](Water<S>& w) { w.density = S(-1); });
  refused("half", [](Water<S>& w) { w.half = vec<S>(-1, 1, 1); });
  refused("linear_drag", [](Water<S>& w) { w.linear_drag = S(-1); });
  refused("quadratic_drag", [](Water<S>& w) { w.quadratic_drag = S(-1); });
  refused("angular_drag", [](Water<S>& w) { w.angular_drag = S(-1); });
  refused("wave_height", [](Water<S>& w) { w.wave_height = S(1); });
  refused("wave_height", [](Water<S>& w) { w.wave_height = num<S>(-0.25); });
  refused("wave_length", [](Water<S>& w) { w.wave_length = S(0); });
  refused("wave_period", [](Water<S>& w) { w.wave_period = S(0); });
  refused("wave_direction", [](Water<S>& w) { w.wave_direction = Vec3<Unit<S>>::zero(); });
  refused(
      "surface_height", [&](Water<S>& w) { w.surface_height = far; }, Fault::out_of_range);
  refused(
      "middle", [&](Water<S>& w) { w.middle.x = far; }, Fault::out_of_range);
  refused(
      "current", [&](Water<S>& w) { w.current.x = far; }, Fault::out_of_range);
  refused(
      "wave_period", [&](Water<S>& w) { w.wave_period = S(2000); }, Fault::out_of_range);
  EXPECT_EQ(this->world_.state().records->kinds(), 0u);
}

}  // namespace water_test
}  // namespace isostep::test
