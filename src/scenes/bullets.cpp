// S13, S13m, S13d: bodies far faster than their size, and thin walls.
// SPDX-License-Identifier: MIT
#include "named.hpp"
#include "shapes.hpp"

namespace isostep::scenes {

namespace {

constexpr double kDensity = 1000;  // [kg/m^3]

Point place_of(int n) { return {0, (n % 40 - 19.5) * 1.2, (n / 40 - 12) * 1.2}; }

Rotation drawn_rotation(Draws& draws) {
  double q[4], squared = 0;
  for (double& x : q) {
    x = draws.between(-1, 1);
    squared += x * x;
  }
  const double length = sqrt(squared);
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

/// Sphere, box, rod in turn; always nine draws a body.
SceneBody drawn_bullet(int n, Draws& draws) {
  Point at = place_of(n);
  at.x = -3 - 2 * draws.unit();
  const double share = draws.unit();
  const ScenePart part = n % 3 == 0   ? sphere_part(0.05)
                         : n % 3 == 1 ? box_part({0.05, 0.05, 0.05})
                                      : box_part({0.01, 0.01, 0.25});
  const bool rod = n % 3 == 2;
  SceneBody body = body_of(part, at);
  body.density = kDensity;
  body.orientation = drawn_rotation(draws);
  body.velocity = {rod ? 5 + 45 * share : 20 + 280 * share, 0, 0};
  const double spin = rod ? 50 : 30;
  const double x = draws.between(-spin, spin), y = draws.between(-spin, spin), z = draws.between(-spin, spin);
  body.angular_velocity = {x, y, z};
  return body;
}

SceneBody plate(int n) {
  SceneBody body = body_of(box_part({0.01, 0.5, 0.5}), place_of(n));
  body.mass = 1;
  return body;
}

/// A mesh as large as the wall, of cells of 2 m, that faces the bullets.
SceneBody sheet() {
  constexpr int kRows = 30, kColumns = 20;
  ScenePart part;
  part.type = ShapeType::mesh;
  for (int y = 0; y <= kRows; ++y) {
    for (int z = 0; z <= kColumns; ++z) part.vertices.push_back({0, 2 * y - kRows, 2 * z - kColumns});
  }
  for (int y = 0; y < kRows; ++y) {
    for (int z = 0; z < kColumns; ++z) {
      const int at = y * (kColumns + 1) + z, above = at + kColumns + 1;
      part.triangles.push_back({at, at + 1, above});
      part.triangles.push_back({above + 1, above, at + 1});
    }
  }
  SceneBody body = body_of(part, {0, 0, 0});
  body.type = BodyType::static_;
  return body;
}

}  // namespace

double bullet_mass(int n) {
  constexpr double kMasses[] = {kDensity * 2 * kTurn / 3 * 0.05 * 0.05 * 0.05, kDensity * 0.1 * 0.1 * 0.1,
                                kDensity * 0.02 * 0.02 * 0.5};
  return kMasses[n % 3];
}

Scene bullets(BulletTarget at) {
  Scene scene = weightless(90);
  Draws draws(1313);
  if (at == BulletTarget::wall) scene.bodies.push_back(fixed_box({0, 0, 0}, {0.01, 30, 20}));
  if (at == BulletTarget::sheet) scene.bodies.push_back(sheet());
  for (int n = 0; n < kBullets; ++n) {
    if (at == BulletTarget::plates) scene.bodies.push_back(plate(n));
    scene.bodies.push_back(drawn_bullet(n, draws));
    scene.bodies.back().bullet = at == BulletTarget::plates;
  }
  return scene;
}

}  // namespace isostep::scenes
