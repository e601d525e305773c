// After Jolt's Pyramid, MaxBodies, ConvexVsMesh and CharacterVirtual.
// SPDX-License-Identifier: MIT
#include "isostep/store/state.hpp"
#include "land.hpp"
#include "peers.hpp"
#include "scenes/build.hpp"
#include "scenes/hull_recipes.hpp"

namespace isostep::scenes {
namespace {

Scene scene_of_jolt() {
  Scene scene;
  scene.gravity = {0, -9.81, 0};
  return scene;
}
/// With Jolt's defaults.
SceneBody loose(SceneBody body) {
  body.density = 1000;
  body.friction = 0.2;
  body.linear_damping = body.angular_damping = 0.05;
  return body;
}
/// [m] Ground of 100 by 100 cells: waves of that many radians from side to side.
SceneBody rolling_land(double pitch, double height, double radians, double middle) {
  constexpr int kCells = 100;
  SceneBody body = body_of(land(kCells, kCells, pitch,
                                [&](int i, int k) {
                                  const double x = sin_cos(i * radians / kCells).sin;
                                  return on_grid(middle + height * x * sin_cos(k * radians / kCells).cos);
                                }),
                           {0, 0, 0});
  body.type = BodyType::static_;
  body.friction = 0.2;
  return body;
}

constexpr int kRow = 10, kCrossers = kRow * kRow;
constexpr double kApart = 4;                      // [m]
constexpr std::uint64_t kTurnTicks = 120;         // from one aim to the next
constexpr double kRadius = 0.3, kHalfUp = 0.675;  // [m] of the capsule

/// [m] The n-th place of the field, on the ground.
Point place_of(int n) { return {kApart * (n % kRow) - 20, 0, kApart * (n / kRow) - 20}; }

template <class S> S scalar(double value) { return value_of<S>(value, "script"); }

template <class S> void add_crossers(World<S>& world) {
  BodyDefinition<S> body;
  body.type = BodyType::kinematic;
  body.allow_sleep = false;
  body.material.friction = scalar<S>(0.2);
  body.shape = world.add_shape(Capsule<S>{scalar<S>(kRadius), scalar<S>(kHalfUp)});
  for (int n = 0; n < kCrossers; ++n) {
    const Point at = place_of(n);
    body.position = {scalar<S>(at.x), scalar<S>(2 + kRadius + kHalfUp), scalar<S>(at.z)};
    CharacterSettings<S> walker;
    walker.body = world.create(body);
    walker.mass = scalar<S>(70);
    walker.push_force = scalar<S>(100);
    walker.step_height = scalar<S>(0.4);
    walker.least_up = scalar<S>(0.6428);  // 50 degrees
    world.add(walker);
  }
}

}  // namespace

Scene jolt_pyramid() {
  constexpr int kHeight = 15;
  Scene scene = scene_of_jolt();
  scene.frames = 300;
  scene.bodies.push_back(fixed_box({0, -1, 0}, {50, 1, 50}));
  scene.bodies.back().friction = 0.2;
  for (int i = 0; i < kHeight; ++i) {
    for (int j = i / 2; j < kHeight - (i + 1) / 2; ++j) {
      for (int k = i / 2; k < kHeight - (i + 1) / 2; ++k) {
        const double shift = i % 2;
        scene.bodies.push_back(
            loose(body_of(box_part({1, 1, 1}), {2.0 * j + shift - 15, 2.5 * i + 1, 2.0 * k + shift - 15})));
        scene.bodies.back().allow_sleep = false;
      }
    }
  }
  return scene;
}

Scene max_bodies_of(int bodies) {
  int side = 1;
  while (static_cast<std::int64_t>(side) * side * side < bodies) ++side;
  Scene scene = scene_of_jolt();
  scene.frames = 60;
  for (int n = 0; n < bodies; ++n) {
    const double x = n % side, y = 2 * (n / side % side), z = 2 * (n / (side * side));
    scene.bodies.push_back(loose(body_of(box_part({0.5, 0.5, 0.5}), {x, y, z})));
  }
  return scene;
}

Scene max_bodies() { return max_bodies_of(131072); }

Scene convex_on_land() {
  constexpr int kHalfRow = 10, kKinds = 4;
  Scene scene = scene_of_jolt();
  scene.frames = 500;
  scene.restitution_threshold = 1;
  scene.bodies.push_back(rolling_land(3, 5, 50, 5));
  const ScenePart parts[kKinds] = {box_part({0.5, 0.75, 1}), sphere_part(0.5), capsule_part(0.5, 0.75),
                                   hull_part({{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}})};
  for (int x = -kHalfRow; x <= kHalfRow; ++x) {
    for (int y = 0; y < kKinds; ++y) {
      for (int z = -kHalfRow; z <= kHalfRow; ++z) {
        scene.bodies.push_back(loose(body_of(parts[y], {7.5 * x, 15 + 2.0 * y, 7.5 * z})));
      }
    }
  }
  for (SceneBody& body : scene.bodies) {
    body.friction = 0.5;
    body.restitution = 0.6;
  }
  return scene;
}

Scene crossers() {
  constexpr int kSteps = 10, kPosts = 10;
  Scene scene = scene_of_jolt();
  scene.frames = 600;
  scene.script = Script::crossers;
  scene.bodies.push_back(rolling_land(0.5, 2, 20, 0));
  const auto add_fixed = [&](Point at, Point half) {
    scene.bodies.push_back(fixed_box(at, half));
    scene.bodies.back().friction = 0.2;
  };
  for (int i = 0; i < kSteps; ++i) add_fixed({-4, 0.3 * i - 1, 0}, {4 - 0.4 * i, 0.15, 4 - 0.4 * i});
  for (int i = 0; i < kPosts; ++i) add_fixed({2, 1, 2 + 0.2 * i}, {0.1, 2.5, 0.1});
  for (int n = 0; n < kCrossers; ++n) {
    const Point at = place_of(n);
    scene.bodies.push_back(loose(body_of(box_part({0.25, 0.25, 0.25}), {at.x, 5, at.z})));
    scene.bodies.back().mass = 1;
  }
  return scene;
}

template <class S> void lead_crossers(World<S>& world) {
  const std::uint64_t tick = world.tick();
  if (tick == 0) add_crossers(world);
  const std::uint64_t turn = tick / kTurnTicks;
  std::uint32_t n = 0;
  for (const CharacterId id : world.state().records->characters.slot_map().template ids<CharacterId>()) {
    Draws draws(static_cast<std::uint32_t>(turn * kCrossers + n++) * 2654435761u);
    draws.next();
    const Point aim = place_of(static_cast<int>(kCrossers * draws.unit()));
    const double speed = 5 + 0.5 * static_cast<int>(10 * draws.unit());  // [m/s]
    const Vec3<S> at = world.pose(world.find(id)->body).position;
    const Direction<S> way = direction_of(scalar<S>(aim.x) - at.x, S(0), scalar<S>(aim.z) - at.z);
    CharacterInput<S> walk;
    walk.move = {convert<S>(way.x) * scalar<S>(speed), S(0), convert<S>(way.z) * scalar<S>(speed)};
    world.set_input(id, walk);
  }
}

#define ISO_INSTANTIATE(S) template void lead_crossers<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
