// Vehicles and wheels as records: faults, snapshots, recordings, sleep, and ground that gives way.
// SPDX-License-Identifier: MIT

#include "isostep/replay/recorder.hpp"
#include "isostep/state/verify.hpp"
#include "isostep/store/state_validator.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace vehicles_test {

template <class S> class VehicleRecords : public ::testing::Test {
 protected:
  static constexpr double kMass = 400;

  static WheelSettings<S> wheel_of(BodyId body, int i) {
    WheelSettings<S> wheel;
    wheel.body = body;
    wheel.hard_point = vec<S>(i % 2 == 0 ? 0.8 : -0.8, 0, i < 2 ? 1.25 : -1.25);
    wheel.stiffness = S(10000);
    wheel.damping = S(800);
    wheel.drive_share = S(1);
    wheel.steer_angle = i < 2 ? num<S>(0.5) : S(0);
    return wheel;
  }
  BodyId add_body(D3 at, double mass = kMass) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.75, 0.25, 1.75), at);
    d.mass = num<S>(mass);
    return w.create(d);
  }
  VehicleSettings<S> vehicle_of(BodyId body) const {
    VehicleSettings<S> v;
    v.body = body;
    v.engine_torque = S(300);
    v.brake_torque = S(600);
    return v;
  }
  BodyId add_car(D3 at) {
    const BodyId body = add_body(at);
    vehicle = w.add(vehicle_of(body));
    for (int i = 0; i < 4; ++i) wheels[i] = w.add(wheel_of(body, i));
    EXPECT_TRUE(vehicle && wheels[3]) << describe(w.fault());
    return body;
  }
  void control(double throttle, double brake, double steer = 0) {
    VehicleInput<S> input = *w.input(vehicle);
    input.throttle = num<S>(throttle);
    input.brake = num<S>(brake);
    input.steer = num<S>(steer);
    EXPECT_TRUE(w.set_input(vehicle, input));
  }
  /// A track on each side, and an engine behind a clutch that slips while it starts.
  void add_tracks_and_clutch() {
    for (int i = 0; i < 4; ++i) {
      WheelSettings<S> wheel = *w.find(wheels[i]);
      wheel.track = i % 2 == 0 ? 1 : 2;
      EXPECT_TRUE(w.set(wheels[i], wheel));
    }
    VehicleSettings<S> v = *w.find(vehicle);
    v.engine_inertia = num<S>(0.5);
    v.clutch_torque = S(200);
    EXPECT_TRUE(w.set(vehicle, v));
  }
  double height(BodyId body) { return to_double(w.center_of_mass(body).y); }
  template <class Record, class Change> void expect_fault(Record record, const char* field, const Change& change) {
    change(record);
    EXPECT_FALSE(w.add(record)) << field;
    EXPECT_STREQ(w.fault().field, field);
  }
  template <class Change> void expect_input_fault(VehicleId id, const char* field, const Change& change) {
    VehicleInput<S> input;
    change(input);
    EXPECT_FALSE(w.set_input(id, input)) << field;
    EXPECT_STREQ(w.fault().field, field);
  }
  /// A state read from outside may have that.
  template <class Change> bool is_valid_with(const Change& change) {
    WorldState<S> state = w.state();
    change(state.parts);
    return broken_rule(state) == nullptr;
  }

  World<S> w{settings<S>()};
  VehicleId vehicle;
  WheelId wheels[4];
};
TYPED_TEST_SUITE(VehicleRecords, AllScalars);

