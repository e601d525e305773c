// Forces that act from step to step: what each does, against formulas, and what commands and sleep do with them.
// SPDX-License-Identifier: MIT

#include "isostep/math/frames.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace {

template <class S> class Forces : public ::testing::Test {
 protected:
  using U = Unit<S>;
  explicit Forces() : world_(settings<S>()) {}

  /// A ball of radius 0.5 that weighs `mass`.
  BodyId ball(D3 at, double mass = 2, D3 velocity = {0, 0, 0}) {
    BodyDefinition<S> d = moving<S>(add_ball(world_, 0.5), at, velocity);
    d.mass = num<S>(mass);
    d.allow_sleep = sleeps_;
    return world_.create(d);
  }
  BodyId box(D3 at, D3 half, double mass) {
    BodyDefinition<S> d = moving<S>(add_box(world_, half.x, half.y, half.z), at);
    d.mass = num<S>(mass);
    d.allow_sleep = sleeps_;
    return world_.create(d);
  }
  void weightless() { world_.set_gravity(Vec3<S>::zero()); }
  D3 velocity(BodyId id) const { return real(world_.velocity(id)); }
  D3 centre(BodyId id) const { return real(world_.center_of_mass(id)); }
  D3 spin(BodyId id) const { return real(world_.angular_velocity(id)); }
  template <class Id> Id added(Id id) {
    EXPECT_TRUE(id) << describe(world_.fault());
    return id;
  }
  static std::string describe(const FaultReport& report) {
    return std::string(report.field) + " " + report.expected;
  }

  World<S> world_;
  bool sleeps_ = false;
};
TYPED_TEST_SUITE(Forces, AllScalars);

TYPED_TEST(Forces, drag_leads_to_its_terminal_speed) {  // O3
  using S = TypeParam;
  const BodyId id = this->ball({0, 0, 0});
  this->added(this->world_.add(BodyDrag<S>{id, S(1), num<S>(0.5), S(0)}));
  run(this->world_, 900);
  const double k1 = 1, k2 = 0.5, weight = 20, terminal = (-k1 + std::sqrt(k1 * k1 + 4 * k2 * weight)) / (2 * k2);
  EXPECT_NEAR(-this->velocity(id).y, terminal, terminal * pick<S>(1e-4, 1e-9, 1e-2, 1e-6));
}

TYPED_TEST(Forces, drag_of_any_strength_only_slows) {
  using S = TypeParam;
  for (const double strength : {1.0, 100.0, 30000.0}) {
    const BodyId id = this->ball({0, 0, 0}, 0.5, {8, 0, 0});
    this->weightless();
    this->world_.set_velocity(id, vec<S>(8, 0, 0), vec<S>(0, 5, 0));
    const S most = num<S>(strength);
    this->added(this->world_.add(BodyDrag<S>{id, most, most, most}));
    double speed = 8, turning = 5;
    for (int i = 0; i < 60; ++i) {
      EXPECT_TRUE(this->world_.step().clean());
      EXPECT_GE(this->velocity(id).x, 0);
      EXPECT_LE(this->velocity(id).x, speed);
      EXPECT_GE(this->spin(id).y, 0);
      EXPECT_LE(this->spin(id).y, turning + 4 * speed_grain<S>(5));
      speed = this->velocity(id).x, turning = this->spin(id).y;
    }
    EXPECT_LT(speed, strength == 1.0 ? 4 : 0.2);
    EXPECT_LT(turning, strength == 1.0 ? 1 : 0.2);
    this->world_.destroy(id);
  }
}

TYPED_TEST(Forces, drag_turns_a_body_with_the_wind) {
  using S = TypeParam;
  this->weightless();
  const BodyId in = this->ball({0, 0, 0}), out = this->ball({8, 0, 0});
  for (const BodyId id : {in, out}) this->added(this->world_.add(BodyDrag<S>{id, S(4), S(0), S(0)}));
  ForceZone<S> zone;
  zone.shape = ZoneShape::box;
  zone.half = vec<S>(4, 4, 20);
  zone.wind = vec<S>(0, 0, 3);
  this->added(this->world_.add(zone));
  run(this->world_, 60);
  EXPECT_NEAR(this->velocity(in).z, 3 * (1 - std::exp(-2.0)), 0.02);
  EXPECT_EQ(this->velocity(out).z, 0);
}

