// The systems that look after how bodies move, before and after the solver. Compiled apart from the step that calls
// them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/carriers.inl"
#include "isostep/systems/continuous/continuous_collision.inl"
#include "isostep/systems/motion/body_finisher.inl"
#include "isostep/systems/motion/move_targets.inl"
#include "isostep/systems/motion/render_poses.inl"
#include "isostep/systems/motion/sensor_mounts.inl"

#define ISO_INSTANTIATE_MOTION_SYSTEMS(S) \
  ISO_FAT_BOX_OF(, S)                     \
  ISO_CARRIERS_OF(, S)                    \
  ISO_BODY_FINISHER_OF(, S)               \
  ISO_CONTINUOUS_COLLISION_OF(, S)        \
  ISO_MOVE_TARGETS_OF(, S)                \
  ISO_SENSOR_MOUNTS_OF(, S)               \
  ISO_RENDER_POSES_OF(, S)
