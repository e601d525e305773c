// The book's oracles O1 to O33 where no other test holds them to the tolerances of their table: each is a formula, a
// scene and a bar for every scalar. A bar beyond the table says why, and is what was measured with some room. Those of
// contacts stand in book_contact_oracles_test.cpp, those of collision in book_collision_oracles_test.cpp.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "laws/particle_laws.hpp"

namespace isostep::test {
namespace book_oracles_test {

template <class S> class BookOracles : public ::testing::Test {
 protected:
  /// I w in the world's frame, of a body whose principal axes are its own.
  static D3 angular_momentum(const World<S>& w, BodyId id, D3 moments) {
    const Quat<Unit<S>> q = w.pose(id).orientation;
    const D3 local = rotated<S>(conjugate(q), real(w.angular_velocity(id)));
    return rotated<S>(q, {moments.x * local.x, moments.y * local.y, moments.z * local.z});
  }
};
TYPED_TEST_SUITE(BookOracles, AllScalars);

// O1. Particles: x_n = x_0 + n h v_0 + a h^2 n (n + 1) / 2; n - 1 where positions go first. Bodies: the parabola.
TYPED_TEST(BookOracles, a_projectile_is_where_its_recurrence_says) {
  using S = TypeParam;
  const D3 from = {-40.3, 1.7, 20.1}, speed = {9.1, 47.3, -5.7};
  const double bar = pick<S>(2e-3, 3e-12, 3e-2, 2e-7), g = held<S>(-9.81), h = 1.0 / 64;
  for (const Integrator integrator : {Integrator::semi_implicit_euler, Integrator::explicit_euler}) {
    ParticleSettings<S> s = at_rate<S>(-9.81);
    s.integrator = integrator;
    ParticleWorld<S> w(s);
    const ParticleId id = w.create(point<S>(from, speed));
    run(w, 640);
    const int more = integrator == Integrator::explicit_euler ? -1 : 1;
    const D3 fall = {0, g * h * h * 640 * (640 + more) / 2, 0};
    expect_near(real(w.position(id)), real(vec<S>(from)) + real(vec<S>(speed)) * 10.0 + fall, bar, "particle");
  }
  World<S> w(settings<S>(-9.81, 64, 1));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), from, speed));
  run(w, 640);
  const D3 fall = {0, g * 10 * 10 / 2, 0};
  expect_near(real(w.center_of_mass(id)), real(vec<S>(from)) + real(vec<S>(speed)) * 10.0 + fall, bar, "body");
}

/// A particle on a spring to the origin, from x = 1 at rest.
template <class S> struct Swing {
  ParticleWorld<S> world{at_rate<S>(0)};
  ParticleId bob;

  Swing(SpringType type, double stiffness, double damping) {
    bob = world.create(point<S>({1, 0, 0}));
    Spring<S> s;
    s.type = type;
    s.a = bob;
    s.stiffness = num<S>(stiffness);
    s.damping = num<S>(damping);
    EXPECT_TRUE(world.add(s));
  }
  double x() const { return to_double(world.position(bob).x); }
};

// O4. Semi-implicit, w = 10 /s: x_n = cos(w' n h - w' h / 2) / cos(w' h / 2) with w' = (2 / h) asin(w h / 2).
TYPED_TEST(BookOracles, an_oscillator_keeps_to_its_discrete_frequency) {
  using S = TypeParam;
  Swing<S> swing(SpringType::spring, 100, 0);
  const double phase = 2 * std::asin(10.0 / 64 / 2);
  double worst = 0;
  for (int i = 1; i <= 640; ++i) {
    swing.world.step();
    worst = std::max(worst, std::fabs(swing.x() - std::cos(phase * (i + 0.5)) / std::cos(phase / 2)));
  }
  EXPECT_LT(worst, pick<S>(1e-6, 1e-12, 1e-4, 3e-9));
}

// O5. x = e^(-c t / 2) (x_0 cos(g t) + ...) below critical damping, at it, and above it. The table has half of these
// bars but in double: steps round the way and the speed too, and a creep ends where its way is no number of Q16.16.
TYPED_TEST(BookOracles, a_stiff_spring_is_exact_in_all_regimes) {
  using S = TypeParam;
  for (const double c : {2.0, 20.0, 50.0}) {
    Swing<S> swing(SpringType::stiff, 100, c);
    const double b = c / 2, g = std::sqrt(std::fabs(100 - b * b));
    double worst = 0;
    for (int i = 1; i <= 640; ++i) {
      swing.world.step();
      const double t = i / 64.0;
      const double under = std::exp(-b * t) * (std::cos(g * t) + b / g * std::sin(g * t));
      const double over = ((b + g) * std::exp((g - b) * t) - (b - g) * std::exp(-(g + b) * t)) / (2 * g);
      const double expected = c < 20 ? under : c > 20 ? over : std::exp(-b * t) * (1 + b * t);
      worst = std::max(worst, std::fabs(swing.x() - expected));
    }
    EXPECT_LT(worst, pick<S>(6e-7, 2e-15, 3e-4, 1e-8)) << c;
  }
}

