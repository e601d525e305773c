// Laws of free flight and of collisions far from scenery: projectiles, tops, flips, impacts, conserved sums.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace flight_test {

template <class S> class FlightLaws : public ::testing::Test {};
TYPED_TEST_SUITE(FlightLaws, AllScalars);

/// Principal moments about the centre, for bodies whose principal axes are their own.
template <class S> D3 angular_momentum(const World<S>& w, BodyId id, D3 moments) {
  const auto q = w.pose(id).orientation;
  const Quat<Unit<S>> back = conjugate(q);
  const D3 local = rotated<S>(back, real(w.angular_velocity(id)));
  return rotated<S>(q, {moments.x * local.x, moments.y * local.y, moments.z * local.z});
}
template <class S> double rotational_energy(const World<S>& w, BodyId id, D3 moments) {
  return dot(angular_momentum(w, id, moments), real(w.angular_velocity(id))) / 2;
}

// O1. x = x_0 + t v_0 + a t^2 / 2, whatever the rate and the sub-steps.
TYPED_TEST(FlightLaws, a_projectile_follows_its_parabola_at_every_rate) {
  using S = TypeParam;
  struct Rate {
    std::int32_t hz, substeps;
  };
  for (const Rate rate : {Rate{64, 4}, Rate{60, 8}, Rate{60, 1}, Rate{100, 3}}) {
    World<S> w(settings<S>(-10, rate.hz, rate.substeps));
    const D3 from = {-40, 1, 20}, v = {9, 40, -5};
    const BodyId id = w.create(moving<S>(add_ball(w, 0.5), from, v));
    run(w, 8 * rate.hz);
    const double n = 8.0 * rate.hz * rate.substeps;
    const D3 expected = from + v * 8.0 + D3{0, -10 * 64.0 / 2, 0};
    // Fixed point: every sub-step rounds speed, its mean and move by half a unit of the speed's format, every step the
    // place by half a unit of its own, at worst always the same way.
    const double in_speed = kIsFixed<S> ? n / 2 * speed_grain<S>() + grain<S>() : pick<S>(2e-3, 1e-11, 0, 0);
    const double in_place =
        kIsFixed<S> ? 8 * in_speed / 2 + n * speed_grain<S>() + 4.0 * rate.hz * grain<S>() : pick<S>(6e-3, 1e-10, 0, 0);
    expect_near(real(w.center_of_mass(id)), expected, in_place, "place");
    expect_near(real(w.velocity(id)), {9, 40 - 80, -5}, in_speed, "velocity");
    EXPECT_EQ(w.angular_velocity(id), Vec3<S>::zero());
  }
}

// O23.
TYPED_TEST(FlightLaws, a_spinning_ball_turns_by_twice_the_arc_tangent_of_half_its_turn) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 64, 4));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  const D3 axis = {0.6, 0, 0.8};
  d.angular_velocity = vec<S>(axis * 10.0);
  const BodyId id = w.create(d);
  run(w, 128);
  const double angle = std::fmod(512 * 2 * std::atan(10.0 / 512), 4 * kPi);
  const auto q = w.pose(id).orientation;
  const double bound = pick<S>(1e-4, 1e-12, 1e-4, 1e-8);
  expect_near({to_double(q.x), to_double(q.y), to_double(q.z)}, axis * std::sin(angle / 2), bound);
  EXPECT_NEAR(to_double(q.w), std::cos(angle / 2), bound);
  const double x = to_double(q.x), y = to_double(q.y), z = to_double(q.z), turned = to_double(q.w);
  EXPECT_NEAR(x * x + y * y + z * z + turned * turned, 1, pick<S>(4e-7, 1e-15, 1e-8, 1e-15));
}

// O12. The axis of a symmetric top goes round its angular momentum at |L| / I_1.
TYPED_TEST(FlightLaws, a_symmetric_top_precesses_about_its_angular_momentum) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 60, 16));
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0, 0});
  d.mass = S(3);
  d.angular_velocity = vec<S>(1, 8, 0);
  const BodyId id = w.create(d);
  const D3 moments = {0.25 + 0.0625, 0.5, 0.25 + 0.0625};
  const D3 momentum = angular_momentum(w, id, moments);
  const double rate = length(momentum) / moments.x, energy = rotational_energy(w, id, moments);
  const D3 up = momentum * (1 / length(momentum));
  const auto off_axis = [&] {
    const D3 a = rotated<S>(w.pose(id).orientation, {0, 1, 0});
    return a - up * dot(a, up);
  };
  const D3 start = off_axis();
  double turned = 0, previous = 0;
  for (int i = 0; i < 60; ++i) {
    w.step();
    const D3 now = off_axis();
    const double angle = std::atan2(dot(cross(start, now), up), dot(start, now));
    turned += std::remainder(angle - previous, 2 * kPi);
    previous = angle;
  }
  EXPECT_NEAR(turned, rate, 0.02 * rate);
  EXPECT_LT(length(angular_momentum(w, id, moments) - momentum), 0.02 * length(momentum));
  EXPECT_LE(rotational_energy(w, id, moments), energy * 1.001);
}

