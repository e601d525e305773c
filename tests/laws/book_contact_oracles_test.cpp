// The book's oracles of contacts, as book_oracles_test.cpp has those of motion: blows, friction, stacks, walls, piles.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "laws/particle_laws.hpp"

namespace isostep::test {
namespace book_contact_oracles_test {

template <class S> class BookContactOracles : public ::testing::Test {
 protected:
  static Settings<S> sleepless(double gravity = -10, std::int32_t hz = 60, std::int32_t substeps = 8) {
    Settings<S> s = settings<S>(gravity, hz, substeps);
    s.allow_sleep = false;
    return s;
  }
  /// A plane through the origin that falls by `angle` towards x.
  static void add_slope(World<S>& w, double angle, double friction) {
    using U = Unit<S>;
    const Vec3<U> normal = {num<U>(std::sin(angle)), num<U>(std::cos(angle)), U(0)};
    BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{normal, S(0)}));
    d.material.friction = num<S>(friction);
    w.create(d);
  }
  static D3 normal(double angle) { return {std::sin(angle), std::cos(angle), 0}; }
  static D3 down(double angle) { return {std::cos(angle), -std::sin(angle), 0}; }
  /// Laid on that plane.
  static BodyId lay(World<S>& w, ShapeId shape, double angle, double height, double friction) {
    BodyDefinition<S> d = moving<S>(shape, normal(angle) * height);
    d.orientation = turn<S>({0, 0, -1}, angle);
    d.material.friction = num<S>(friction);
    return w.create(d);
  }
};
TYPED_TEST_SUITE(BookContactOracles, AllScalars);

// O8. v_a' = ((m_a - e m_b) v_a + (1 + e) m_b v_b) / (m_a + m_b), of bodies, by the book's resolver. Two units in the
// last place; in fixed point eight, for an impulse is kept as the velocity of the reduced mass, a tenth of the larger.
TYPED_TEST(BookContactOracles, two_bodies_part_by_newtons_rule) {
  using S = TypeParam;
  ISO_NEEDS_BOOK();
  for (const double e : {0.5, 1.0}) {
    for (const double mass : {1.0, 2.0, 10.0}) {
      Settings<S> s = settings<S>(0);
      s.solver = SolverName::worst_first;
      World<S> w(s);
      const ShapeId ball = add_ball(w, 0.5);
      BodyDefinition<S> d = moving<S>(ball, {-1, 0, 0}, {5, 0, 0});
      d.mass = num<S>(mass);
      d.material.restitution = num<S>(e);
      const BodyId a = w.create(d);
      d.position = vec<S>(1, 0, 0), d.velocity = vec<S>(-3, 0, 0);
      d.mass = S(1);
      const BodyId b = w.create(d);
      run(w, 30);
      const double bar = kIsFixed<S> ? 8 * grain<S>() : 2 * grain<S>(8);
      EXPECT_NEAR(real(w.velocity(a)).x, ((mass - e) * 5 + (1 + e) * -3) / (mass + 1), bar) << e << " " << mass;
      EXPECT_NEAR(real(w.velocity(b)).x, ((1 - e * mass) * -3 + (1 + e) * mass * 5) / (mass + 1), bar);
    }
  }
}

// O9. Peak n at h_0 e^(2n), of a body, three times.
TYPED_TEST(BookContactOracles, a_body_bounces_to_its_share_of_the_height) {
  using S = TypeParam;
  for (const SolverName solver : built({SolverName::soft_step, SolverName::worst_first})) {
    Settings<S> s = this->sleepless();
    s.solver = solver;
    World<S> w(s);
    add_ground(w);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {0, 4.25, 0});
    d.material.restitution = num<S>(0.8);
    const BodyId id = w.create(d);
    double expected = 4, before = 0;
    int peaks = 0;
    for (int i = 0; i < 60 * 8 && peaks < 3; ++i) {
      w.step();
      const double v = real(w.velocity(id)).y;
      if (before > 0 && v <= 0) {
        expected *= 0.64;
        EXPECT_NEAR(real(w.center_of_mass(id)).y - 0.25, expected, pick<S>(0.02, 0.02, 0.03, 0.02) * expected);
        ++peaks;
      }
      before = v;
    }
    EXPECT_EQ(peaks, 3);
  }
}

