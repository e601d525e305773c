// The commands that change what a body is, and those that put it to sleep or tell it where to be.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/commands/command_executor.hpp"
#include "isostep/dynamics/joints/joint_checks.hpp"
#include "isostep/store/fat_box.hpp"

namespace isostep {

// ---- whether a body may be another

template <class S> bool CommandExecutor<S>::accepts(const BodyMass<S>& mass) {
  return faults_.accept(detail::Checklist()
                            .finite(mass.density, "density")
                            .finite(mass.mass, "mass")
                            .finite(mass.inertia, "inertia")
                            .also(detail::fault_of_signs(mass.density, mass.mass, mass.inertia))
                            .report());
}

/// The centre is the shape's and stays, since another density would round it differently.
template <class S> bool CommandExecutor<S>::give_mass_anew(const BodyMass<S>& mass, BodyProperties<S>& body) {
  const Vec3<S> centre = body.local_centre;
  const bool good = accepts(mass) && give_mass(mass, body);
  body.local_centre = centre;
  return good;
}

/// Refuses a change of a body after which a record could not name it.
template <class S>
template <class Record>
bool CommandExecutor<S>::check_tie(const Record& record, std::uint32_t slot, const BodyProperties<S>& next) {
  const detail::NamedBodies<S> bodies = detail::bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) {
    const detail::NamedBody<S>& named = bodies.all[i];
    if (!named.body || named.body.slot != slot) continue;
    if (!detail::is_as_asked(next.type, named.must_be))
      return faults_.refuse({Fault::bad_argument, "", "type", "one that the body's records may name"});
    if (detail::overreaches(next, named))
      return faults_.refuse({Fault::out_of_range, "", "mass", "kappa arm^2 of records up to Limits::leverage()"});
  }
  const FaultReport fault = detail::RecordRules<Record>::fault_at(record, place_of(record, slot, &next));
  if (fault.fault != Fault::not_dynamic) return faults_.accept(fault);
  return faults_.refuse({Fault::bad_argument, "", "type", "one that the body's springs may tie"});
}

/// Refuses a body whose joints would reach too far, or would tie it to one that is far lighter or heavier.
template <class S> bool CommandExecutor<S>::check_joints_of(std::uint32_t slot, const BodyProperties<S>& next) {
  bool good = true, even = true;
  const auto look_at = [&](std::uint32_t other, const Pose<S>& frame) {
    good = good && !detail::overreaches(next.kappa, next.principal, frame.position);
    even = even && (other == kNoBody || !detail::outweighs(next, map_.properties_at(map_.location(other))));
  };
  const auto look = [&](const JointSet<S>& joints) {
    for (const JointProperties<S>& joint : joints.properties) {
      if (joint.body_a == slot) look_at(joint.body_b, joint.frame_a);
      if (joint.body_b == slot) look_at(joint.body_a, joint.frame_b);
    }
  };
  look(state_.joints);
  const Location at = map_.location(slot);
  if (at.is_asleep()) look(state_.sleeping[at.set]->joints);
  else if (map_.names(slot) != 0) {
    for (std::uint32_t i = 0; i < state_.sleeping.size(); ++i) look(state_.sleeping[i]->joints);
  }
  if (!good)
    return faults_.refuse({Fault::out_of_range, "", "mass", "kappa arm^2 of joints up to Limits::leverage()"});
  constexpr const char* kRatio = "up to Limits::mass_ratio() to one of what joints tie it to";
  return even || faults_.refuse({Fault::out_of_range, "", "mass", kRatio});
}

/// Returns true if the joints and records of a body allow its next properties.
template <class S> bool CommandExecutor<S>::check_ties(std::uint32_t slot, const BodyProperties<S>& next) {
  if (!check_joints_of(slot, next)) return false;
  bool good = true;
  RecordStore<S>::members(
      [&](const char*, const auto& registry) {
        for (const auto& record : registry.all()) {
          const BodyId a = detail::first_body_of(record), b = detail::second_body_of(record);
          const bool names = (a && a.slot == slot) || (b && b.slot == slot);
          if (good && names) good = check_tie(record, slot, next);
        }
      },
      *state_.records);
  return good;
}

// ---- the changes

/// Wakes what couplings tie to the body's joints: a coupling is awake as a whole.
template <class S> void CommandExecutor<S>::wake_coupled(std::uint32_t slot) {
  for (const Coupling<S>& coupling : state_.records->couplings.all()) {
    const detail::NamedJoints joints = detail::joints_of(coupling);
    bool named = false;
    for (const JointId id : joints.all) {
      const JointProperties<S>* const joint = map_.joints.properties_of(id);
      named = named || (joint != nullptr && (joint->body_a == slot || joint->body_b == slot));
    }
    for (const JointId id : joints.all) {
      if (named && id) wake_.wake_joint(id.slot);
    }
  }
}

/// Ends the footing of a character whose body was away, or was put elsewhere than `from`: the ground carries it no
/// further. One that only turned, or moved by no more than its skin, keeps its ground.
template <class S> void CommandExecutor<S>::leave_ground(std::uint32_t slot, const Pose<S>* from) {
  if (map_.properties_at(map_.location(slot)).type != BodyType::kinematic) return;
  const auto& characters = state_.records->characters;
  const CharacterId id = characters.id_where([slot](const CharacterSettings<S>& c) { return c.body.slot == slot; });
  const CharacterSettings<S>* const character = characters.find(id);
  if (character == nullptr || !state_.parts.character_states[id.slot].ground) return;
  const Vec3<S> at = map_.origin_pose_at(slot).position;
  if (from != nullptr && max_abs(saturating_subtract(at, from->position)) <= character->skin) return;
  state_.parts.character_states[id.slot].ground = {};
}