TYPED_TEST(Forces, springs_hold_weights_and_swing_without_gaining) {  // defect 26: a compressed one pushes
  using S = TypeParam;
  const BodyId id = this->ball({0, 2, 0}, 2);
  BodySpring<S> spring;
  spring.a = id;
  spring.anchor_b = vec<S>(0, 4, 0);
  spring.rest_length = S(3);
  spring.stiffness = S(200);
  this->added(this->world_.add(spring));
  double lowest = 1e9, highest = -1e9;
  for (int i = 0; i < 600; ++i) {
    EXPECT_TRUE(this->world_.step().clean());
    if (i >= 540) lowest = std::min(lowest, this->centre(id).y), highest = std::max(highest, this->centre(id).y);
  }
  // About 4 - 3 - m g / k = 0.9, from 2: an amplitude of 1.1.
  EXPECT_NEAR((lowest + highest) / 2, 0.9, 0.02);
  EXPECT_NEAR((highest - lowest) / 2, 1.1, 0.03);
}

TYPED_TEST(Forces, damped_springs_come_to_rest_where_statics_says) {
  using S = TypeParam;
  const BodyId id = this->box({0, 1, 0}, {0.5, 0.125, 0.25}, 4);
  for (const double side : {-0.5, 0.5}) {
    BodySpring<S> spring;
    spring.a = id;
    spring.anchor_a = vec<S>(side, 0, 0);
    spring.anchor_b = vec<S>(side, 3, 0);
    spring.rest_length = S(2);
    spring.stiffness = S(side < 0 ? 100 : 50);
    spring.damping = S(8);
    this->added(this->world_.add(spring));
  }
  run(this->world_, 1200);
  // 20 N each: stretched by 0.2 and by 0.4 m.
  expect_near(this->centre(id), {0, 3 - 2.3, 0}, 0.005);
  EXPECT_NEAR(rotated<S>(this->world_.pose(id).orientation, D3{1, 0, 0}).y, -0.2, 0.005);
}

TYPED_TEST(Forces, bungees_only_pull) {  // defect 27
  using S = TypeParam;
  this->weightless();
  const BodyId slack = this->ball({0, 0, 0}), taut = this->ball({4, 0, 0});
  BodySpring<S> spring;
  spring.only_pulls = true;
  spring.stiffness = S(20);
  spring.rest_length = S(2);
  spring.a = slack;
  spring.anchor_b = vec<S>(0, 1, 0);
  this->added(this->world_.add(spring));
  spring.a = taut;
  spring.anchor_b = vec<S>(4, 3, 0);
  this->added(this->world_.add(spring));
  run(this->world_, 10);
  EXPECT_EQ(this->velocity(slack).y, 0);
  EXPECT_GT(this->velocity(taut).y, 0.5);
}

TYPED_TEST(Forces, between_bodies_keep_momentum) {  // O24
  using S = TypeParam;
  this->weightless();
  const BodyId a = this->ball({0, 0, 0}, 2, {0, 0, 1}), b = this->ball({3, 0, 0}, 2);
  BodySpring<S> spring;
  spring.a = a, spring.b = b;
  spring.anchor_a = vec<S>(0.25, 0.25, 0);
  spring.rest_length = S(2);
  spring.stiffness = S(30);
  this->added(this->world_.add(spring));
  Attractor<S> attractor;
  attractor.body = a;
  attractor.strength = S(4);
  this->added(this->world_.add(attractor));
  run(this->world_, 120);
  expect_near(this->velocity(a) + this->velocity(b), {0, 0, 1}, 2e4 * speed_grain<S>() + 1e-9);
  EXPECT_GT(length(this->velocity(b)), 0.1);
  EXPECT_GT(length(this->spin(a)), 0.01);
}

