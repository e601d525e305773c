// The commands about records: forces that act from step to step, and what else is registered.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/commands/command_executor.hpp"

namespace isostep {

/// Refuses a record whose numbers, bodies or joints break the rules of its kind.
template <class S> template <class Record> bool CommandExecutor<S>::check_record(const Record& record) {
  using Rules = detail::RecordRules<Record>;
  if (!faults_.accept(Rules::fault(record))) return false;
  const detail::NamedBodies<S> bodies = detail::bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) {
    const detail::NamedBody<S>& named = bodies.all[i];
    if (!named.body && named.may_be_null) continue;
    if (!known(state_.body_slots, named.body, named.field)) return false;
    const BodyProperties<S>& body = *map_.properties_of(named.body);
    if (!detail::is_as_asked(body.type, named.must_be))
      return faults_.refuse(named.must_be == detail::MustBe::dynamic
                                ? FaultReport{Fault::not_dynamic, "", named.field, "a dynamic one"}
                                : FaultReport{Fault::bad_argument, "", named.field, "a kinematic one"});
    if (detail::overreaches(body, named))
      return faults_.refuse({Fault::out_of_range, "", named.point_field, "kappa arm^2 up to Limits::leverage()"});
  }
  return check_joints(record) && faults_.accept(Rules::fault_at(record, place_of(record, kNoBody, nullptr)));
}
/// Refuses a record that names a joint which does not exist.
template <class S> template <class Record> bool CommandExecutor<S>::check_joints(const Record& record) {
  const detail::NamedJoints named = detail::joints_of(record);
  for (int i = 0; i < named.count; ++i) {
    if (!named.all[i] && named.may_be_null(i)) continue;
    if (!known(state_.joint_slots, named.all[i], named.field(i))) return false;
  }
  return true;
}
/// Finds what a record names. If `next` is not null, it takes the place of the properties of the body in `slot`.
template <class S>
template <class Record>
detail::RecordPlace<S> CommandExecutor<S>::place_of(const Record& record, std::uint32_t slot,
                                                    const BodyProperties<S>* next) const {
  const auto body = [&](BodyId id) { return next != nullptr && id && id.slot == slot ? next : map_.properties_of(id); };
  const auto joint = [&](JointId id) { return map_.joints.properties_of(id); };
  const auto children_of = [&](std::uint32_t shape) { return map_.shapes.children_of(shape); };
  return detail::place_of<S>(record, state_.settings, body, joint, children_of);
}

/// Refuses a record that shares with one of another slot what no two may share.
template <class S>
template <class Record>
bool CommandExecutor<S>::check_alone(const Record& record, std::uint32_t slot) {
  using Rules = detail::RecordRules<Record>;
  const auto& all = detail::registry_of(*state_.records, typename detail::RecordIdOf<Record>::Type{});
  const auto another = [&](const auto& match) {
    const auto id = all.id_where(match);
    return id && id.slot != slot;
  };
  if constexpr (requires { Rules::key(record); }) {
    const detail::RecordKey key = Rules::key(record);
    const detail::OnlyOne rule = Rules::only_one(record);
    if (another([&](const Record& other) { return Rules::key(other) == key; }))
      return faults_.refuse({Fault::bad_argument, "", rule.field, rule.expected});
  }
  if constexpr (requires { Rules::kNoCarrier; }) {
    const detail::NamedBodies<S> named = detail::bodies_of(record);
    const BodyId first = named.all[0].body, second = named.all[1].body;
    if (another([&](const Record& other) { return detail::second_body_of(other) == first; }))
      return faults_.refuse({Fault::bad_argument, "", named.all[0].field, Rules::kNoCarrier[0]});
    if (another([&](const Record& other) { return detail::first_body_of(other) == second; }))
      return faults_.refuse({Fault::bad_argument, "", named.all[1].field, Rules::kNoCarrier[1]});
  }
  return true;
}

/// Wakes what touches a body, and what sleeps on it by the last step.
template <class S> void CommandExecutor<S>::wake_what_rests_on(BodyId body) {
  wake_.wake_touching(body.slot);
  wake_.wake_held_by(body.slot);
}

