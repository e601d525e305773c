// Laws of tracks: wheels that roll as one, what drives, brakes and steers them, against closed forms.
// SPDX-License-Identifier: MIT
#include <array>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace tracks_test {

/// 1200 kg on a track of three wheels each side, heading +z; the left wheels are 0 to 2 from the front, then the right.
template <class S> class Tracks : public ::testing::Test {
 protected:
  static constexpr double kMass = 1200, kSide = 0.8, kHeight = 0.55, kRadius = 0.35, kSquare = kRadius * kRadius;
  static constexpr std::array kRear = {2, 5}, kMiddle = {1, 4};

  /// Engine and brakes are at the rear wheels.
  void add_tank(double speed = 0, double grip_across = 1) {
    add_ground(w, 1);
    BodyDefinition<S> d = moving<S>(add_box(w, 0.9, 0.3, 1.5), {0, kHeight, 0}, {0, 0, speed});
    d.mass = num<S>(kMass);
    d.allow_sleep = false;
    tank = w.create(d);
    VehicleSettings<S> v;
    v.body = tank;
    v.engine_torque = S(2400);
    v.brake_torque = S(6000);
    vehicle = w.add(v);
    EXPECT_TRUE(vehicle) << describe(w.fault());
    for (int i = 0; i < 6; ++i) {
      WheelSettings<S> wheel;
      wheel.body = tank;
      wheel.hard_point = vec<S>(i < 3 ? kSide : -kSide, 0, 1 - i % 3);
      wheel.stiffness = S(20000);
      wheel.damping = S(1600);
      wheel.grip_across = num<S>(grip_across);
      wheel.track = i < 3 ? 7 : 3;
      wheel.drive_share = wheel.brake_share = S(i % 3 == 2 ? 1 : 0);
      wheels[i] = w.add(wheel);
      EXPECT_TRUE(wheels[i]) << describe(w.fault());
    }
    for (int i = 0; i < 6 && speed != 0; ++i) spin(i, speed / kRadius);
  }
  void renew() {
    World<S> fresh(settings<S>());
    w = std::move(fresh);
  }
  void control(double throttle, double brake, double steer) {
    VehicleInput<S> input;
    input.throttle = num<S>(throttle);
    input.brake = num<S>(brake);
    input.steer = num<S>(steer);
    ASSERT_TRUE(w.set_input(vehicle, input)) << describe(w.fault());
  }
  template <class Change> void change(int i, const Change& of) {
    WheelSettings<S> wheel = *w.find(wheels[i]);
    of(wheel);
    ASSERT_TRUE(w.set(wheels[i], wheel)) << describe(w.fault());
  }
  void spin(int i, double spin) { ASSERT_TRUE(w.set_spin(wheels[i], num<S>(spin))) << describe(w.fault()); }
  template <class Change> void change_vehicle(const Change& of) {
    VehicleSettings<S> v = *w.find(vehicle);
    of(v);
    ASSERT_TRUE(w.set(vehicle, v)) << describe(w.fault());
  }
  double rim(int i) const { return to_double(w.state(wheels[i])->spin) * to_double(w.find(wheels[i])->radius); }
  D3 place() const { return real(w.center_of_mass(tank)); }
  D3 speed() const { return real(w.velocity(tank)); }
  double yaw_rate() const { return to_double(w.angular_velocity(tank).y); }
  /// [degrees] The heading from +z towards +x: counter-clockwise seen from above.
  double heading() const {
    const D3 forward = rotated<S>(w.pose(tank).orientation, {0, 0, 1});
    return std::atan2(forward.x, forward.z) * 180 / kPi;
  }

  World<S> w{settings<S>()};
  BodyId tank;
  VehicleId vehicle;
  WheelId wheels[6];
};
TYPED_TEST_SUITE(Tracks, AllScalars);

