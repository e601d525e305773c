// The commands about bodies, and gravity.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/commands/command_executor.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "isostep/store/fat_box.hpp"

namespace isostep {

/// Checks all of a definition that needs no mass.
template <class S> bool CommandExecutor<S>::accepts(const BodyDefinition<S>& d) {
  const Vec3<S> zero = Vec3<S>::zero();
  const bool still = d.type == BodyType::static_;
  return known(state_.shape_slots, d.shape, "shape") &&
         faults_.accept(
             detail::Checklist()
                 .finite(d.density, "density")
                 .finite(d.mass, "mass")
                 .finite(d.position, "position")
                 .finite(d.velocity, "velocity")
                 .finite(d.angular_velocity, "angular_velocity")
                 .finite(d.inertia, "inertia")
                 .in_range(detail::within(d.position, Limits<S>::position()), "position", detail::kWithinPosition)
                 .in_range(detail::no_longer(d.velocity, Limits<S>::speed()), "velocity", detail::kWithinSpeed)
                 .in_range(detail::no_longer(d.angular_velocity, Limits<S>::angular_speed()), "angular_velocity",
                           detail::kWithinAngularSpeed)
                 .proper(detail::is_unit<S>(d.orientation), "orientation", detail::kUnitLength)
                 .proper(d.type <= BodyType::dynamic, "type", "one of BodyType")
                 .proper(!still || d.velocity == zero, "velocity", detail::kZeroOfStatic)
                 .proper(!still || d.angular_velocity == zero, "angular_velocity", detail::kZeroOfStatic)
                 .also(detail::fault_of_signs(d.density, d.mass, d.inertia))
                 .also(detail::fault_of(d.material))
                 .also(detail::fault_of_motion(d.gravity_scale, d.linear_damping, d.angular_damping, d.locks))
                 .report());
}

/// Checks the mass of a dynamic body. `shape`: the shape's mass at that density.
template <class S> bool CommandExecutor<S>::check_mass(const BodyMass<S>& d, const MassProperties<S>& shape) {
  const S zero = S(0);
  return faults_.accept(
      detail::Checklist()
          .ask(zero < d.density || zero < d.mass, Fault::bad_mass, "density", "above 0 where mass is 0")
          .ask(!(shape.mass == zero), Fault::bad_mass, "shape", "one with a volume that the scalar can count")
          .ask(zero < d.mass || shape.mass < Limits<S>::mass(), Fault::bad_mass, "density",
               "one at which the shape is lighter than Limits::mass()")
          .report());
}

/// Gives a body the mass that follows from its type and shape, as when it is made.
template <class S> bool CommandExecutor<S>::give_mass(const BodyMass<S>& d, BodyProperties<S>& body) {
  const S zero = S(0);
  const std::span<const Child<S>> children = map_.shapes.children_of(body.shape);
  const MassProperties<S> shape =
      mass_properties(children, d.density > zero ? d.density : S(1), map_.shapes.contents());
  body.local_centre = shape.centre;
  body.principal = shape.principal;
  body.mass = zero;
  body.kappa = Vec3<S>::zero();
  body.flags &= ~body_flag::kSpins;
  if (body.type != BodyType::dynamic) return true;
  if (!check_mass(d, shape)) return false;
  MassProperties<S> chosen = d.mass == zero ? shape : with_mass(shape, d.mass);
  if (!(d.inertia == Vec3<S>::zero())) chosen = from_mass_and_inertia(chosen.mass, d.inertia, shape.centre);
  if (!faults_.accept(detail::fault_of_mass(chosen.mass, chosen.kappa))) return false;
  body.mass = chosen.mass;
  body.kappa = chosen.kappa;
  body.principal = chosen.principal;
  const bool even = body.kappa.x == body.kappa.y && body.kappa.y == body.kappa.z;
  if (!even) body.flags |= body_flag::kSpins;
  return true;
}

/// Returns the properties of a body without its mass.
template <class S> BodyProperties<S> CommandExecutor<S>::properties_of(const BodyDefinition<S>& d) {
  BodyProperties<S> body = {};
  body.type = d.type;
  body.flags = d.locks | (d.sensor ? body_flag::kSensor : 0u) | (d.allow_sleep ? body_flag::kAllowSleep : 0u) |
               (d.collide ? body_flag::kCollide : 0u) | (d.bullet ? body_flag::kBullet : 0u) |
               (d.report_contacts ? body_flag::kReportContacts : 0u);
  body.shape = d.shape.slot;
  body.filter = d.filter;
  body.user_data = d.user_data;
  body.material = d.material;
  body.gravity_scale = d.gravity_scale;
  body.linear_damping = d.linear_damping;
  body.angular_damping = d.angular_damping;
  return body;
}

template <class S> BodyId CommandExecutor<S>::execute(const CreateBody<S>& command) {
  const BodyDefinition<S>& d = command.definition;
  if (!accepts(d)) return {};
  BodyProperties<S> body = properties_of(d);
  if (!give_mass({d.density, d.mass, d.inertia}, body)) return {};

  BodyState<S> state = {};
  const Pose<S> centre = centre_pose({d.position, normalise(d.orientation)}, body.local_centre);
  state.orientation = centre.orientation;
  state.centre = centre.position;
  if (d.type != BodyType::static_) {
    state.velocity = convert<Velocity<S>>(d.velocity);
    state.angular_velocity = convert<Velocity<S>>(d.angular_velocity);
  }
  if (!faults_.accept(detail::fault_of_place(state.centre, "position"))) return {};
  detail::renew_fat_box(map_, state, body, true);
  if (detail::rotates_too_fast(state.angular_velocity, detail::solid_box(map_, state, body))) {
    faults_.refuse(
        {Fault::out_of_range, "", "angular_velocity", "points of the body no faster than Limits::surface_speed()"});
    return {};
  }
  const BodyId id = state_.body_slots.template take<BodyId>(state_.settings.id_space);
  state.slot = id.slot;
  render_poses_.start_here(state);
  map_.insert(state, body);
  proxies_.place(state, body, d.type != BodyType::static_);
  if (d.type != BodyType::dynamic) wake_.wake_touching(id.slot);
  return id;
}

template <class S> bool CommandExecutor<S>::mark_for_destruction(BodyId body) {
  if (!known(body)) return false;
  if (destruction_.is_marked(body.slot)) return faults_.refuse({Fault::stale_id, "", "body", ""});
  destruction_.mark(body.slot);
  return true;
}
template <class S> bool CommandExecutor<S>::execute(const DestroyBody& command) {
  const bool known = mark_for_destruction(command.body);
  destruction_.erase_marked();
  return known;
}

template <class S> std::size_t CommandExecutor<S>::destroy_all(std::span<const BodyId> bodies) {
  std::size_t count = 0;
  for (const BodyId body : bodies) {
    if (!mark_for_destruction(body)) {
      faults_.sign(kCommandNames[detail::kNumberOf<DestroyBody, EveryCommand>]);
      continue;
    }
    journal_.record<EveryCommand>(DestroyBody{body});
    ++count;
    // Sleepers are woken to be destroyed: so that the awake stay few, those that are gone leave now and then.
    const std::size_t marked = destruction_.marked_awake();
    if (marked > 64 && marked > state_.awake.states.size() / 4) destruction_.erase_marked();
  }
  destruction_.erase_marked();
  return count;
}

template <class S> bool CommandExecutor<S>::is_enabled(BodyId body) {
  return map_.is_enabled(body.slot) || faults_.refuse({Fault::bad_argument, "", "body", "one that is enabled"});
}
/// Refuses a body whose motion cannot be changed, a static one. Returns true if it can.
template <class S> bool CommandExecutor<S>::may_change(BodyId body) {
  if (!known(body) || !is_enabled(body)) return false;
  const bool moves = map_.location(body.slot).set != Location::kStatic;
  return moves || faults_.refuse({Fault::not_dynamic, "", "body", "a dynamic or kinematic one"});
}
template <class S> bool CommandExecutor<S>::execute(const WakeBody& command) {
  if (!may_change(command.body)) return false;
  wake_.wake_for_change(command.body.slot);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetPose<S>& command) {
  if (!known(command.body) || !faults_.accept(detail::fault_of_place(command.pose.position, "position"))) return false;
  if (!detail::is_unit<S>(command.pose.orientation))
    return faults_.refuse({Fault::bad_argument, "", "orientation", detail::kUnitLength});
  const std::uint32_t slot = command.body.slot;
  const Location at = map_.location(slot);
  const Pose<S> centre =
      centre_pose({command.pose.position, normalise(command.pose.orientation)}, map_.properties_at(at).local_centre);
  if (!faults_.accept(detail::fault_of_place(centre.position, "position"))) return false;
  const Pose<S> from = map_.origin_pose_at(slot);
  wake_.wake_touching(slot);
  if (map_.properties_at(map_.location(slot)).type != BodyType::dynamic) wake_.wake_held_by(slot);
  if (at.set != Location::kStatic) wake_.wake_for_change(slot);
  const Location now = map_.location(slot);
  BodyState<S>& state = map_.change_state(slot);
  const BodyProperties<S>& body = map_.properties_at(now);
  state.orientation = centre.orientation;
  state.centre = centre.position;
  render_poses_.start_here(state);
  detail::renew_fat_box(map_, state, body, true);
  proxies_.place(state, body, now.set == Location::kAwake);
  wake_.wake_touching(slot);
  leave_ground(slot, &from);
  return true;
}

/// Sets a velocity of zero without waking: what sleeps has no other, what rests rests on. A game may do it every frame.
template <class S> void CommandExecutor<S>::halt(std::uint32_t slot) {
  if (map_.location(slot).set != Location::kAwake) return;
  BodyState<S>& state = state_.awake.states[map_.location(slot).index];
  state.velocity = Vec3<Velocity<S>>::zero();
  state.angular_velocity = Vec3<Velocity<S>>::zero();
}

template <class S> bool CommandExecutor<S>::execute(const SetVelocity<S>& command) {
  if (!faults_.accept(
          detail::Checklist()
              .finite(command.linear, "linear")
              .finite(command.angular, "angular")
              .in_range(detail::no_longer(command.linear, Limits<S>::speed()), "linear", detail::kWithinSpeed)
              .in_range(detail::no_longer(command.angular, Limits<S>::angular_speed()), "angular",
                        detail::kWithinAngularSpeed)
              .report()) ||
      !may_change(command.body)) {
    return false;
  }
  if (command.linear == Vec3<S>::zero() && command.angular == Vec3<S>::zero()) {
    halt(command.body.slot);
    return true;
  }
  const std::uint32_t slot = command.body.slot;
  wake_.wake_for_change(slot);
  if (map_.properties_at(map_.location(slot)).type == BodyType::kinematic) wake_.wake_held_by(slot);
  BodyState<S>& state = state_.awake.states[map_.location(slot).index];
  state.velocity = convert<Velocity<S>>(command.linear);
  state.angular_velocity = convert<Velocity<S>>(command.angular);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetMaterial<S>& command) {
  if (!known(command.body) || !faults_.accept(detail::fault_of(command.material))) return false;
  wake_what_rests_on(command.body);
  wake_.wake(command.body.slot);
  map_.change_properties(command.body.slot).material = command.material;
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetFilter& command) {
  if (!known(command.body)) return false;
  const std::uint32_t slot = command.body.slot;
  wake_what_rests_on(command.body);
  wake_.wake(slot);
  BodyProperties<S>& body = map_.change_properties(slot);
  body.filter = command.filter;
  proxies_.place(map_.state_at(map_.location(slot)), body, map_.location(slot).set == Location::kAwake);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetMotion<S>& command) {
  if (!faults_.accept(detail::fault_of_motion(command.gravity_scale, command.linear_damping, command.angular_damping,
                                              command.locks))) {
    return false;
  }
  if (!may_change(command.body)) return false;
  wake_.wake_for_change(command.body.slot);
  BodyProperties<S>& body = map_.change_properties(command.body.slot);
  body.gravity_scale = command.gravity_scale;
  body.linear_damping = command.linear_damping;
  body.angular_damping = command.angular_damping;
  body.flags = (body.flags & ~body_flag::kAllLocks) | command.locks;
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetUserData& command) {
  if (!known(command.body)) return false;
  wake_.wake(command.body.slot);
  map_.change_properties(command.body.slot).user_data = command.user_data;
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetGravity<S>& command) {
  if (!faults_.accept(detail::Checklist()
                          .finite(command.gravity, "gravity")
                          .in_range(detail::within(command.gravity, Limits<S>::speed()), "gravity",
                                    "components up to Limits::speed()")
                          .report())) {
    return false;
  }
  state_.settings.gravity = command.gravity;
  wake_.wake_all();
  return true;
}

}  // namespace isostep
