// `town` and `yard`: what falls, rolls, tumbles and is shot in the levels.
// SPDX-License-Identifier: MIT
#include "level_bodies.hpp"

#include "scenes/hull_recipes.hpp"
#include "scenes/named.hpp"
#include "scenes/ragdolls.hpp"

namespace isostep::scenes {
namespace {

constexpr int kFrames = 600;

Scene scene_of(Level level) {
  Scene scene = std::move(level.scene);
  scene.frames = kFrames;
  return scene;
}

/// Four boxes high and four wide, across x.
void add_crates(Scene& scene, Point foot) {
  for (int n = 0; n < 16; ++n) {
    const Point at = {foot.x, foot.y + 0.3 + 0.6 * (n / 4), foot.z + 0.61 * (n % 4 - 1.5)};
    scene.bodies.push_back(body_of(box_part({0.3, 0.3, 0.3}), at));
    scene.bodies.back().mass = 8;
  }
}
void add_bullet(Scene& scene, Point from, Point velocity) {
  SceneBody bullet = body_of(sphere_part(0.05), from);
  bullet.mass = 0.5;
  bullet.velocity = vector_of(velocity);
  bullet.bullet = true;
  scene.bodies.push_back(bullet);
}

void add_thrown_ragdoll(Scene& scene, Point origin, double tilt, Point velocity) {
  add_ragdoll(scene, origin, tilt, true);
  for (std::size_t i = scene.bodies.size() - kRagdollParts; i < scene.bodies.size(); ++i)
    scene.bodies[i].velocity = vector_of(velocity);
}

}  // namespace

SceneBody drawn_visitor(int n, Point at, Draws& draws) {
  const double a = draws.unit(), b = draws.unit(), angle = draws.between(0, kTurn);
  const DrawnHull hull = drawn_hull(n, draws);
  const double radius = 0.15 + 0.15 * a, half = 0.15 + 0.15 * b;
  const auto part = [&] {
    switch (n % 6) {
      case 0: return box_part({radius, half, 0.25});
      case 1: return sphere_part(radius + 0.1);
      case 2: return capsule_part(radius, half);
      case 3: return hull_part(hull.points);
      case 4: return round_part(ShapeType::cylinder, radius, half);
      default: return round_part(ShapeType::cone, radius + 0.1, half + 0.1);
    }
  };
  SceneBody body = body_of(part(), at);
  body.orientation = yaw(angle);
  return body;
}

Scene town() {
  Scene scene = scene_of(town_level());
  Draws draws(2024);
  add_crates(scene, {10, 0, 0});
  add_crates(scene, {-12, 0, -0.5});
  for (int n = 0; n < 3; ++n) add_bullet(scene, {25.0 + 2 * n, 0.75 + 0.5 * n, 0.3 - 0.3 * n}, {-120, 0, 0});
  add_bullet(scene, {-9.125, 1, 2}, {0, 0, -120});  // in at a door, and out at the other
  for (int n = 0; n < 12; ++n)                      // from the hill
    scene.bodies.push_back(drawn_visitor(n, {15.0 + n % 4, 6.0 + n / 4, -18.0 + n % 3}, draws));
  for (int n = 0; n < 6; ++n)  // on roofs
    scene.bodies.push_back(drawn_visitor(n, {-22.0 + 12 * (n % 2), 6.5, -22.0 + 12 * (n / 2 % 2) + n / 4}, draws));
  for (int n = 0; n < 12; ++n)  // on the bridge, and over the dell beside it
    scene.bodies.push_back(drawn_visitor(n, {-22.0 + n, n % 2 == 0 ? 3.5 : 2.5, n % 2 == 0 ? 16.0 : 12.0}, draws));
  constexpr Point kTops[] = {{23, 5, 18}, {16.7, 6, 20}, {8.5, 2, 25.125}, {20.5, 4, 26}};  // spiral, stairs, ramps
  for (int n = 0; n < 8; ++n) {
    const Point top = kTops[n % 4];
    scene.bodies.push_back(drawn_visitor(n, {top.x, top.y + 2 * (n / 4), top.z}, draws));
  }
  add_thrown_ragdoll(scene, {10.5, 4, 7}, 0.25, {-3, 0, 0});  // down the grand stairs
  add_thrown_ragdoll(scene, {17, 7, -15}, 0.5, {0, 0, 3});    // down the hill
  return scene;
}

Scene yard() {
  Level level = yard_level();
  std::vector<Point> tops;
  for (const LevelSpot& spot : level.spots) {
    if (spot.kind == LevelSpot::Kind::top) tops.push_back(spot.at);
  }
  Scene scene = scene_of(std::move(level));
  Draws draws(4048);
  for (int n = 0; n < 60; ++n) {
    const Point at = tops[static_cast<std::size_t>(draws.unit() * static_cast<double>(tops.size()))];
    scene.bodies.push_back(drawn_visitor(n, {at.x, at.y + 1 + 0.75 * (n / 15), at.z}, draws));
  }
  for (int n = 0; n < 4; ++n) add_bullet(scene, {-19, 0.5 + 0.25 * n, -15.0 + 9 * n}, {120, 0, 4.0 * n - 6});
  for (int n = 0; n < 3; ++n) add_ragdoll(scene, {-9.0 + 9 * n, 4.5, 3.0 * n - 2.5}, 0.4 * n, true);
  return scene;
}

}  // namespace isostep::scenes
