// Laws of wheels on edges: a car that meets a curb climbs it, and nothing throws it.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace curbs_test {

/// The meeting of a car and a curb.
struct Meeting {
  double curb;            // [m] height
  double speed;           // [m/s]
  double phase;           // [1] of the way of a step, by which it starts further on
  double radius = 0.35;   // [m] of its wheels
  bool platform = false;  // the curb is a kinematic body that moves towards it with half of the speed
};

template <class S> class Curbs : public ::testing::Test {
 protected:
  static constexpr double kLength = 3.8, kHalfBase = 1.35;  // [m]

  static void add_slab(World<S>& w, double top, double from, double speed) {
    BodyDefinition<S> d = still<S>(add_box(w, 20, 1, 40), {0, top - 1, from + 40});
    d.material.friction = num<S>(0.6);
    if (speed != 0) d.type = BodyType::kinematic;
    d.velocity = vec<S>(0, 0, -speed);
    w.create(d);
  }
  static BodyId add_car(World<S>& w, const Meeting& m, double z, double speed) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.8, 0.3, kLength / 2), {0, m.radius + 0.35, z}, {0, 0, speed});
    d.mass = S(1200);
    d.material.friction = num<S>(0.6);
    const BodyId car = w.create(d);
    for (const double x : {-0.8, 0.8}) {
      for (const double along : {-kHalfBase, kHalfBase}) {
        WheelSettings<S> wheel;
        wheel.body = car;
        wheel.hard_point = vec<S>(x, -0.1, along);
        wheel.free_length = num<S>(0.35);
        wheel.stiffness = S(30000);
        wheel.damping = S(2400);
        wheel.radius = num<S>(m.radius);
        wheel.inertia = num<S>(m.radius < 0.4 ? 1 : 2);  // within Limits::leverage() of Q16.16
        EXPECT_TRUE(w.set_spin(w.add(wheel), num<S>(speed / m.radius))) << describe(w.fault());
      }
    }
    return car;
  }
  /// [m] The rise of its middle, from a tenth of a second before the curb till half a second after it.
  static double rise_of(const Meeting& m) {
    World<S> w(settings<S>());
    add_slab(w, 0, -40, 0);
    const double towards = m.platform ? m.speed / 2 : 0, speed = m.speed - towards;
    const double start = -kLength / 2 - m.speed * (0.1 - m.phase / 60);
    add_slab(w, m.curb, 0, towards);
    const BodyId car = add_car(w, m, start, speed);
    double most = 0;
    const int frames = static_cast<int>((2 * kHalfBase + kLength) / m.speed * 60) + 36;
    for (int i = 0; i < frames; ++i) {
      w.step();
      most = std::max(most, to_double(w.center_of_mass(car).y));
    }
    EXPECT_GT(to_double(w.center_of_mass(car).z) + towards * frames / 60, kHalfBase) << "it is on the curb";
    return most - m.radius - 0.35;
  }
  static void expect_no_throw(const Meeting& m) {
    EXPECT_LT(rise_of(m), 2 * m.curb) << "curb of " << m.curb << " m at " << m.speed << " m/s, phase " << m.phase
                                      << ", wheels of " << m.radius << " m";
  }
};
TYPED_TEST_SUITE(Curbs, AllScalars);

TYPED_TEST(Curbs, throw_no_car_by_more_than_their_height) {
  for (const double curb : {0.03, 0.05, 0.15}) {
    for (const double speed : {5.0, 20.0, 30.0, 40.0}) {
      for (const double phase : {0.0, 0.35, 0.7}) this->expect_no_throw({curb, speed, phase});
    }
  }
}

TYPED_TEST(Curbs, throw_no_car_on_other_wheels) {
  for (const double radius : {0.25, 0.5}) {
    for (const double phase : {0.1, 0.6}) this->expect_no_throw({0.12, 25, phase, radius});
  }
}

/// The ground that it gets to moves: it is where it is now, not where it was.
TYPED_TEST(Curbs, throw_no_car_where_they_come_towards_it) {
  for (const double phase : {0.0, 0.3, 0.6}) this->expect_no_throw({0.1, 20, phase, 0.35, true});
}

}  // namespace curbs_test
}  // namespace isostep::test
