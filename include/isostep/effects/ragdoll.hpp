// ragdoll: the bodies and joints of a limp or posed figure, from its skeleton.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/world/world.hpp"

namespace isostep {

/// A part of a figure as it rests. Angles are counted from that pose.
template <class S> struct RagdollBone {
  int parent = -1;                      // index of an earlier bone; -1: the root
  ShapeId shape = {};                   // of the world
  Pose<S> pose = Pose<S>::identity();   // of the body's origin, world, at rest
  S mass = S(0);                        // [kg] 0: by the shape's volume at 1 kg/m^3, which is light as air
  Pose<S> joint = Pose<S>::identity();  // to the parent, world; z: the bone's length, or a hinge's axis
  bool hinge = false;                   // turns about z alone: knees, elbows
  S swing_x = S(0), swing_y = S(0);     // [rad] half axes of the ellipse in which z stays; of no hinge
  S lower = S(0), upper = S(0);         // [rad] of the twist, or of the hinge's angle
};

/// The settings that all joints of a ragdoll share.
template <class S> struct RagdollSettings {
  S friction = S(0);         // [N m] each axis resists; 0 where servos hold the pose
  JointServo<S> pose = {};   // holds the rest pose where its `max_force` [N m] is above 0; its target is 0
  S limit_frequency = S(0);  // [Hz] of limits that yield, as in AxisDrive; 0: hard ones
  S limit_damping = S(1);    // [1] ratio, 1 = critical
  Filter filter = {};        // of all bodies. Bones that a joint ties have no contacts with each other, and bones that
                             // overlap at rest none until they are apart
  Material<S> material = {};
};

template <class S> struct Ragdoll {
  std::vector<BodyId> bodies;   // one a bone
  std::vector<JointId> joints;  // one a bone; null for roots
};

/// Adds it to the world. If a setting or a bone is refused returns an empty one, of which nothing is left in the world;
/// World::first_fault says why.
/// Method: balls and hinges with limits; where joints have friction, servos or soft limits, six-axis joints whose axes
///         have them.
/// Limits: servos and soft limits are made for what hangs on their joint at rest, as if the rest of the body stood
///         still; a servo holds while its force suffices; see AxisDrive.
template <class S>
Ragdoll<S> add_ragdoll(World<S>& world, std::span<const RagdollBone<S>> bones, const RagdollSettings<S>& settings = {});

#define ISO_RAGDOLL_OF(extern, S) \
  extern template Ragdoll<S> add_ragdoll<S>(World<S>&, std::span<const RagdollBone<S>>, const RagdollSettings<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_RAGDOLL_OF)

}  // namespace isostep
