// Laws of articulations: pendulums, chains, free trees; energy and momentum against closed forms.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/effects/articulations.hpp"

namespace isostep::test {
namespace articulation_test {

constexpr double kPi = 3.14159265358979323846;

template <class S> class ArticulationLaws : public ::testing::Test {};
TYPED_TEST_SUITE(ArticulationLaws, ArticulatedScalars);

template <class S> ArticulationDefinition<S> double_pendulum() {
  ArticulationDefinition<S> d;
  d.links.push_back(bob<S>(kArticulationBase, {0, 0, 0}, 1, 1));
  d.links.push_back(bob<S>(0, {0, -1, 0}, 1, 1));
  return d;
}
template <class S> void set_angle(Articulation<S>& a, std::uint32_t link, double angle, double speed = 0) {
  JointCoordinates<S> c;
  c.position.x = number<S>(angle);
  c.velocity.x = number<S>(speed);
  EXPECT_TRUE(a.set_coordinates(link, c)) << describe(a.fault());
}

// 30 J of swing. The table of the best of two impulse solvers loses 20 J (trees of joints at the same rate).
TYPED_TEST(ArticulationLaws, a_double_pendulum_keeps_its_energy_for_a_minute) {
  using S = TypeParam;
  Articulation<S> a = built(double_pendulum<S>());
  set_angle(a, 0, kPi / 2);
  const double start = motion_of(a).energy();
  double worst = 0;
  for (int i = 0; i < 60 * 60; ++i) {
    const ArticulationReport report = a.step();
    ASSERT_EQ(report.clamped + report.lost, 0u);
    worst = std::max(worst, std::fabs(motion_of(a).energy() - start));
  }
  EXPECT_LT(worst, 0.01);
}

TYPED_TEST(ArticulationLaws, a_double_pendulum_is_where_it_should_be_after_a_second) {
  using S = TypeParam;
  Articulation<S> a = built(double_pendulum<S>());
  set_angle(a, 0, kPi / 2);
  for (int i = 0; i < 60; ++i) a.step();
  const D3 tip = doubles(a.link_centre(1));
  EXPECT_NEAR(tip.x, -1.48109, 1e-3);
  EXPECT_NEAR(tip.y, -1.28886, 1e-3);
}

/// Time of `swings` swings of the tip [s], by interpolated crossings of x = 0 to the right.
template <class S> double period_of(Articulation<S>& a, std::uint32_t link, int swings, double seconds) {
  const int hz = a.definition().settings.hz;
  double before = to_double(a.link_centre(link).x), first = -1;
  int crossings = 0;
  for (int i = 1; i < seconds * hz; ++i) {
    a.step();
    const double now = to_double(a.link_centre(link).x);
    if (before < 0 && now >= 0) {
      const double at = (i - 1 + before / (before - now)) / hz;
      if (first < 0) first = at;
      else if (++crossings == swings) return (at - first) / swings;
    }
    before = now;
  }
  ADD_FAILURE() << "it does not swing";
  return 0;
}

TYPED_TEST(ArticulationLaws, small_swings_of_a_double_pendulum_have_the_rates_of_its_modes) {
  using S = TypeParam;
  for (const double sign : {-1.0, 1.0}) {
    // Eigenvectors of both bobs' angles: (1, -+ sqrt 2).
    Articulation<S> a = built(double_pendulum<S>());
    const double angle = 0.005, second = -sign * std::sqrt(2.0) * angle;
    set_angle(a, 0, angle);
    set_angle(a, 1, second - angle);
    const double rate = 2 * kPi / period_of(a, 0, 8, 40), wanted = std::sqrt(10 * (2 + sign * std::sqrt(2.0)));
    EXPECT_NEAR(rate, wanted, 1e-3 * wanted);
  }
}

/// A chain of uniform bars that hangs from hinges.
template <class S> ArticulationDefinition<S> chain(int links, double length) {
  ArticulationDefinition<S> d;
  const double part = length / links;
  for (int i = 0; i < links; ++i)
    d.links.push_back(
        bar<S>(i == 0 ? kArticulationBase : static_cast<std::uint32_t>(i - 1), {0, i == 0 ? 0 : -part, 0}, part, 1));
  return d;
}

// The lowest mode is J0(2 w sqrt(y / g)), y from the free end: 2 w sqrt(L / g) = 2.404826.
TYPED_TEST(ArticulationLaws, a_hanging_chain_swings_in_the_time_of_bessels_function) {
  using S = TypeParam;
  const int n = 50;
  const double length = 25;
  Articulation<S> a = built(chain<S>(n, length));
  // The shape of the mode, 5 cm at the free end.
  const auto aside = [&](double depth) {
    return 0.05 * std::cyl_bessel_j(0, 2.404825557695773 * std::sqrt(1 - depth));
  };
  double before = 0;
  for (int i = 0; i < n; ++i) {
    const double top = aside(static_cast<double>(i) / n), bottom = aside(static_cast<double>(i + 1) / n);
    const double angle = std::asin((bottom - top) / (length / n));
    set_angle(a, static_cast<std::uint32_t>(i), angle - before);
    before = angle;
  }
  const double period = period_of(a, n - 1, 3, 60);
  EXPECT_NEAR(period, 8.262, 0.005 * 8.262);
}

TYPED_TEST(ArticulationLaws, a_chain_at_rest_pulls_at_its_root_by_its_weight) {
  using S = TypeParam;
  Articulation<S> a = built(chain<S>(50, 25));
  for (int i = 0; i < 600; ++i) a.step();
  const LinkLoad<S> load = a.joint_load(0);
  EXPECT_NEAR(to_double(load.force.y), 500, by_scalar<S>(1e-2, 1e-9, 1e-4));
  EXPECT_NEAR(to_double(load.force.x), 0, by_scalar<S>(1e-2, 1e-9, 1e-4));
  EXPECT_NEAR(to_double(a.joint_load(25).force.y), 250, by_scalar<S>(1e-2, 1e-9, 1e-4));
  EXPECT_NEAR(to_double(a.link_centre(49).y), -24.75, by_scalar<S>(1e-4, 1e-9, 1e-6));
}

/// A body with an arm of balls, one of hinges and a slider, in flight.
template <class S> ArticulationDefinition<S> free_tree() {
  ArticulationDefinition<S> d;
  ArticulationLink<S> body = bar<S>(kArticulationBase, {0, 0, 0}, 0.5, 3, 0.2);
  body.type = ArticulationJoint::free;
  d.links.push_back(body);
  for (int i = 0; i < 2; ++i) {
    ArticulationLink<S> arm =
        bar<S>(static_cast<std::uint32_t>(i), {i == 0 ? 0.2 : 0, i == 0 ? 0 : -0.4, 0}, 0.4, 1, 0.05);
    arm.type = ArticulationJoint::ball;
    d.links.push_back(arm);
  }
  ArticulationLink<S> other = bar<S>(0, {-0.2, 0, 0.1}, 0.6, 0.5, 0.05);
  other.axis = vector<Unit<S>>({0.6, 0, 0.8});
  d.links.push_back(other);
  ArticulationLink<S> piston = bar<S>(3, {0, -0.6, 0}, 0.3, 0.25, 0.05);
  piston.type = ArticulationJoint::slider;
  piston.axis = vector<Unit<S>>({0, 1, 0});
  piston.limited = true;
  piston.lower = number<S>(-0.2);
  piston.upper = number<S>(0.2);
  piston.stiffness = number<S>(40);
  d.links.push_back(piston);
  return d;
}
template <class S> void set_going(Articulation<S>& a) {
  JointCoordinates<S> c;
  c.velocity = vector<S>({1, 8, -2});
  c.angular_velocity = vector<S>({1, 2, -1.5});
  a.set_coordinates(0, c);
  c.velocity = Vec3<S>::zero();
  c.angular_velocity = vector<S>({2, -3, 1});
  a.set_coordinates(1, c);
  c.angular_velocity = vector<S>({-2, 1, 4});
  a.set_coordinates(2, c);
  set_angle(a, 3, 0.5, 3.0);
}

TYPED_TEST(ArticulationLaws, a_free_tree_keeps_its_momentum_and_flies_along_a_parabola) {
  using S = TypeParam;
  Articulation<S> a = built(free_tree<S>());
  set_going(a);
  const Motion start = motion_of(a);
  const double tolerance = by_scalar<S>(2e-4, 1e-9, 1e-6);
  double momentum = 0, angular = 0, path = 0;
  for (int i = 1; i <= 300; ++i) {
    a.step();
    const Motion now = motion_of(a);
    const double t = i / 60.0;
    const D3 fall = {0, -10 * t, 0};
    momentum = std::max(momentum, size(now.momentum - (start.momentum + fall * start.mass)) / start.mass);
    angular = std::max(angular, size(now.angular_about_centre() - start.angular_about_centre()));
    path = std::max(path, size(now.centre - (start.centre + start.momentum * (t / start.mass) + fall * (t / 2))));
  }
  EXPECT_LT(momentum, tolerance * 50);
  EXPECT_LT(angular, tolerance);
  EXPECT_LT(path, tolerance * 100);
}

}  // namespace articulation_test
}  // namespace isostep::test
