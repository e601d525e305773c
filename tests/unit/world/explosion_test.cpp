// Explosions: each phase against its formula, whom they reach, what they leave, and rollbacks through the middle.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace explosion_test {

template <class S> class Explosions : public ::testing::Test {
 protected:
  explicit Explosions() : world_(settings<S>(0)) {}

  BodyId body(ShapeId shape, D3 at, double mass, D3 velocity = {0, 0, 0}) {
    BodyDefinition<S> d = moving<S>(shape, at, velocity);
    d.mass = num<S>(mass);
    return world_.create(d);
  }
  BodyId ball(D3 at, double mass) { return body(add_ball(world_, 0.25), at, mass); }
  static Explosion<S> wave(double force, double duration = 1) {
    Explosion<S> e;
    e.wave_force = num<S>(force);
    e.wave_duration = num<S>(duration);
    return e;
  }
  ExplosionId ignite(const Explosion<S>& e) {
    const ExplosionId id = world_.add(e);
    EXPECT_TRUE(id) << world_.fault().field << " " << world_.fault().expected;
    return id;
  }
  D3 velocity(BodyId id) const { return real(world_.velocity(id)); }
  double spin(BodyId id) const { return length(real(world_.angular_velocity(id))); }

  World<S> world_;
};
TYPED_TEST_SUITE(Explosions, AllScalars);

TYPED_TEST(Explosions, a_wave_gives_what_is_heavy_the_impulse_of_its_width) {  // O25
  using S = TypeParam;
  // Thinner than a sub-step's way, and 64 of them long.
  for (const double width : {0.0625, 6.0}) {
    const double mass = 1000, force = 4000, k = 0.5, speed = 50, distance = 12, duration = 4;
    const BodyId id = this->ball({distance, 0, 0}, mass);
    Explosion<S> e = this->wave(force, duration);
    e.wave_width = num<S>(width);
    const ExplosionId blast = this->ignite(e);
    run(this->world_, 120);
    // The fade is a line, and the profile is even about the middle of its plateau: that counts, as it passes the point.
    const double fade = 1 - (distance - 0.25 - width / 2) / speed / duration;
    const double impulse = force * width * (1 + k) / speed * fade;
    EXPECT_NEAR(this->velocity(id).x * mass / impulse, 1, pick<S>(3e-3, 3e-3, 0.01, 3e-3)) << width;
    EXPECT_EQ(this->spin(id), 0);
    this->world_.destroy(id);
    this->world_.remove(blast);
  }
}

TYPED_TEST(Explosions, implosions_pull_within_their_shell) {
  using S = TypeParam;
  const BodyId near = this->ball({1, 0, 0}, 2), in = this->ball({4, 0, 0}, 2), far = this->ball({9, 0, 0}, 2);
  Explosion<S> e;
  e.implosion_force = S(16);
  e.implosion_least = S(2);
  e.implosion_most = S(6);
  e.implosion_duration = num<S>(0.25);
  this->ignite(e);
  run(this->world_, 30);
  EXPECT_EQ(this->velocity(near).x, 0);
  EXPECT_NEAR(this->velocity(in).x, -2, 1e-2);
  EXPECT_EQ(this->velocity(far).x, 0);
}

TYPED_TEST(Explosions, chimneys_lift_what_is_over_them) {
  using S = TypeParam;
  this->world_.set_gravity(vec<S>(0, -1, 0));
  const BodyId over = this->ball({0, 2, 0}, 2), aside = this->ball({1, 2, 0}, 2), below = this->ball({0, -2, 0}, 2);
  const BodyId out = this->ball({3, 2, 0}, 2);
  Explosion<S> e;
  e.chimney_force = S(20);
  e.chimney_radius = S(2);
  e.chimney_height = S(8);
  e.chimney_duration = num<S>(0.5);
  this->ignite(e);
  run(this->world_, 15);
  EXPECT_NEAR(this->velocity(over).y, (10 - 1) * 0.25, 0.02);
  EXPECT_GT(this->velocity(aside).y, 0);
  EXPECT_LT(this->velocity(aside).y, this->velocity(over).y);
  EXPECT_GT(this->velocity(aside).x, 0);
  EXPECT_NEAR(this->velocity(below).y, -0.25, 1e-2);
  EXPECT_NEAR(this->velocity(out).y, -0.25, 1e-2);
}