TYPED_TEST(Forces, thrusters_push_and_turn_with_their_body) {
  using S = TypeParam;
  this->weightless();
  const BodyId id = this->box({0, 0, 0}, {1, 0.5, 0.5}, 3);
  this->added(this->world_.add(Thruster<S>{id, vec<S>(0, 0, 0), vec<S>(6, 0, 0)}));
  run(this->world_, 30);
  expect_near(this->velocity(id), {1, 0, 0}, 0.002);
  this->world_.set_pose(id, {Vec3<S>::zero(), turn<S>({0, 1, 0}, kPi / 2)});
  this->world_.set_velocity(id, Vec3<S>::zero(), Vec3<S>::zero());
  run(this->world_, 30);
  expect_near(this->velocity(id), {0, 0, -1}, 0.002);
  // Off the centre it turns: I = m (x^2 + y^2) / 3 = 1.25.
  this->world_.set_pose(id, Pose<S>::identity());
  this->world_.set_velocity(id, Vec3<S>::zero(), Vec3<S>::zero());
  const auto ids = this->world_.state().force_records->thrusters.slots().template ids<ThrusterId>();
  ASSERT_EQ(ids.size(), 1u);
  EXPECT_TRUE(this->world_.set(ids[0], {id, vec<S>(0, 0.5, 0), vec<S>(3, 0, 0)}));
  run(this->world_, 6);
  EXPECT_NEAR(this->spin(id).z, -1.5 * 0.1 / 1.25, 0.003);
}

TYPED_TEST(Forces, buoyancy_floats_at_the_depth_of_its_mass) {  // O21; defect 28
  using S = TypeParam;
  const BodyId id = this->ball({0, 1, 0}, 5);
  BuoyancyPoint<S> buoyancy;
  buoyancy.body = id;
  buoyancy.max_depth = num<S>(0.5);
  buoyancy.volume = num<S>(0.02);
  buoyancy.surface_height = S(1);
  this->added(this->world_.add(buoyancy));
  run(this->world_, 6);
  // w^2 = density volume g / (2 max_depth m) = 40; begun 0.25 m below its place, from rest.
  EXPECT_NEAR(this->centre(id).y, 1.25 - 0.25 * std::cos(std::sqrt(40) * 0.1), 0.005);
  this->added(this->world_.add(BodyDrag<S>{id, S(20), S(0), S(0)}));
  run(this->world_, 600);
  EXPECT_NEAR(this->centre(id).y, 1 + 0.5 - 5 / 20.0, pick<S>(1e-4, 1e-6, 1e-2, 1e-5));
  EXPECT_LT(std::fabs(this->velocity(id).y), 0.001);
}

TYPED_TEST(Forces, surfaces_feel_the_air_at_their_point) {  // defect 35
  using S = TypeParam;
  this->weightless();
  const BodyId spinning = this->box({0, 0, 0}, {1, 0.25, 0.25}, 2), still = this->ball({0, 8, 0});
  this->world_.set_velocity(spinning, Vec3<S>::zero(), vec<S>(0, 0, 2));
  AeroSurface<S> surface;
  surface.body = spinning;
  surface.point = vec<S>(1, 0, 0);
  surface.tensor = Mat3<S>::diagonal(vec<S>(0, -1, 0));
  this->added(this->world_.add(surface));
  surface.body = still;
  surface.point = Vec3<S>::zero();
  surface.tensor = Mat3<S>::diagonal(vec<S>(-1, -1, -1));
  this->added(this->world_.add(surface));
  ForceZone<S> wind;
  wind.wind = vec<S>(0, 0, 4);
  wind.shape = ZoneShape::sphere;
  wind.pose.position = vec<S>(0, 8, 0);
  wind.half = vec<S>(3, 0, 0);
  this->added(this->world_.add(wind));
  run(this->world_, 30);
  EXPECT_LT(this->spin(spinning).z, 1.6);
  EXPECT_LT(this->velocity(spinning).y, -0.1);
  EXPECT_NEAR(this->velocity(still).z, 4 * (1 - std::exp(-0.25)), 0.01);
}

TYPED_TEST(Forces, control_surfaces_lead_from_one_tensor_to_another) {
  using S = TypeParam;
  this->weightless();
  const BodyId id = this->ball({0, 0, 0}, 1, {0, 0, 4});
  AeroSurface<S> surface;
  surface.body = id;
  const auto lift = [](double per_speed) {
    Mat3<S> m = Mat3<S>::diagonal(Vec3<S>::zero());
    m.rows[1].z = num<S>(per_speed);
    return m;
  };
  surface.tensor = lift(0.25), surface.low = lift(0), surface.high = lift(1);
  const AeroSurfaceId wing = this->added(this->world_.add(surface));
  double before = 0;
  for (const auto& [control, expected] : {std::pair{0.0, 0.25}, {-1.0, 0.0}, {-0.5, 0.125}, {0.5, 0.625}, {1.0, 1.0}}) {
    surface.control = num<S>(control);
    EXPECT_TRUE(this->world_.set(wing, surface));
    run(this->world_, 6);
    EXPECT_NEAR(this->velocity(id).y - before, 4 * expected * 0.1, 0.002) << control;
    before = this->velocity(id).y;
  }
}

