// The commands about records: forces that act from step to step, and what else is registered.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/commands/command_executor.hpp"
#include "isostep/store/record_checks.hpp"

namespace isostep {

/// Whether the record's numbers and bodies keep the rules.
template <class S> template <class Record> bool CommandExecutor<S>::check_force(const Record& record) {
  if (!journal_.accept(detail::fault_of(record))) return false;
  const detail::NamedBodies<S> bodies = detail::bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) {
    const detail::NamedBody<S>& named = bodies.all[i];
    if (!named.body && named.may_be_null) continue;
    if (!known(state_.body_slots, named.body, named.field)) return false;
    const BodyProperties<S>& body = *map_.properties_of(named.body);
    if (!detail::is_as_asked(body.type, named.must_be))
      return journal_.refuse(named.must_be == detail::MustBe::dynamic
                                 ? FaultReport{Fault::not_dynamic, "", named.field, "a dynamic one"}
                                 : FaultReport{Fault::bad_argument, "", named.field, "a kinematic one"});
    if (detail::overreaches(body, named))
      return journal_.refuse({Fault::out_of_range, "", named.point_field, "kappa arm^2 up to Limits::leverage()"});
  }
  return check_joints(record) && check_spring(record);
}
template <class S> template <class Record> bool CommandExecutor<S>::check_joints(const Record& record) {
  const detail::NamedJoints named = detail::joints_of(record);
  if constexpr (requires {
                  record.axis;
                  record.joint;
                }) {
    return known(state_.joint_slots, record.joint, "joint") &&
           journal_.accept(
               detail::fault_of_joint(record, *map_.properties_of(record.joint), substep_rate(state_.settings)));
  } else if constexpr (requires { record.joint; }) {
    return known(state_.joint_slots, record.joint, "joint");
  }
  if constexpr (requires { record.joint_a; }) {
    constexpr const char* kFields[] = {"joint_a", "joint_b", "joint_c"};
    const JointProperties<S>* joints[3];
    for (int i = 0; i < 3; ++i) {
      if ((i < 2 || named.all[i]) && !known(state_.joint_slots, named.all[i], kFields[i])) return false;
      joints[i] = map_.properties_of(named.all[i]);
    }
    return journal_.accept(detail::fault_of_joints(record, joints));
  }
  return true;
}
template <class S> bool CommandExecutor<S>::check_spring(const BodySpring<S>& spring) {
  return check_spring(spring, map_.properties_of(spring.a), map_.properties_of(spring.b),
                      {Fault::not_dynamic, "", "a, b", "a dynamic one"});
}
/// Whether a spring may tie bodies that are like that; a null one does not move.
template <class S>
bool CommandExecutor<S>::check_spring(const BodySpring<S>& spring, const BodyProperties<S>* a,
                                      const BodyProperties<S>* b, const FaultReport& none_moves) {
  const auto moves = [](const BodyProperties<S>* body) { return body != nullptr && body->type == BodyType::dynamic; };
  if (!moves(a) && !moves(b)) return journal_.refuse(none_moves);
  const Settings<S>& s = state_.settings;
  return journal_.accept(detail::fault_of_rate(spring, a, b, S(integration_rate(s.solver, s.hz, s.substeps))));
}
template <class S> bool CommandExecutor<S>::check_spring(const Wheel<S>& wheel) {
  return journal_.accept(detail::fault_of_inertia(wheel, *map_.properties_of(wheel.body)));
}

namespace detail {
/// Whether a record that is alike, of which a world has one at most, is that of another slot.
template <class IdType> ISO_INLINE bool is_another(IdType alike, std::uint32_t slot) {
  return alike && alike.slot != slot;
}
}  // namespace detail

/// Whether no record of another slot has the same two kinds.
template <class S>
template <class Record>
bool CommandExecutor<S>::check_kinds(const Record& pair, std::uint32_t slot) {
  const auto& pairs = detail::registry_of(*state_.force_records, typename detail::ForceIdOf<Record>::Type{});
  const auto alike = pairs.id_where([&](const Record& other) {
    return kinds_key(other.kind_a, other.kind_b) == kinds_key(pair.kind_a, pair.kind_b);
  });
  return !detail::is_another(alike, slot) ||
         journal_.refuse({Fault::bad_argument, "", "kind_b", "a pair of kinds that has no record yet"});
}
template <class S> bool CommandExecutor<S>::check_alone(const MaterialPair<S>& pair, std::uint32_t slot) {
  return check_kinds(pair, slot);
}
template <class S> bool CommandExecutor<S>::check_alone(const KindGhost<S>& ghost, std::uint32_t slot) {
  return check_kinds(ghost, slot);
}