// O12. The axis of a symmetric top goes round its angular momentum at |L| / I_1.
TYPED_TEST(BookOracles, a_top_without_torque_precesses_in_its_time) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0, 0});
  d.mass = S(3);
  d.angular_velocity = vec<S>(1, 8, 0);
  const BodyId id = w.create(d);
  const D3 moments = {0.3125, 0.5, 0.3125};
  const D3 momentum = this->angular_momentum(w, id, moments), up = momentum * (1 / length(momentum));
  const auto off_axis = [&] {
    const D3 a = rotated<S>(w.pose(id).orientation, {0, 1, 0});
    return a - up * dot(a, up);
  };
  const D3 start = off_axis();
  double turned = 0, previous = 0;
  for (int i = 0; i < 120; ++i) {
    w.step();
    const D3 now = off_axis();
    const double angle = std::atan2(dot(cross(start, now), up), dot(start, now));
    turned += std::remainder(angle - previous, 2 * kPi);
    previous = angle;
  }
  EXPECT_NEAR(turned / (2 * length(momentum) / moments.x), 1, pick<S>(1e-3, 1e-3, 2e-2, 1e-3));
}

// O13. I = (1, 2, 3), w = (0.01, 5, 0): flips at 2.633 + 5.266 k s, the later ones as rounding decides. Angular
// velocity is state and angular momentum is not, so the latter is kept to first order of the sub-step: 0.3 % at the
// default rate. Articulations carry it: articulation_joints_test.cpp.
TYPED_TEST(BookOracles, a_body_that_flips_keeps_its_energy) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0, 0});
  d.mass = S(1);
  d.inertia = vec<S>(1, 2, 3);
  d.angular_velocity = vec<S>(0.01, 5, 0);
  const BodyId id = w.create(d);
  const D3 moments = {1, 2, 3}, momentum = this->angular_momentum(w, id, moments);
  const double energy = dot(momentum, real(w.angular_velocity(id)));
  double drift = 0, change = 0;
  std::vector<double> flips;
  for (int i = 1; i <= 60 * 20; ++i) {
    w.step();
    const D3 now = this->angular_momentum(w, id, moments);
    drift = std::max(drift, length(now - momentum) / length(momentum));
    change = std::max(change, std::fabs(dot(now, real(w.angular_velocity(id))) / energy - 1));
    const double along = rotated<S>(conjugate(w.pose(id).orientation), real(w.angular_velocity(id))).y;
    if ((along < 0) != (flips.size() % 2 == 1)) flips.push_back(i / 60.0);
  }
  ASSERT_GE(flips.size(), 4u);
  EXPECT_LE(flips.size(), pick<S>(4, 4, 5, 4));
  EXPECT_NEAR(flips[0], 2.633, pick<S>(0.02, 0.02, 0.25, 0.02));
  for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(flips[k] - flips[k - 1], 5.266, pick<S>(0.5, 0.02, 1.5, 0.02));
  EXPECT_LT(drift, 4e-3);
  EXPECT_LT(change, 2.5e-4);
}

// O23. 2 atan(w h / 2) a step, and a norm of 1.
TYPED_TEST(BookOracles, a_spinning_quaternion_keeps_its_norm_and_angle) {
  using S = TypeParam;
  World<S> w(settings<S>(0, 64, 1));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  d.angular_velocity = vec<S>(0, 10, 0);
  const BodyId id = w.create(d);
  double worst = 0, turned = 0;
  for (int i = 1; i <= 640; ++i) {
    w.step();
    const auto q = w.pose(id).orientation;
    const double x = to_double(q.x), y = to_double(q.y), z = to_double(q.z), r = to_double(q.w);
    worst = std::max(worst, std::fabs(std::sqrt(x * x + y * y + z * z + r * r) - 1));
    turned = 2 * std::atan2(y, r);
  }
  EXPECT_LE(worst, pick<S>(2e-7, 4e-16, 4 * 0x1p-30, 4 * 0x1p-53));
  EXPECT_NEAR(std::remainder(turned - 640 * 2 * std::atan(10.0 / 128), 2 * kPi), 0, pick<S>(1e-4, 1e-12, 1e-6, 1e-9));
}

}  // namespace book_oracles_test
}  // namespace isostep::test