TYPED_TEST(Forces, angled_surfaces_are_tensors_that_are_turned) {
  using S = TypeParam;
  this->weightless();
  const BodyId turned = this->ball({0, 0, 0}, 1, {3, 1, -2}), plain = this->ball({0, 4, 0}, 1, {3, 1, -2});
  AeroSurface<S> surface;
  surface.body = turned;
  surface.orientation = turn<S>({0.6, 0, 0.8}, 0.75);
  surface.tensor = {{vec<S>(-1, 0.25, 0), vec<S>(0, -0.5, 0), vec<S>(0, 0.25, -2)}};
  this->added(this->world_.add(surface));
  const Mat3<Unit<S>> r = to_matrix(surface.orientation);
  surface.tensor = change_of_basis(r, surface.tensor);
  surface.orientation = Quat<Unit<S>>::identity();
  surface.body = plain;
  this->added(this->world_.add(surface));
  run(this->world_, 60);
  expect_near(this->velocity(turned), this->velocity(plain), 400 * grain<S>() + 1e-12);
  EXPECT_LT(length(this->velocity(turned)), 3);
}

TYPED_TEST(Forces, large_tensors_are_stable) {
  using S = TypeParam;
  for (const bool quadratic : {false, true}) {
    const BodyId id = this->box({0, 0, 0}, {0.5, 0.25, 0.25}, 0.5);
    this->weightless();
    this->world_.set_velocity(id, vec<S>(4, -3, 2), vec<S>(1, 2, 3));
    AeroSurface<S> surface;
    surface.body = id;
    surface.point = vec<S>(0.5, 0.125, 0);
    surface.tensor = Mat3<S>::diagonal(vec<S>(-8000, -4000, -8000));
    surface.is_quadratic = quadratic;
    this->added(this->world_.add(surface));
    double energy = 1e9;
    for (int i = 0; i < 60; ++i) {
      this->world_.step();
      const double now = length(this->velocity(id)) + length(this->spin(id));
      EXPECT_LT(now, 12);
      energy = std::min(energy, now);
    }
    EXPECT_LT(length(this->velocity(id)), 4);
    this->world_.destroy(id);
  }
}

TYPED_TEST(Forces, zones_accelerate_what_is_inside_and_of_their_categories) {
  using S = TypeParam;
  const BodyId in = this->ball({0, 0, 0}), out = this->ball({0, 5, 0}), other = this->ball({2, 0, 0});
  this->world_.set_filter(other, {4, 0xffffffffu, 0});
  ForceZone<S> zone;
  zone.shape = ZoneShape::box;
  zone.pose.orientation = turn<S>({0, 0, 1}, kPi / 4);
  zone.half = vec<S>(2.5, 2.5, 1);
  zone.acceleration = vec<S>(0, 10, 2);
  zone.mask = 1;
  const ForceZoneId id = this->added(this->world_.add(zone));
  run(this->world_, 30);
  expect_near(this->velocity(in), {0, 0, 1}, 0.002);
  expect_near(this->velocity(out), {0, -5, 0}, 0.002);
  expect_near(this->velocity(other), {0, -5, 0}, 0.002);
  EXPECT_TRUE(this->world_.remove(id));
  run(this->world_, 30);
  expect_near(this->velocity(in), {0, -5, 1}, 0.002);
}

TYPED_TEST(Forces, attractors_keep_bodies_in_orbit) {
  using S = TypeParam;
  this->weightless();
  const BodyId planet = this->ball({4, 0, 0}, 1, {0, 0, 2}), far = this->ball({20, 0, 0});
  Attractor<S> sun;
  sun.strength = S(16);
  sun.range = S(10);
  this->added(this->world_.add(sun));
  for (int i = 0; i < 1200; ++i) {
    EXPECT_TRUE(this->world_.step().clean());
    EXPECT_NEAR(length(this->centre(planet)), 4, pick<S>(0.02, 0.02, 0.25, 0.02));
  }
  EXPECT_LT(this->centre(planet).x, 3.9);
  EXPECT_EQ(this->velocity(far).x, 0);
}