/// Two rows of `direct` on one body share its true mass: its matrix is one of square roots of masses.
template <class S> bool CommandExecutor<S>::check_alone(const KindResponse<S>& response, std::uint32_t slot) {
  if (state_.settings.solver == SolverName::direct)
    return journal_.refuse({Fault::bad_argument, "", "solver", "another solver than direct"});
  return check_kinds(response, slot);
}

namespace detail {
/// What two records of one kind may not have in common.
template <class Record> ISO_INLINE auto subject_of(const Record& record) {
  if constexpr (requires { record.joint; }) return record.joint;
  else return record.body;
}
}  // namespace detail

/// Whether no record of another slot has the same body, or joint.
template <class S>
template <class Record>
bool CommandExecutor<S>::check_only_one(const Record& record, std::uint32_t slot) {
  constexpr bool kOfJoint = requires { record.joint; };
  const auto& all = detail::registry_of(*state_.force_records, typename detail::ForceIdOf<Record>::Type{});
  const auto alike =
      all.id_where([&](const Record& other) { return detail::subject_of(other) == detail::subject_of(record); });
  return !detail::is_another(alike, slot) ||
         journal_.refuse({Fault::bad_argument, "", kOfJoint ? "joint" : "body",
                          kOfJoint ? "a joint that has no record yet" : "a body that has no record yet"});
}
template <class S> bool CommandExecutor<S>::check_alone(const JointLoad<S>& load, std::uint32_t slot) {
  return check_only_one(load, slot);
}
/// Whether no record of another slot has the same axis of the same joint.
template <class S> bool CommandExecutor<S>::check_alone(const AxisDrive<S>& drive, std::uint32_t slot) {
  return !detail::is_another(detail::drive_on(*state_.force_records, drive.joint, drive.axis), slot) ||
         journal_.refuse({Fault::bad_argument, "", "axis", "an axis that has no record yet"});
}
template <class S> bool CommandExecutor<S>::check_alone(const Breakable<S>& breakable, std::uint32_t slot) {
  return check_only_one(breakable, slot);
}
template <class S> bool CommandExecutor<S>::check_alone(const Vehicle<S>& vehicle, std::uint32_t slot) {
  return check_only_one(vehicle, slot);
}

/// Whether no record of another slot has the same part of the same body, and the body's shape has that part.
template <class S> bool CommandExecutor<S>::check_alone(const SurfaceVelocity<S>& surface, std::uint32_t slot) {
  const bool whole = surface.part == kEveryPart;
  if (!whole && surface.part >= map_.children_of(map_.properties_of(surface.body)->shape).size())
    return journal_.refuse({Fault::bad_argument, "", "part", "kEveryPart, or a child of the body's shape"});
  const auto alike = state_.force_records->surface_velocitys.id_where(
      [&](const SurfaceVelocity<S>& other) { return other.body == surface.body && other.part == surface.part; });
  return !detail::is_another(alike, slot) ||
         journal_.refuse(whole ? FaultReport{Fault::bad_argument, "", "body", "a body that has no record yet"}
                               : FaultReport{Fault::bad_argument, "", "part", "a part that has no record yet"});
}
template <class S> bool CommandExecutor<S>::check_alone(const OneWay<S>& one_way, std::uint32_t slot) {
  return check_only_one(one_way, slot);
}
template <class S> bool CommandExecutor<S>::check_alone(const HitReport<S>& report, std::uint32_t slot) {
  return check_only_one(report, slot);
}
template <class S> bool CommandExecutor<S>::check_alone(const ContactReport<S>& report, std::uint32_t slot) {
  return check_only_one(report, slot);
}
template <class S> bool CommandExecutor<S>::check_alone(const MoveTarget<S>& target, std::uint32_t slot) {
  return check_only_one(target, slot);
}
/// Whether it is a sensor, which no record of another slot has, and neither of the two is mounted on and mounted.
template <class S> bool CommandExecutor<S>::check_alone(const SensorMount<S>& mount, std::uint32_t slot) {
  const auto refuse = [&](const char* field, const char* expected) {
    return journal_.refuse({Fault::bad_argument, "", field, expected});
  };
  if ((map_.properties_of(mount.sensor)->flags & body_flag::kSensor) == 0)
    return refuse("sensor", "a body that is a sensor");
  const auto& all = state_.force_records->sensor_mounts;
  for (std::uint32_t i = 0; i < all.all().size(); ++i) {
    const SensorMount<S>& other = all.all()[i];
    if (i == slot || !all.is_taken(i)) continue;
    if (other.sensor == mount.sensor) return refuse("sensor", "a sensor that has no record yet");
    if (other.on == mount.sensor) return refuse("sensor", "a sensor that carries none");
    if (other.sensor == mount.on) return refuse("on", "a body that is not mounted itself");
  }
  return true;
}
/// Whether no record of another slot has the same two bodies.
template <class S> bool CommandExecutor<S>::check_alone(const Ghost<S>& ghost, std::uint32_t slot) {
  const auto alike = state_.force_records->ghosts.id_where([&](const Ghost<S>& other) {
    return (other.a == ghost.a && other.b == ghost.b) || (other.a == ghost.b && other.b == ghost.a);
  });
  return !detail::is_another(alike, slot) ||
         journal_.refuse({Fault::bad_argument, "", "b", "a pair that has no record yet"});
}

