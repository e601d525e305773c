// Defects of the book's own source (Cyclone) that concern bodies in a world: none of them happens here. The numbers are
// those of the list of 37. Particles: particle_defects_test.cpp; the book's resolver: worst_first_defects_test.cpp.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace book_defects_test {

template <class S> class BookDefects : public ::testing::Test {
 protected:
  /// A ball of 2 kg, radius 0.5.
  static BodyId add_two_kilos(World<S>& w, D3 at, D3 velocity = {0, 0, 0}) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), at, velocity);
    d.mass = S(2);
    return w.create(d);
  }
  /// [N] The force on the ball of 2 kg, from the speed that one step gives it.
  static double force_of_a_step(World<S>& w, BodyId id, double hz = 64) {
    const double before = real(w.velocity(id)).y;
    EXPECT_TRUE(w.step().clean());
    return (real(w.velocity(id)).y - before) * hz * 2;
  }
  /// A force of every kind that names no body, each strong enough to move what is dynamic.
  static void add_forces_of_the_world(World<S>& w) {
    ForceZone<S> zone;
    zone.acceleration = vec<S>(3, 4, 5);
    Attractor<S> attractor;
    attractor.point = vec<S>(4, 0, 0);
    attractor.strength = S(50);
    Water<S> water;
    water.surface_height = S(8);
    water.current = vec<S>(2, 0, 0);
    Explosion<S> explosion;
    explosion.centre = vec<S>(0, -3, 1);
    explosion.wave_force = S(1000);
    explosion.wave_duration = S(1);
    EXPECT_TRUE(w.add(zone) && w.add(attractor) && w.add(water) && w.add(explosion));
  }
};
TYPED_TEST_SUITE(BookDefects, AllScalars);

// 1, 3. Boxes had one contact a pair, written without a look at the end of the array; of a hundred that were dropped,
// 23 fell through the floor when the buffer of 256 contacts was full.
TYPED_TEST(BookDefects, a_hundred_dropped_boxes_stay_above_the_floor_and_all_sleep) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  for (int i = 0; i < 100; ++i) {
    const D3 at = {1.25 * (i % 4) + 0.125 * (i / 16), 1 + 1.25 * (i / 16), 1.25 * (i / 4 % 4) - 0.0625 * (i % 5)};
    BodyDefinition<S> d = moving<S>(box, at);
    d.orientation = turn<S>({0, 1, 0}, 0.1 * i);
    w.create(d);
  }
  std::uint32_t most_points = 0;
  for (int i = 0; i < 1800 && w.counts().awake > 0; ++i) {
    ASSERT_TRUE(w.step().clean());
    most_points = std::max(most_points, w.counts().points);
  }
  EXPECT_GT(most_points, 256u);
  EXPECT_EQ(w.counts().awake, 0u);
  for (const BodyId id : w.bodies()) {
    if (w.type(id) != BodyType::dynamic) continue;
    EXPECT_GT(real(w.center_of_mass(id)).y, 0.45);
  }
}

// 7. The cross product of parallel edges is zero: 0 < 0 told aligned boxes that overlap as apart.
TYPED_TEST(BookDefects, aligned_boxes_that_overlap_are_told_to) {
  using S = TypeParam;
  const D3 half = {0.5, 0.25, 0.75};
  World<S> w(settings<S>());
  const BodyId body = w.create(still<S>(add_box(w, half.x, half.y, half.z)));
  const QueryShape<S> asked(primitive_of(Box<S>{vec<S>(half)}));
  for (int axis = 0; axis < 3; ++axis) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      D3 about = {0, 0, 0}, turned = half;
      about[axis] = 1;
      if (quarters % 2 == 1) std::swap(turned[(axis + 1) % 3], turned[(axis + 2) % 3]);
      for (int away = 0; away < 3; ++away) {
        for (const double off : {-1.0 / 64, 1.0 / 64}) {
          D3 at = {0, 0, 0};
          at[away] = half[away] + turned[away] + off;
          const Pose<S> pose = {vec<S>(at), turn<S>(about, quarters * kPi / 2)};
          const auto found = w.overlap_first(asked, pose);
          EXPECT_EQ(found.has_value(), off < 0) << axis << quarters << away;
          EXPECT_EQ(found.value_or(OverlapHit{}).body, off < 0 ? body : BodyId{});
        }
      }
    }
  }
}

