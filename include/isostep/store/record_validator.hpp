// RecordValidator: whether the records of a state read from outside keep every rule that the step relies on.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/records/record_store.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/record_place.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// Tables of the bodies and joints of a state by slot, and of the sets in which they lie.
template <class S> struct SlotTables {
  struct JointAt {
    const JointProperties<S>* joint;
    std::uint32_t set;  // as set_of_body
  };

  std::vector<std::uint32_t> set_of_body;                    // Location::kNone, kStatic, kAwake or a sleeping island
  std::vector<const BodyProperties<S>*> properties_of_body;  // null: there is no body
  std::vector<JointAt> joint_at;

  bool is_body(std::uint32_t slot) const { return slot < set_of_body.size() && set_of_body[slot] != Location::kNone; }
  /// Returns the type of a body that exists.
  BodyType type_of(std::uint32_t slot) const { return properties_of_body[slot]->type; }
  bool is_disabled(std::uint32_t slot) const {
    return set_of_body[slot] == Location::kStatic && type_of(slot) != BodyType::static_;
  }
  /// Returns true if forces move the body.
  bool moves(std::uint32_t slot) const {
    return slot != kNoBody && type_of(slot) == BodyType::dynamic && set_of_body[slot] != Location::kStatic;
  }
};

namespace detail {
ISO_INLINE bool lie_in(const SlotMap& slot_map, std::uint32_t space) {
  bool all = true;
  for (std::uint32_t i = 0; i < slot_map.entries().size(); ++i)
    all = all && SlotMap::space_of(slot_map.id_of<BodyId>(i)) == space;
  return all;
}
}  // namespace detail

