// After Box3D's: trees on a mesh, a grid of joints, a washer, a large world.
// SPDX-License-Identifier: MIT
#include <cmath>

#include "land.hpp"
#include "peers.hpp"
#include "scenes/hull_recipes.hpp"

namespace isostep::scenes {
namespace {

double wave(int i, int k) {
  return 0.4 * sin_cos(kTurn * 0.1 * i).sin * sin_cos(kTurn * 0.05 * k).sin;  // [m]
}

/// Prisms of six sides above each other, thinner upwards.
struct Trunk {
  std::vector<ScenePart> parts;
  double middle;  // [m] height of the centre of mass
};
Trunk trunk() {
  constexpr int kPrisms = 22, kSides = 6;
  Trunk trunk;
  double y = 1, radius = 0.75, volume = 0, moment = 0;
  for (int i = 0; i < kPrisms; ++i) {
    const double low = y - radius, height = 1.5 + 2 * radius;
    std::vector<Point> points;
    for (int side = 0; side < kSides; ++side) {
      const SinCos<double> at = sin_cos(kTurn * side / kSides);
      for (const double end : {low, low + height}) points.push_back({radius * at.cos, end, radius * at.sin});
    }
    trunk.parts.push_back(hull_part(points));
    volume += radius * radius * height;
    moment += radius * radius * height * (low + height / 2);
    y += height;
    radius *= 0.95;
  }
  trunk.middle = moment / volume;
  return trunk;
}

/// A hull between two radii and two angles, as deep as the drum.
ScenePart ring_piece(double inner, double outer, double from, double to) {
  constexpr double kHalfDepth = 10;  // [m]
  std::vector<Point> points;
  for (const double z : {-kHalfDepth, kHalfDepth}) {
    for (const double angle : {from, to}) {
      const SinCos<double> at = sin_cos(angle);
      for (const double radius : {inner, outer}) points.push_back({radius * at.cos, radius * at.sin, z});
    }
  }
  return hull_part(points);
}
SceneBody open_drum() {
  constexpr int kPieces = 36, kPaddle = 9;  // a paddle at every ninth piece
  constexpr double kPiece = kTurn / kPieces;
  SceneBody drum;
  drum.type = BodyType::kinematic;
  drum.position = {0, 21, 0};
  drum.angular_velocity = {0, 0, kTurn * 25 / 360};
  for (int i = 0; i < kPieces; ++i) {
    drum.parts.push_back(ring_piece(16, 18, (i - 0.1) * kPiece, (i + 1.1) * kPiece));
    if (i % kPaddle == 0) drum.parts.push_back(ring_piece(14, 16, i * kPiece, (i + 1) * kPiece));
  }
  drum.friction = 0.6;
  return drum;
}

}  // namespace

Scene trees() {
  constexpr int kTrees = 50;
  const Trunk of = trunk();
  Scene scene;
  scene.bodies.push_back(body_of(land(150, 200, 1, wave), {0, 0, 0}));
  scene.bodies.back().type = BodyType::static_;
  scene.bodies.back().friction = 0.6;
  for (int i = 0; i < kTrees; ++i) {
    const double spin = (i % 2 == 0 ? -0.5 : 0.5) * (0.5 + 0.5 * i / kTrees);  // [rad/s] about the foot
    SceneBody tree = body_of(ScenePart{}, {0, 1, 3.0 * i - 70});
    tree.parts = of.parts;
    tree.friction = 0.9;
    tree.velocity = {-spin * of.middle, 0, 0};
    tree.angular_velocity = {0, 0, spin};
    scene.bodies.push_back(tree);
  }
  return scene;
}

Scene joint_grid() {
  constexpr int kSide = 100;
  Scene scene = awake(500);
  for (int column = 0; column < kSide; ++column) {
    for (int row = 0; row < kSide; ++row) {
      const double x = column, y = -row;
      const int here = column * kSide + row;
      SceneBody body = body_of(sphere_part(0.4), {x, y, 0});
      body.type = row == 0 ? BodyType::static_ : BodyType::dynamic;
      body.density = 1000;
      body.collide = false;
      scene.bodies.push_back(body);
      if (row == 0) continue;
      scene.joints.push_back(joint_of(JointType::ball, here - 1, here, {x, y + 0.5, 0}));
      if (column != 0) scene.joints.push_back(joint_of(JointType::ball, here - kSide, here, {x - 0.5, y, 0}));
    }
  }
  return scene;
}

Scene washer() {
  constexpr int kSide = 20;
  Scene scene;
  scene.frames = 300;
  scene.bodies.push_back(fixed_box({0, -1, 0}, {60, 1, 60}));
  scene.bodies.back().friction = 0.6;
  scene.bodies.push_back(open_drum());
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    const int x = n / (kSide * kSide), y = n / kSide % kSide, z = n % kSide;
    scene.bodies.push_back(body_of(box_part({0.2, 0.2, 0.2}), {0.8 * x - 8, 13 + 0.8 * y, 0.8 * z - 8}));
    scene.bodies.back().density = 1000;
    scene.bodies.back().friction = 0.6;
  }
  return scene;
}

Scene large_world() {
  constexpr int kTiles = 100, kBalls = 10;  // along a side
  constexpr double kTile = 100;             // [m]
  Scene scene;
  for (int n = 0; n < kTiles * kTiles; ++n) {
    const Point at = {(n / kTiles - kTiles * 0.5 + 0.5) * kTile, 0, (n % kTiles - kTiles * 0.5 + 0.5) * kTile};
    scene.bodies.push_back(fixed_box(at, {kTile / 2, 0.25, kTile / 2}));
  }
  for (int n = 0; n < kBalls * kBalls; ++n) {
    const Point at = {(n / kBalls - 4.5) * 800, 1.5, (n % kBalls - 4.5) * 800};
    scene.bodies.push_back(body_of(sphere_part(0.5), at));
    scene.bodies.back().density = 1000;
  }
  return scene;
}

}  // namespace isostep::scenes