TYPED_TEST(VehicleRecords, name_what_is_wrong_with_a_vehicle) {
  using S = TypeParam;
  using V = VehicleSettings<S>;
  using I = VehicleInput<S>;
  const V v = this->vehicle_of(this->add_body({0, 2, 0}));
  this->expect_fault(v, "body", [&](V& r) { r.body = {}; });
  this->expect_fault(v, "body", [&](V& r) { r.body = add_ground(this->w); });
  this->expect_fault(v, "engine_torque", [](V& r) { r.engine_torque = S(-1); });
  this->expect_fault(v, "engine_speed", [](V& r) { r.engine_speed = S(-1); });
  this->expect_fault(v, "differential_lock", [](V& r) { r.differential_lock = S(2); });
  this->expect_fault(v, "brake_torque", [](V& r) { r.brake_torque = S(-1); });
  this->expect_fault(v, "handbrake_torque", [](V& r) { r.handbrake_torque = S(-1); });
  this->expect_fault(v, "ackermann", [](V& r) { r.ackermann = S(2); });
  this->expect_fault(v, "engine_inertia", [](V& r) { r.engine_inertia = S(-1); });
  this->expect_fault(v, "engine_inertia", [](V& r) { r.engine_inertia = S(0x1p-11); });
  this->expect_fault(v, "clutch_torque", [](V& r) { r.clutch_torque = S(-1); });
  this->expect_fault(v, "track_steer", [](V& r) { r.track_steer = S(-1); });
  this->expect_fault(v, "track_steer", [](V& r) { r.track_steer = S(3); });
  const VehicleId id = this->w.add(v);
  ASSERT_TRUE(id);
  this->expect_fault(v, "body", [](V&) {});
  const std::uint64_t before = this->w.hash();
  this->expect_input_fault(id, "gear", [](I& i) { i.gear = kMostGears; });
  this->expect_input_fault(id, "throttle", [](I& i) { i.throttle = S(-2); });
  this->expect_input_fault(id, "brake", [](I& i) { i.brake = S(2); });
  this->expect_input_fault(id, "handbrake", [](I& i) { i.handbrake = S(-1); });
  this->expect_input_fault(id, "steer", [](I& i) { i.steer = S(2); });
  this->expect_input_fault(id, "clutch", [](I& i) { i.clutch = S(-1); });
  this->expect_input_fault(id, "clutch", [](I& i) { i.clutch = S(2); });
  EXPECT_EQ(this->w.hash(), before);
  const auto is_valid_with = [&](const auto& change) {
    return this->is_valid_with([&](RecordParts<S>& parts) { change(parts.vehicle_states[id.slot]); });
  };
  EXPECT_TRUE(is_valid_with([](VehicleState<S>&) {}));
  EXPECT_FALSE(is_valid_with([](VehicleState<S>& s) { s.engine_spin = fastest_engine<S>() * S(2); }));
  if constexpr (kIsFixed<S>) return;
  const S infinite = from_bits<S>(to_bits(highest<S>()) + 1);
  this->expect_fault(v, "gears", [&](V& r) { r.gears[3] = infinite; });
  this->expect_fault(v, "final_drive", [&](V& r) { r.final_drive = infinite; });
  this->expect_fault(v, "engine_inertia", [&](V& r) { r.engine_inertia = infinite; });
  this->expect_fault(v, "clutch_torque", [&](V& r) { r.clutch_torque = infinite; });
  EXPECT_FALSE(is_valid_with([&](VehicleState<S>& s) { s.engine_spin = infinite; }));
  EXPECT_FALSE(is_valid_with([&](VehicleState<S>& s) { s.clutch_load = infinite; }));
}

