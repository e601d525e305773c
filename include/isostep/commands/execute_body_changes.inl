// The commands that change what a body is, and those that put it to sleep or tell it where to be.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/commands/command_executor.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/store/record_checks.hpp"

namespace isostep {

// ---- whether a body may be another

template <class S> bool CommandExecutor<S>::accepts(const BodyMass<S>& mass) {
  return journal_.accept(detail::Checklist()
                             .finite(mass.density, "density")
                             .finite(mass.mass, "mass")
                             .finite(mass.inertia, "inertia")
                             .also(detail::fault_of_signs(mass.density, mass.mass, mass.inertia))
                             .report());
}

/// The centre is the shape's and stays: another density rounds it otherwise.
template <class S> bool CommandExecutor<S>::give_mass_anew(const BodyMass<S>& mass, BodyProperties<S>& body) {
  const Vec3<S> centre = body.local_centre;
  const bool good = accepts(mass) && give_mass(mass, body);
  body.local_centre = centre;
  return good;
}

/// Whether a record that names the body may do so once it is like that.
template <class S>
template <class Record>
bool CommandExecutor<S>::check_tie(const Record& record, std::uint32_t slot, const BodyProperties<S>& next) {
  const detail::NamedBodies<S> bodies = detail::bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) {
    const detail::NamedBody<S>& named = bodies.all[i];
    if (!named.body || named.body.slot != slot) continue;
    if (!detail::is_as_asked(next.type, named.must_be))
      return journal_.refuse({Fault::bad_argument, "", "type", "one that the body's records may name"});
    if (detail::overreaches(next, named))
      return journal_.refuse({Fault::out_of_range, "", "mass", "kappa arm^2 of records up to Limits::leverage()"});
  }
  const auto as_next = [&](BodyId body) { return body && body.slot == slot ? &next : map_.properties_of(body); };
  if constexpr (std::is_same_v<Record, BodySpring<S>>) {
    return check_spring(record, as_next(record.a), as_next(record.b),
                        {Fault::bad_argument, "", "type", "one that the body's springs may tie"});
  } else if constexpr (std::is_same_v<Record, Wheel<S>>) {
    return journal_.accept(detail::fault_of_inertia(record, next));
  }
  return true;
}

/// Whether no joint of the body would reach too far.
template <class S> bool CommandExecutor<S>::check_joints_of(std::uint32_t slot, const BodyProperties<S>& next) {
  bool good = true;
  const auto look = [&](const JointSet<S>& joints) {
    for (const JointProperties<S>& joint : joints.properties) {
      if (joint.body_a == slot) good = good && !detail::overreaches(next.kappa, next.principal, joint.frame_a.position);
      if (joint.body_b == slot) good = good && !detail::overreaches(next.kappa, next.principal, joint.frame_b.position);
    }
  };
  look(state_.joints);
  const Location at = map_.location(slot);
  if (at.is_asleep()) look(state_.sleeping[at.set]->joints);
  else if (map_.names(slot) != 0) {
    for (std::uint32_t i = 0; i < state_.sleeping.size(); ++i) look(state_.sleeping[i]->joints);
  }
  return good || journal_.refuse({Fault::out_of_range, "", "mass", "kappa arm^2 of joints up to Limits::leverage()"});
}

/// Whether the joints and records of a body bear that it is like that from now on.
template <class S> bool CommandExecutor<S>::check_ties(std::uint32_t slot, const BodyProperties<S>& next) {
  if (!check_joints_of(slot, next)) return false;
  bool good = true;
  ForceRecords<S>::members(
      [&](const char*, const auto& registry) {
        for (const auto& record : registry.all()) {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(record)>, MoveTarget<S>>) continue;  // goes
          const BodyId a = detail::first_body_of(record), b = detail::second_body_of(record);
          const bool names = (a && a.slot == slot) || (b && b.slot == slot);
          if (good && names) good = check_tie(record, slot, next);
        }
      },
      *state_.force_records);
  return good;
}

// ---- the changes

/// What couples the body's joints with others is awake as a whole.
template <class S> void CommandExecutor<S>::wake_coupled(std::uint32_t slot) {
  for (const Coupling<S>& coupling : state_.force_records->couplings.all()) {
    const detail::NamedJoints joints = detail::joints_of(coupling);
    bool named = false;
    for (const JointId id : joints.all) {
      const JointProperties<S>* const joint = map_.properties_of(id);
      named = named || (joint != nullptr && (joint->body_a == slot || joint->body_b == slot));
    }
    for (const JointId id : joints.all) {
      if (named && id) wake_.wake_joint(id.slot);
    }
  }
}

