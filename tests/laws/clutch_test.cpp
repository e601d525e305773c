// Laws of clutches: what passes between an engine with inertia and a car's wheels, against closed forms.
// SPDX-License-Identifier: MIT

#include "unit/world/edited_state.hpp"

namespace isostep::test {
namespace clutch_test {

/// 1200 kg on four wheels of 1 kg m^2, heading +z, geared 4 to an engine of 0.5 kg m^2.
template <class S> class Clutches : public ::testing::Test {
 protected:
  static constexpr double kMass = 1200, kHeight = 0.55, kRadius = 0.35, kSquare = kRadius * kRadius;
  static constexpr double kGear = 4, kInertia = 0.5, kMost = 200;
  static constexpr double kCar = (kMass * kSquare + 4) / (kGear * kGear);  // [kg m^2] at the clutch, 9.44

  void SetUp() override {
    add_ground(w, 1);
    BodyDefinition<S> d = moving<S>(add_box(w, 0.9, 0.3, 2.1), {0, kHeight, 0});
    d.mass = num<S>(kMass);
    car = w.create(d);
    VehicleSettings<S> v;
    v.body = car;
    v.gears[0] = num<S>(kGear);
    v.gears[1] = S(0);
    v.gears[2] = num<S>(-kGear);
    v.engine_inertia = num<S>(kInertia);
    v.clutch_torque = num<S>(kMost);
    v.brake_torque = S(1500);
    vehicle = w.add(v);
    EXPECT_TRUE(vehicle) << describe(w.fault());
    for (int i = 0; i < 4; ++i) {
      WheelSettings<S> wheel;
      wheel.body = car;
      wheel.hard_point = vec<S>(i % 2 == 0 ? 0.8 : -0.8, 0, i < 2 ? 1.35 : -1.35);
      wheel.stiffness = S(30000);
      wheel.damping = S(2400);
      wheel.drive_share = S(1);
      wheels[i] = w.add(wheel);
      EXPECT_TRUE(wheels[i]) << describe(w.fault());
    }
  }
  template <class Change> void ask(const Change& of) {
    VehicleInput<S> input = *w.input(vehicle);
    of(input);
    ASSERT_TRUE(w.set_input(vehicle, input)) << describe(w.fault());
  }
  void turn_engine(double spin) {
    edit_parts(w, [&](RecordParts<S>& parts) { parts.vehicle_states[vehicle.slot].engine_spin = num<S>(spin); });
  }
  void turn_engine(double spin, double clutch) {
    turn_engine(spin);
    ask([&](VehicleInput<S>& input) { input.clutch = num<S>(clutch); });
  }
  void press(double torque) {
    VehicleSettings<S> v = *w.find(vehicle);
    v.engine_torque = num<S>(torque);
    ASSERT_TRUE(w.set(vehicle, v)) << describe(w.fault());
    ask([](VehicleInput<S>& input) { input.throttle = S(1); });
  }
  double engine() const { return to_double(w.state(vehicle)->engine_spin); }
  double load() const { return to_double(w.state(vehicle)->clutch_load); }
  double shaft() const {
    double sum = 0;
    for (const WheelId id : wheels) sum += to_double(w.state(id)->spin);
    return kGear * sum / 4;
  }
  double speed() const { return to_double(w.velocity(car).z); }

  World<S> w{settings<S>()};
  BodyId car;
  VehicleId vehicle;
  WheelId wheels[4];
};
TYPED_TEST_SUITE(Clutches, AllScalars);

/// The slip of 200 rad/s ends at (1/I + 1/I_car) T: in 0.47 s.
TYPED_TEST(Clutches, slips_with_its_torque_and_ends_locked) {
  this->turn_engine(200, 1);
  const double gone = this->kMost * (1 / this->kInertia + 1 / this->kCar) / 60;  // [rad/s] of slip in a step
  double least = 0;
  for (double slip = 200; slip > 2 * gone; slip -= gone) {
    const double before = this->engine();
    run(this->w, 1);
    EXPECT_NEAR((before - this->engine()) * 60 * this->kInertia, this->kMost, 0.01 * this->kMost);
    EXPECT_NEAR(this->load(), this->kMost, 0.01 * this->kMost);
    EXPECT_NEAR(this->engine() - this->shaft(), slip - gone, 2);
  }
  for (int step = 0; step < 60; ++step) {
    run(this->w, 1);
    least = std::min(least, this->engine() - this->shaft());
  }
  const double together = 200 * this->kInertia / (this->kInertia + this->kCar);
  EXPECT_GT(least, -0.001);
  EXPECT_NEAR(this->engine(), this->shaft(), 0.001);
  EXPECT_NEAR(this->engine(), together, 0.001 * together);
  EXPECT_NEAR(this->speed(), together / this->kGear * this->kRadius, 0.001 * this->speed());
  EXPECT_NEAR(this->load(), 0, 0.1);
}

TYPED_TEST(Clutches, slips_with_the_part_of_its_torque_that_is_asked_for) {
  this->turn_engine(200, 0.25);
  run(this->w, 1);
  const double before = this->engine();
  run(this->w, 60);
  EXPECT_NEAR((before - this->engine()) * this->kInertia, this->kMost / 4, 0.01 * this->kMost / 4);
}

TYPED_TEST(Clutches, leaves_the_car_alone_while_the_engine_turns_up) {
  using S = TypeParam;
  this->turn_engine(0, 0);
  this->press(300);
  for (int step = 1; step <= 60; ++step) {
    run(this->w, 1);
    EXPECT_NEAR(this->engine(), 300 / this->kInertia * step / 60, 0.01 * 600);
    ASSERT_TRUE(this->w.is_awake(this->car));
  }
  run(this->w, 60);
  EXPECT_NEAR(this->engine(), 600, 1);
  EXPECT_NEAR(this->speed(), 0, 1e-3);
  EXPECT_EQ(this->load(), 0);
  // Neutral is as good, with the clutch engaged.
  this->ask([](VehicleInput<S>& input) { input.gear = 1, input.clutch = S(1), input.throttle = S(-1); });
  run(this->w, 60);
  EXPECT_NEAR(this->engine(), 0, 6);
  EXPECT_NEAR(this->speed(), 0, 1e-3);
}

/// Engine and car as one, as far as the clutch bears what the car needs; a reverse gear likewise.
TYPED_TEST(Clutches, accelerates_car_and_engine_together) {
  using S = TypeParam;
  for (const std::uint32_t gear : {0u, 2u}) {
    this->ask([&](VehicleInput<S>& input) { input.gear = gear; });
    this->turn_engine(0);
    this->w.set_velocity(this->car, vec<S>(0, 0, 0), vec<S>(0, 0, 0));
    this->press(100);
    run(this->w, 60);
    const double before = this->speed(), sign = gear == 0 ? 1 : -1;
    run(this->w, 60);
    const double expected = sign * 100 / (this->kCar + this->kInertia) / this->kGear * this->kRadius;
    EXPECT_NEAR(this->speed() - before, expected, 0.001 * std::fabs(expected)) << gear;
    EXPECT_NEAR(this->engine(), sign * this->shaft(), 0.001) << gear;
    EXPECT_NEAR(this->load(), 100 * this->kCar / (this->kCar + this->kInertia), 0.2) << gear;
  }
}

TYPED_TEST(Clutches, slips_while_throttle_asks_for_more_than_it_bears) {
  this->press(300);
  run(this->w, 30);
  const double before = this->speed(), engine = this->engine();
  run(this->w, 60);
  const double expected = this->kMost / this->kCar / this->kGear * this->kRadius;
  EXPECT_NEAR(this->speed() - before, expected, 0.001 * expected);
  EXPECT_NEAR(this->engine() - engine, 100 / this->kInertia, 0.01 * 100 / this->kInertia);
}

TYPED_TEST(Clutches, stops_the_engine_of_a_car_with_its_brakes_on) {
  using S = TypeParam;
  this->turn_engine(100, 1);
  this->ask([](VehicleInput<S>& input) { input.brake = S(1); });
  run(this->w, 12);
  EXPECT_NEAR(100 - this->engine(), this->kMost / this->kInertia / 5, 1);
  run(this->w, 60);
  EXPECT_NEAR(this->engine(), 0, 0.01);
  EXPECT_NEAR(this->speed(), 0, 1e-3);
  EXPECT_TRUE(settle(this->w));
}

}  // namespace clutch_test
}  // namespace isostep::test
