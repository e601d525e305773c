// Laws of vehicles: sag, braking, steering, grip, roll and drive against closed forms, on the car of scene S17.
// SPDX-License-Identifier: MIT
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace vehicles_test {

/// The car of S17, heading +z.
template <class S> class Vehicles : public ::testing::Test {
 protected:
  static constexpr double kMass = 1200, kSide = 0.8, kHalfBase = 1.35, kBase = 2 * kHalfBase;
  static constexpr double kHeight = 0.55;  // [m] of the centre of mass, at rest
  static constexpr double kWheelRadius = 0.35;

  struct Car {
    BodyId body;
    VehicleId vehicle;
    WheelId wheels[4];  // left front, right front, left rear, right rear
  };
  static VehicleSettings<S> engine_of(BodyId body) {
    VehicleSettings<S> v;
    v.body = body;
    v.engine_torque = S(1200);
    v.brake_torque = S(1500);
    return v;
  }
  static WheelSettings<S> wheel_of(BodyId body, double x, double z, double steer) {
    WheelSettings<S> wheel;
    wheel.body = body;
    wheel.hard_point = vec<S>(x, 0, z);
    wheel.stiffness = S(30000);
    wheel.damping = S(2400);
    wheel.drive_share = S(0.25);
    wheel.steer_angle = num<S>(steer);
    return wheel;
  }
  Car add_car(D3 at, double speed = 0, double yaw = 0, Quat<Unit<S>> orientation = Quat<Unit<S>>::identity()) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.9, 0.3, 2.1), at);
    d.velocity = vec<S>(rotated<S>(orientation, {0, 0, speed}));
    d.angular_velocity = vec<S>(0, yaw, 0);
    d.orientation = orientation;
    d.mass = num<S>(kMass);
    d.allow_sleep = false;
    Car car;
    car.body = w.create(d);
    car.vehicle = w.add(engine_of(car.body));
    EXPECT_TRUE(car.vehicle) << describe(w.fault());
    const double x[] = {kSide, -kSide, kSide, -kSide}, z[] = {kHalfBase, kHalfBase, -kHalfBase, -kHalfBase};
    for (int i = 0; i < 4; ++i) {
      car.wheels[i] = w.add(wheel_of(car.body, x[i], z[i], i < 2 ? 0.5 : 0));
      EXPECT_TRUE(car.wheels[i]) << describe(w.fault());
    }
    // It rolls from the first step on.
    for (const WheelId id : car.wheels) EXPECT_TRUE(w.set_spin(id, num<S>(speed / kWheelRadius)));
    return car;
  }
  void control(const Car& car, double throttle, double brake, double steer = 0) {
    VehicleInput<S> input = *w.input(car.vehicle);
    input.throttle = num<S>(throttle);
    input.brake = num<S>(brake);
    input.steer = num<S>(steer / 0.5);
    ASSERT_TRUE(w.set_input(car.vehicle, input)) << describe(w.fault());
  }
  void set_curve(const Car& car, double peak_slip, double peak, double slide_slip, double slide) {
    for (const WheelId id : car.wheels) {
      WheelSettings<S> wheel = *w.find(id);
      wheel.peak_slip = num<S>(peak_slip);
      wheel.peak_grip = num<S>(peak);
      wheel.slide_slip = num<S>(slide_slip);
      wheel.slide_grip = num<S>(slide);
      ASSERT_TRUE(w.set(id, wheel)) << describe(w.fault());
    }
  }
  void torque(const Car& car, double brakes) {
    VehicleSettings<S> v = *w.find(car.vehicle);
    v.brake_torque = num<S>(brakes);
    ASSERT_TRUE(w.set(car.vehicle, v)) << describe(w.fault());
  }
  void slope(double degrees) {
    BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
    d.material.friction = S(1);
    d.orientation = tilt(degrees);
    w.create(d);
  }
  /// Downhill is +z.
  static Quat<Unit<S>> tilt(double degrees) { return turn<S>({1, 0, 0}, degrees * kPi / 180); }
  D3 place(const Car& car) { return real(w.center_of_mass(car.body)); }
  D3 speed(const Car& car) { return real(w.velocity(car.body)); }
  D3 axis(const Car& car, D3 local) { return rotated<S>(w.pose(car.body).orientation, local); }
  static double dot3(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

  /// Adds a car on a circle of that radius of the middle, counter-clockwise about the origin, at rest in its springs.
  Car add_on_circle(double radius, double speed) {
    const double rear = std::sqrt(radius * radius - kHalfBase * kHalfBase);
    const Car car = add_car({-rear, kHeight, kHalfBase}, speed * rear / radius, speed / radius);
    const double yaw = speed / radius;
    w.set_velocity(car.body, vec<S>(yaw * kHalfBase, 0, yaw * rear), vec<S>(0, yaw, 0));
    control(car, 0, 0, std::atan(kBase / rear));
    return car;
  }
  double off_circle(double radius, double speed) {
    World<S> fresh(settings<S>());
    w = std::move(fresh);
    add_ground(w, 1);
    const Car car = add_on_circle(radius, speed);
    run(w, 60);
    const D3 at = place(car);
    return std::hypot(at.x, at.z) - radius;
  }

  /// Writes a figure into the report that --gtest_output makes.
  static void told(const char* what, double figure) { ::testing::Test::RecordProperty(what, std::to_string(figure)); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(Vehicles, AllScalars);

TYPED_TEST(Vehicles, springs_sag_by_the_weight_over_their_stiffness) {
  add_ground(this->w, 1);
  const auto car = this->add_car({0, 0.6, 0});
  run(this->w, 300);
  for (const WheelId id : car.wheels) {
    EXPECT_NEAR(0.3 - to_double(this->w.state(id)->length), 0.1, 0.001);
    EXPECT_NEAR(to_double(this->w.state(id)->load), 3000, 15);
    EXPECT_NEAR(to_double(this->w.state(id)->spin), 0, 0.01);
    EXPECT_TRUE(this->w.state(id)->contact_body);
  }
  EXPECT_NEAR(this->place(car).y, this->kHeight, 0.001);
  this->told("sag", 0.65 - this->place(car).y);
}

TYPED_TEST(Vehicles, brakes_stop_it_within_the_square_of_its_speed_over_twice_the_friction) {
  add_ground(this->w, 1);
  const auto car = this->add_car({0, this->kHeight, 0}, 20);
  run(this->w, 30);
  const double from = this->place(car).z, speed = this->speed(car).z;
  EXPECT_NEAR(speed, 20, 0.05);
  this->control(car, 0, 1);
  run(this->w, 180);
  const D3 forward = this->axis(car, {0, 0, 1});
  const double expected = speed * speed / 20;
  EXPECT_NEAR(this->place(car).z - from, expected, 0.02 * expected);
  EXPECT_LT(std::fabs(std::atan2(forward.x, forward.z)) * 180 / kPi, 0.5);
  EXPECT_LT(length(this->speed(car)), 0.01);
  this->told("stopped_in", (this->place(car).z - from) / expected * 20);
  this->told("heading", std::atan2(forward.x, forward.z) * 180 / kPi);
}

/// Brakes hold each wheel with more than the tyre's 1 without slip and less than the 1.25 of its peak, at a slip of
/// 0.125: it slips where mu is what they ask for. They slow the wheels as well: F = T / r - I a / r^2. Loads of the
/// front wheels are more by m a h / 2 base.
TYPED_TEST(Vehicles, brakes_at_the_slip_at_which_the_curve_bears_its_brakes) {
  add_ground(this->w, 1);
  const auto car = this->add_car({0, this->kHeight, 0}, 30);
  this->set_curve(car, 0.125, 1.25, 0.5, 1);
  const auto more = [&](double a) { return this->kMass * a * this->kHeight / (2 * this->kBase); };
  const double load = this->kMass * 10 / 4, front = 1.1 * (load + more(11)), rear = 1.1 * (load - more(11));
  for (const WheelId id : {car.wheels[2], car.wheels[3]}) {
    WheelSettings<TypeParam> wheel = *this->w.find(id);
    wheel.brake_share = num<TypeParam>(rear / front);
    ASSERT_TRUE(this->w.set(id, wheel));
  }
  this->torque(car, front * this->kWheelRadius);
  this->control(car, 0, 1);
  run(this->w, 30);
  const double before = this->speed(car).z;
  double slip = 0;
  for (int i = 0; i < 60; ++i) {
    run(this->w, 1);
    for (const WheelId id : car.wheels) slip += to_double(this->w.state(id)->slip) / 240;
  }
  const double square = this->kWheelRadius * this->kWheelRadius, a = 11 / (1 + 4 / (this->kMass * square));
  const double mu_front = (front - a / square) / (load + more(a)), mu_rear = (rear - a / square) / (load - more(a));
  const double braking = before - this->speed(car).z, expected = ((mu_front - 1) + (mu_rear - 1)) / 2 * 0.125 / 0.25;
  EXPECT_NEAR(braking, a, 0.005 * a);
  EXPECT_NEAR(slip, expected, 0.1 * expected);
  this->told("braking", braking);
  this->told("slip", slip);
}

TYPED_TEST(Vehicles, slides_with_locked_wheels_by_the_end_of_the_curve) {
  add_ground(this->w, 1);
  const auto car = this->add_car({0, this->kHeight, 0}, 20);
  this->set_curve(car, 0.0625, 1.25, 0.25, 0.75);
  this->control(car, 0, 1);
  this->torque(car, 6000);
  run(this->w, 30);
  const double before = this->speed(car).z;
  run(this->w, 60);
  EXPECT_NEAR(before - this->speed(car).z, 7.5, 0.02 * 7.5);
  for (const WheelId id : car.wheels) EXPECT_NEAR(to_double(this->w.state(id)->slip), 1, 0.01);
  run(this->w, 180);
  EXPECT_LT(length(this->speed(car)), 0.01);
  for (const WheelId id : car.wheels) EXPECT_NEAR(to_double(this->w.state(id)->slip), 0, 0.01);
}

TYPED_TEST(Vehicles, steering_leads_the_rear_axle_round_a_circle) {
  add_ground(this->w, 1);
  const auto car = this->add_car({0, this->kHeight, 0}, 3);
  this->control(car, 0, 0, 10 * kPi / 180);
  run(this->w, 60);
  const auto rear = [&] { return this->place(car) + this->axis(car, {0, 0, -this->kHalfBase}); };
  D3 at[3];
  for (int i = 0; i < 3; ++i) {
    at[i] = rear();
    run(this->w, 180);
  }
  const auto apart = [&](int i, int j) { return std::hypot(at[i].x - at[j].x, at[i].z - at[j].z); };
  const double a = apart(0, 1), b = apart(1, 2), c = apart(0, 2), s = (a + b + c) / 2;
  const double radius = a * b * c / (4 * std::sqrt(s * (s - a) * (s - b) * (s - c)));  // of the circle through them
  EXPECT_NEAR(radius, 15.31, 0.03 * 15.31);
  this->told("radius", radius);
}

TYPED_TEST(Vehicles, lets_go_of_a_circle_where_friction_ends) {
  double lets_go = 0;
  for (double v = 12.5; v < 16 && lets_go == 0; v += 0.1) {
    if (this->off_circle(20, v) > 0.1) lets_go = v;
  }
  EXPECT_NEAR(lets_go, 14.14, 0.05 * 14.14);
  this->told("lets_go", lets_go);
}

TYPED_TEST(Vehicles, leans_by_the_moment_of_its_acceleration_over_its_springs) {
  add_ground(this->w, 1);
  const auto car = this->add_on_circle(20, 10);
  run(this->w, 150);
  double sum = 0, speed = 0;
  for (int i = 0; i < 60; ++i) {
    run(this->w, 1);
    sum += std::asin(-this->axis(car, {1, 0, 0}).y) * 180 / kPi / 60;
    speed += length(this->speed(car)) / 60;
  }
  const double a = speed * speed / 20, moment = this->kMass * a * this->kHeight;
  const double expected =
      moment / (4 * 30000 * this->kSide * this->kSide - this->kMass * 10 * this->kHeight) * 180 / kPi;
  EXPECT_NEAR(expected, 2.69, 0.1);
  EXPECT_NEAR(std::fabs(sum), expected, 0.1 * expected);
  this->told("leans", sum / expected * 2.69);
}

TYPED_TEST(Vehicles, torque_moves_its_mass_and_turns_its_wheels) {
  add_ground(this->w, 1);
  const auto car = this->add_car({0, this->kHeight, 0});
  this->control(car, 1, 0);
  run(this->w, 60);
  const double before = this->speed(car).z;
  run(this->w, 120);
  const double expected = 1200 / 0.35 / (this->kMass + 4 / (0.35 * 0.35));
  EXPECT_NEAR((this->speed(car).z - before) / 2, expected, 0.01 * expected);
  this->told("accelerates", (this->speed(car).z - before) / 2);
}

TYPED_TEST(Vehicles, stands_on_a_slope_with_its_brakes_on) {
  this->slope(30);
  const D3 up = rotated<TypeParam>(this->tilt(30), {0, this->kHeight, 0});
  const auto car = this->add_car(up, 0, 0, this->tilt(30));
  this->control(car, 0, 1);
  run(this->w, 300);
  const D3 from = this->place(car);
  run(this->w, 3600);
  EXPECT_LT(length(this->place(car) - from), 0.001);
  this->told("crept", length(this->place(car) - from));
}

TYPED_TEST(Vehicles, slides_down_a_slope_that_is_steeper_than_its_friction) {
  this->slope(46);
  const D3 up = rotated<TypeParam>(this->tilt(46), {0, this->kHeight, 0});
  const D3 down = rotated<TypeParam>(this->tilt(46), {0, 0, 1});
  const auto car = this->add_car(up, 0, 0, this->tilt(46));
  this->control(car, 0, 1);
  run(this->w, 120);
  const double before = this->dot3(this->speed(car), down);
  run(this->w, 240);
  EXPECT_NEAR((this->dot3(this->speed(car), down) - before) / 4, 0.247, 0.0247);
  this->told("slides", (this->dot3(this->speed(car), down) - before) / 4);
}

TYPED_TEST(Vehicles, lands_on_its_springs_and_comes_to_rest) {
  add_ground(this->w, 1);
  const auto car = this->add_car({0, this->kHeight + 0.5, 0});
  this->control(car, 0, 1);
  double lowest = 1;
  for (int i = 0; i < 180; ++i) {
    run(this->w, 1);
    lowest = std::min(lowest, this->place(car).y - 0.3);
  }
  EXPECT_GT(lowest, 0.02);
  EXPECT_LT(length(this->speed(car)), 0.01);
  EXPECT_EQ(this->w.counts().contacts, 0u);
  this->told("lowest", lowest);
}

/// Nothing but its wheels reaches the ground.
TYPED_TEST(Vehicles, asleep_wakes_with_what_its_ground_becomes) {
  using S = TypeParam;
  for (const bool filter : {false, true}) {
    this->w = World<S>(settings<S>());
    const BodyId ground = add_ground(this->w, 1);
    BodyDefinition<S> d = moving<S>(add_box(this->w, 0.9, 0.3, 2.1), {0, this->kHeight, 0});
    d.mass = num<S>(this->kMass);
    const BodyId car = this->w.create(d);
    for (const double x : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) ASSERT_TRUE(this->w.add(this->wheel_of(car, x, z, 0)));
    }
    ASSERT_TRUE(settle(this->w));
    Material<S> ice = this->w.view(ground).properties->material;
    ice.friction = S(0);
    ASSERT_TRUE(filter ? this->w.set_filter(ground, {1, 0, 0}) : this->w.set_material(ground, ice));
    EXPECT_TRUE(this->w.is_awake(car));
    run(this->w, 60);
    EXPECT_EQ(to_double(this->w.center_of_mass(car).y) < 0, filter);
  }
}

/// What a step writes is no field of the settings: who sets them from copies of the first frame takes nothing back.
TYPED_TEST(Vehicles, drives_alike_whether_a_game_sets_its_settings_too) {
  using S = TypeParam;
  add_ground(this->w, 1);
  const auto car = this->add_car({0, this->kHeight, 0});
  VehicleSettings<S> engine = *this->w.find(car.vehicle);
  engine.engine_torque = S(300);
  engine.gears[0] = S(4);
  engine.engine_inertia = num<S>(0.5);
  engine.clutch_torque = S(200);
  ASSERT_TRUE(this->w.set(car.vehicle, engine)) << describe(this->w.fault());
  const WheelSettings<S> wheels[] = {*this->w.find(car.wheels[0]), *this->w.find(car.wheels[1]),
                                     *this->w.find(car.wheels[2]), *this->w.find(car.wheels[3])};
  typename World<S>::Snapshot start;
  this->w.save(start);
  World<S> other(settings<S>());
  ASSERT_TRUE(other.load(start));
  for (int i = 0; i < 180; ++i) {
    VehicleInput<S> input;
    input.throttle = S(i < 120 ? 1 : 0);
    input.clutch = num<S>(i < 30 ? 0.5 : 1);
    input.brake = num<S>(i < 150 ? 0 : 0.125);
    input.steer = num<S>(i % 60 < 30 ? 0.25 : -0.25);
    ASSERT_TRUE(this->w.set_input(car.vehicle, input)) << describe(this->w.fault());
    ASSERT_TRUE(other.set(car.vehicle, engine));
    for (int wheel = 0; wheel < 4; ++wheel) ASSERT_TRUE(other.set(car.wheels[wheel], wheels[wheel]));
    ASSERT_TRUE(other.set_input(car.vehicle, input));
    this->w.step(), other.step();
    ASSERT_EQ(this->w.hash(), other.hash()) << i;
  }
  EXPECT_GT(this->place(car).z, 2);
  EXPECT_GT(to_double(this->w.state(car.vehicle)->engine_spin), 10);
  EXPECT_GT(to_double(this->w.state(car.wheels[0])->spin), 2);
}

}  // namespace vehicles_test
}  // namespace isostep::test