/// Of a character whose body was away, or was put elsewhere `from` there: the ground has carried it so far, and no
/// further. One that is only turned stands where it stood.
template <class S> void CommandExecutor<S>::leave_ground(std::uint32_t slot, const Pose<S>* from) {
  if (map_.properties_at(map_.location(slot)).type != BodyType::kinematic) return;
  const auto& characters = state_.force_records->characters;
  const CharacterId id = characters.id_where([slot](const Character<S>& c) { return c.body.slot == slot; });
  const Character<S>* const character = characters.find(id);
  if (character == nullptr || !character->ground) return;
  const Vec3<S> at = map_.origin_pose_at(slot).position;
  if (from != nullptr && max_abs(saturating_subtract(at, from->position)) <= character->skin) return;
  state_.force_records.change().characters.change(id).ground = {};
}

/// Another body in place of one, in its slot: all that it touched has ended, joints begin without impulses.
template <class S>
void CommandExecutor<S>::replace(std::uint32_t slot, BodyState<S> state, const BodyProperties<S>& next) {
  destruction_.part(slot);
  wake_coupled(slot);
  leave_ground(slot);
  for (std::size_t i = 0; i < state_.joints.states.size(); ++i) {
    const JointProperties<S>& joint = state_.joints.properties[i];
    if (joint.body_a != slot && joint.body_b != slot) continue;
    JointState<S> fresh = {};
    fresh.slot = state_.joints.states[i].slot;
    state_.joints.states[i] = fresh;
  }
  map_.erase(slot);
  state.sleep_clock = 0;
  detail::renew_fat_box(map_, state, next, true);
  map_.insert(state, next);
  render_poses_.start_here(state);
  proxies_.place(state, next, !is_fixed(next));
  wake_.wake_touching(slot);
}

template <class S> bool CommandExecutor<S>::execute(const SetEnabled& command) {
  if (!known(command.body)) return false;
  if (command.enabled > 1) return journal_.refuse({Fault::bad_argument, "", "enabled", "0 or 1"});
  const std::uint32_t slot = command.body.slot;
  if (map_.is_enabled(slot) == (command.enabled != 0)) return true;
  BodyProperties<S> next = map_.properties_at(map_.location(slot));
  next.flags ^= body_flag::kDisabled;
  replace(slot, map_.state_at(map_.location(slot)), next);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetType<S>& command) {
  if (!known(command.body)) return false;
  if (command.type > BodyType::dynamic) return journal_.refuse({Fault::bad_argument, "", "type", "one of BodyType"});
  const std::uint32_t slot = command.body.slot;
  BodyProperties<S> next = map_.properties_at(map_.location(slot));
  BodyState<S> state = map_.state_at(map_.location(slot));
  if (next.type == command.type) return true;
  next.type = command.type;
  if (!give_mass_anew(command.mass, next) || !check_ties(slot, next)) return false;
  if (next.type == BodyType::static_) state.velocity = state.angular_velocity = Vec3<Velocity<S>>::zero();
  remove_target(slot);
  replace(slot, state, next);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetMass<S>& command) {
  if (!known(command.body)) return false;
  const std::uint32_t slot = command.body.slot;
  BodyProperties<S> next = map_.properties_at(map_.location(slot));
  if (next.type != BodyType::dynamic) return journal_.refuse({Fault::not_dynamic, "", "body", "a dynamic one"});
  if (!give_mass_anew(command.mass, next) || !check_ties(slot, next)) return false;
  if (map_.is_enabled(slot)) wake_.wake_for_change(slot);
  map_.change_properties(slot) = next;
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SleepBody& command) {
  if (!may_push(command.body)) return false;
  const std::uint32_t slot = command.body.slot;
  if (map_.location(slot).is_asleep()) return true;
  return (state_.settings.allow_sleep && sleep_.put_to_sleep(slot)) ||
         journal_.refuse({Fault::bad_argument, "", "body", "one of an island whose bodies may sleep"});
}

// ---- targets of kinematic bodies

/// Of a body; null where it has none.
template <class S> MoveTargetId CommandExecutor<S>::target_of(std::uint32_t slot) const {
  return state_.force_records->move_targets.id_where(
      [slot](const MoveTarget<S>& target) { return target.body.slot == slot; });
}
template <class S> void CommandExecutor<S>::remove_target(std::uint32_t slot) {
  const MoveTargetId target = target_of(slot);
  if (target) state_.force_records.change().move_targets.remove_at(target.slot);
}

/// In place of the target that the body has. What rests where it is told to be goes on resting, so that a game may say
/// so every frame.
template <class S> bool CommandExecutor<S>::execute(const MoveTo<S>& command) {
  const MoveTarget<S> target = {command.body, command.pose};
  if (!check_force(target)) return false;
  const MoveTargetId earlier = target_of(command.body.slot);
  if (earlier) return set_force(earlier, target);
  const BodyState<S>& state = *map_.state_of(command.body);
  const Pose<S> goal = detail::centre_at<S>(target, map_.properties_of(command.body)->local_centre);
  const bool rests = state.velocity == Vec3<Velocity<S>>::zero() && state.angular_velocity == Vec3<Velocity<S>>::zero();
  if (rests && state.centre == goal.position && state.orientation == goal.orientation) return true;
  return static_cast<bool>(execute(AddRecord<MoveTarget<S>>{target}));
}

}  // namespace isostep
