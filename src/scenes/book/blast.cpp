// Explosions: the book's rubble, and a crowd of boxes about a charge.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

SceneRecord charge(Point at, double force) {
  return {"explosion",
          {{"centre", {at.x, at.y, at.z}},
           {"begin", {kBlastBegins}},
           {"implosion_force", {force / 20}},
           {"implosion_least", {1}},
           {"implosion_most", {12}},
           {"implosion_duration", {0.25}},
           {"wave_force", {force}},
           {"wave_speed", {60}},
           {"wave_width", {2}},
           {"wave_duration", {0.75}},
           {"chimney_force", {force / 10}},
           {"chimney_radius", {4}},
           {"chimney_height", {12}},
           {"chimney_duration", {1.5}}}};
}
void make_lively(SceneBody& body) {
  body.friction = 0.9;
  body.restitution = 0.6;
  body.linear_damping = 0.05;
  body.angular_damping = 0.2;
}

}  // namespace

Scene rubble() {
  Scene scene;
  scene.frames = 600;
  add_floor(scene);
  Draws draws(17);
  for (int n = 0; n < 10; ++n) {
    const double angle = kTurn * n / 10, x = draws.between(0.5, 1.5), y = draws.between(0.5, 1.5);
    const Point half = n == 0 ? Point{2, 0.5, 0.5} : n == 2 ? Point{0.5, 0.5, 2} : Point{x, y, draws.between(0.5, 1.5)};
    const double radius = draws.between(0.5, 1.5);
    const SinCos<double> way = sin_cos(angle);
    const double height = n % 2 == 0 ? half.y : radius;
    SceneBody body = body_of(n % 2 == 0 ? box_part(half) : sphere_part(radius), {6 * way.cos, height, 6 * way.sin});
    body.mass = 20;
    make_lively(body);
    scene.bodies.push_back(body);
  }
  scene.records = {charge({0, 1, 0}, 4000)};
  return scene;
}

/// Rings of boxes, each box alone.
Scene blast(int bodies) {
  Scene scene;
  scene.frames = 300;
  scene.bodies.push_back(fixed_box({0, -1, 0}, {100, 1, 100}));
  int placed = 0;
  for (int ring = 2; placed < bodies; ++ring) {
    for (int n = 0; n < 6 * ring && placed < bodies; ++n, ++placed) {
      const SinCos<double> way = sin_cos(kTurn * n / (6 * ring));
      SceneBody body = body_of(box_part({0.25, 0.25, 0.25}), {ring * way.cos, 0.25, ring * way.sin});
      body.mass = 2;
      scene.bodies.push_back(body);
    }
  }
  scene.records = {charge({0, 0.5, 0}, 400)};
  return scene;
}

}  // namespace isostep::scenes