// 16. Something slow, or thrown slowly, fell asleep where it was: at 0.5 m/s after 2.8 s, or in mid-air after 1.4 s.
TYPED_TEST(BookDefects, what_is_thrown_comes_down_again) {
  using S = TypeParam;
  for (const double gravity : {0.5, 2.0, 10.0}) {
    for (const double speed : {0.25, 0.5, 2.0}) {
      World<S> w(settings<S>(-gravity, 64, 4));
      const BodyId id = this->add_two_kilos(w, {0, 0, 0}, {0, speed, 0});
      const int steps = static_cast<int>(2 * speed / gravity * 64);
      for (int i = 0; i < steps; ++i) {
        w.step();
        ASSERT_TRUE(w.is_awake(id)) << gravity << " m/s^2, step " << i;
      }
      EXPECT_NEAR(real(w.velocity(id)).y, speed - gravity * steps / 64, 0.001);
      EXPECT_NEAR(real(w.center_of_mass(id)).y, 0, 0.02 * speed + 0.001);
    }
  }
}

// 16. v^2 + w^2 were one number, and its weighted mean fell below the bound for whatever moved evenly and slowly.
TYPED_TEST(BookDefects, moving_and_turning_each_keep_a_body_awake) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId drifting = this->add_two_kilos(w, {0, 0, 0}, {0.5, 0, 0});
  const BodyId creeping = this->add_two_kilos(w, {0, 4, 0}, {0, 0, 0.0625});
  const BodyId turning = this->add_two_kilos(w, {0, 8, 0}), still = this->add_two_kilos(w, {0, 12, 0});
  w.set_velocity(turning, Vec3<S>::zero(), vec<S>(0, 0.0625, 0));
  w.set_velocity(still, vec<S>(0.03125, 0, 0), vec<S>(0, 0.03125, 0));
  run(w, 600);
  EXPECT_TRUE(w.is_awake(drifting) && w.is_awake(creeping) && w.is_awake(turning));
  EXPECT_FALSE(w.is_awake(still));
  EXPECT_NEAR(real(w.center_of_mass(drifting)).x, 5, 0.01);
}

// 18. A force that was registered woke its body every frame: it flickered between sleep and waking.
TYPED_TEST(BookDefects, what_rests_under_steady_forces_sleeps_through) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const BodyId id = this->add_two_kilos(w, {0, 0.5, 0});
  ForceZone<S> zone;
  zone.acceleration = vec<S>(0, -2, 0);
  Attractor<S> attractor;
  attractor.point = vec<S>(0, -9, 0);
  attractor.strength = S(20);
  EXPECT_TRUE(w.add(zone) && w.add(attractor) && w.add(BodyDrag<S>{id, S(1), S(1), S(1)}));
  EXPECT_TRUE(w.add(Thruster<S>{id, Vec3<S>::zero(), vec<S>(0, 2, 0)}));
  ASSERT_TRUE(settle(w));
  std::size_t told = 0;
  for (int i = 0; i < 300; ++i) {
    w.step();
    told += w.events().woke.size() + w.events().fell_asleep.size();
  }
  EXPECT_EQ(told, 0u);
  EXPECT_FALSE(w.is_awake(id));
}

// 19, 20. What cannot be moved fell by its acceleration, 5 m in a second, and was told to have a finite mass.
TYPED_TEST(BookDefects, what_is_fixed_or_driven_feels_no_force) {
  using S = TypeParam;
  World<S> w(settings<S>());
  this->add_forces_of_the_world(w);
  BodyDefinition<S> d = still<S>(add_box(w, 0.5, 0.5, 0.5), {1, 2, 3});
  const BodyId fixed = w.create(d);
  d.type = BodyType::kinematic;
  d.position = vec<S>(-3, 2, 3);
  const BodyId driven = w.create(d), free = this->add_two_kilos(w, {0, 2, -4});
  for (const BodyId id : {fixed, driven}) {
    EXPECT_EQ(w.mass(id), S(0));
    EXPECT_FALSE(w.apply_force(id, vec<S>(1, 2, 3)));
    EXPECT_FALSE(w.apply_impulse(id, vec<S>(1, 2, 3)));
    EXPECT_EQ(w.fault().fault, Fault::not_dynamic);
  }
  run(w, 120);
  EXPECT_EQ(w.pose(fixed).position, vec<S>(1, 2, 3));
  EXPECT_EQ(w.pose(driven).position, vec<S>(-3, 2, 3));
  EXPECT_EQ(w.velocity(driven), Vec3<S>::zero());
  EXPECT_GT(length(real(w.velocity(free))), 1);
}