TYPED_TEST(VehicleRecords, name_what_is_wrong_with_a_wheel) {
  using S = TypeParam;
  using W = WheelSettings<S>;
  using U = Unit<S>;
  const W wheel = this->wheel_of(this->add_body({0, 2, 0}), 0);
  this->expect_fault(wheel, "body", [&](W& r) { r.body = {}; });
  this->expect_fault(wheel, "hard_point", [](W& r) { r.hard_point.x = Limits<S>::position() + Limits<S>::position(); });
  this->expect_fault(wheel, "suspension", [](W& r) { r.suspension.y = U(0); });
  this->expect_fault(wheel, "axle_direction", [](W& r) { r.axle_direction.x = U(0); });
  this->expect_fault(wheel, "axle_direction", [](W& r) { r.axle_direction = r.suspension; });
  this->expect_fault(wheel, "free_length", [](W& r) { r.free_length = S(0); });
  this->expect_fault(wheel, "travel", [](W& r) { r.travel = r.free_length * S(2); });
  this->expect_fault(wheel, "stiffness", [](W& r) { r.stiffness = S(-1); });
  this->expect_fault(wheel, "damping", [](W& r) { r.damping = S(-1); });
  this->expect_fault(wheel, "radius", [](W& r) { r.radius = S(0); });
  this->expect_fault(wheel, "inertia", [](W& r) { r.inertia = S(0); });
  this->expect_fault(wheel, "grip_along", [](W& r) { r.grip_along = S(-1); });
  this->expect_fault(wheel, "grip_across", [](W& r) { r.grip_across = S(17); });
  this->expect_fault(wheel, "steer_angle", [](W& r) { r.steer_angle = S(2); });
  this->expect_fault(wheel, "drive_share", [](W& r) { r.drive_share = S(-1); });
  this->expect_fault(wheel, "brake_share", [](W& r) { r.brake_share = S(2); });
  this->expect_fault(wheel, "handbrake_share", [](W& r) { r.handbrake_share = S(2); });
  this->expect_fault(wheel, "anti_roll", [](W& r) { r.anti_roll = S(-1); });
  this->expect_fault(wheel, "peak_slip", [](W& r) { r.peak_slip = S(0); });
  this->expect_fault(wheel, "peak_grip", [](W& r) { r.peak_grip = S(-1); });
  this->expect_fault(wheel, "slide_slip", [](W& r) { r.slide_slip = r.peak_slip; });
  this->expect_fault(wheel, "slide_slip", [](W& r) { r.slide_slip = S(5); });
  this->expect_fault(wheel, "slide_grip", [](W& r) { r.slide_grip = S(17); });
  const WheelId id = this->w.add(wheel);
  ASSERT_TRUE(id);
  const auto is_valid_with = [&](const auto& change) {
    return this->is_valid_with([&](RecordParts<S>& parts) { change(parts.wheel_states[id.slot]); });
  };
  EXPECT_TRUE(is_valid_with([](WheelState<S>&) {}));
  EXPECT_FALSE(is_valid_with([](WheelState<S>& s) { s.angle = S(7); }));
  EXPECT_FALSE(is_valid_with([](WheelState<S>& s) { s.steered = S(-7); }));
  EXPECT_FALSE(is_valid_with([](WheelState<S>& s) { s.slip = S(5); }));
  EXPECT_FALSE(is_valid_with([](WheelState<S>& s) { s.load = S(-1); }));
  if constexpr (std::is_same_v<S, Q16_16>)
    this->expect_fault(wheel, "inertia", [](W& r) { r.inertia = num<S>(0.125); });
}

TYPED_TEST(VehicleRecords, go_on_alike_after_a_snapshot_and_from_the_portable_form) {
  using S = TypeParam;
  for (const bool tracked : {false, true}) {
    World<S> fresh(settings<S>());
    this->w = std::move(fresh);
    add_ground(this->w, 0.9);
    this->add_car({0, 1, 0});
    if (tracked) this->add_tracks_and_clutch();
    this->control(1, 0, 0.5);
    run(this->w, 45);
    EXPECT_EQ(to_double(this->w.state(this->vehicle)->engine_spin) > 1, tracked);
    typename World<S>::Snapshot middle;
    this->w.save(middle);
    const auto bytes = bytes_of(this->w);
    const auto drive_on = [&](World<S>& world) {
      for (int i = 0; i < 90; ++i) {
        VehicleInput<S> input = *world.input(this->vehicle);
        input.brake = S(i > 45 ? 1 : 0);
        input.steer = S(i % 2);
        input.clutch = num<S>(i % 30 < 10 ? 0 : 1);
        world.set_input(this->vehicle, input);
        world.step();
      }
      return world.hash();
    };
    const std::uint64_t first = drive_on(this->w);
    ASSERT_TRUE(this->w.load(middle));
    EXPECT_EQ(drive_on(this->w), first);
    World<S> other;
    Reader reader(bytes);
    ASSERT_TRUE(other.read_portable(reader));
    EXPECT_EQ(drive_on(other), first);
  }
}

/// With all wheels on axles that meet: inner wheels turn by more than the outer.
TYPED_TEST(VehicleRecords, tell_how_far_their_wheels_are_steered) {
  add_ground(this->w, 1);
  this->add_car({0, 0.55, 0});
  this->control(0, 1, 1);
  run(this->w, 2);
  const double base = 2.5, side = 0.8, middle = base / std::tan(0.5);
  const double expected[] = {std::atan(base / (middle - side)), std::atan(base / (middle + side)), 0, 0};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(to_double(this->w.state(this->wheels[i])->steered), expected[i], 1e-3) << i;
  this->control(0, 1, -1);
  run(this->w, 2);
  EXPECT_NEAR(to_double(this->w.state(this->wheels[0])->steered), -expected[1], 1e-3);
  this->control(0, 1, 0);
  run(this->w, 2);
  EXPECT_EQ(to_double(this->w.state(this->wheels[0])->steered), 0);
}

