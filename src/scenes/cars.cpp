// Cars of 1200 kg on wheels with springs of 30 kN/m, 0.8 m and 1.35 m from the middle, driven by all four.
// SPDX-License-Identifier: MIT
#include "cars.hpp"

#include "build.hpp"
#include "isostep/store/state.hpp"
#include "shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr double kPitch = 12;       // [m]
constexpr double kMostSteer = 0.3;  // [rad]

}  // namespace

void add_car(Scene& scene, Point at, double heading) {
  const double body = static_cast<double>(scene.bodies.size());
  scene.bodies.push_back(body_of(box_part({0.9, 0.3, 2.1}), at));
  scene.bodies.back().mass = 1200;
  if (heading != 0) scene.bodies.back().orientation = yaw(heading);
  scene.records.push_back({"vehicle", {{"body", {body}}, {"engine_torque", {1200}}, {"brake_torque", {1500}}}});
  for (const int wheel : {0, 1, 2, 3}) {
    const bool front = wheel < 2;
    scene.records.push_back({"wheel",
                             {{"body", {body}},
                              {"hard_point", {wheel % 2 == 0 ? 0.8 : -0.8, 0, front ? 1.35 : -1.35}},
                              {"stiffness", {30000}},
                              {"damping", {2400}},
                              {"steer_angle", {front ? kMostSteer : 0.0}},
                              {"drive_share", {1}}}});
  }
}

Scene cars() {
  Scene scene;
  scene.frames = 600;
  scene.script = Script::cars;
  scene.bodies.push_back(fixed_box({0, -1, 0}, {120, 1, 120}));
  scene.bodies.back().friction = 1;
  for (int row = 0; row < kCarsASide; ++row) {
    for (int column = 0; column < kCarsASide; ++column)
      add_car(scene, {kPitch * (column - 3.5), 0.55, kPitch * (row - 3.5)});
  }
  return scene;
}

template <class S> void drive_cars(World<S>& world) {
  const auto number = [](double value) { return value_of<S>(value, "script"); };
  constexpr std::uint64_t kRound = 360, kThrottle = 120, kBrake = 300, kSwing = 240;  // [frames]
  const std::uint64_t tick = world.tick();
  const S turned = S(static_cast<int>(tick % kSwing)) * number(2 * 3.14159265358979323846 / kSwing);
  const auto ids = world.state().records->vehicles.slot_map().template ids<VehicleId>();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    VehicleInput<S> driver;
    driver.throttle = S(tick % kRound < kThrottle ? 1 : 0);
    driver.brake = S(tick % kRound < kBrake ? 0 : 1);
    driver.steer = sin(turned + S(static_cast<int>(i)));
    world.set_input(ids[i], driver);
  }
}

#define ISO_INSTANTIATE(S) template void drive_cars<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