// 24. X was (0, 1, 0) and Y was (1, 0, 0).
TYPED_TEST(BookDefects, axes_have_one_order_everywhere) {
  using S = TypeParam;
  for (int k = 0; k < 3; ++k) {
    D3 axis = {0, 0, 0};
    axis[k] = 1;
    World<S> w(settings<S>(0, 64, 4));
    w.set_gravity(vec<S>(axis));
    const BodyId id = this->add_two_kilos(w, {0, 0, 0});
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {9, 0, 0}, {1, 1, 1});
    d.gravity_scale = S(0);
    d.angular_velocity = vec<S>(1, 1, 1);
    d.locks = (body_flag::kLockX | body_flag::kLockAngularX) << k;
    const BodyId locked = w.create(d);
    run(w, 64);
    expect_near(real(w.velocity(id)), axis, 0.001, "gravity");
    expect_near(real(w.velocity(locked)), D3{1, 1, 1} - axis, 0.001, "lock");
    expect_near(real(w.angular_velocity(locked)), D3{1, 1, 1} - axis, 0.001, "lock of turning");
    // Right-handed: a quarter of a turn about each axis leads from the next one to the one after that.
    D3 next = {0, 0, 0}, last = {0, 0, 0};
    next[(k + 1) % 3] = last[(k + 2) % 3] = 1;
    expect_near(rotated<S>(turn<S>(axis, kPi / 2), next), last, 1e-6, "turn");
    const Vec3<Unit<S>> turned = rotate(rotation<S>(vec<Unit<S>>(axis), num<S>(kPi / 2)), vec<Unit<S>>(next));
    expect_near(real(turned), last, pick<S>(1e-6, 1e-15, 1e-5, 1e-9), "rotation");
  }
}

// 25. What was nearly zero kept its imaginary part.
TYPED_TEST(BookDefects, a_quaternion_of_any_size_becomes_one_of_unit_length) {
  using U = Unit<TypeParam>;
  const int last = kIsFixed<TypeParam> ? (sizeof(TypeParam) == 4 ? 30 : 62) : sizeof(TypeParam) == 4 ? 60 : 480;
  for (int power = 0; power <= last; ++power) {
    U size = U(1);
    for (int i = 0; i < power; ++i) size = size * U(0.5);
    for (const double w : {0.0, 0.5, 1.0}) {
      const Quat<U> q = normalise(Quat<U>{size, -size, U(0), size * num<U>(w)});
      const double x = to_double(q.x), y = to_double(q.y), r = to_double(q.w);
      ASSERT_NEAR(x * x + y * y + r * r, 1, 1e-6) << "2^-" << power;
      EXPECT_EQ(q.z, U(0));
    }
  }
  EXPECT_EQ(normalise(Quat<U>{U(0), U(0), U(0), U(0)}), Quat<U>::identity());
}

// 26, 27. abs() made a compressed spring pull, and a wrong sign made a stretched bungee push.
TYPED_TEST(BookDefects, springs_push_and_pull_by_hookes_law_and_bungees_only_pull) {
  using S = TypeParam;
  for (const bool only_pulls : {false, true}) {
    for (const double at : {1.0, 3.0, 5.0}) {
      World<S> w(settings<S>(0, 64, 1));
      const BodyId a = this->add_two_kilos(w, {0, at, 0}), b = this->add_two_kilos(w, {0, 0, 0});
      BodySpring<S> spring;
      spring.a = a, spring.b = b;
      spring.rest_length = S(3);
      spring.stiffness = S(10);
      spring.only_pulls = only_pulls;
      w.set_filter(a, {1, 0, 0});
      ASSERT_TRUE(w.add(spring));
      const double expected = only_pulls && at < 3 ? 0 : 10 * (3 - at);
      EXPECT_NEAR(this->force_of_a_step(w, a), expected, 0.002) << at;
      EXPECT_NEAR(real(w.velocity(b)).y * 64 * 2, -expected, 0.002) << at;
    }
  }
}

// 28. Partly under water the force pointed down, grew to the whole of it and then jumped; gravity was not in it, and it
// was multiplied by the depth instead of divided.
TYPED_TEST(BookDefects, buoyancy_points_up_and_grows_with_depth_without_a_jump) {
  using S = TypeParam;
  constexpr double kDepth = 0.5, kDensity = 16, kVolume = 0.25;
  for (int i = 0; i <= 16; ++i) {
    const double sunk = 2 * kDepth * (i - 2) / 12;
    World<S> w(settings<S>(-10, 64, 1));
    const BodyId id = this->add_two_kilos(w, {0, 2 + kDepth - sunk, 0});
    BuoyancyPoint<S> buoyancy;
    buoyancy.body = id;
    buoyancy.max_depth = num<S>(kDepth);
    buoyancy.volume = num<S>(kVolume);
    buoyancy.density = num<S>(kDensity);
    buoyancy.surface_height = S(2);
    ASSERT_TRUE(w.add(buoyancy));
    const double share = std::min(std::max(sunk / (2 * kDepth), 0.0), 1.0);
    EXPECT_NEAR(this->force_of_a_step(w, id) + 2 * 10, share * kDensity * kVolume * 10, 0.01) << i;
  }
}