/// The middle wheels are smaller and in the air. As they are spun, what they turn with, I w / r each, becomes that of
/// the body and of all wheels, which roll.
TYPED_TEST(Tracks, rolls_as_one_with_wheels_in_the_air) {
  using S = TypeParam;
  this->add_tank();
  const auto lift = [](WheelSettings<S>& wheel) {
    wheel.hard_point.y = S(1);
    wheel.radius = num<S>(0.25);
    wheel.inertia = num<S>(0.5);
  };
  for (const int i : this->kMiddle) this->change(i, lift);
  run(this->w, 120);
  for (const int i : this->kMiddle) {
    EXPECT_FALSE(this->w.state(this->wheels[i])->contact_body);
    this->spin(i, 40);
  }
  for (int step = 0; step < 120; ++step) {
    run(this->w, 1);
    for (int i = 0; i < 6; ++i) ASSERT_NEAR(this->rim(i), this->rim(i / 3 * 3), 1e-4) << step << ' ' << i;
  }
  const double spun = 2 * 0.5 * 40 / 0.25;  // [kg m/s]
  const double expected = spun / (this->kMass + 4 / this->kSquare + 2 * 0.5 / (0.25 * 0.25));
  EXPECT_NEAR(this->speed().z, expected, 0.001 * expected);
  EXPECT_NEAR(this->rim(0), expected, 0.001 * expected);
}

/// By more than the two driven wheels' own grip.
TYPED_TEST(Tracks, accelerates_its_mass_and_turns_its_wheels) {
  this->add_tank();
  this->control(1, 0, 0);
  run(this->w, 60);
  const double before = this->speed().z;
  run(this->w, 120);
  const double force = 2400 / this->kRadius, expected = force / (this->kMass + 6 / this->kSquare);
  ASSERT_GT(force, 2 * this->kMass * 10 / 6);
  EXPECT_NEAR((this->speed().z - before) / 2, expected, 0.001 * expected);
  EXPECT_LT(std::fabs(this->heading()), 0.001);
}

TYPED_TEST(Tracks, brakes_all_wheels_by_two) {
  this->add_tank(10);
  run(this->w, 30);
  this->control(0, 1, 0);
  run(this->w, 12);
  const double before = this->speed().z;
  run(this->w, 24);
  EXPECT_NEAR((before - this->speed().z) / 0.4, 10, 0.2);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(this->rim(i), 0, 1e-3) << i;
  run(this->w, 120);
  EXPECT_LT(length(this->speed()), 0.01);
  EXPECT_LT(std::fabs(this->heading()), 0.1);
}

TYPED_TEST(Tracks, turns_on_the_spot_to_where_it_steers) {
  for (const double steer : {1.0, -1.0}) {
    this->renew();
    this->add_tank(0, 0.25);
    run(this->w, 60);
    const D3 from = this->place();
    this->control(1, 0, steer);
    double most = 0;
    for (int step = 0; step < 90; ++step) {
      run(this->w, 1);
      most = std::max(most, length(this->place() - from));
    }
    EXPECT_GT(this->yaw_rate() * steer, 0.5);
    EXPECT_LT(most, 0.001);
    EXPECT_NEAR(this->rim(0), -this->rim(3), 0.05);
    EXPECT_LT(this->rim(0) * steer, -0.1);
  }
}

/// At half of the steering the inner track has no drive, and the outer turns the body forwards: its moment is above
/// what friction across has at the four wheels that are not in the middle, 4000 N m.
TYPED_TEST(Tracks, turns_forwards_by_the_outer_track) {
  using S = TypeParam;
  this->add_tank(0, 0.25);
  this->change_vehicle([](VehicleSettings<S>& v) { v.engine_torque = S(4800); });
  this->control(1, 0, 0.5);
  run(this->w, 60);
  EXPECT_GT(this->yaw_rate(), 0.2);
  EXPECT_GT(this->speed().z, 0.5);
  EXPECT_GT(this->rim(3), this->rim(0) + 0.2);
}

/// Locked, without throttle: the inner track, geared to 0, stops; nothing turns it while the differential is open.
TYPED_TEST(Tracks, turns_without_throttle_by_a_locked_differential) {
  using S = TypeParam;
  for (const int locked : {0, 1}) {
    this->renew();
    this->add_tank(4, 0.25);
    this->change_vehicle([&](VehicleSettings<S>& v) { v.differential_lock = S(locked); });
    this->control(0, 0, 0.5);
    run(this->w, 30);
    if (locked == 0) {
      EXPECT_LT(std::fabs(this->heading()), 0.1);
      EXPECT_NEAR(this->speed().z, 4, 0.02);
    } else {
      EXPECT_GT(this->yaw_rate(), 0.5);
      EXPECT_LT(std::fabs(this->rim(0)), 0.25 * this->rim(3));
    }
  }
}

}  // namespace tracks_test
}  // namespace isostep::test