/// Wakes what a record acts on.
template <class S> template <class Record> void CommandExecutor<S>::wake_for_record(const Record& record) {
  constexpr detail::Wakes kWakes = detail::RecordRules<Record>::kWakes;
  if constexpr (kWakes == detail::Wakes::all) wake_.wake_all();
  if constexpr (kWakes == detail::Wakes::named || kWakes == detail::Wakes::touching) {
    for (const BodyId body : {detail::first_body_of(record), detail::second_body_of(record)}) {
      if (!body) continue;
      wake_.wake(body.slot);
      wake_.reset_clock(body.slot);
      if constexpr (kWakes == detail::Wakes::touching) wake_what_rests_on(body);
    }
    for (const JointId joint : detail::joints_of(record).all) {
      if (joint) wake_.wake_joint(joint.slot);
    }
  }
}

template <class S> template <class Record> auto CommandExecutor<S>::add_record(const Record& record) {
  using IdType = typename detail::RecordIdOf<Record>::Type;
  if (!check_record(record) || !check_alone(record, ~0u)) return IdType{};
  wake_for_record(record);
  Record added = record;
  if constexpr (requires { added.begin; }) added.begin = max(added.begin, state_.tick);
  const IdType id = detail::registry_of(state_.records.change(), IdType{}).add(added, state_.settings.id_space);
  detail::renew_parts<IdType>(state_.parts, id.slot);
  return id;
}
template <class S>
template <class Record, class IdType>
bool CommandExecutor<S>::set_record(IdType id, const Record& record) {
  if (!known(detail::registry_of(*state_.records, id).slot_map(), id, "id") || !check_record(record) ||
      !check_alone(record, id.slot))
    return false;
  wake_for_record(*detail::registry_of(*state_.records, id).find(id));
  wake_for_record(record);
  detail::registry_of(state_.records.change(), id).change(id) = record;
  return true;
}
template <class S> template <class IdType> bool CommandExecutor<S>::remove_record(IdType id) {
  if (!known(detail::registry_of(*state_.records, id).slot_map(), id, "id")) return false;
  wake_for_record(*detail::registry_of(*state_.records, id).find(id));
  detail::registry_of(state_.records.change(), id).remove(id);
  detail::renew_parts<IdType>(state_.parts, id.slot);
  return true;
}
template <class S>
template <class IdType, class Input>
bool CommandExecutor<S>::set_input(IdType id, const Input& input) {
  const auto& registry = detail::registry_of(*state_.records, id);
  if (!known(registry.slot_map(), id, "id")) return false;
  const auto& record = *registry.find(id);
  if (!faults_.accept(detail::RecordRules<std::remove_cvref_t<decltype(record)>>::fault(input))) return false;
  wake_for_record(record);
  detail::inputs_of(state_.parts, id)[id.slot] = input;
  return true;
}
template <class S> bool CommandExecutor<S>::execute(const SetWheelSpin<S>& command) {
  const auto& wheels = state_.records->wheels;
  if (!known(wheels.slot_map(), command.wheel, "wheel")) return false;
  const WheelSettings<S>& wheel = *wheels.find(command.wheel);
  const S rim = saturate_to<S>(product(command.spin, wheel.radius));
  if (!faults_.accept(detail::Checklist()
                          .finite(command.spin, "spin")
                          .in_range(detail::within(rim, Limits<S>::speed()), "spin",
                                    "a rim no faster than Limits::speed()")
                          .report()))
    return false;
  wake_for_record(wheel);
  state_.parts.wheel_states[command.wheel.slot].spin = command.spin;
  return true;
}

#define ISO_EXECUTE(name, Record, Id, S)                                                    \
  template <class S> Id CommandExecutor<S>::execute(const AddRecord<Record>& command) {     \
    return add_record(command.record);                                                      \
  }                                                                                         \
  template <class S> bool CommandExecutor<S>::execute(const SetRecordOf<Record>& command) { \
    return set_record(command.id, command.record);                                          \
  }                                                                                         \
  template <class S> bool CommandExecutor<S>::execute(const RemoveRecord<Id>& command) {    \
    return remove_record(command.id);                                                       \
  }
ISO_FOR_EACH_RECORD(ISO_EXECUTE, S)
#undef ISO_EXECUTE
#define ISO_EXECUTE(name, Input, Id, S)                                                   \
  template <class S> bool CommandExecutor<S>::execute(const SetInputOf<Input>& command) { \
    return set_input(command.id, command.input);                                          \
  }
ISO_FOR_EACH_INPUT(ISO_EXECUTE, S)
#undef ISO_EXECUTE

}  // namespace isostep
