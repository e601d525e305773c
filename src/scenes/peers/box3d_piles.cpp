// After Box3D's: pyramids of boxes, a pile of boulders, rocks that a pillar pushes around.
// SPDX-License-Identifier: MIT
#include <cmath>

#include "peers.hpp"
#include "scenes/build.hpp"
#include "scenes/hull_recipes.hpp"

namespace isostep::scenes {
namespace {

constexpr double kFriction = 0.6, kDensity = 1000;  // [1], [kg/m^3] Box3D's defaults

void add_rock(Scene& scene, const ScenePart& rock, Point at) {
  scene.bodies.push_back(body_of(rock, at));
  scene.bodies.back().density = kDensity;
  scene.bodies.back().friction = kFriction;
}

void add_ground(Scene& scene, double half) {
  scene.bodies.push_back(fixed_box({0, -1, 0}, {half, 1, half}));
  scene.bodies.back().friction = kFriction;
}
/// A triangle of unit boxes, `rows` high, whose lowest box in front stands at `first` [m].
void add_triangle(Scene& scene, int rows, Point first) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows - i; ++j) {
      SceneBody box = body_of(box_part({0.5, 0.5, 0.5}), {first.x + 0.5 * i + j, first.y + i, first.z});
      box.density = 100;
      box.friction = kFriction;
      box.allow_sleep = false;
      scene.bodies.push_back(box);
    }
  }
}

/// [m] 32 points of a ball of 2 m.
std::vector<Point> boulder_points() {
  constexpr std::size_t kPoints = 32;
  constexpr double kRadius = 2;
  Draws draws(42);
  std::vector<Point> points;
  while (points.size() < kPoints) {
    const double x = draws.between(-1, 1), y = draws.between(-1, 1), z = draws.between(-1, 1);
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length > 1 || length < 0x1p-6) continue;
    const double out = kRadius / length;
    points.push_back(on_grid(Point{out * x, out * y, out * z}));
  }
  return points;
}
/// [m] Ten points of a ball, evenly spread along a spiral.
std::vector<Point> rock_on_spiral(double radius) {
  constexpr int kPoints = 10;
  constexpr double kGolden = 1.6180339887498949;
  std::vector<Point> points;
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - (2 * i + 1) / double{kPoints}, wide = std::sqrt(1 - z * z);
    const SinCos<double> at = sin_cos(i * kTurn / kGolden);
    points.push_back(on_grid(Point{radius * wide * at.cos, radius * wide * at.sin, radius * z}));
  }
  return points;
}

constexpr double kPusherWay = 35, kPusherSpeed = kTurn * 6 / 360;  // [m] from the middle, [rad/s]

SceneBody pusher() {
  constexpr int kSides = 16;
  constexpr double kRadius = 4, kHeight = 24;  // [m]
  std::vector<Point> points;
  for (int side = 0; side < kSides; ++side) {
    const SinCos<double> at = sin_cos(kTurn * side / kSides);
    for (const double y : {0.0, kHeight}) points.push_back(on_grid(Point{kRadius * at.cos, y, kRadius * at.sin}));
  }
  SceneBody body = body_of(hull_part(points), {kPusherWay, 0, 0});
  body.type = BodyType::kinematic;
  body.friction = kFriction;
  return body;
}

}  // namespace

Scene large_pyramid() {
  constexpr int kRows = 100;
  Scene scene = awake(400);
  add_ground(scene, 400);
  add_triangle(scene, kRows, {0.5 - kRows / 2, 0.5, 0});
  return scene;
}

Scene many_pyramids() {
  constexpr int kSide = 14, kRows = 10;
  constexpr double kHalf = 76;  // [m]
  Scene scene;
  scene.frames = 300;
  add_ground(scene, kHalf + 1);
  for (int n = 0; n < kSide * kSide; ++n) {
    add_triangle(scene, kRows, {n % kSide * 11 - kHalf, 0.5, n / kSide * (2 * kHalf / (kSide - 1)) - kHalf});
  }
  return scene;
}

Scene convex_pile() {
  constexpr int kSide = 8, kLayers = 80;
  constexpr double kApart = 4;  // [m]
  Scene scene;
  scene.frames = 500;
  add_ground(scene, 250);
  const ScenePart boulder = hull_part(boulder_points());
  for (int n = 0; n < kSide * kSide * kLayers; ++n) {
    const int x = n % kSide, z = n / kSide % kSide, layer = n / (kSide * kSide);
    add_rock(scene, boulder, {(x - kSide / 2) * kApart, 2 + kApart * layer, (z - kSide / 2) * kApart});
  }
  return scene;
}

Scene junkyard() {
  constexpr int kSide = 21, kLayers = 24;
  Scene scene;
  scene.frames = 500;
  scene.script = Script::pusher;
  SceneBody yard = fixed_box({0, -1, 0}, {120, 1, 120});
  const auto add_wall = [&](Point half, Point at) {
    ScenePart wall = box_part(half);
    wall.position = vector_of(at);
    yard.parts.push_back(wall);
  };
  for (const double side : {-50.0, 50.0}) {
    add_wall({1, 8, 50}, {side, 8, 0});
    add_wall({50, 8, 1}, {0, 8, side});
  }
  yard.friction = kFriction;
  scene.bodies.push_back(yard);
  scene.bodies.push_back(pusher());
  const ScenePart rock = hull_part(rock_on_spiral(1.5));
  for (int n = 0; n < kSide * kSide * kLayers; ++n) {
    const int x = n / kSide % kSide, z = n % kSide, layer = n / (kSide * kSide);
    add_rock(scene, rock, {4.0 * x - 40, 4.0 * layer + 25, 4.0 * z - 40});
  }
  return scene;
}

template <class S> void push_junk(World<S>& world) {
  const double angle = -kPusherSpeed / 60 * static_cast<double>(world.tick() + 1);
  const SinCos<double> at = sin_cos(angle);
  const S x = value_of<S>(kPusherWay * at.cos, "script"), z = value_of<S>(kPusherWay * at.sin, "script");
  for (const BodyId body : world.bodies()) {
    if (world.type(body) != BodyType::kinematic) continue;
    world.move_to(body, {{x, S(0), z}, Quat<Unit<S>>::identity()});
    return;
  }
}

#define ISO_INSTANTIATE(S) template void push_junk<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
