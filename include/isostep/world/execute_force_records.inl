// The commands about forces that act from step to step.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/command_executor.hpp"
#include "isostep/world/force_checks.hpp"

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
    if (named.must_move && body.type != BodyType::dynamic)
      return journal_.refuse({Fault::not_dynamic, "", named.field, "a dynamic one"});
    if (detail::overreaches(body.kappa, body.principal, named.point - body.local_centre))
      return journal_.refuse({Fault::out_of_range, "", named.point_field, "kappa arm^2 up to Limits::leverage()"});
  }
  return check_spring(record);
}
template <class S> bool CommandExecutor<S>::check_spring(const BodySpring<S>& spring) {
  const BodyProperties<S>*a = map_.properties_of(spring.a), *b = map_.properties_of(spring.b);
  const auto moves = [](const BodyProperties<S>* body) { return body != nullptr && body->type == BodyType::dynamic; };
  if (!moves(a) && !moves(b)) return journal_.refuse({Fault::not_dynamic, "", "a, b", "a dynamic one"});
  const Settings<S>& s = state_.settings;
  return journal_.accept(detail::fault_of_rate(spring, a, b, S(integration_rate(s.solver, s.hz, s.substeps))));
}

/// Wakes what a record acts on: the bodies that it names, or all that it might reach.
template <class S> template <class Record> void CommandExecutor<S>::wake_for_force(const Record& record) {
  if constexpr (requires { record.mask; }) {
    wake_.wake_all();
  } else {
    for (const BodyId body : {detail::first_body_of(record), detail::second_body_of(record)}) {
      if (!body) continue;
      wake_.wake(body.slot);
      wake_.reset_clock(body.slot);
    }
  }
}

template <class S> template <class Record> auto CommandExecutor<S>::add_force(const Record& record) {
  using IdType = typename detail::ForceIdOf<Record>::Type;
  if (!check_force(record)) return IdType{};
  wake_for_force(record);
  return detail::registry_of(state_.force_records.change(), IdType{}).add(record, state_.settings.id_space);
}
template <class S>
template <class Record, class IdType>
bool CommandExecutor<S>::set_force(IdType id, const Record& record) {
  if (!known(detail::registry_of(*state_.force_records, id).slots(), id, "id") || !check_force(record)) return false;
  wake_for_force(*detail::registry_of(*state_.force_records, id).find(id));
  wake_for_force(record);
  detail::registry_of(state_.force_records.change(), id).change(id) = record;
  return true;
}
template <class S> template <class IdType> bool CommandExecutor<S>::remove_force(IdType id) {
  if (!known(detail::registry_of(*state_.force_records, id).slots(), id, "id")) return false;
  wake_for_force(*detail::registry_of(*state_.force_records, id).find(id));
  return detail::registry_of(state_.force_records.change(), id).remove(id);
}

#define ISO_EXECUTE(name, Record, Id, S)                                                         \
  template <class S> Id CommandExecutor<S>::execute(const AddRecord<Record>& command) {          \
    return add_force(command.record);                                                            \
  }                                                                                              \
  template <class S> bool CommandExecutor<S>::execute(const SetForce<Record>& command) {         \
    return set_force(command.id, command.record);                                                \
  }                                                                                              \
  template <class S> bool CommandExecutor<S>::execute(const RemoveRecord<Id>& command) {         \
    return remove_force(command.id);                                                             \
  }
ISO_FOR_EACH_FORCE(ISO_EXECUTE, S)
#undef ISO_EXECUTE

}  // namespace isostep
