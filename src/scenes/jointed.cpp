// S6, S6v, S7: chains and ragdolls.
// SPDX-License-Identifier: MIT
#include "named.hpp"
#include "shapes.hpp"

namespace isostep::scenes {
namespace {

/// Local y to world +x: -90 degrees about z.
const double kHalfRoot = sqrt(0.5);

SceneJoint ball_joint(int a, int b, Point anchor) {
  SceneJoint joint;
  joint.a = a;
  joint.b = b;
  joint.anchor = vector_of(anchor);
  return joint;
}

struct RagdollPart {
  ScenePart part;
  double x, y;    // [m] from the ragdoll's origin
  double mass;    // [kg]
  bool sideways;  // along x
};
std::vector<RagdollPart> ragdoll_parts() {
  return {{box_part({0.15, 0.10, 0.10}), 0, 0, 1.0, false},     // pelvis
          {box_part({0.18, 0.22, 0.11}), 0, 0.34, 2.0, false},  // torso
          {sphere_part(0.12), 0, 0.70, 0.5, false},             // head
          {capsule_part(0.05, 0.10), 0.35, 0.48, 0.2, true},    // upper arms
          {capsule_part(0.05, 0.10), -0.35, 0.48, 0.2, true},
          {capsule_part(0.045, 0.10), 0.655, 0.48, 0.15, true},  // lower arms
          {capsule_part(0.045, 0.10), -0.655, 0.48, 0.15, true},
          {capsule_part(0.07, 0.13), 0.09, -0.32, 0.7, false},  // upper legs
          {capsule_part(0.07, 0.13), -0.09, -0.32, 0.7, false},
          {capsule_part(0.06, 0.14), 0.09, -0.74, 0.4, false},  // lower legs
          {capsule_part(0.06, 0.14), -0.09, -0.74, 0.4, false}};
}
struct RagdollJoint {
  int a, b;
  double x, y;
};
constexpr RagdollJoint kRagdollJoints[] = {
    {0, 1, 0, 0.11},      {1, 2, 0, 0.57},     {1, 3, 0.19, 0.48},   {1, 4, -0.19, 0.48}, {3, 5, 0.505, 0.48},
    {4, 6, -0.505, 0.48}, {0, 7, 0.09, -0.11}, {0, 8, -0.09, -0.11}, {7, 9, 0.09, -0.53}, {8, 10, -0.09, -0.53}};

/// Upright, then tilted about x.
void add_ragdoll(Scene& scene, Point origin, double tilt, const std::vector<RagdollPart>& parts) {
  const SinCos<double> whole = sin_cos(tilt), half = sin_cos(tilt / 2);
  const auto place = [&](double x, double y) {
    return Point{origin.x + x, origin.y + whole.cos * y, origin.z + whole.sin * y};
  };
  const int first = static_cast<int>(scene.bodies.size());
  for (const RagdollPart& part : parts) {
    SceneBody body = body_of(part.part, place(part.x, part.y));
    body.orientation = part.sideways ? Rotation{half.sin * kHalfRoot, half.sin * kHalfRoot, -half.cos * kHalfRoot,
                                                half.cos * kHalfRoot}
                                     : Rotation{half.sin, 0, 0, half.cos};
    body.mass = part.mass;
    scene.bodies.push_back(body);
  }
  for (const RagdollJoint& joint : kRagdollJoints) {
    scene.joints.push_back(ball_joint(first + joint.a, first + joint.b, place(joint.x, joint.y)));
  }
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

Scene ragdolls() {
  Scene scene;
  scene.allow_sleep = false;
  add_pit(scene, 10);
  Draws draws(4242);
  const std::vector<RagdollPart> parts = ragdoll_parts();
  for (int n = 0; n < 50; ++n) {
    const int layer = n / 25, column = n % 25;
    const Point origin = {(column % 5 - 2) * 1.9, 2.0 + 2.2 * layer, (column / 5 - 2) * 1.9};
    add_ragdoll(scene, origin, draws.between(-0.1, 0.1), parts);
  }
  return scene;
}

}  // namespace isostep::scenes
