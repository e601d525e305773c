// The flight simulator: wings, tail and fin as aerodynamic surfaces, and a script that holds height, speed and bank.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/store/state.hpp"
#include "scenes/build.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

// The nose looks along x, y is up, the right wing is at z = 1. Forces per metre a second of air: lift of a wing at its
// camber and by its angle, drag of it.
constexpr double kLift = 6.25, kAngleLift = 12.5, kWingDrag = 0.625;  // [N s/m]
constexpr double kTailLift = 10, kFinLift = 7.5;                      // [N s/m] by the angle
constexpr double kDeflection = 2.5, kTailDeflection = 5;              // [N s/m] by a full control

using Rows = std::vector<Number>;  // of a tensor
Rows wing(double lift) { return {-kWingDrag, 0, 0, lift, -kAngleLift, 0, 0, 0, 0}; }
Rows tail(double lift) { return {0, 0, 0, lift, -kTailLift, 0, 0, 0, 0}; }
Rows fin(double push) { return {0, 0, 0, 0, 0, 0, push, 0, -kFinLift}; }

SceneRecord surface(Point at, Rows (*rows)(double), double lift, double deflection = kDeflection) {
  return {"aero_surface",
          {{"body", {0}},
           {"point", {at.x, at.y, at.z}},
           {"tensor", rows(lift)},
           {"low", rows(lift - deflection)},
           {"high", rows(lift + deflection)}}};
}

template <class S> S number(double value) { return value_of<S>(value, "script"); }
template <class S> S within(S x, double most) { return clamp(x, number<S>(-most), number<S>(most)); }

template <class S> void deflect(World<S>& world, AeroSurfaceId id, S control) {
  AeroSurface<S> surface = *world.find(id);
  surface.control = within(control, 1);
  world.set(id, surface);
}

}  // namespace

Scene flight(Turn turn) {
  Scene scene = awake(2 * kFlightTurns);
  scene.script = turn == Turn::right ? Script::flight : Script::flight_left;
  SceneBody aircraft = body_of(box_part({1, 0.2, 0.3}), {-240, kFlightHeight, 0});
  aircraft.mass = 10;
  aircraft.inertia = {6, 16, 10};
  aircraft.velocity = {kFlightSpeed, 0, 0};
  scene.bodies.push_back(aircraft);
  scene.records = {{"thruster", {{"body", {0}}}},
                   surface({0, 0, -1}, wing, kLift),
                   surface({0, 0, 1}, wing, kLift),
                   surface({-2, 0, 0}, tail, 0, kTailDeflection),
                   surface({-2, 0.5, 0}, fin, 0)};
  return scene;
}

/// Proportional control of each axis. Mirrored, every quantity of roll and yaw has the other sign, bit for bit.
template <class S> void fly(World<S>& world, Turn turn) {
  const SlotMap& bodies = world.state().body_slots;
  const RecordStore<S>& records = *world.state().records;
  const auto surfaces = records.aero_surfaces.slot_map().template ids<AeroSurfaceId>();
  const auto engines = records.thrusters.slot_map().template ids<ThrusterId>();
  const auto aircraft = bodies.template ids<BodyId>();
  if (aircraft.empty() || surfaces.size() < 4 || engines.empty()) return;
  const BodyId body = aircraft[0];
  const Mat3<Unit<S>> axes = to_matrix(world.pose(body).orientation);
  const Vec3<Unit<S>> nose = axes.column(0), right = axes.column(2);
  const Vec3<S> velocity = world.velocity(body), spin = world.angular_velocity(body);
  const double bank = world.tick() < kFlightTurns ? 0 : turn == Turn::right ? kFlightBank : -kFlightBank;
  const S aileron = (number<S>(bank) + convert<S>(right.y)) * number<S>(2) - dot(spin, nose);
  const S climb = within<S>((number<S>(kFlightHeight) - world.center_of_mass(body).y) * number<S>(0.25), 2);
  const S elevator = dot(spin, right) * number<S>(0.75) - (climb - velocity.y) * number<S>(0.75);
  deflect(world, surfaces[0], aileron);
  deflect(world, surfaces[1], -aileron);
  deflect(world, surfaces[2], elevator);
  deflect(world, surfaces[3], dot(velocity, right) * number<S>(-2));
  Thruster<S> engine = *world.find(engines[0]);
  const S slow = number<S>(kFlightSpeed) - dot(velocity, nose);
  engine.body = body;
  engine.force.x = clamp(number<S>(10) + slow * number<S>(20), number<S>(0), number<S>(60));
  world.set(engines[0], engine);
}

#define ISO_INSTANTIATE(S) template void fly<S>(World<S>&, Turn);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