/// Puts another body into a slot in place of one: all that it touched has ended, joints begin without impulses.
template <class S>
void CommandExecutor<S>::replace(std::uint32_t slot, BodyState<S> state, const BodyProperties<S>& next) {
  destruction_.part(slot);
  wake_coupled(slot);
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
  if (command.enabled > 1) return faults_.refuse({Fault::bad_argument, "", "enabled", "0 or 1"});
  const std::uint32_t slot = command.body.slot;
  if (map_.is_enabled(slot) == (command.enabled != 0)) return true;
  BodyProperties<S> next = map_.properties_at(map_.location(slot));
  next.flags ^= body_flag::kDisabled;
  leave_ground(slot);
  replace(slot, map_.state_at(map_.location(slot)), next);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetType<S>& command) {
  if (!known(command.body)) return false;
  if (command.type > BodyType::dynamic) return faults_.refuse({Fault::bad_argument, "", "type", "one of BodyType"});
  const std::uint32_t slot = command.body.slot;
  BodyProperties<S> next = map_.properties_at(map_.location(slot));
  BodyState<S> state = map_.state_at(map_.location(slot));
  if (next.type == command.type) return true;
  next.type = command.type;
  if (!give_mass_anew(command.mass, next) || !check_ties(slot, next)) return false;
  if (next.type == BodyType::static_) state.velocity = state.angular_velocity = Vec3<Velocity<S>>::zero();
  leave_ground(slot);
  forget_move(slot);
  replace(slot, state, next);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SetMass<S>& command) {
  if (!known(command.body)) return false;
  const std::uint32_t slot = command.body.slot;
  BodyProperties<S> next = map_.properties_at(map_.location(slot));
  if (next.type != BodyType::dynamic) return faults_.refuse({Fault::not_dynamic, "", "body", "a dynamic one"});
  if (!give_mass_anew(command.mass, next) || !check_ties(slot, next)) return false;
  if (map_.is_enabled(slot)) wake_.wake_for_change(slot);
  map_.change_properties(slot) = next;
  return true;
}

/// Contacts end and begin anew. The pose of the body's origin, which a game sees, stays. A character stays on its
/// ground.
template <class S> bool CommandExecutor<S>::execute(const SetShape<S>& command) {
  if (!known(command.body) || !known(state_.shape_slots, command.shape, "shape") || !accepts(command.mass))
    return false;
  const std::uint32_t slot = command.body.slot;
  BodyProperties<S> next = map_.properties_at(map_.location(slot));
  next.shape = command.shape.slot;
  if (!give_mass(command.mass, next) || !check_ties(slot, next)) return false;
  BodyState<S> state = map_.state_at(map_.location(slot));
  const Pose<S> centre = centre_pose(map_.origin_pose_at(slot), next.local_centre);
  if (!faults_.accept(detail::fault_of_place(centre.position, "shape"))) return false;
  state.centre = centre.position;
  replace(slot, state, next);
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const SleepBody& command) {
  if (!may_push(command.body)) return false;
  const std::uint32_t slot = command.body.slot;
  if (map_.location(slot).is_asleep()) return true;
  return (state_.settings.allow_sleep && sleep_.put_to_sleep(slot)) ||
         faults_.refuse({Fault::bad_argument, "", "body", "one of an island whose bodies may sleep"});
}

// ---- moves of kinematic bodies

template <class S> void CommandExecutor<S>::forget_move(std::uint32_t slot) {
  std::erase_if(state_.moves, [slot](const PendingMove<S>& move) { return move.slot == slot; });
}

/// Replaces an earlier move of the body. A body that rests at that pose goes on resting, so a game may say it every
/// frame.
template <class S> bool CommandExecutor<S>::execute(const MoveTo<S>& command) {
  if (!known(command.body)) return false;
  const std::uint32_t slot = command.body.slot;
  const BodyProperties<S>& body = *map_.properties_of(command.body);
  if (body.type != BodyType::kinematic) return faults_.refuse({Fault::bad_argument, "", "body", "a kinematic one"});
  if (!faults_.accept(detail::fault_of_pose(command.pose))) return false;
  const std::size_t place = place_of_slot(state_.moves, slot);
  const bool told = place < state_.moves.size() && state_.moves[place].slot == slot;
  const BodyState<S>& state = *map_.state_of(command.body);
  const Pose<S> goal = detail::centre_at(command.pose, body.local_centre);
  const bool rests = state.velocity == Vec3<Velocity<S>>::zero() && state.angular_velocity == Vec3<Velocity<S>>::zero();
  if (!told && rests && state.centre == goal.position && state.orientation == goal.orientation) return true;
  wake_.wake(slot);
  wake_.reset_clock(slot);
  wake_what_rests_on(command.body);
  find_or_insert(state_.moves, PendingMove<S>{slot, 0, command.pose}).pose = command.pose;
  return true;
}

}  // namespace isostep
