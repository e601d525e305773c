// S11, S12, S15, S16: bodies on a mesh or a height field of 20 000 triangles.
// SPDX-License-Identifier: MIT
#include "terrain.hpp"

#include <cmath>

#include "hull_recipes.hpp"
#include "named.hpp"

namespace isostep::scenes {
namespace {

constexpr int kGroundPlaces = 101;  // of heights along a side
constexpr double kApart = 0.5;      // [m]
constexpr double kGroundHalf = 25;  // [m] of the side

double place(int i) { return kApart * i - kGroundHalf; }
double hill(int i, int k) {
  const double x = place(i), z = place(k);
  const double wave = sin_cos(kTurn * i / 25).sin * sin_cos(kTurn * k / 20).cos;
  return on_grid(0.75 * wave + 0.125 * sin_cos(kTurn * (i + 2 * k) / 9).sin + 0.006 * (x * x + z * z));
}
double plain(int, int) { return 0; }

using Height = double (*)(int i, int k);

ScenePart mesh_part(Height height) {
  ScenePart part;
  part.type = ShapeType::mesh;
  for (int k = 0; k < kGroundPlaces; ++k) {
    for (int i = 0; i < kGroundPlaces; ++i) part.vertices.push_back({place(i), height(i, k), place(k)});
  }
  for (int k = 0; k + 1 < kGroundPlaces; ++k) {
    for (int i = 0; i + 1 < kGroundPlaces; ++i) {
      const double at = k * kGroundPlaces + i, right = at + 1, below = at + kGroundPlaces;
      part.triangles.push_back({at, below, right});
      part.triangles.push_back({below + 1, right, below});
    }
  }
  return part;
}
ScenePart height_field_part(Height height) {
  ScenePart part;
  part.type = ShapeType::height_field;
  part.columns = part.rows = kGroundPlaces;
  part.pitch = kApart;
  for (int k = 0; k < kGroundPlaces; ++k) {
    for (int i = 0; i < kGroundPlaces; ++i) part.heights.push_back(height(i, k));
  }
  part.position = {-kGroundHalf, 0, -kGroundHalf};
  return part;
}
void add_ground(Scene& scene, bool field, Height height) {
  scene.allow_sleep = false;
  scene.bodies.push_back(body_of(field ? height_field_part(height) : mesh_part(height), {0, 0, 0}));
  scene.bodies.back().type = BodyType::static_;
}

Point place_above(int n, double apart, double height) {
  return {(n % 10 - 4.5) * apart, height, (n / 10 % 10 - 4.5) * apart};
}

Rotation drawn_orientation(Draws& draws) {
  double q[4];
  for (double& c : q) c = draws.between(-1, 1);
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

ScenePart slider(int n) {
  switch (n % 4) {
    case 0: return sphere_part(0.25);
    case 1: return capsule_part(0.2, 0.2);
    case 2: return box_part({0.25, 0.25, 0.25});
    default: return hull_part(prism_points(0.4, 0.2, 0.29));
  }
}
/// [m] The height of a slider's centre over the plain.
double slider_height(int n) {
  const double heights[] = {0.25, 0.2, 0.25, on_grid(0.15 + 0.35 * 0.29)};
  return heights[n % 4];
}

}  // namespace

double hill_height(double x, double z) {
  const double u = (x + kGroundHalf) / kApart, v = (z + kGroundHalf) / kApart;
  const int i = std::min(std::max(static_cast<int>(u), 0), kGroundPlaces - 2);
  const int k = std::min(std::max(static_cast<int>(v), 0), kGroundPlaces - 2);
  const double s = u - i, t = v - k;
  if (s + t <= 1) return hill(i, k) + s * (hill(i + 1, k) - hill(i, k)) + t * (hill(i, k + 1) - hill(i, k));
  const double corner = hill(i + 1, k + 1);
  return corner + (1 - s) * (hill(i, k + 1) - corner) + (1 - t) * (hill(i + 1, k) - corner);
}

double hill_corner(double x, double z) {
  return hill(static_cast<int>(std::floor((x + kGroundHalf) / kApart)),
              static_cast<int>(std::floor((z + kGroundHalf) / kApart)));
}
Scene hills() {
  Scene scene;
  add_ground(scene, false, hill);
  return scene;
}

Scene terrain(bool field) {
  Scene scene;
  add_ground(scene, field, hill);
  Draws draws(3131);
  for (int n = 0; n < 200; ++n) {
    const Point at = place_above(n, 2, 4 + 2 * (n / 100));
    if (n % 3 == 0) {
      const DrawnHull hull = drawn_hull(n / 3, draws);
      scene.bodies.push_back(body_of(hull_part(hull.points), at));
      scene.bodies.back().orientation = yaw(hull.yaw);
      continue;
    }
    const double a = draws.unit(), b = draws.unit();
    draws.unit();
    const double angle = kTurn * draws.unit();
    scene.bodies.push_back(
        body_of(n % 3 == 1 ? capsule_part(0.15 + 0.15 * a, 0.1 + 0.15 * b) : sphere_part(0.25 + 0.25 * a), at));
    scene.bodies.back().orientation = yaw(angle);
  }
  return scene;
}

Scene thin_bodies(bool field) {
  Scene scene;
  add_ground(scene, field, hill);
  Draws draws(1515);
  const Point halves[] = {{0.3, 0.0098, 0.2}, {0.0098, 0.25, 0.0098}, {0.0049, 0.0195, 0.0049}};
  for (int n = 0; n < 300; ++n) {
    const Point half = halves[n % 3];
    scene.bodies.push_back(
        body_of(box_part({on_grid(half.x), on_grid(half.y), on_grid(half.z)}), place_above(n, 1.5, 4 + n / 100)));
    scene.bodies.back().orientation = drawn_orientation(draws);
    scene.bodies.back().velocity = {0, -10, 0};
  }
  return scene;
}

Scene sliders(bool field) {
  Scene scene;
  scene.frames = 300;
  add_ground(scene, field, plain);
  scene.bodies.back().friction = 0;
  const SinCos<double> way = sin_cos(0.15);
  for (int n = 0; n < 40; ++n) {
    scene.bodies.push_back(body_of(slider(n), {-20, slider_height(n), (n - 19.5) * 0.9 - 2.6}));
    SceneBody& body = scene.bodies.back();
    body.friction = 0;
    body.velocity = {7 * way.cos, 0, 7 * way.sin};
    if (n % 4 == 1) body.orientation = {kHalfRoot, 0, 0, kHalfRoot};
  }
  return scene;
}

}  // namespace isostep::scenes
