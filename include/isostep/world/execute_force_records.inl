// The commands about records: forces that act from step to step, and what else is registered.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/command_executor.hpp"
#include "isostep/world/record_checks.hpp"

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
template <class S> bool CommandExecutor<S>::check_spring(const Wheel<S>& wheel) {
  return journal_.accept(detail::fault_of_inertia(wheel, *map_.properties_of(wheel.body)));
}

/// Whether no record of another slot has the same two kinds.
template <class S> bool CommandExecutor<S>::check_alone(const MaterialPair<S>& pair, std::uint32_t slot) {
  const auto& pairs = state_.force_records->material_pairs;
  for (std::uint32_t i = 0; i < pairs.all().size(); ++i) {
    const MaterialPair<S>& other = pairs.all()[i];
    if (i == slot || !pairs.is_taken(i) || kinds_key(other.kind_a, other.kind_b) != kinds_key(pair.kind_a, pair.kind_b))
      continue;
    return journal_.refuse({Fault::bad_argument, "", "kind_b", "a pair of kinds that has no record yet"});
  }
  return true;
}

/// Whether no record of another slot has the same body.
template <class S>
template <class Record>
bool CommandExecutor<S>::check_only_one(const Record& record, std::uint32_t slot) {
  const auto& all = detail::registry_of(*state_.force_records, typename detail::ForceIdOf<Record>::Type{});
  for (std::uint32_t i = 0; i < all.all().size(); ++i) {
    if (i != slot && all.is_taken(i) && all.all()[i].body == record.body)
      return journal_.refuse({Fault::bad_argument, "", "body", "a body that has no record yet"});
  }
  return true;
}
template <class S> bool CommandExecutor<S>::check_alone(const Breakable<S>& breakable, std::uint32_t slot) {
  return check_only_one(breakable, slot);
}
template <class S> bool CommandExecutor<S>::check_alone(const Vehicle<S>& vehicle, std::uint32_t slot) {
  return check_only_one(vehicle, slot);
}

/// Whether no record of another slot has the same body, and its shape can be cast.
template <class S> bool CommandExecutor<S>::check_alone(const Character<S>& character, std::uint32_t slot) {
  if (!check_only_one(character, slot)) return false;
  const std::span<const Child<S>> parts = map_.children_of(map_.properties_of(character.body)->shape);
  return (parts.size() == 1 && !is_surface(parts[0].primitive.type) && is_bounded(parts[0].primitive.type)) ||
         journal_.refuse({Fault::bad_shape, "", "body", "one of a single convex part with an end"});
}

namespace detail {
/// Whether a record acts on more than the bodies that it names. A character's mask is of what is in its way.
template <class Record>
inline constexpr bool kActsOnAll =
    requires(Record record) { record.mask; } || requires(Record record) { record.kind_a; };
template <class S> inline constexpr bool kActsOnAll<Character<S>> = false;
}  // namespace detail

/// Wakes what a record acts on: the bodies that it names, or all that it might reach.
template <class S> template <class Record> void CommandExecutor<S>::wake_for_force(const Record& record) {
  if constexpr (detail::kActsOnAll<Record>) {
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
  if (!check_force(record) || !check_alone(record, ~0u)) return IdType{};
  wake_for_force(record);
  Record added = record;
  if constexpr (requires { added.begin; }) added.begin = max(added.begin, state_.tick);
  return detail::registry_of(state_.force_records.change(), IdType{}).add(added, state_.settings.id_space);
}
template <class S>
template <class Record, class IdType>
bool CommandExecutor<S>::set_force(IdType id, const Record& record) {
  if (!known(detail::registry_of(*state_.force_records, id).slots(), id, "id") || !check_force(record) ||
      !check_alone(record, id.slot))
    return false;
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
ISO_FOR_EACH_RECORD(ISO_EXECUTE, S)
#undef ISO_EXECUTE

}  // namespace isostep
