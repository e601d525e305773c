// Four cars and four walkers in the town.
// SPDX-License-Identifier: MIT
#include "street.hpp"

#include "build.hpp"
#include "cars.hpp"
#include "isostep/store/state.hpp"
#include "levels/level.hpp"
#include "shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr Frame kChoice = 60;  // [frames] a bot holds what it chose

void add_walker(Scene& scene, Point at) {
  const double body = static_cast<double>(scene.bodies.size());
  scene.bodies.push_back(body_of(capsule_part(0.3, 0.6), at));
  scene.bodies.back().type = BodyType::kinematic;
  scene.records.push_back({"character", {{"body", {body}}}});
}
/// A door of 20 kg, 1 m wide, whose hinge is at its western edge.
void add_door(Scene& scene, Point foot) {
  const int body = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(body_of(box_part({0.5, 0.9, 0.05}), {foot.x + 0.5, foot.y + 1, foot.z}));
  scene.bodies.back().mass = 20;
  SceneJoint hinge = joint_of(JointType::hinge, -1, body, {foot.x, foot.y + 1, foot.z});
  hinge.orientation = {-kHalfRoot, 0, 0, kHalfRoot};  // z to y
  hinge.flags = joint_flag::kLimit;
  hinge.lower = -2;
  hinge.upper = 2;
  scene.joints.push_back(hinge);
}
/// A platform of 500 kg on a slider, which a motor presses up against a stop a metre above; a walker's weight or a car
/// on it changes nothing, its motor bears them.
void add_lift(Scene& scene, Point at) {
  const int body = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(body_of(box_part({1, 0.125, 1}), at));
  scene.bodies.back().mass = 500;
  SceneJoint slide = joint_of(JointType::slider, -1, body, at);
  slide.anchor_b = slide.anchor;
  slide.orientation = {-kHalfRoot, 0, 0, kHalfRoot};
  slide.flags = joint_flag::kLimit | joint_flag::kMotor;
  slide.upper = 1;
  slide.motor_speed = 0.25;
  slide.max_force = 20'000;
  scene.joints.push_back(slide);
}

}  // namespace

StreetInput street_bot(int player, Frame frame) {
  Draws draws(static_cast<std::uint32_t>(frame / kChoice) * 2654435761u + static_cast<std::uint32_t>(player) * 97u +
              5u);
  for (int i = 0; i < 3; ++i) draws.next();
  StreetInput input;
  const auto draw = [&](double most) { return static_cast<std::int8_t>(draws.between(-most, most)); };
  input.throttle = draw(100);
  input.steer = draw(127);
  input.walk_x = draw(120);
  input.walk_z = draw(120);
  const double dice = draws.unit();
  input.buttons = static_cast<std::uint8_t>((dice < 0.25 && frame % kChoice < 2 ? 1 : 0) | (dice > 0.75 ? 2 : 0));
  return input;
}

Scene street() {
  Scene scene = town_level().scene;
  scene.frames = 600;
  scene.script = Script::street;
  constexpr Point kCarPlaces[] = {{1.25, 0.6, 12}, {-1.25, 0.6, -14}, {14, 0.6, -1.25}, {-15, 0.6, 1.25}};
  constexpr double kYaws[] = {kTurn / 2, 0, -kTurn / 4, kTurn / 4};  // towards the middle
  for (int i = 0; i < kStreetPlayers; ++i) add_car(scene, kCarPlaces[i], kYaws[i]);
  constexpr Point kWalkerPlaces[] = {{-3, 1, -6}, {3.5, 1, -8}, {-6, 1, 3.5}, {8, 1, -3.5}};
  for (const Point at : kWalkerPlaces) add_walker(scene, at);
  for (int i = 0; i < 12; ++i) {
    scene.bodies.push_back(body_of(box_part({0.25, 0.25, 0.25}), {20.0 + 0.55 * (i % 3), 0.3 + 0.5 * (i / 3), 1.5}));
    scene.bodies.back().mass = 10;
  }
  add_door(scene, {-5, 0, -4});
  add_door(scene, {4, 0, -5});
  add_lift(scene, {8, 0.25, -8});
  return scene;
}

template <class S> void play_street(World<S>& world, std::span<const StreetInput> inputs) {
  const auto part = [](std::int8_t n, S unit) { return S(static_cast<int>(n)) * unit; };
  const S share = value_of<S>(1.0 / 128, "script"), speed = value_of<S>(1.0 / 32, "script");
  const RecordStore<S>& records = *world.state().records;
  const auto cars = records.vehicles.slot_map().template ids<VehicleId>();
  const auto walkers = records.characters.slot_map().template ids<CharacterId>();
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const StreetInput& input = inputs[i];
    VehicleInput<S> driver;
    driver.throttle = part(input.throttle, share);
    driver.steer = part(input.steer, share);
    driver.brake = S((input.buttons & 2) != 0 ? 1 : 0);
    world.set_input(cars[i], driver);
    CharacterInput<S> walk = *world.input(walkers[i]);  // a jump in the air waits for the ground
    walk.move = {part(input.walk_x, speed), S(0), part(input.walk_z, speed)};
    if ((input.buttons & 1) != 0) walk.jump = S(5);
    world.set_input(walkers[i], walk);
  }
}
template <class S> void play_street(World<S>& world) {
  StreetInput inputs[kStreetPlayers];
  for (int i = 0; i < kStreetPlayers; ++i) inputs[i] = street_bot(i, static_cast<Frame>(world.tick()));
  play_street<S>(world, inputs);
}

#define ISO_INSTANTIATE(S)                                               \
  template void play_street<S>(World<S>&, std::span<const StreetInput>); \
  template void play_street<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
