// S7, S20: ragdolls, their joints free or with the limits of a body's.
// SPDX-License-Identifier: MIT
#include "ragdolls.hpp"

#include "named.hpp"

namespace isostep::scenes {
namespace {

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

const RagdollJoint kRagdollJoints[] = {{0, 1, 0, 0.11, kAxisUp, 0.5, -0.4, 0.4},         // spine
                                       {1, 2, 0, 0.57, kAxisUp, 0.6, -0.7, 0.7},         // neck
                                       {1, 3, 0.19, 0.48, kAxisRight, 1.3, -0.6, 0.6},   // shoulders
                                       {1, 4, -0.19, 0.48, kAxisLeft, 1.3, -0.6, 0.6},   //
                                       {3, 5, 0.505, 0.48, kAxisUp, 0, -2.4, 0},         // elbows
                                       {4, 6, -0.505, 0.48, kAxisUp, 0, 0, 2.4},         //
                                       {0, 7, 0.09, -0.11, kAxisDown, 0.9, -0.5, 0.5},   // hips
                                       {0, 8, -0.09, -0.11, kAxisDown, 0.9, -0.5, 0.5},  //
                                       {7, 9, 0.09, -0.53, kAxisRight, 0, 0, 2.4},       // knees
                                       {8, 10, -0.09, -0.53, kAxisRight, 0, 0, 2.4}};

/// Sets the limits of a joint, with its frame tilted about x as its ragdoll is.
void limit(SceneJoint& joint, const RagdollJoint& of, const SinCos<double>& half_tilt) {
  const double s = half_tilt.sin, c = half_tilt.cos;
  joint.orientation = {c * of.axis.x + s * kHalfRoot, c * of.axis.y, s * of.axis.y, c * kHalfRoot - s * of.axis.x};
  joint.type = of.cone > 0 ? JointType::ball : JointType::hinge;
  joint.flags = joint_flag::kLimit | (of.cone > 0 ? joint_flag::kCone : 0u);
  joint.cone = of.cone;
  joint.lower = of.lower;
  joint.upper = of.upper;
}

}  // namespace

void add_ragdoll(Scene& scene, std::span<const RagdollPart> parts, std::span<const RagdollJoint> joints, Point origin,
                 double tilt, bool limited) {
  const SinCos<double> whole = sin_cos(tilt), half = sin_cos(tilt / 2);
  const auto place = [&](double x, double y, double z) {
    return Point{origin.x + x, origin.y + whole.cos * y - whole.sin * z, origin.z + whole.sin * y + whole.cos * z};
  };
  const int first = static_cast<int>(scene.bodies.size());
  for (const RagdollPart& part : parts) {
    SceneBody body = body_of(part.part, place(part.x, part.y, part.z));
    body.orientation = part.sideways ? Rotation{half.sin * kHalfRoot, half.sin * kHalfRoot, -half.cos * kHalfRoot,
                                                half.cos * kHalfRoot}
                                     : Rotation{half.sin, 0, 0, half.cos};
    body.mass = part.mass;
    scene.bodies.push_back(body);
  }
  for (const RagdollJoint& of : joints) {
    SceneJoint joint;
    joint.a = first + of.a;
    joint.b = first + of.b;
    joint.anchor = vector_of(place(of.x, of.y, of.z));
    if (limited) limit(joint, of, half);
    scene.joints.push_back(joint);
  }
}

void add_ragdoll(Scene& scene, Point origin, double tilt, bool limited) {
  add_ragdoll(scene, ragdoll_parts(), kRagdollJoints, origin, tilt, limited);
}

namespace {

Scene pit_of_ragdolls(bool limited) {
  Scene scene;
  scene.allow_sleep = false;
  add_pit(scene, 10);
  Draws draws(4242);
  for (int n = 0; n < 50; ++n) {
    const int layer = n / 25, column = n % 25;
    const Point origin = {(column % 5 - 2) * 1.9, 2.0 + 2.2 * layer, (column / 5 - 2) * 1.9};
    add_ragdoll(scene, origin, draws.between(-0.1, 0.1), limited);
  }
  return scene;
}

}  // namespace

Scene ragdolls() { return pit_of_ragdolls(false); }
Scene limited_ragdolls() { return pit_of_ragdolls(true); }

Scene tilted_ragdolls() {
  constexpr int kTilts = 100, kRow = 10;
  constexpr double kPitch = 4;  // [m] they fall apart from each other
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = 300;
  add_floor(scene);
  for (int n = 0; n < kTilts; ++n) {
    const Point origin = {(n % kRow - 4.5) * kPitch, 2, (n / kRow - 4.5) * kPitch};
    add_ragdoll(scene, origin, n * kTurn / kTilts, true);
  }
  return scene;
}

}  // namespace isostep::scenes