// 33. Worlds could not be given bodies, and registries could neither remove nor clear.
TYPED_TEST(BookDefects, every_kind_of_record_comes_is_changed_and_goes) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId id = this->add_two_kilos(w, {0, 0, 0});
  const auto goes = [&](auto record) {
    const auto added = w.add(record);
    ASSERT_TRUE(added) << w.fault().field;
    ASSERT_NE(w.find(added), nullptr);
    EXPECT_TRUE(w.set(added, record));
    EXPECT_TRUE(w.remove(added));
    EXPECT_EQ(w.find(added), nullptr);
    EXPECT_FALSE(w.remove(added) || w.set(added, record));
    EXPECT_EQ(w.fault().fault, Fault::stale_id);
  };
  ForceZone<S> zone;
  zone.acceleration = vec<S>(1, 2, 3);
  BodySpring<S> spring;
  spring.a = id, spring.anchor_b = vec<S>(2, 0, 0), spring.stiffness = S(10);
  AeroSurface<S> wing;
  wing.body = id, wing.tensor = Mat3<S>::diagonal(vec<S>(1, 1, 1));
  MaterialPair<S> pair;
  pair.kind_a = 1, pair.kind_b = 2;
  Breakable<S> breakable;
  breakable.body = id;
  BuoyancyPoint<S> buoyancy;
  buoyancy.body = id, buoyancy.volume = num<S>(0.125);
  Attractor<S> attractor;
  attractor.strength = S(10), attractor.point = vec<S>(3, 0, 0);
  Explosion<S> explosion;
  explosion.wave_force = S(100), explosion.wave_duration = S(1), explosion.centre = vec<S>(3, 0, 0);
  goes(zone), goes(spring), goes(wing), goes(pair), goes(breakable), goes(buoyancy), goes(attractor), goes(explosion);
  goes(Water<S>{}), goes(BodyDrag<S>{id, S(1), S(0), S(0)}), goes(Thruster<S>{id, {}, vec<S>(0, 1, 0)});
  run(w, 60);
  EXPECT_EQ(w.center_of_mass(id), Vec3<S>::zero()) << "something still acts";
}

// 34. A joint was free inside its slack, only ever pulled, and had a normal of length zero where its anchors meet.
TYPED_TEST(BookDefects, a_ball_joint_holds_both_ways_without_slack) {
  using S = TypeParam;
  for (const double gravity : {-10.0, 0.0, 10.0}) {
    World<S> w(settings<S>(gravity));
    const BodyId id = w.create(moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 0, 0}));
    const JointId pin = w.create(w.joint_at(JointType::ball, {}, id, Pose<S>::identity()));
    ASSERT_TRUE(pin);
    double worst = 0;
    for (int i = 0; i < 240; ++i) {
      ASSERT_TRUE(w.step().clean());
      worst = std::max(worst, to_double(w.joint_error(pin)));
    }
    EXPECT_LE(worst, gravity == 0 ? 0 : 1e-3) << gravity;
    expect_near(real(w.center_of_mass(id)), {0, 0, 0}, gravity == 0 ? 0 : 1e-3, "it hangs where it is held");
  }
}

// 35. The wind was added to the velocity, and no force grew with the speed squared.
TYPED_TEST(BookDefects, surfaces_meet_the_air_less_its_wind_and_its_square_if_told_so) {
  using S = TypeParam;
  const auto slowing = [&](double speed, double wind, bool quadratic) {
    World<S> w(settings<S>(0, 64, 1));
    const BodyId id = this->add_two_kilos(w, {0, 0, 0}, {0, speed, 0});
    ForceZone<S> air;
    air.wind = vec<S>(0, wind, 0);
    AeroSurface<S> wing;
    wing.body = id;
    wing.tensor = Mat3<S>::diagonal(vec<S>(0, -0.03125, 0));
    wing.is_quadratic = quadratic;
    EXPECT_TRUE(w.add(air) && w.add(wing));
    return -this->force_of_a_step(w, id) / 0.03125;
  };
  for (const bool quadratic : {false, true}) {
    EXPECT_NEAR(slowing(4, 4, quadratic), 0, 0.01);
    EXPECT_NEAR(slowing(0, 4, quadratic), quadratic ? -16 : -4, 0.05);
    EXPECT_NEAR(slowing(4, 0, quadratic), quadratic ? 16 : 4, 0.05);
    EXPECT_NEAR(slowing(4, -4, quadratic), quadratic ? 64 : 8, 0.2);
  }
}

}  // namespace book_defects_test
}  // namespace isostep::test
