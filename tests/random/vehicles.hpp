// Random vehicles: added to worlds, driven and taken to pieces: functions of the state and the dice.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/record_draw.hpp"

namespace isostep::test {

/// Makes up to two vehicles of two to six wheels, whose engines end at some metres a second. Some have tracks, at the
/// left and the right or of any wheels, and some a clutch.
template <class S> class RandomVehicles {
 public:
  static constexpr double kFastest = 4;  // [m/s] of a rim

  RandomVehicles(World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  /// Makes `placed` a vehicle where it is a body for one; else one is driven, or loses a wheel, or all.
  void change(BodyId placed) {
    if (placed) return build(placed);
    const auto vehicles = world_.state().records->vehicles.slot_map().template ids<VehicleId>();
    const auto wheels = world_.state().records->wheels.slot_map().template ids<WheelId>();
    if (vehicles.empty()) return;
    const VehicleId id = dice_.one_of(vehicles);
    if (dice_.one_in(24)) {
      world_.remove(id);
    } else if (dice_.one_in(24) && !wheels.empty()) {
      world_.remove(dice_.one_of(wheels));
    } else {
      world_.set_input(id, drawn_input());
    }
  }
  bool has_room() const { return world_.state().records->vehicles.slot_map().template ids<VehicleId>().size() < 2; }

 private:
  void build(BodyId body) {
    const double mass = to_double(world_.mass(body)), radius = dice_.in(0.125, 0.25);
    VehicleSettings<S> vehicle;
    vehicle.body = body;
    vehicle.engine_torque = num<S>(mass * dice_.in(0, 2));
    vehicle.engine_speed = num<S>(kFastest / radius * dice_.in(0.25, 1));
    vehicle.gears[1] = S(-1);
    vehicle.gears[2] = S(0.5);
    vehicle.differential_lock = num<S>(dice_.in(0, 1));
    vehicle.brake_torque = num<S>(mass * dice_.in(0, 4));
    vehicle.handbrake_torque = num<S>(mass * dice_.in(0, 4));
    vehicle.ackermann = num<S>(dice_.in(0, 1));
    const VehicleInput<S> input = drawn_input();
    if (dice_.one_in(2)) add_clutch(vehicle, mass, radius);
    const VehicleId id = world_.add(vehicle);
    if (!id) return;
    world_.set_input(id, input);
    const std::uint32_t wheels = 2 + dice_.below(5);
    const std::uint32_t tracks = dice_.below(3);  // none, two, or up to three of any wheels
    for (std::uint32_t i = 0; i < wheels; ++i) {
      WheelSettings<S> wheel;
      wheel.body = body;
      wheel.hard_point = vec<S>(i % 2 == 0 ? 0.5 : -0.5, dice_.in(-0.125, 0.125), dice_.in(-1, 1));
      wheel.free_length = num<S>(dice_.in(0.125, 0.5));
      wheel.travel = num<S>(dice_.in(0, to_double(wheel.free_length)));
      wheel.stiffness = num<S>(mass * dice_.in(0, 60));
      wheel.damping = num<S>(mass * dice_.in(0, 6));
      wheel.radius = num<S>(radius);
      wheel.inertia = num<S>(mass * radius * radius * dice_.in(0.0078125, 0.125));
      wheel.grip_along = num<S>(dice_.in(0, 2));
      wheel.grip_across = num<S>(dice_.in(0, 2));
      if (dice_.one_in(2)) {
        wheel.peak_slip = num<S>(dice_.in(0.015625, 0.25));
        wheel.slide_slip = num<S>(to_double(wheel.peak_slip) + dice_.in(0.015625, 1));
        wheel.peak_grip = num<S>(dice_.in(0, 2));
        wheel.slide_grip = num<S>(dice_.in(0, 2));
      }
      wheel.steer_angle = num<S>(dice_.one_in(2) ? dice_.in(-0.75, 0.75) : 0);
      wheel.drive_share = num<S>(dice_.one_in(2) ? dice_.in(0, 1) : 0);
      wheel.handbrake_share = num<S>(dice_.in(0, 1));
      wheel.axle = dice_.below(3);
      wheel.anti_roll = num<S>(mass * dice_.in(0, 30));
      wheel.track = tracks == 0 ? 0 : tracks == 1 ? 1 + i % 2 : dice_.below(3);
      world_.add(wheel);
    }
  }
  void add_clutch(VehicleSettings<S>& vehicle, double mass, double radius) {
    vehicle.engine_inertia = num<S>(mass * radius * radius * dice_.in(0.0625, 0.5));
    vehicle.clutch_torque = num<S>(mass * dice_.in(0, 4));
    vehicle.track_steer = num<S>(dice_.in(0, 2));
  }
  VehicleInput<S> drawn_input() {
    VehicleInput<S> input;
    RecordDraw<S> random(world_, dice_);
    detail::RecordRules<VehicleSettings<S>>::draw(input, random);
    return input;
  }

  World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
