// Laws of riders: what stands on a platform that turns as told stays where it stands.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace turntable_test {

template <class S> class Turntable : public ::testing::Test {
 protected:
  struct Ride {
    double seconds;
    D3 velocity, angular_velocity;  // [m/s], [rad/s] of the platform
    D3 axis = {0, 0, 1};            // the platform lies turned about this
    double angle = 0;               // [rad]
    D3 rider = {1, 0, 0};           // [m] from the platform's middle, in its plane
    D3 half = {0.25, 0.25, 0.25};   // [m] of the rider
    double gravity = -10;           // [m/s^2]
  };

  /// [m] The way of a box on the platform after it has settled, seen from the platform.
  static double drift(const Settings<S>& settings, const Ride& ride, const Material<S>& belt = {}) {
    World<S> w(settings);
    const Quat<Unit<S>> lie = turn<S>(ride.axis, ride.angle);
    BodyDefinition<S> d = still<S>(add_box(w, 2, 0.5, 2));
    d.type = BodyType::kinematic;
    d.orientation = lie;
    d.velocity = vec<S>(ride.velocity);
    d.angular_velocity = vec<S>(ride.angular_velocity);
    d.material = belt;
    d.material.friction = S(1);
    const BodyId platform = w.create(d);
    const D3 up = ride.rider + D3{0, 0.5 + ride.half.y, 0};
    const D3 place = rotated<S>(lie, up);
    d = moving<S>(add_box(w, ride.half.x, ride.half.y, ride.half.z), place,
                  ride.velocity + cross(ride.angular_velocity, place));
    d.orientation = lie;
    d.angular_velocity = vec<S>(ride.angular_velocity);
    d.material.friction = S(1);
    const BodyId rider = w.create(d);
    const auto seen = [&] {
      const Pose<S> at = w.pose(platform);
      return rotated<S>(conjugate(at.orientation), real(w.center_of_mass(rider)) - real(at.position));
    };
    for (int i = 0; i < settings.hz; ++i) w.step();
    const D3 start = seen();
    double most = 0;
    for (int i = 0; i < ride.seconds * settings.hz; ++i) {
      w.step();
      const D3 moved = seen() - start;
      most = std::max(most, std::sqrt(moved.x * moved.x + moved.z * moved.z));
    }
    return most;
  }
};
TYPED_TEST_SUITE(Turntable, AllScalars);

/// Q16.16's grains, one a step, take a rider up to five millimetres in a minute.
template <class S> double drift_bar() { return pick<S>(0.001, 0.001, 0.006, 0.001); }

// At 4 rad/s friction of 1 holds what is within 0.625 m.
TYPED_TEST(Turntable, a_rider_stays_within_a_millimetre_in_a_minute) {
  using S = TypeParam;
  const auto ride = [](double angular_velocity, double x) {
    typename TestFixture::Ride r = {60, {0, 0, 0}, {0, angular_velocity, 0}};
    r.rider = {x, 0, 0};
    return r;
  };
  for (const std::int32_t substeps : {1, 8}) {
    const Settings<S> s = settings<S>(-10, 60, substeps);
    EXPECT_LT(this->drift(s, ride(1, 1)), drift_bar<S>()) << substeps;
    EXPECT_LT(this->drift(s, ride(2, 1)), drift_bar<S>()) << substeps;
    EXPECT_LT(this->drift(s, ride(4, 0.5)), drift_bar<S>()) << substeps;
  }
}

TYPED_TEST(Turntable, so_it_does_in_every_solver) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::soft_step})) {
    Settings<S> s = settings<S>();
    s.solver = solver;
    EXPECT_LT(this->drift(s, {20, {0, 0, 0}, {0, 2, 0}}), drift_bar<S>()) << kSolverNames[static_cast<int>(solver)];
  }
}

TYPED_TEST(Turntable, a_rider_stays_on_platforms_that_tilt_and_move) {
  using S = TypeParam;
  EXPECT_LT(this->drift(settings<S>(), {1, {0, 0, 0}, {0, 0, 0.25}, {0, 0, 1}, -0.25}), drift_bar<S>());
  EXPECT_LT(this->drift(settings<S>(), {20, {2, 0.5, 1}, {0, 1, 0}}), drift_bar<S>());
}

// A slope that turns about the vertical lifts its riders anew with every step: contacts close that after it came, point
// by point, and give way by 0.7 mm a second. It was 17.
TYPED_TEST(Turntable, a_rider_creeps_on_a_slope_that_turns_about_the_vertical) {
  using S = TypeParam;
  EXPECT_LT(this->drift(settings<S>(), {20, {0, 0, 0}, {0, 1.5, 0}, {0, 0, 1}, 0.3}), 0.02);
}

}  // namespace turntable_test
}  // namespace isostep::test