TYPED_TEST(Explosions, bodies_spin_that_are_not_met_in_the_middle) {
  const ShapeId plank = add_box(this->world_, 2, 0.125, 0.125);
  const BodyId met = this->body(plank, {4, 3, 0}, 2), straight = this->body(plank, {0, -3, 0}, 2);
  this->ignite(this->wave(200));
  run(this->world_, 30);
  EXPECT_GT(this->spin(met), 0.5);
  EXPECT_NEAR(this->spin(straight), 0, 1e-3);
  EXPECT_LT(this->velocity(straight).y, -1);
}

TYPED_TEST(Explosions, mirrored_scenes_stay_mirrored) {  // O26
  using S = TypeParam;
  const ShapeId box = add_box(this->world_, 0.5, 0.25, 0.375);
  const BodyId a = this->body(box, {3, 1, 2}, 2), b = this->body(box, {-3, 1, 2}, 2);
  this->ignite(this->wave(300));
  run(this->world_, 60);
  const D3 v = this->velocity(a), w = this->velocity(b);
  EXPECT_GT(length(v), 1);
  const double tolerance = kIsFixed<S> ? 60 * 8 * speed_grain<S>() : 0;
  expect_near({-v.x, v.y, v.z}, w, tolerance);
  const D3 spin = real(this->world_.angular_velocity(a));
  expect_near({spin.x, -spin.y, -spin.z}, real(this->world_.angular_velocity(b)), tolerance * 4);
}

TYPED_TEST(Explosions, walls_shield_what_is_behind_them) {
  using S = TypeParam;
  this->world_.create(still<S>(add_box(this->world_, 0.25, 2, 2), {3, 0, 0}));
  const BodyId behind = this->ball({5, 0, 0}, 2), beside = this->ball({0, 0, 5}, 2);
  Explosion<S> e = this->wave(200);
  e.is_shielded = true;
  this->ignite(e);
  run(this->world_, 70);
  EXPECT_EQ(length(this->velocity(behind)), 0);
  EXPECT_GT(this->velocity(beside).z, 1);
  e.is_shielded = false;
  this->ignite(e);
  run(this->world_, 70);
  EXPECT_GT(this->velocity(behind).x, 1);
}

TYPED_TEST(Explosions, what_is_nearer_flies_first_and_the_energy_is_the_integral) {
  using S = TypeParam;
  const double force = 60, mass = 2, speed = 50, width = 1, k = 0.5, duration = 2;
  struct Flying {
    BodyId id;
    double distance, energy;
    int first;
  };
  std::vector<Flying> bodies;
  std::uint32_t draw = 1;
  const auto next = [&] { return static_cast<double>((draw = draw * 1664525u + 1013904223u) >> 8) / (1 << 24); };
  for (int i = 0; i < 500; ++i) {
    // On a spiral, so far apart that none meets another; the first in a sphere's worth of directions.
    const double distance = 4 + i * 0.045 + next() * 0.02, height = 2 * next() - 1, angle = i * 2.399963;
    const double ring = std::sqrt(1 - height * height);
    const D3 at = D3{ring * std::cos(angle), height, ring * std::sin(angle)} * distance;
    BodyDefinition<S> d = moving<S>(add_ball(this->world_, 0.0625), at);
    d.mass = num<S>(mass);
    d.filter.mask = 0;
    const double nearest = distance - 0.0625, h = 1e-5;
    double x = nearest, v = 0;  // dv/dt = f p(s t - x) (1 - v / s) (1 - t / T) / m
    for (double t = 0; t < 1.5; t += h) {
      const double y = speed * t - x;
      const double p = y < -width * (1 + k) ? 0
                       : y < -width         ? (y + width * (1 + k)) / (k * width)
                       : y < 0              ? 1
                       : y < k * width      ? 1 - y / (k * width)
                                            : 0;
      v += force * p * (1 - v / speed) * (1 - t / duration) / mass * h;
      x += v * h;
    }
    bodies.push_back({this->world_.create(d), distance, mass * v * v / 2, 0});
  }
  Explosion<S> e = this->wave(force, duration);
  this->ignite(e);
  for (int i = 1; i <= 90; ++i) {
    EXPECT_TRUE(this->world_.step().clean());
    for (Flying& b : bodies) {
      if (b.first == 0 && length(this->velocity(b.id)) > 0.01) b.first = i;
    }
  }
  double energy = 0, expected = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    ASSERT_GT(bodies[i].first, 0) << i;
    if (i > 0) {
      EXPECT_GE(bodies[i].first, bodies[i - 1].first) << i;
    }
    const double v = length(this->velocity(bodies[i].id));
    energy += mass * v * v / 2;
    expected += bodies[i].energy;
  }
  EXPECT_GT(bodies.back().first, bodies.front().first + 10);
  EXPECT_NEAR(energy / expected, 1, 0.02);
}