// O11. J = -(1 + e) v_n / (1/m_a + 1/m_b + (r x n)^2 / I), of the book's resolver.
TYPED_TEST(BookContactOracles, a_blow_off_centre_turns_as_much_as_it_pushes) {
  using S = TypeParam;
  ISO_NEEDS_BOOK();
  for (const double e : {0.0, 0.5, 1.0}) {
    Settings<S> s = settings<S>(0);
    s.solver = SolverName::worst_first;
    World<S> w(s);
    BodyDefinition<S> d = moving<S>(add_box(w, 1, 0.25, 1), {0, 0, 0});
    d.mass = S(4);
    d.material.friction = S(0);
    const BodyId box = w.create(d);
    d = moving<S>(add_ball(w, 0.25), {0.5, 1, 0}, {0, -3, 0});
    d.mass = S(1);
    d.material.friction = S(0);
    d.material.restitution = num<S>(e);
    const BodyId ball = w.create(d);
    for (int i = 0; i < 30 && real(w.velocity(box)).y == 0; ++i) w.step();
    const double inertia = 4 * (1 + 0.0625) / 3, impulse = (1 + e) * 3 / (1 + 0.25 + 0.25 / inertia);
    const double bar = pick<S>(1e-5, 1e-13, 1e-2, 1e-7);
    EXPECT_NEAR(real(w.velocity(ball)).y, impulse - 3, bar) << e;
    EXPECT_NEAR(real(w.velocity(box)).y, -impulse / 4, bar) << e;
    EXPECT_NEAR(real(w.angular_velocity(box)).z, -0.5 * impulse / inertia, bar) << e;
    EXPECT_NEAR(0.5 * real(w.velocity(ball)).y + inertia * real(w.angular_velocity(box)).z, -1.5, bar) << e;
  }
}

// O16. At rest exactly while tan(angle) <= mu, over ten seconds; else a = g (sin - mu cos).
TYPED_TEST(BookContactOracles, a_block_rests_for_ten_seconds_or_slides_by_its_formula) {
  using S = TypeParam;
  const double angle = std::atan(0.5);
  for (const double part : {1.1, 0.9}) {
    World<S> w(this->sleepless());
    const double mu = held<S>(part * 0.5);
    this->add_slope(w, angle, mu);
    const BodyId id = this->lay(w, add_box(w, 0.5, 0.25, 0.5), angle, 0.25, mu);
    run(w, 30);
    const D3 from = real(w.center_of_mass(id)), v = real(w.velocity(id));
    run(w, part > 1 ? 600 : 60);
    if (part > 1) {
      EXPECT_LT(length(real(w.center_of_mass(id)) - from), pick<S>(1e-3, 1e-3, 5e-3, 1e-3));
    } else {
      const double a = 10 * (std::sin(angle) - mu * std::cos(angle));
      EXPECT_NEAR(dot(real(w.velocity(id)) - v, this->down(angle)) / a, 1, pick<S>(0.02, 0.02, 0.03, 0.02));
    }
  }
}

// O17. v_0^2 / (2 mu g) after v_0 / (mu g).
TYPED_TEST(BookContactOracles, a_sliding_block_stops_in_its_way_and_time) {
  using S = TypeParam;
  World<S> w(this->sleepless());
  add_ground(w, 0.4);
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0}, {4, 0, 0});
  d.material.friction = num<S>(0.4);
  const BodyId id = w.create(d);
  int steps = 0;
  while (real(w.velocity(id)).x > 0.01 && steps < 120) w.step(), ++steps;
  const double bar = pick<S>(0.01, 0.01, 0.02, 0.01);
  EXPECT_NEAR(real(w.center_of_mass(id)).x, 2, 2 * bar);
  EXPECT_NEAR(steps / 60.0, 1, bar + 1.0 / 60);
}