TYPED_TEST(VehicleRecords, stand_by_every_solver) {
  using S = TypeParam;
  for (std::uint32_t solver = 0; solver < kSolvers; ++solver) {
    if (left_out(SolverName{solver}) != nullptr) continue;
    Settings<S> s = settings<S>();
    s.solver = static_cast<SolverName>(solver);
    World<S> fresh(s);
    this->w = std::move(fresh);
    add_ground(this->w, 1);
    const BodyId car = this->add_car({0, 0.6, 0});
    this->control(0, 1);
    run(this->w, 240);
    EXPECT_NEAR(this->height(car), 0.55, 0.002) << kSolverNames[solver];
  }
}

TYPED_TEST(VehicleRecords, sleep_with_their_ground_and_wake_by_their_inputs) {
  const BodyId ground = add_ground(this->w, 1);
  const BodyId car = this->add_car({0, 0.55, 0});
  this->control(0, 1);
  EXPECT_TRUE(settle(this->w));
  EXPECT_FALSE(this->w.is_awake(car));
  this->control(1, 0);
  run(this->w, 60);
  EXPECT_GT(to_double(this->w.velocity(car).z), 0.5);
  this->control(0, 1);
  EXPECT_TRUE(settle(this->w));
  this->w.destroy(ground);
  run(this->w, 30);
  EXPECT_LT(this->height(car), 0);
  EXPECT_FALSE(this->w.state(this->wheels[0])->contact_body);
  this->w.destroy(car);
  EXPECT_EQ(this->w.find(this->wheels[0]), nullptr);
  EXPECT_EQ(this->w.find(this->vehicle), nullptr);
  EXPECT_EQ(this->w.input(this->vehicle), nullptr);
  EXPECT_EQ(this->w.state(this->wheels[0]), nullptr);
}

TYPED_TEST(VehicleRecords, push_the_ground_back) {
  using S = TypeParam;
  // A raft without weight that nothing holds: what the car gains it loses, along and about every axis.
  const ShapeId plate = add_box(this->w, 8, 0.25, 8);
  BodyDefinition<S> d = moving<S>(plate, {0, -0.25, 0});
  d.mass = S(2000);
  d.gravity_scale = S(0);
  d.material.friction = S(1);
  const BodyId raft = this->w.create(d);
  const BodyId car = this->add_car({0, 0.55, 0});
  this->w.set_motion(car, S(0), S(0), S(0), 0);
  this->w.set_velocity(car, vec<S>(0, -1, 0), vec<S>(0, 0, 0));
  this->control(1, 0, 0.25);
  for (int i = 0; i < 60; ++i) this->w.step();
  const D3 a = real(this->w.velocity(car)) * this->kMass, b = real(this->w.velocity(raft)) * 2000.0;
  EXPECT_GT(length(b), 100);
  EXPECT_NEAR(a.x + b.x, 0, pick<S>(0.1, 1e-6, 2, 1e-3));
  EXPECT_NEAR(a.y + b.y, -this->kMass, pick<S>(0.1, 1e-6, 2, 1e-3));
  EXPECT_NEAR(a.z + b.z, 0, pick<S>(0.1, 1e-6, 2, 1e-3));
}

TYPED_TEST(VehicleRecords, stop_at_the_end_of_their_travel) {
  add_ground(this->w, 1);
  const BodyId car = this->add_car({0, 0.6, 0});
  for (const WheelId id : this->wheels) {
    WheelSettings<TypeParam> wheel = *this->w.find(id);
    wheel.stiffness = TypeParam(0);
    wheel.damping = TypeParam(0);
    wheel.travel = num<TypeParam>(0.125);
    this->w.set(id, wheel);
  }
  run(this->w, 180);
  EXPECT_NEAR(this->height(car), 0.35 + 0.175, 0.002);
  EXPECT_LT(length(real(this->w.velocity(car))), 0.001);
}

