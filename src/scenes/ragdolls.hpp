// Ragdolls, for scenes that have one: their bodies and joints are tables.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "shapes.hpp"

namespace isostep::scenes {

struct RagdollPart {
  ScenePart part;
  double x, y;    // [m] from the ragdoll's origin
  double mass;    // [kg]
  bool sideways;  // along x
  double z = 0;   // [m] forwards
};

/// A quarter of a turn that lays z onto an axis: about x, or about y.
struct RagdollAxis {
  double x, y;  // of the quaternion, whose z is 0 and whose w is kHalfRoot
};
inline constexpr RagdollAxis kAxisUp = {-kHalfRoot, 0}, kAxisDown = {kHalfRoot, 0}, kAxisRight = {0, kHalfRoot},
                             kAxisLeft = {0, -kHalfRoot};

struct RagdollJoint {
  int a, b;             // places in the table of parts
  double x, y;          // [m]
  RagdollAxis axis;     // upright: what twists and hinges turn about
  double cone;          // [rad] 0: a hinge
  double lower, upper;  // [rad]
  double z = 0;         // [m]
};

/// Adds the bodies and joints of the tables at `origin` [m], upright, then tilted about x [rad]. `limited`: joints have
/// the cones and limits of the table, else they are balls.
void add_ragdoll(Scene& scene, std::span<const RagdollPart> parts, std::span<const RagdollJoint> joints, Point origin,
                 double tilt, bool limited);

/// The ragdoll of S7: kRagdollParts bodies, `origin` in the pelvis.
void add_ragdoll(Scene& scene, Point origin, double tilt, bool limited);

}  // namespace isostep::scenes