TYPED_TEST(Forces, bad_records_are_refused_by_name_and_change_nothing) {
  using S = TypeParam;
  const BodyId id = this->ball({0, 0, 0});
  const BodyId fixed = this->world_.create(still<S>(add_ball(this->world_, 0.5), {4, 0, 0}));
  const BodyId light = this->ball({12, 0, 0}, 0.0625), gone = this->ball({8, 0, 0});
  this->world_.destroy(gone);
  const std::uint64_t before = this->world_.hash();
  const auto refused = [&](auto record, const char* field) {
    EXPECT_FALSE(this->world_.add(record)) << field;
    EXPECT_STREQ(this->world_.fault().field, field);
    EXPECT_NE(std::string(this->world_.fault().expected) + std::string(this->world_.fault().field), "");
    EXPECT_EQ(this->world_.hash(), before) << field;
  };
  const auto spring = [&](auto edit) {
    BodySpring<S> s;
    s.a = id, s.stiffness = S(1);
    edit(s);
    return s;
  };
  refused(spring([&](auto& s) { s.a = gone; }), "a");
  refused(spring([&](auto& s) { s.b = id; }), "b");
  refused(spring([&](auto& s) { s.a = fixed; }), "a, b");
  refused(spring([&](auto& s) { s.a = light, s.stiffness = highest<S>(); }), "stiffness");
  refused(spring([&](auto& s) { s.a = light, s.damping = highest<S>(); }), "damping");
  refused(spring([&](auto& s) { s.damping = S(-1); }), "damping");
  refused(spring([&](auto& s) { s.rest_length = S(-1); }), "rest_length");
  refused(spring([&](auto& s) { s.anchor_a.x = Limits<S>::position() * S(1.5); }), "anchor_a");
  refused(BodyDrag<S>{fixed, S(1), S(1), S(1)}, "body");
  refused(BodyDrag<S>{id, S(-1), S(1), S(1)}, "linear");
  refused(BodyDrag<S>{id, S(1), S(-1), S(1)}, "quadratic");
  refused(BodyDrag<S>{id, S(1), S(1), S(-1)}, "angular");
  refused(Thruster<S>{{}, Vec3<S>::zero(), Vec3<S>::zero()}, "body");
  BuoyancyPoint<S> buoyancy;
  buoyancy.body = id;
  buoyancy.max_depth = S(0);
  refused(buoyancy, "max_depth");
  AeroSurface<S> surface;
  surface.body = id;
  surface.control = S(1.5);
  refused(surface, "control");
  surface.control = S(0);
  surface.orientation.w = Unit<S>(0.5);
  refused(surface, "orientation");
  Attractor<S> attractor;
  attractor.body = gone;
  refused(attractor, "body");
  attractor.body = {};
  attractor.least_distance = S(0);
  refused(attractor, "least_distance");
  ForceZone<S> zone;
  zone.shape = static_cast<ZoneShape>(3);
  refused(zone, "shape");
  zone.shape = ZoneShape::box;
  zone.half.z = S(-1);
  refused(zone, "half");
  EXPECT_FALSE(this->world_.remove(DragId{0, 1}));
  EXPECT_FALSE(this->world_.set(ThrusterId{0, 1}, {id, Vec3<S>::zero(), Vec3<S>::zero()}));
  EXPECT_EQ(this->world_.find(AeroSurfaceId{3, 1}), nullptr);
  EXPECT_EQ(this->world_.hash(), before);
}

TYPED_TEST(Forces, go_with_the_bodies_that_they_name) {
  using S = TypeParam;
  const BodyId a = this->ball({0, 0, 0}), b = this->ball({2, 0, 0});
  const DragId drag = this->added(this->world_.add(BodyDrag<S>{a, S(1), S(0), S(0)}));
  const DragId kept = this->added(this->world_.add(BodyDrag<S>{b, S(1), S(0), S(0)}));
  BodySpring<S> spring;
  spring.a = b, spring.b = a;
  const BodySpringId tie = this->added(this->world_.add(spring));
  ASSERT_NE(this->world_.find(tie), nullptr);
  this->world_.destroy(a);
  EXPECT_EQ(this->world_.find(drag), nullptr);
  EXPECT_EQ(this->world_.find(tie), nullptr);
  EXPECT_NE(this->world_.find(kept), nullptr);
  run(this->world_, 3);
}