// O13. The intermediate axis: I = (1, 2, 3), w = (0.01, 5, 0), flips at 2.633 and 7.899 s (Runge-Kutta, fine steps).
TYPED_TEST(FlightLaws, a_body_turning_about_its_middle_axis_flips_and_gains_no_energy) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 60, 16));
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0, 0});
  d.mass = S(1);
  d.inertia = vec<S>(1, 2, 3);
  d.angular_velocity = vec<S>(0.01, 5, 0);
  const BodyId id = w.create(d);
  const D3 moments = {1, 2, 3};
  const D3 momentum = angular_momentum(w, id, moments);
  const double energy = rotational_energy(w, id, moments);
  std::vector<double> flips;
  double side = 1;
  for (int i = 1; i <= 8 * 60; ++i) {
    w.step();
    const Quat<Unit<S>> back = conjugate(w.pose(id).orientation);
    const double along = rotated<S>(back, real(w.angular_velocity(id))).y;
    if (along * side < 0) {
      flips.push_back(i / 60.0);
      side = -side;
    }
    ASSERT_LE(rotational_energy(w, id, moments), energy * 1.001) << i;
    ASSERT_LT(length(angular_momentum(w, id, moments) - momentum), 0.1 * length(momentum)) << i;
  }
  ASSERT_GE(flips.size(), 1u);
  EXPECT_NEAR(flips[0], 2.633, pick<S>(0.1, 0.1, 0.4, 0.1));
  EXPECT_LE(flips.size(), 2u);
}

// O8.
TYPED_TEST(FlightLaws, two_balls_in_line_part_by_newtons_rule_and_keep_their_momentum) {
  using S = TypeParam;
  for (const double e : {0.0, 0.25, 0.5, 1.0}) {
    for (const double mass : {1.0, 2.0, 10.0}) {
      World<S> w(settings<S>(0));
      const ShapeId ball = add_ball(w, 0.5);
      BodyDefinition<S> d = moving<S>(ball, {-1, 0, 0}, {5, 0, 0});
      d.mass = num<S>(mass);
      d.material.restitution = num<S>(e);
      const BodyId a = w.create(d);
      d = moving<S>(ball, {1, 0, 0}, {-3, 0, 0});
      d.mass = S(1);
      const BodyId b = w.create(d);
      run(w, 30);
      const double va = ((mass - e) * 5 + (1 + e) * -3) / (mass + 1),
                   vb = ((1 - e * mass) * -3 + (1 + e) * mass * 5) / (mass + 1);
      // Without restitution the overlap that they met with is pushed apart softly.
      const double bound = e > 0 ? pick<S>(1e-4, 1e-9, 1e-3, 1e-7) : 0.2;
      EXPECT_NEAR(to_double(w.velocity(a).x), va, bound) << "e " << e << " mass " << mass;
      EXPECT_NEAR(to_double(w.velocity(b).x), vb, bound) << "e " << e << " mass " << mass;
      EXPECT_NEAR(mass * to_double(w.velocity(a).x) + to_double(w.velocity(b).x), mass * 5 - 3,
                  pick<S>(1e-4, 1e-12, 1e-2, 1e-7));
      EXPECT_EQ(w.velocity(a).y, S(0));
    }
  }
}

// O10, as far as a solver of simultaneous impulses goes: momentum passes on to the last ball.
TYPED_TEST(FlightLaws, a_row_of_balls_hands_momentum_on) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  std::vector<BodyId> row;
  for (int i = 0; i < 5; ++i) {
    BodyDefinition<S> d = moving<S>(ball, {1.25 * i, 0, 0}, {i == 0 ? 4.0 : 0.0, 0, 0});
    d.material.restitution = S(1);
    row.push_back(w.create(d));
  }
  run(w, 90);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(to_double(w.velocity(row[static_cast<std::size_t>(i)]).x), 0, 0.01);
  EXPECT_NEAR(to_double(w.velocity(row[4]).x), 4, 0.01);
}