/// Checks the records of a state. The tables have the place of every body and joint.
template <class S> class RecordValidator {
 public:
  RecordValidator(const WorldState<S>& state, const SlotTables<S>& seen) : state_(state), seen_(seen) {}

  /// Returns null, or a sentence for the first broken rule.
  const char* broken_rule() const {
    const char* broken = nullptr;
    RecordStore<S>::members(
        [&](const char*, const auto& registry) {
          if (broken == nullptr) broken = records(registry);
        },
        *state_.records);
    return broken;
  }

 private:
  template <class Record, class IdType> const char* records(const Registry<Record, IdType>& registry) const {
    using Rules = detail::RecordRules<Record>;
    const std::vector<Record>& all = registry.all();
    if (all.size() != registry.slot_map().entries().size()) return "records are not one a slot";
    if (!detail::lie_in(registry.slot_map(), state_.settings.id_space)) return "a record's slot is of another id space";
    if (!has_parts(registry)) return "a record's input or state is out of range";
    for (std::uint32_t slot = 0; slot < all.size(); ++slot) {
      if (!registry.is_taken(slot)) {
        if (!is_empty(all[slot])) return "a free record holds something";
        continue;
      }
      if (Rules::fault(all[slot]) != Fault::none) return "a record is out of range";
      if (!names_well(all[slot])) return "a record names no body or joint that it may act on";
      if (Rules::fault_at(all[slot], place_of(all[slot])) != Fault::none)
        return "a record does not fit what it names, or the solver";
      if (Rules::kTies && ties_islands(all[slot])) return "a record ties two islands";
    }
    if constexpr (requires(const Record& record) { Rules::key(record); }) {
      if (has_twins(registry)) return "two records of a kind are about the same";
    }
    if constexpr (requires { Rules::kNoCarrier; }) {
      if (has_chain(all)) return "a sensor is mounted on one that is mounted";
    }
    return nullptr;
  }
  /// Returns true if each slot has one part of a kind, and a free slot a new one.
  template <class Record, class IdType> bool has_parts(const Registry<Record, IdType>& registry) const {
    bool good = true;
    detail::for_each_part<IdType>(state_.parts, [&](const auto& parts) {
      good = good && parts.size() == registry.all().size();
      for (std::uint32_t slot = 0; good && slot < parts.size(); ++slot)
        good = registry.is_taken(slot) ? detail::RecordRules<Record>::fault(parts[slot]) == Fault::none
                                       : is_empty(parts[slot]);
    });
    return good;
  }
  template <class Record> static bool is_empty(const Record& record) {
    const Record none{};
    return hash_records_by_fields(&record, 1) == hash_records_by_fields(&none, 1);
  }
  template <class Record> bool names_well(const Record& record) const {
    const detail::NamedBodies<S> bodies = detail::bodies_of(record);
    for (int i = 0; i < bodies.count; ++i) {
      const detail::NamedBody<S>& named = bodies.all[i];
      if (!named.body && named.may_be_null) continue;
      if (!state_.body_slots.holds(named.body) || !detail::is_as_asked(seen_.type_of(named.body.slot), named.must_be))
        return false;
    }
    const detail::NamedJoints joints = detail::joints_of(record);
    for (int i = 0; i < joints.count; ++i) {
      if (!joints.all[i] && joints.may_be_null(i)) continue;
      if (!state_.joint_slots.holds(joints.all[i])) return false;
    }
    return true;
  }
  /// `record` keeps the rules of names_well().
  template <class Record> detail::RecordPlace<S> place_of(const Record& record) const {
    const auto body = [&](BodyId id) { return id ? seen_.properties_of_body[id.slot] : nullptr; };
    const auto joint = [&](JointId id) { return id ? seen_.joint_at[id.slot].joint : nullptr; };
    const auto children_of = [&](std::uint32_t shape) { return std::span(state_.shapes[shape]->children); };
    return detail::place_of<S>(record, state_.settings, body, joint, children_of);
  }
  /// Returns true if bodies that move, or joints that hold something, lie in two sets.
  template <class Record> bool ties_islands(const Record& record) const {
    std::uint32_t set = Location::kNone;
    bool differ = false;
    const auto look = [&](std::uint32_t of) {
      differ = differ || (set != Location::kNone && set != of);
      set = of;
    };
    const detail::NamedBodies<S> bodies = detail::bodies_of(record);
    for (int i = 0; i < bodies.count; ++i) {
      const BodyId body = bodies.all[i].body;
      if (body && seen_.moves(body.slot)) look(seen_.set_of_body[body.slot]);
    }
    for (const JointId id : detail::joints_of(record).all) {
      if (!id) continue;
      const typename SlotTables<S>::JointAt& at = seen_.joint_at[id.slot];
      if (seen_.moves(at.joint->body_a) || seen_.moves(at.joint->body_b)) look(at.set);
    }
    return differ;
  }
  template <class Record, class IdType> static bool has_twins(const Registry<Record, IdType>& registry) {
    std::vector<detail::RecordKey> keys;
    for (std::uint32_t slot = 0; slot < registry.all().size(); ++slot) {
      if (registry.is_taken(slot)) keys.push_back(detail::RecordRules<Record>::key(registry.all()[slot]));
    }
    std::vector<detail::RecordKey> scratch(keys.size());
    const auto count = static_cast<std::uint32_t>(keys.size());
    stable_sort(keys.data(), scratch.data(), count, [](const detail::RecordKey& key) { return key.second; });
    stable_sort(keys.data(), scratch.data(), count, [](const detail::RecordKey& key) { return key.first; });
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i - 1] == keys[i]) return true;
    }
    return false;
  }
  /// Returns true if the second body of one record is the first of another.
  template <class Record> bool has_chain(const std::vector<Record>& all) const {
    std::vector<std::uint8_t> is_first(seen_.set_of_body.size(), 0);
    for (const Record& record : all) {
      if (const BodyId body = detail::first_body_of(record)) is_first[body.slot] = 1;
    }
    for (const Record& record : all) {
      const BodyId body = detail::second_body_of(record);
      if (body && is_first[body.slot] != 0) return true;
    }
    return false;
  }

  const WorldState<S>& state_;
  const SlotTables<S>& seen_;
};

}  // namespace isostep
