// The systems that look after how bodies move, before and after the solver. Compiled apart from the step that calls
// them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/carriers.inl"
#include "isostep/systems/continuous/continuous_joined.inl"
#include "isostep/systems/continuous/continuous_movers.inl"
#include "isostep/systems/continuous/continuous_rules.inl"
#include "isostep/systems/continuous/continuous_sweeps.inl"
#include "isostep/systems/continuous/joined_bodies.inl"
#include "isostep/systems/motion/body_finisher.inl"
#include "isostep/systems/motion/move_targets.inl"
#include "isostep/systems/motion/render_poses.inl"
#include "isostep/systems/motion/sensor_mounts.inl"

#define ISO_INSTANTIATE_MOTION_SYSTEMS(S)                                                                   \
  template void detail::renew_fat_box<S>(const BodyMap<S>&, BodyState<S>&, const BodyProperties<S>&, bool); \
  template class Carriers<S>;                                                                               \
  template class BodyFinisher<S>;                                                                           \
  template class ContinuousCollision<S>;                                                                    \
  template class JoinedBodies<S>;                                                                           \
  template class MoveTargets<S>;                                                                            \
  template class SensorMounts<S>;                                                                           \
  template class RenderPoses<S>;