TYPED_TEST(Explosions, are_state_with_a_clock) {
  using S = TypeParam;
  World<S>& w = this->world_;
  w.set_gravity(vec<S>(0, -10, 0));
  add_ground(w);
  for (int i = 0; i < 20; ++i) this->ball({i % 5 - 2.0, 0.25 + i / 5 * 0.5, 0.125 * i}, 1);
  ASSERT_TRUE(settle(w));
  Explosion<S> e = this->wave(100, 0.5);
  e.implosion_force = S(4), e.implosion_most = S(8), e.implosion_duration = num<S>(0.125);
  e.chimney_force = S(20), e.chimney_radius = S(2), e.chimney_height = S(4), e.chimney_duration = num<S>(0.75);
  e.begin = w.tick() + 6;
  const ExplosionId id = this->ignite(e);
  EXPECT_EQ(w.counts().asleep, 0u);
  typename World<S>::Snapshot middle;
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 120; ++i) {
    if (i == 12) w.save(middle);
    EXPECT_EQ(w.find(id) != nullptr, i < 6 + 53) << i;  // 0.875 s
    w.step();
    if (i >= 12) hashes.push_back(w.hash());
  }
  ASSERT_TRUE(w.load(middle));
  World<S> read(settings<S>(5, 10, 1));
  const std::vector<std::uint8_t> bytes = bytes_of(w);
  Reader reader(bytes);
  ASSERT_TRUE(read.read_portable(reader).ok());
  EXPECT_NE(read.find(id), nullptr);
  for (const std::uint64_t hash : hashes) {
    w.step(), read.step();
    ASSERT_EQ(w.hash(), hash);
    ASSERT_EQ(read.hash(), hash);
  }
}

TYPED_TEST(Explosions, bad_numbers_are_named) {
  using S = TypeParam;
  const auto refused = [&](const char* field, const auto& change, Fault fault = Fault::bad_argument) {
    Explosion<S> e;
    change(e);
    EXPECT_FALSE(this->world_.add(e));
    EXPECT_STREQ(this->world_.fault().field, field);
    EXPECT_EQ(this->world_.fault().fault, fault) << field;
  };
  refused("implosion_least", [](Explosion<S>& e) { e.implosion_least = S(-1); });
  refused("implosion_most", [](Explosion<S>& e) { e.implosion_most = S(-1); });
  refused("implosion_duration", [](Explosion<S>& e) { e.implosion_duration = S(-1); });
  refused("wave_speed", [](Explosion<S>& e) { e.wave_speed = S(0); });
  refused("wave_width", [](Explosion<S>& e) { e.wave_width = S(-1); });
  refused("wave_ramp", [](Explosion<S>& e) { e.wave_ramp = S(2); });
  refused("wave_duration", [](Explosion<S>& e) { e.wave_duration = S(-1); });
  refused("chimney_radius", [](Explosion<S>& e) { e.chimney_radius = S(0); });
  refused("chimney_height", [](Explosion<S>& e) { e.chimney_height = S(-1); });
  refused("chimney_duration", [](Explosion<S>& e) { e.chimney_duration = S(-1); });
  refused(
      "centre", [](Explosion<S>& e) { e.centre.y = highest<S>(); }, Fault::out_of_range);
  refused(
      "chimney_duration", [](Explosion<S>& e) { e.chimney_duration = S(2000); }, Fault::out_of_range);
  refused(
      "wave_duration",
      [](Explosion<S>& e) {
        e.wave_speed = Limits<S>::position();
        e.wave_duration = S(2);
      },
      Fault::out_of_range);
  EXPECT_EQ(this->world_.state().records->kinds(), 0u);
}

}  // namespace explosion_test
}  // namespace isostep::test
