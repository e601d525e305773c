// Bullets do not pass what comes towards them, whatever the two are and however they turn.
// SPDX-License-Identifier: MIT

#include "random/dice.hpp"

namespace isostep::test {
namespace bullets_meet_test {

template <class S> class BulletsThatMeet : public ::testing::Test {
 protected:
  /// [m/s, rad/s] The speed and spin of each; within Q16.16's limits with room.
  static constexpr double kSpeed = std::is_same_v<S, Q16_16> ? 40 : 200, kSpin = std::is_same_v<S, Q16_16> ? 30 : 60;

  static ShapeId add_shape(World<S>& w, std::uint32_t kind, double size) {
    switch (kind) {
      case 0: return add_ball(w, size);
      case 1: return add_box(w, size, size, size);
      case 2: return w.add_shape(Capsule<S>{num<S>(size / 4), num<S>(2 * size)});
      case 3: return add_box(w, size / 4, 2 * size, 2 * size);
      default: return add_two_boxes<S>(w, {size, size, size}, {size, 0, 0}, {size, size / 2, size}, {-size, 0, 0});
    }
  }
  /// Its middle is at the origin after `time`.
  static BodyDefinition<S> draw_body(Dice& dice, World<S>& w, std::uint32_t kind, D3 velocity, double time) {
    const ShapeId shape = add_shape(w, kind, dice.magnitude(0.0625, 0.5));
    BodyDefinition<S> d = moving<S>(shape, velocity * -time, velocity);
    d.orientation = dice.template orientation<S>();
    if (dice.one_in(2)) d.angular_velocity = vec<S>(dice.arrow(0, kSpin));
    d.mass = num<S>(dice.magnitude(0.25, 4));
    return d;
  }
  /// Two bodies whose middles would be in one place at once. Whether they touched.
  static bool meet(std::uint64_t seed) {
    Dice dice(seed);
    World<S> w(settings<S>(0));
    const double fast = dice.magnitude(4, kSpeed), slow = dice.one_in(4) ? 0 : dice.magnitude(1, fast);
    const bool bullet_is_fast = dice.one_in(2);
    const D3 way = dice.direction(), other_way = dice.direction();
    const double time = dice.in(0.05, 0.1) + 3 / fast;
    const double along = dot(way, other_way) * slow < fast / 2 ? 1 : -1;  // they meet, and do not fly side by side
    BodyDefinition<S> a = draw_body(dice, w, dice.below(5), way * fast, time);
    BodyDefinition<S> b = draw_body(dice, w, dice.below(5), other_way * (slow * along), time);
    (bullet_is_fast ? a : b).bullet = true;
    if (dice.one_in(2)) std::swap(a, b);
    EXPECT_TRUE(w.create(a) && w.create(b));
    for (int step = 0; step < static_cast<int>(time * 60) + 4; ++step) {
      w.step();
      if (!w.events().contact_begin.empty()) return true;
    }
    return false;
  }
};
TYPED_TEST_SUITE(BulletsThatMeet, AllScalars);

TYPED_TEST(BulletsThatMeet, touch) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) EXPECT_TRUE(this->meet(seed)) << seed;
}

/// As they meet half a metre apart in phase: at 100 m/s both go further in a step than the cube is wide.
TYPED_TEST(BulletsThatMeet, a_cube_head_on_at_every_phase_do_not_end_behind_it) {
  using S = TypeParam;
  for (int phase = 0; phase < 50; ++phase) {
    World<S> w(settings<S>(0));
    const double apart = 5 + phase * 0.04, speed = std::is_same_v<S, Q16_16> ? 60 : 100;
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.125), {-apart, 0, 0}, {speed, 0, 0});
    d.bullet = true;
    d.mass = S(1);
    const BodyId bullet = w.create(d);
    d = moving<S>(add_box(w, 0.5, 0.5, 0.5), {apart, 0, 0}, {-speed, 0, 0});
    d.mass = S(1);
    const BodyId cube = w.create(d);
    for (int step = 0; step < 15; ++step) w.step();
    EXPECT_LT(to_double(w.center_of_mass(bullet).x), to_double(w.center_of_mass(cube).x) - 0.6) << phase;
  }
}

/// In the frame of what turns a bullet goes along a bow: taken for straight, it passes the blade of a fan.
TYPED_TEST(BulletsThatMeet, what_a_motor_turns_touch) {
  using S = TypeParam;
  for (int i = 0; i < 160; ++i) {
    World<S> w(settings<S>(0));
    const double speed = i % 2 == 0 ? 40 : std::is_same_v<S, Q16_16> ? 50 : 200;
    const double spin = this->kSpin * (1 + i % 3) / 3;
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.0625), {-10 - i * speed / 60 / 160, 0.015625, 0}, {speed, 0, 0});
    d.bullet = true;
    d.mass = S(1);
    w.create(d);
    d = moving<S>(i % 4 < 2 ? add_box(w, 0.15, 0.15, 0.15) : add_ball(w, 0.15), {0, 0, 0});
    d.type = BodyType::kinematic;
    d.angular_velocity = vec<S>(0, spin, 0);
    w.create(d);
    bool touched = false;
    for (int step = 0; step < 20 / speed * 60 + 8; ++step) {
      w.step();
      touched = touched || !w.events().contact_begin.empty();
    }
    EXPECT_TRUE(touched) << i << ": " << speed << " m/s, " << spin << " rad/s";
  }
}

/// A bullet that a plate carries along does not go through the wall behind it.
TYPED_TEST(BulletsThatMeet, a_plate_in_front_of_a_wall_are_not_pressed_through_it) {
  using S = TypeParam;
  for (int phase = 0; phase < 50; ++phase) {
    World<S> w(settings<S>(0));
    w.create(still<S>(add_box(w, 0.03125, 2, 2)));
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.125), {0.25 + phase * 0.005, 0, 0});
    d.bullet = true;
    d.mass = S(1);
    const BodyId bullet = w.create(d);
    d = moving<S>(add_box(w, 0.0625, 0.5, 0.5), {4 + phase * 0.02, 0, 0}, {-50, 0, 0});
    d.mass = S(1);
    w.create(d);
    for (int step = 0; step < 15; ++step) w.step();
    EXPECT_GT(to_double(w.center_of_mass(bullet).x), 0) << phase;
  }
}

}  // namespace bullets_meet_test
}  // namespace isostep::test
