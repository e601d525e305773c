// The words of scene files that reader and writer share, in the order of the enumerations.
// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"

namespace isostep::scenes {

inline constexpr const char* kBodyNames[] = {"static", "kinematic", "dynamic"};

struct FlagKey {
  const char* key;
  std::uint32_t flag;
};
inline constexpr FlagKey kBodyLocks[] = {{"lock_x", body_flag::kLockX},
                                         {"lock_y", body_flag::kLockX << 1},
                                         {"lock_z", body_flag::kLockX << 2},
                                         {"lock_angular_x", body_flag::kLockAngularX},
                                         {"lock_angular_y", body_flag::kLockAngularX << 1},
                                         {"lock_angular_z", body_flag::kLockAngularX << 2}};
inline constexpr FlagKey kJointFlags[] = {{"collide_connected", joint_flag::kCollideConnected},
                                          {"limit", joint_flag::kLimit},
                                          {"motor", joint_flag::kMotor},
                                          {"spring", joint_flag::kSpring},
                                          {"limit_cone", joint_flag::kCone},
                                          {"lock_x", joint_flag::kLockX},
                                          {"lock_y", joint_flag::kLockY},
                                          {"lock_z", joint_flag::kLockZ},
                                          {"lock_swing_x", joint_flag::kLockSwingX},
                                          {"lock_swing_y", joint_flag::kLockSwingY},
                                          {"lock_twist", joint_flag::kLockTwist}};

struct JointNumberKey {
  const char* key;
  Number SceneJoint::*member;
};
inline constexpr JointNumberKey kJointNumbers[] = {{"lower", &SceneJoint::lower},
                                                   {"upper", &SceneJoint::upper},
                                                   {"cone", &SceneJoint::cone},
                                                   {"motor_speed", &SceneJoint::motor_speed},
                                                   {"max_force", &SceneJoint::max_force},
                                                   {"spring_target", &SceneJoint::spring_target},
                                                   {"spring_frequency", &SceneJoint::spring_frequency},
                                                   {"spring_damping", &SceneJoint::spring_damping}};

}  // namespace isostep::scenes