// O18. Down a slope at 5/7 of g sin(angle) for a ball, 2/3 for a cylinder; on the level from v to 5/7 v.
TYPED_TEST(BookContactOracles, what_rolls_down_a_slope_is_as_fast_as_its_inertia_lets_it) {
  using S = TypeParam;
  const double angle = 0.35, bar = pick<S>(0.01, 0.01, 0.02, 0.01);
  for (const bool is_ball : {true, false}) {
    World<S> w(this->sleepless());
    this->add_slope(w, angle, 0.6);
    const ShapeId shape = is_ball ? add_ball(w, 0.5) : w.add_shape(Cylinder<S>{S(0.5), S(0.25)});
    BodyDefinition<S> d = moving<S>(shape, this->normal(angle) * 0.5);
    d.orientation = turn<S>({1, 0, 0}, kPi / 2);
    const BodyId id = w.create(d);
    run(w, 12);
    const D3 v = real(w.velocity(id));
    run(w, 60);
    const double a = (is_ball ? 5.0 / 7 : 2.0 / 3) * 10 * std::sin(angle);
    EXPECT_NEAR(dot(real(w.velocity(id)) - v, this->down(angle)) / a, 1, bar) << is_ball;
  }
  World<S> w(this->sleepless());
  add_ground(w, 0.25);
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0.5, 0}, {7, 0, 0});
  d.material.friction = num<S>(0.25);
  const BodyId id = w.create(d);
  run(w, 24);
  EXPECT_NEAR(real(w.velocity(id)).x, 6, 6 * bar);
  run(w, 48);
  EXPECT_NEAR(real(w.velocity(id)).x, 5, 5 * bar);
}

// O19. Ten boxes: 1 cm in a minute, asleep within 5 s, where they are but for what their contacts give.
TYPED_TEST(BookContactOracles, ten_boxes_stand_for_a_minute) {
  using S = TypeParam;
  for (const bool sleeps : {false, true}) {
    Settings<S> s = this->sleepless();
    s.allow_sleep = sleeps;
    World<S> w(s);
    add_ground(w);
    const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
    std::vector<BodyId> stack;
    for (int i = 0; i < 10; ++i) stack.push_back(w.create(moving<S>(box, {0, 0.5 + i, 0})));
    run(w, 300);
    EXPECT_EQ(w.counts().awake == 0, sleeps);
    const D3 settled = real(w.center_of_mass(stack[9]));
    run(w, 3300);
    expect_near(real(w.center_of_mass(stack[9])), settled, 0.01, "drift");
    EXPECT_NEAR(settled.y, 9.5, 10 * 0.005 + pick<S>(0, 0, 0.002, 0));
    EXPECT_LT(std::hypot(settled.x, settled.z), 0.01);
  }
}

/// A box of w / h = 1/2 stands for 15 s on a slope this much [degrees] steeper than that.
template <class S> bool stands(double off, std::int32_t hz) {
  Settings<S> s = settings<S>(-10, hz);
  s.allow_sleep = false;
  World<S> w(s);
  const double angle = std::atan(0.5) + off * kPi / 180;
  const D3 up = {std::sin(angle), std::cos(angle), 0};
  BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{vec<Unit<S>>(up), S(0)}));
  d.material.friction = num<S>(1.5);
  w.create(d);
  d = moving<S>(add_box(w, 0.25, 0.5, 0.25), up * 0.5);
  d.orientation = turn<S>({0, 0, -1}, angle);
  d.material.friction = num<S>(1.5);
  const BodyId id = w.create(d);
  run(w, 15 * hz);
  return dot(rotated<S>(w.pose(id).orientation, {0, 1, 0}), up) > 0.99;
}