TYPED_TEST(VehicleRecords, lean_less_with_a_bar) {
  using S = TypeParam;
  double leans[2];
  for (int bar = 0; bar < 2; ++bar) {
    World<S> fresh(settings<S>());
    this->w = std::move(fresh);
    add_ground(this->w, 1);
    const BodyId car = this->add_car({0, 0.55, 0});
    for (int i = 0; i < 4 && bar != 0; ++i) {
      WheelSettings<S> wheel = *this->w.find(this->wheels[i]);
      wheel.axle = i < 2 ? 1 : 2;
      wheel.anti_roll = S(5000);
      this->w.set(this->wheels[i], wheel);
    }
    this->control(0, 1);
    for (int i = 0; i < 180; ++i) {
      this->w.apply_force(car, {S(0), S(0), S(0)}, vec<S>(0, 0, 500));
      this->w.step();
    }
    leans[bar] = to_double(to_matrix(this->w.pose(car).orientation).column(0).y);
  }
  // Of stiffness k t^2 4 less m g h: a bar adds 2 k' t^2 4 for its difference of lengths.
  EXPECT_NEAR(leans[0], 500 / (4 * 10000 * 0.64 - 400 * 10 * 0.55), 0.1 * leans[0]);
  EXPECT_NEAR(leans[1], 500 / (4 * 20000 * 0.64 - 400 * 10 * 0.55), 0.1 * leans[1]);
}

TYPED_TEST(VehicleRecords, end_at_the_speed_of_their_engine_and_drive_backwards) {
  using S = TypeParam;
  add_ground(this->w, 1);
  const BodyId car = this->add_car({0, 0.55, 0});
  VehicleSettings<S> v = *this->w.find(this->vehicle);
  v.engine_speed = S(20);
  v.gears[0] = S(2);
  v.gears[1] = S(-2);
  v.gears[2] = S(0);
  this->w.set(this->vehicle, v);
  this->control(1, 0);
  run(this->w, 480);
  EXPECT_NEAR(to_double(this->w.velocity(car).z), 10 * 0.35, 0.06);
  VehicleInput<S> input = *this->w.input(this->vehicle);
  input.gear = 1;
  ASSERT_TRUE(this->w.set_input(this->vehicle, input));
  run(this->w, 960);
  EXPECT_NEAR(to_double(this->w.velocity(car).z), -10 * 0.35, 0.06);
}

TYPED_TEST(VehicleRecords, spin_freely_at_one_side_unless_locked) {
  using S = TypeParam;
  double reached[2];
  for (int locked = 0; locked < 2; ++locked) {
    World<S> fresh(settings<S>());
    this->w = std::move(fresh);
    add_ground(this->w, 1);
    const BodyId car = this->add_car({0, 0.55, 0});
    for (int i = 0; i < 4; i += 2) {
      WheelSettings<S> wheel = *this->w.find(this->wheels[i]);
      wheel.grip_along = S(0);
      this->w.set(this->wheels[i], wheel);
    }
    VehicleSettings<S> v = *this->w.find(this->vehicle);
    v.differential_lock = S(locked);
    v.engine_speed = S(40);
    this->w.set(this->vehicle, v);
    this->control(1, 0);
    run(this->w, 60);
    reached[locked] = length(real(this->w.velocity(car)));
    const double slick = to_double(this->w.state(this->wheels[2])->spin);
    const double firm = to_double(this->w.state(this->wheels[3])->spin);
    if (locked != 0) EXPECT_NEAR(slick, firm, 1);
    else EXPECT_GT(slick, firm + 10);
  }
  EXPECT_GT(reached[1], 1.5 * reached[0]);
}

TYPED_TEST(VehicleRecords, stand_on_one_another) {
  using S = TypeParam;
  add_ground(this->w, 1);
  BodyDefinition<S> d = moving<S>(add_box(this->w, 2, 0.25, 3), {0, 0.25, 0});
  d.mass = S(4000);
  d.material.friction = S(1);
  const BodyId plate = this->w.create(d);
  EXPECT_TRUE(settle(this->w));
  const BodyId car = this->add_car({0, 1.2, 0});
  this->control(0, 1);
  run(this->w, 20);
  EXPECT_TRUE(this->w.is_awake(plate));
  EXPECT_TRUE(settle(this->w));
  EXPECT_FALSE(this->w.is_awake(car));
  this->w.set_velocity(plate, vec<S>(0, 0, 1), vec<S>(0, 0, 0));
  EXPECT_TRUE(this->w.is_awake(car));
  run(this->w, 5);
  EXPECT_GT(to_double(this->w.velocity(car).z), 0.1);
}

}  // namespace vehicles_test
}  // namespace isostep::test