TYPED_TEST(Forces, springs_sleep_and_wake_with_both_of_their_bodies) {
  using S = TypeParam;
  this->sleeps_ = true;
  add_ground(this->world_);
  const BodyId a = this->ball({0, 0.5, 0}), b = this->ball({3, 0.5, 0}), alone = this->ball({-6, 0.5, 0});
  BodySpring<S> spring;
  spring.a = a, spring.b = b, spring.rest_length = S(3), spring.stiffness = S(50), spring.damping = S(4);
  this->added(this->world_.add(spring));
  ASSERT_TRUE(settle(this->world_));
  this->world_.wake(a);
  EXPECT_TRUE(this->world_.is_awake(b));
  EXPECT_FALSE(this->world_.is_awake(alone));
  ASSERT_TRUE(settle(this->world_));
  const ThrusterId push = this->added(this->world_.add(Thruster<S>{alone, Vec3<S>::zero(), vec<S>(0, 1, 0)}));
  EXPECT_TRUE(this->world_.is_awake(alone));
  EXPECT_FALSE(this->world_.is_awake(a));
  ASSERT_TRUE(settle(this->world_)) << "a steady force lets rest what it does not move";
  this->world_.remove(push);
  EXPECT_TRUE(this->world_.is_awake(alone));
  this->added(this->world_.add(ForceZone<S>{}));
  EXPECT_TRUE(this->world_.is_awake(a));
}

TYPED_TEST(Forces, driven_ends_keep_springs_awake) {
  using S = TypeParam;
  this->sleeps_ = true;
  add_ground(this->world_);
  BodyDefinition<S> d = moving<S>(add_ball(this->world_, 0.25), {0, 4, 0});
  d.type = BodyType::kinematic;
  const BodyId driven = this->world_.create(d), body = this->ball({0, 0.5, 0});
  BodySpring<S> spring;
  spring.a = driven, spring.b = body, spring.rest_length = S(1), spring.stiffness = S(2), spring.damping = S(1);
  this->added(this->world_.add(spring));
  for (int i = 0; i < 300 && this->world_.is_awake(body); ++i) this->world_.step();
  ASSERT_FALSE(this->world_.is_awake(body));
  this->world_.set_velocity(driven, vec<S>(0, 4, 0), Vec3<S>::zero());
  EXPECT_TRUE(this->world_.is_awake(body));
  run(this->world_, 300);
  EXPECT_GT(this->centre(body).y, 1);
}

TYPED_TEST(Forces, are_state) {
  using S = TypeParam;
  const BodyId id = this->ball({0, 4, 0}), other = this->ball({2, 4, 0});
  const std::vector<std::uint8_t> plain = bytes_of(this->world_);
  const DragId drag = this->added(this->world_.add(BodyDrag<S>{id, S(1), S(1), S(1)}));
  BodySpring<S> spring;
  spring.a = id, spring.b = other, spring.stiffness = S(20);
  this->added(this->world_.add(spring));
  EXPECT_GT(bytes_of(this->world_).size(), plain.size());
  typename World<S>::Snapshot snapshot;
  this->world_.save(snapshot);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 30; ++i) {
    if (i == 10) this->world_.remove(drag);
    this->world_.step();
    hashes.push_back(this->world_.hash());
  }
  ASSERT_TRUE(this->world_.load(snapshot));
  EXPECT_NE(this->world_.find(drag), nullptr);
  World<S> read(settings<S>(5, 10, 1));
  const std::vector<std::uint8_t> bytes = bytes_of(this->world_);
  Reader reader(bytes);
  ASSERT_TRUE(read.read_portable(reader).ok());
  EXPECT_EQ(read.hash(), this->world_.hash());
  for (int i = 0; i < 30; ++i) {
    for (World<S>* w : {&this->world_, &read}) {
      if (i == 10) {
        EXPECT_TRUE(w->remove(drag));
      }
      w->step();
      EXPECT_EQ(w->hash(), hashes[static_cast<std::size_t>(i)]) << i;
    }
  }
}

}  // namespace
}  // namespace isostep::test