// O20. Tips exactly where tan(angle) > w / h. Contacts are soft and give below the lower edge: at the default rate that
// is 0.3 degrees too early, at four times that the table is kept.
TYPED_TEST(BookContactOracles, a_box_tips_where_its_centre_leaves_its_edge) {
  using S = TypeParam;
  const double bar = pick<S>(0.2, 0.1, 0.5, 0.1);
  EXPECT_TRUE(stands<S>(-bar, 240));
  EXPECT_FALSE(stands<S>(bar, 240));
  EXPECT_TRUE(stands<S>(-0.4, 60));
  EXPECT_FALSE(stands<S>(0.1, 60));
}

// O20. Of two blocks the upper one stands while less than half of it hangs over.
TYPED_TEST(BookContactOracles, a_block_overhangs_by_half_and_no_more) {
  using S = TypeParam;
  for (const double overhang : {0.49, 0.51}) {
    World<S> w(this->sleepless());
    add_ground(w);
    w.create(still<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0}));
    const BodyId id = w.create(moving<S>(add_box(w, 0.5, 0.25, 0.5), {overhang, 0.75, 0}));
    run(w, 600);
    const bool stays = length(real(w.center_of_mass(id)) - D3{overhang, 0.75, 0}) < 0.02;
    EXPECT_EQ(stays, overhang < 0.5);
  }
}

// O31. A ball whose way of a step is twenty walls meets the wall after d / v: within the way of 4 mm that continuous
// collision leaves between what it stops. In divided time particles keep the table: particle_collisions_test.cpp.
TYPED_TEST(BookContactOracles, a_body_meets_a_thin_wall_in_time) {
  using S = TypeParam;
  const double half = 1.0 / 64, radius = 1.0 / 16, speed = 20 * 2 * half * 60;
  for (const double share : {0.25, 0.5, 0.75}) {
    World<S> w(settings<S>(0, 60, 1));
    w.create(still<S>(add_box(w, half, 1, 1)));
    const double way = share * speed / 60;
    const BodyId id = w.create(moving<S>(add_ball(w, radius), {-half - radius - way, 0, 0}, {speed, 0, 0}));
    run(w, 1);
    const double met = real(w.center_of_mass(id)).x + half + radius;
    EXPECT_LT(std::fabs(met) / speed, 0.004 / speed) << share;
    run(w, 60);
    EXPECT_LT(real(w.center_of_mass(id)).x, -half);
  }
}

// O33. Ten minutes of a pile of boxes: J/kg.
TYPED_TEST(BookContactOracles, a_pile_gains_no_energy) {
  using S = TypeParam;
  World<S> w(this->sleepless());
  add_ground(w);
  const ShapeId box = add_box(w, 0.5, 0.25, 0.375);
  std::vector<BodyId> ids;
  for (int i = 0; i < 6; ++i) {
    BodyDefinition<S> d = moving<S>(box, {0.2 * (i % 3), 0.5 + 0.75 * i, 0.15 * (i % 2)});
    d.mass = S(1);
    d.orientation = turn<S>({0, 0.6, 0.8}, 0.3 * i);
    ids.push_back(w.create(d));
  }
  const auto energy = [&] {
    double sum = 0;
    for (const BodyId id : ids) {
      const D3 v = real(w.velocity(id)), turning = real(w.angular_velocity(id));
      sum += 10 * real(w.center_of_mass(id)).y + dot(v, v) / 2 + 0.1 * dot(turning, turning) / 2;
    }
    return sum / 6;
  };
  run(w, 1200);
  const double start = energy();
  double before = start, rise = 0;
  for (int i = 0; i < 60 * 600; ++i) {
    w.step();
    const double now = energy();
    rise = std::max(rise, now - before);
    before = now;
  }
  EXPECT_LT(rise, pick<S>(1e-4, 1e-9, 1e-2, 1e-6)) << "of a step";
  EXPECT_LT(before - start, pick<S>(1e-4, 1e-9, 1e-2, 1e-6)) << "of all";
}

}  // namespace book_contact_oracles_test
}  // namespace isostep::test
