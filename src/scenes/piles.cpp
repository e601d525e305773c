// S4, S5, S9, S10: many bodies that fall, settle or are stirred.
// SPDX-License-Identifier: MIT
#include "hull_recipes.hpp"
#include "named.hpp"
#include "shapes.hpp"

namespace isostep::scenes {

namespace {
/// Layers of 7 x 7.
Point place_in_pit(int n) {
  const int layer = n / 49, column = n % 49;
  return {(column % 7 - 3) * 1.4, 1.0 + 1.2 * layer, (column / 7 - 3) * 1.4};
}
}  // namespace

Scene pile(int bodies) {
  Scene scene;
  scene.allow_sleep = false;
  add_pit(scene, 10);
  Draws draws(12345);
  for (int n = 0; n < bodies; ++n) {
    scene.bodies.push_back(drawn_body(n, place_in_pit(n), draws, 1));
  }
  return scene;
}

Scene hull_pile(int bodies) {
  Scene scene;
  scene.allow_sleep = false;
  add_pit(scene, 10);
  Draws draws(2025);
  for (int n = 0; n < bodies; ++n) {
    const DrawnHull hull = drawn_hull(n, draws);
    scene.bodies.push_back(body_of(hull_part(hull.points), place_in_pit(n)));
    scene.bodies.back().orientation = yaw(hull.yaw);
  }
  return scene;
}

Scene rain() {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = 300;
  add_pit(scene, 10);
  Draws draws(777);
  for (int n = 0; n < 4000; ++n) {
    const int layer = n / 256, column = n % 256;
    const double dx = draws.between(-0.02, 0.02), dz = draws.between(-0.02, 0.02);
    const Point at = {(column % 16 - 7.5) * 0.6 + dx, 2.0 + 0.6 * layer, (column / 16 - 7.5) * 0.6 + dz};
    scene.bodies.push_back(body_of(sphere_part(0.25), at));
  }
  return scene;
}

namespace {
constexpr double kDrumHeight = 6;  // [m] of its axis
constexpr int kLayer = 60, kLayers = 10;

/// Eight sides and two end walls, one body. A part's x axis points away from the drum's axis.
SceneBody drum() {
  SceneBody body;
  body.type = BodyType::kinematic;
  body.position = {0, kDrumHeight, 0};
  body.angular_velocity = {0, 0, 0.6};
  for (int i = 0; i < 8; ++i) {
    const double angle = i * (kTurn / 8);
    const SinCos<double> whole = sin_cos(angle), half = sin_cos(angle / 2);
    ScenePart side = box_part({0.5, 1.8, 4});
    side.position = {4.5 * whole.cos, 4.5 * whole.sin, 0};
    side.orientation = {0, 0, half.sin, half.cos};
    body.parts.push_back(side);
  }
  for (const double z : {4.5, -4.5}) {
    ScenePart wall = box_part({5.5, 5.5, 0.5});
    wall.position = {0, 0, z};
    body.parts.push_back(wall);
  }
  return body;
}

/// The first 60 lattice points inside the drum's cross section.
std::vector<Point> lattice() {
  std::vector<Point> points;
  for (int j = -4; j <= 4; ++j) {
    for (int i = -4; i <= 4 && points.size() < kLayer; ++i) {
      if (i * i + j * j <= 20) points.push_back({0.75 * i, kDrumHeight + 0.75 * j, 0});
    }
  }
  return points;
}
}  // namespace

SceneBody mixer_body(int n) {
  Draws draws(2024);
  for (int i = 0; i < 4 * n; ++i) draws.next();
  Point at = {0, kDrumHeight, 0};
  if (n < kLayer * kLayers) {
    static const std::vector<Point> points = lattice();
    at = points[static_cast<std::size_t>(n % kLayer)];
    at.z = (n / kLayer - 4.5) * 0.75;
  }
  return drawn_body(n, at, draws, 0.5);
}

Scene mixer() {
  Scene scene;
  scene.allow_sleep = false;
  scene.script = Script::mixer;
  scene.frames = kMixerBirthsEnd + 60;
  scene.bodies.push_back(drum());
  for (int n = 0; n < kLayer * kLayers; ++n) scene.bodies.push_back(mixer_body(n));
  return scene;
}

}  // namespace isostep::scenes
