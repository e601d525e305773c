// A heap of figures of 23 parts on the hills: many small bodies between joints with cones and limits.
// SPDX-License-Identifier: MIT
#include <vector>

#include "named.hpp"
#include "ragdolls.hpp"
#include "terrain.hpp"

namespace isostep::scenes {
namespace {

/// An arm and a leg, on the side where x is `side`; places of parts begin with the one after the trunk.
void add_limbs(std::vector<RagdollPart>& parts, double side) {
  const RagdollPart limbs[] = {{box_part({0.07, 0.04, 0.05}), side * 0.14, 0.52, 1.5, false},           // shoulder
                               {capsule_part(0.05, 0.10), side * 0.37, 0.52, 2.0, true},                // upper arm
                               {capsule_part(0.04, 0.09), side * 0.64, 0.52, 1.3, true},                // lower arm
                               {box_part({0.08, 0.02, 0.04}), side * 0.86, 0.52, 0.5, false},           // hand
                               {capsule_part(0.07, 0.14), side * 0.10, -0.30, 7.0, false},              // thigh
                               {capsule_part(0.05, 0.15), side * 0.10, -0.72, 3.5, false},              // shin
                               {box_part({0.04, 0.03, 0.08}), side * 0.10, -0.96, 0.8, false, 0.04},    // foot
                               {box_part({0.04, 0.02, 0.035}), side * 0.10, -0.97, 0.2, false, 0.16}};  // toes
  parts.insert(parts.end(), std::begin(limbs), std::end(limbs));
}
std::vector<RagdollPart> figure_parts() {
  std::vector<RagdollPart> parts = {
      {box_part({0.14, 0.08, 0.10}), 0, 0, 9.0, false},     // pelvis
      {box_part({0.12, 0.05, 0.09}), 0, 0.14, 5.0, false},  // spine, from below
      {box_part({0.13, 0.05, 0.09}), 0, 0.25, 5.0, false},
      {box_part({0.14, 0.05, 0.10}), 0, 0.36, 5.0, false},
      {box_part({0.06, 0.09, 0.10}), 0, 0.51, 6.0, false},  // chest, between the shoulders
      {capsule_part(0.045, 0.02), 0, 0.64, 1.0, false},     // neck
      {sphere_part(0.11), 0, 0.78, 4.5, false}};            // head
  add_limbs(parts, 1);
  add_limbs(parts, -1);
  return parts;
}

constexpr int kTrunk = 7, kLimb = 8;  // parts

void add_limb_joints(std::vector<RagdollJoint>& joints, double side) {
  const int first = kTrunk + (side > 0 ? 0 : kLimb);
  const RagdollAxis out = side > 0 ? kAxisRight : kAxisLeft;
  const double bend = side > 0 ? -2.3 : 0, back = side > 0 ? 0 : 2.3;  // [rad] elbows, forwards
  const RagdollJoint limbs[] = {{4, first, side * 0.07, 0.52, out, 0.2, -0.1, 0.1},
                                {first, first + 1, side * 0.22, 0.52, out, 1.3, -0.6, 0.6},
                                {first + 1, first + 2, side * 0.52, 0.52, kAxisUp, 0, bend, back},
                                {first + 2, first + 3, side * 0.77, 0.52, out, 0.7, -0.7, 0.7},
                                {0, first + 4, side * 0.10, -0.09, kAxisDown, 0.9, -0.5, 0.5},
                                {first + 4, first + 5, side * 0.10, -0.51, kAxisRight, 0, 0, 2.3},
                                {first + 5, first + 6, side * 0.10, -0.92, kAxisDown, 0.5, -0.2, 0.2},
                                {first + 6, first + 7, side * 0.10, -0.97, kAxisRight, 0, -0.7, 0.3, 0.12}};
  joints.insert(joints.end(), std::begin(limbs), std::end(limbs));
}
std::vector<RagdollJoint> figure_joints() {
  std::vector<RagdollJoint> joints = {
      {0, 1, 0, 0.085, kAxisUp, 0.25, -0.15, 0.15}, {1, 2, 0, 0.195, kAxisUp, 0.25, -0.15, 0.15},
      {2, 3, 0, 0.305, kAxisUp, 0.25, -0.15, 0.15}, {3, 4, 0, 0.415, kAxisUp, 0.2, -0.15, 0.15},
      {4, 5, 0, 0.60, kAxisUp, 0.4, -0.5, 0.5},     {5, 6, 0, 0.69, kAxisUp, 0.5, -0.5, 0.5}};
  add_limb_joints(joints, 1);
  add_limb_joints(joints, -1);
  return joints;
}

}  // namespace

Scene figures() {
  constexpr int kRow = 4, kLayers = 10;
  constexpr double kPitch = 2.0, kRise = 2.2, kLowest = 5;  // [m]
  const std::vector<RagdollPart> parts = figure_parts();
  const std::vector<RagdollJoint> joints = figure_joints();
  Scene scene = hills();
  scene.frames = 300;
  Draws draws(1608);
  for (int n = 0; n < kRow * kRow * kLayers; ++n) {
    const int column = n % (kRow * kRow);
    const Point origin = {(column % kRow - 1.5) * kPitch, kLowest + kRise * (n / (kRow * kRow)),
                          (column / kRow - 1.5) * kPitch};
    add_ragdoll(scene, parts, joints, origin, draws.between(-1, 1), true);
  }
  return scene;
}

}  // namespace isostep::scenes
