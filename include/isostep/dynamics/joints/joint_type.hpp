// The closed list of joints. To add one: its line here, its file beside this one, that file's name in joint_kinds.hpp
// (see README.md). What its file does not say does not compile.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

/// Expands ISO_FOR_EACH_JOINT(X) to X(name, Joint): the name in JointType, in scene files and on pages, and the class.
#define ISO_FOR_EACH_JOINT(X)                 \
  X(ball, BallJoint)                          \
  X(hinge, HingeJoint)                        \
  X(fixed, FixedJoint)                        \
  X(distance, DistanceJoint)                  \
  X(slider, SliderJoint)                      \
  X(cylindrical, CylindricalJoint)            \
  X(planar, PlanarJoint)                      \
  X(universal, UniversalJoint)                \
  X(constant_velocity, ConstantVelocityJoint) \
  X(angular, AngularJoint)                    \
  X(six_axis, SixAxisJoint)

namespace isostep {

/// The types of joints. Every type connects two frames, whose axis is z.
#define ISO_ENUMERATOR(name, Joint) name,
enum class JointType : std::uint32_t { ISO_FOR_EACH_JOINT(ISO_ENUMERATOR) };
#undef ISO_ENUMERATOR

#define ISO_NAME(name, Joint) #name,
inline constexpr const char* kJointNames[] = {ISO_FOR_EACH_JOINT(ISO_NAME)};
#undef ISO_NAME
inline constexpr std::uint32_t kJointTypes = sizeof kJointNames / sizeof kJointNames[0];

/// The unit of a joint's position, and so of lower, upper and spring_target.
enum class JointMeasure : std::uint32_t {
  angle,  // [rad]
  length  // [m]
};

}  // namespace isostep
