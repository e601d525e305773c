// Fracture: a ball at a cube, four materials, and a tower of boxes that break.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

SceneBody ball(Point at, double radius, double mass, Point velocity) {
  SceneBody body = body_of(sphere_part(radius), at);
  body.mass = mass;
  body.velocity = vector_of(velocity);
  return body;
}
/// Patterns by their number in BreakPattern.
SceneRecord breakable(double body, double impulse, double pattern, double pieces, double depth = 1) {
  return {"breakable",
          {{"body", {body}},
           {"break_impulse", {impulse}},
           {"pattern", {pattern}},
           {"most_pieces", {pieces}},
           {"depth", {depth}},
           {"seed", {pattern + 1}}}};
}
ScenePart rock() {
  ScenePart part;
  part.type = ShapeType::hull;
  Draws draws(5);
  for (int i = 0; i < 16; ++i) {
    const double height = draws.between(-1, 1), angle = draws.between(0, kTurn), ring = sqrt(1 - height * height);
    const SinCos<double> way = sin_cos(angle);
    part.points.push_back(vector_of({ring * way.cos, 0.75 * height, ring * way.sin}));
  }
  return part;
}

}  // namespace

Scene broken_cube() {
  Scene scene;
  scene.frames = 300;
  add_floor(scene);
  SceneBody cube = body_of(box_part({1, 1, 1}), {0, 1, 0});
  cube.mass = 100;
  scene.bodies.push_back(cube);
  scene.bodies.push_back(ball({0.3, 1.4, 5}, 0.25, 5, {0, 0, -20}));
  scene.records = {breakable(1, 20, 0, 8, 2)};
  return scene;
}

Scene materials() {
  Scene scene;
  scene.frames = 300;
  add_floor(scene);
  const ScenePart parts[] = {box_part({0.5, 1, 0.5}), box_part({0.25, 1.5, 0.25}), box_part({1, 1, 0.0625}), rock()};
  const double heights[] = {1, 1.5, 1, 0.75};
  for (int n = 0; n < 4; ++n) {
    SceneBody target = body_of(parts[n], {4.0 * n - 6, heights[n], 0});
    target.mass = 20;
    scene.bodies.push_back(target);
    scene.records.push_back(breakable(1 + 2 * n, 10, n, n == 0 ? 8 : 16));
    scene.records.back().fields.push_back({"small_mass", {0.5}});
    scene.records.back().fields.push_back({"lifetime", {120}});
    scene.bodies.push_back(ball({4.0 * n - 6, heights[n], 4}, 0.2, 4, {0, 0, -16}));
  }
  return scene;
}

Scene breakable_tower() {
  Scene scene;
  scene.frames = 300;
  add_floor(scene);
  for (int n = 0; n < kTowerBoxes; ++n) {
    const int layer = n / 10, row = n % 10 / 5, column = n % 5;
    SceneBody box = body_of(box_part({0.25, 0.25, 0.25}), {0.5 * column - 1, 0.25 + 0.5 * layer, 0.5 * row - 0.25});
    box.mass = 10;
    scene.bodies.push_back(box);
    scene.records.push_back(breakable(1 + n, 60, n % 2 == 0 ? 0 : 3, 8));
  }
  scene.bodies.push_back(ball({0, 2.5, 8}, 0.5, 100, {0, 0, -20}));
  return scene;
}

}  // namespace isostep::scenes
