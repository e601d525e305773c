// S6, S6v: chains.
// SPDX-License-Identifier: MIT
#include "named.hpp"
#include "shapes.hpp"

namespace isostep::scenes {
namespace {

/// Local y to world +x: -90 degrees about z.

SceneJoint ball_joint(int a, int b, Point anchor) {
  SceneJoint joint;
  joint.a = a;
  joint.b = b;
  joint.anchor = vector_of(anchor);
  return joint;
}

}  // namespace

Scene chain(bool hanging) {
  constexpr int kLinks = 50;
  constexpr double kLength = 0.5, kTop = 30;  // [m]
  Scene scene;
  scene.allow_sleep = false;
  const auto along = [&](double distance) { return hanging ? Point{0, kTop - distance, 0} : Point{distance, kTop, 0}; };
  for (int i = 0; i <= kLinks; ++i) {
    const bool link = i < kLinks;
    SceneBody body = body_of(link ? capsule_part(0.05, 0.2) : sphere_part(0.5),
                             along(link ? (i + 0.5) * kLength : kLinks * kLength + 0.5));
    if (link && !hanging) body.orientation = {0, 0, -kHalfRoot, kHalfRoot};
    body.mass = link ? 1.0 : 100.0;
    body.collide = false;
    scene.bodies.push_back(body);
    scene.joints.push_back(ball_joint(i - 1, i, along(i * kLength)));
  }
  return scene;
}

}  // namespace isostep::scenes