/// Whether no record of another slot has the same body, and its shape can be cast.
template <class S> bool CommandExecutor<S>::check_alone(const Character<S>& character, std::uint32_t slot) {
  if (!check_only_one(character, slot)) return false;
  return detail::can_walk(map_.children_of(map_.properties_of(character.body)->shape)) ||
         journal_.refuse({Fault::bad_shape, "", "body", "one of a single convex part with an end"});
}

namespace detail {
/// Whether a record acts on more than the bodies that it names. A character's mask is of what is in its way.
template <class Record> inline constexpr bool kActsOnAll = requires(Record record) { record.mask; }
|| requires(Record record) { record.kind_a; };
template <class S> inline constexpr bool kActsOnAll<Character<S>> = false;
/// Whether a record acts on what touches its body.
template <class Record> inline constexpr bool kActsOnTouching = false;
template <class S> inline constexpr bool kActsOnTouching<SurfaceVelocity<S>> = true;
template <class S> inline constexpr bool kActsOnTouching<OneWay<S>> = true;
template <class S> inline constexpr bool kActsOnTouching<MoveTarget<S>> = true;
/// Whether a record changes nothing that moves.
template <class Record> inline constexpr bool kOnlyTells = false;
template <class S> inline constexpr bool kOnlyTells<HitReport<S>> = true;
template <class S> inline constexpr bool kOnlyTells<ContactReport<S>> = true;
template <class S> inline constexpr bool kOnlyTells<SensorMount<S>> = true;
}  // namespace detail

/// What touches a body, and what sleeps on it as a step found it.
template <class S> void CommandExecutor<S>::wake_what_rests_on(BodyId body) {
  wake_.wake_touching(body.slot);
  wake_.wake_held_by(body.slot);
}

/// Wakes what a record acts on: the bodies that it names, or all that it might reach.
template <class S> template <class Record> void CommandExecutor<S>::wake_for_force(const Record& record) {
  if constexpr (detail::kActsOnAll<Record>) {
    wake_.wake_all();
  } else if constexpr (!detail::kOnlyTells<Record>) {
    for (const BodyId body : {detail::first_body_of(record), detail::second_body_of(record)}) {
      if (!body) continue;
      wake_.wake(body.slot);
      wake_.reset_clock(body.slot);
      if constexpr (detail::kActsOnTouching<Record>) wake_what_rests_on(body);
    }
    for (const JointId joint : detail::joints_of(record).all) {
      if (joint) wake_.wake_joint(joint.slot);
    }
  }
}

template <class S> template <class Record> auto CommandExecutor<S>::add_force(const Record& record) {
  using IdType = typename detail::ForceIdOf<Record>::Type;
  if (!check_force(record) || !check_alone(record, ~0u)) return IdType{};
  wake_for_force(record);
  Record added = record;
  if constexpr (requires { added.begin; }) added.begin = max(added.begin, state_.tick);
  return detail::registry_of(state_.force_records.change(), IdType{}).add(added, state_.settings.id_space);
}
template <class S>
template <class Record, class IdType>
bool CommandExecutor<S>::set_force(IdType id, const Record& record) {
  if (!known(detail::registry_of(*state_.force_records, id).slot_map(), id, "id") || !check_force(record) ||
      !check_alone(record, id.slot))
    return false;
  wake_for_force(*detail::registry_of(*state_.force_records, id).find(id));
  wake_for_force(record);
  detail::registry_of(state_.force_records.change(), id).change(id) = record;
  return true;
}
template <class S> template <class IdType> bool CommandExecutor<S>::remove_force(IdType id) {
  if (!known(detail::registry_of(*state_.force_records, id).slot_map(), id, "id")) return false;
  wake_for_force(*detail::registry_of(*state_.force_records, id).find(id));
  return detail::registry_of(state_.force_records.change(), id).remove(id);
}

#define ISO_EXECUTE(name, Record, Id, S)                                                 \
  template <class S> Id CommandExecutor<S>::execute(const AddRecord<Record>& command) {  \
    return add_force(command.record);                                                    \
  }                                                                                      \
  template <class S> bool CommandExecutor<S>::execute(const SetForce<Record>& command) { \
    return set_force(command.id, command.record);                                        \
  }                                                                                      \
  template <class S> bool CommandExecutor<S>::execute(const RemoveRecord<Id>& command) { \
    return remove_force(command.id);                                                     \
  }
ISO_FOR_EACH_RECORD(ISO_EXECUTE, S)
#undef ISO_EXECUTE

}  // namespace isostep
