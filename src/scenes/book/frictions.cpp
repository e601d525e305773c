// Friction: balls that roll down a slope, and on, with and without rolling resistance.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {

/// A level floor, over which four balls roll at 4 m/s; each has twice the rolling resistance of the one before, the
/// first has none.
Scene rolling() {
  Scene scene = awake(600);
  scene.bodies.push_back(fixed_box({20, -1, 0}, {60, 1, 10}));
  for (int n = 0; n < 4; ++n) {
    SceneBody ball = body_of(sphere_part(0.5), {-30, 0.5, 3.0 * n - 4.5});
    ball.velocity = {4, 0, 0};
    ball.angular_velocity = {0, 0, -8};
    ball.mass = 4;
    ball.rolling_resistance = n == 0 ? 0 : 0.01 * (1 << n);
    scene.bodies.push_back(ball);
  }
  return scene;
}

/// Three sledges at 4 m/s along x: one with its runners that way, one askew by 45 degrees, one across.
Scene sledges() {
  Scene scene = awake(600);
  SceneBody ice = fixed_box({0, -1, 0}, {100, 1, 50});
  ice.friction = 0.25;
  scene.bodies.push_back(ice);
  for (int n = 0; n < 3; ++n) {
    SceneBody sledge = body_of(box_part({1, 0.25, 0.5}), {-40, 0.25, 8.0 * n - 8});
    sledge.orientation = yaw(kTurn * n / 8);
    sledge.velocity = {4, 0, 0};
    sledge.mass = 20;
    sledge.friction = 0.25;
    sledge.anisotropy = {kSledgeRunners, 1, 1};
    scene.bodies.push_back(sledge);
  }
  return scene;
}

/// Three crates on slopes of 20, 25 and 30 degrees: coefficients of 0.5 at rest and 0.4 in motion hold up to 26.6.
Scene slopes() {
  Scene scene = awake(300);
  for (int n = 0; n < 3; ++n) {
    const double angle = kTurn * (20 + 5 * n) / 360;
    const SinCos<double> way = sin_cos(angle), half = sin_cos(angle / 2);
    SceneBody slope = fixed_box({-way.sin, -way.cos, 6.0 * n - 6}, {40, 1, 2});
    slope.orientation = {0, 0, half.sin, half.cos};
    SceneBody crate = body_of(box_part({0.5, 0.25, 0.5}), {-0.25 * way.sin, 0.25 * way.cos, 6.0 * n - 6});
    slope.position = {way.sin, -way.cos, 6.0 * n - 6};
    crate.orientation = slope.orientation;
    for (SceneBody* const body : {&slope, &crate}) {
      body->friction = 0.4;
      body->static_friction = 0.5;
    }
    scene.bodies.push_back(slope);
    scene.bodies.push_back(crate);
  }
  return scene;
}

}  // namespace isostep::scenes
