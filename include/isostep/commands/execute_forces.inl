// The commands that push bodies.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/commands/command_executor.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/store/fat_box.hpp"

namespace isostep {

template <class S> bool CommandExecutor<S>::may_push(BodyId body) {
  if (!known(body) || !is_enabled(body)) return false;
  const bool pushable = map_.properties_at(map_.location(body.slot)).type == BodyType::dynamic;
  return pushable || faults_.refuse({Fault::not_dynamic, "", "body", "a dynamic one"});
}

template <class S> bool CommandExecutor<S>::execute(const ApplyForce<S>& command) {
  if (!faults_.accept(detail::Checklist().finite(command.force, "force").finite(command.torque, "torque").report()) ||
      !may_push(command.body)) {
    return false;
  }
  if (command.force == Vec3<S>::zero() && command.torque == Vec3<S>::zero()) return true;
  BodyState<S>& state = wake_.wake_for_change(command.body.slot);
  const BodyProperties<S>& body = state_.awake.properties[map_.location(state.slot).index];
  const Mat3<S> kappa = detail::world_kappa(body, detail::world_axes(state.orientation, body));
  // It leads from rest to the limit in one step: velocities then stay within their format.
  const std::int32_t hz = state_.settings.hz;
  const S most = detail::most_acceleration(hz, Limits<S>::speed());
  const S most_turning =
      detail::most_acceleration(hz, detail::most_angular_speed(detail::solid_box(map_, state, body)));
  PendingForce<S>& force = pending_force(state.slot);
  detail::Bounder<S> bounder;
  const Vec3<S> linear = bounder.quotient(command.force, body.mass, most);
  force.linear = bounder.sum(force.linear, linear, most);
  const Vec3<S> turning = bounder.turning(kappa, command.torque, body.mass, most_turning);
  force.angular = bounder.sum(force.angular, turning, most_turning);
  if (bounder.cut) force.cut = 1;
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const ApplyImpulse<S>& command) {
  if (!faults_.accept(
          detail::Checklist().finite(command.linear, "linear").finite(command.angular, "angular").report()) ||
      !may_push(command.body)) {
    return false;
  }
  if (command.linear == Vec3<S>::zero() && command.angular == Vec3<S>::zero()) return true;
  BodyState<S>& state = wake_.wake_for_change(command.body.slot);
  const BodyProperties<S>& body = state_.awake.properties[map_.location(state.slot).index];
  const Mat3<S> kappa = detail::world_kappa(body, detail::world_axes(state.orientation, body));
  // A quarter above the limit: the step then cuts them again and reports it.
  const S speed = Limits<S>::speed() * S(1.25), angular_speed = Limits<S>::angular_speed() * S(1.25);
  detail::Bounder<S> bounder;
  const Vec3<S> linear = bounder.quotient(command.linear, body.mass, S(2) * speed);
  state.velocity = bounder.faster(state.velocity, linear, speed);
  const Vec3<S> turning = bounder.turning(kappa, command.angular, body.mass, S(2) * angular_speed);
  state.angular_velocity = bounder.faster(state.angular_velocity, turning, angular_speed);
  if (bounder.cut) pending_force(state.slot).cut = 1;
  return true;
}

/// Returns the force that is asked of a body until the next step.
template <class S> PendingForce<S>& CommandExecutor<S>::pending_force(std::uint32_t slot) {
  return find_or_insert(state_.forces, PendingForce<S>{slot, 0, Vec3<S>::zero(), Vec3<S>::zero()});
}

}  // namespace isostep