// O11. J = -(1 + e) v_n / (1/m_a + 1/m_b + (I_b^-1 (r x n)) x r . n).
TYPED_TEST(FlightLaws, a_blow_off_centre_turns_a_rod_as_its_impulse_says) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const double arm = 1, e = 0.5, m_rod = 3, m_ball = 1, v = 6;
  BodyDefinition<S> d = moving<S>(add_box(w, 1.5, 0.25, 0.25), {0, 0, 0});
  d.mass = num<S>(m_rod);
  d.material.friction = S(0);
  const BodyId rod = w.create(d);
  d = moving<S>(add_ball(w, 0.25), {arm, 1, 0}, {0, -v, 0});
  d.mass = num<S>(m_ball);
  d.material.friction = S(0);
  d.material.restitution = num<S>(e);
  const BodyId ball = w.create(d);
  run(w, 12);
  const double inertia = m_rod / 3 * (1.5 * 1.5 + 0.25 * 0.25);
  const double impulse = (1 + e) * v / (1 / m_rod + 1 / m_ball + arm * arm / inertia);
  const double bound = 0.01 * v;
  EXPECT_NEAR(to_double(w.velocity(ball).y), impulse / m_ball - v, bound);
  EXPECT_NEAR(to_double(w.velocity(rod).y), -impulse / m_rod, bound);
  EXPECT_NEAR(to_double(w.angular_velocity(rod).z), -impulse * arm / inertia, bound);
  const double momentum = m_ball * to_double(w.velocity(ball).y) + m_rod * to_double(w.velocity(rod).y);
  EXPECT_NEAR(momentum, -m_ball * v, pick<S>(1e-5, 1e-13, 1e-3, 1e-8));
  const auto about_origin = [&](BodyId id, double m) {
    return m * (to_double(w.center_of_mass(id).x) * to_double(w.velocity(id).y) -
                to_double(w.center_of_mass(id).y) * to_double(w.velocity(id).x));
  };
  const double angular =
      about_origin(ball, m_ball) + about_origin(rod, m_rod) + inertia * to_double(w.angular_velocity(rod).z);
  EXPECT_NEAR(angular, -m_ball * v * arm, 0.01 * m_ball * v * arm);
}

// O24.
TYPED_TEST(FlightLaws, a_cluster_that_collides_in_free_space_keeps_momentum_and_angular_momentum) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5), cube = add_box(w, 0.5, 0.5, 0.5);
  std::vector<BodyId> ids;
  for (int i = 0; i < 27; ++i) {
    const D3 at = {1.5 * (i % 3 - 1), 1.5 * (i / 3 % 3 - 1), 1.5 * (i / 9 - 1)};
    // Inwards, with some turning about y.
    BodyDefinition<S> d = moving<S>(i % 2 == 0 ? ball : cube, at, at * -1.5 + D3{at.z, 0.1 * i, -at.x} * 0.5);
    d.mass = S(1 + i % 4);
    d.angular_velocity = vec<S>(0.1 * i, 1, -0.05 * i);
    if (i % 3 == 0) d.material.restitution = num<S>(0.5);
    ids.push_back(w.create(d));
  }
  const auto sums = [&](D3& p, D3& l) {
    p = l = {0, 0, 0};
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const double m = 1 + static_cast<double>(i % 4), inertia = m * (i % 2 == 0 ? 0.4 * 0.25 : 1.0 / 6);
      const D3 v = real(w.velocity(ids[i])) * m;
      p = p + v;
      l = l + cross(real(w.center_of_mass(ids[i])), v) + real(w.angular_velocity(ids[i])) * inertia;
    }
  };
  D3 p0, l0, p1, l1;
  sums(p0, l0);
  std::size_t touches = 0;
  for (int i = 0; i < 120; ++i) {
    ASSERT_TRUE(w.step().clean());
    touches += w.events().contact_begin.size();
  }
  sums(p1, l1);
  EXPECT_GT(touches, 40u);
  EXPECT_GT(length(l0), 20);
  expect_near(p1, p0, pick<S>(2e-4, 1e-12, 2e-2, 1e-6), "momentum");
  // Arms are those of the step's beginning, while bodies move on within it.
  expect_near(l1, l0, 0.02 * length(l0), "angular momentum");
}

}  // namespace flight_test
}  // namespace isostep::test
