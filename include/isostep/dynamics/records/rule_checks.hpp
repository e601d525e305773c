// Rules of a record that contradict its members, or one another, do not compile.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <type_traits>

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/records/record_rules.hpp"

namespace isostep::detail {

template <class T> inline constexpr bool kIsId = false;
template <class Tag> inline constexpr bool kIsId<Id<Tag>> = true;

template <class T> constexpr int count_ids();
struct IdCounter {
  int* count;
  template <class T> constexpr void operator()(const char*, const T&) const { *count += count_ids<T>(); }
};
/// Counts the ids in a struct, with those in its structs and arrays.
template <class T> constexpr int count_ids() {
  int count = 0;
  if constexpr (kIsId<T>) count = 1;
  else if constexpr (std::is_bounded_array_v<T>) count = std::extent_v<T> * count_ids<std::remove_extent_t<T>>();
  else if constexpr (HasFields<T>) T::fields(IdCounter{&count}, T{});
  return count;
}

/// Compares the members of a record that have an id's type with those that its rules name, in the order of the members.
template <class IdType, class FieldOf> struct NameComparer {
  const FieldOf& field_of;  // (i): "" beyond the last
  int* met;
  bool* same;
  template <class T> constexpr void operator()(const char* name, const T&) const {
    if constexpr (std::is_same_v<T, IdType>) *same = *same && std::string_view(field_of((*met)++)) == name;
  }
};
template <class IdType, class Record, class FieldOf> constexpr bool names_members(int count, const FieldOf& field_of) {
  int met = 0;
  bool same = true;
  Record::fields(NameComparer<IdType, FieldOf>{field_of, &met, &same}, Record{});
  return same && met == count;
}

/// Returns true if a kind's rules name each member that is a BodyId in `bodies`: with those the record ends.
template <class Record> constexpr bool names_its_bodies() {
  using Rules = RecordRules<Record>;
  const auto nothing = [](int) { return ""; };
  if constexpr (requires(const Record& record) { Rules::bodies(record); }) {
    constexpr auto kNamed = Rules::bodies(Record{});
    return names_members<BodyId, Record>(kNamed.count,
                                         [&](int i) { return i < kNamed.count ? kNamed.all[i].field : ""; });
  } else {
    return names_members<BodyId, Record>(0, nothing);
  }
}
/// Returns true if `joints` does so for each JointId.
template <class Record> constexpr bool names_its_joints() {
  using Rules = RecordRules<Record>;
  const auto nothing = [](int) { return ""; };
  if constexpr (requires(const Record& record) { Rules::joints(record); }) {
    constexpr NamedJoints kNamed = Rules::joints(Record{});
    return names_members<JointId, Record>(kNamed.count, [&](int i) { return i < kNamed.count ? kNamed.field(i) : ""; });
  } else {
    return names_members<JointId, Record>(0, nothing);
  }
}
/// Returns true if a record has no other ids than those of bodies and joints as its own members: destroying other
/// things removes no record.
template <class Record> constexpr bool names_bodies_and_joints_alone() {
  int named = 0;
  const auto count = [&]<class T>(const char*, const T&) {
    named += std::is_same_v<T, BodyId> || std::is_same_v<T, JointId> ? 1 : 0;
  };
  Record::fields(count, Record{});
  return count_ids<Record>() == named;
}

/// Returns true if the rules have `only_one` and `key` together, or neither.
template <class Record> constexpr bool has_a_key_for_only_one() {
  using Rules = RecordRules<Record>;
  constexpr bool kKey = requires(const Record& record) { Rules::key(record); };
  constexpr bool kOnlyOne = requires(const Record& record) { Rules::only_one(record); };
  return kKey == kOnlyOne;
}

/// Stands for the Forces of rules in checks that do not call them.
struct NoForces;
/// Returns true if the rules of a kind have those functions of Acts that its kActs names, and no others.
template <class Record> constexpr bool acts_as_it_says() {
  using Rules = RecordRules<Record>;
  constexpr bool kPushes = requires(const Record& r, NoForces& f) { Rules::act(r, f); };
  constexpr bool kResists = requires(const Record& r, NoForces& f) { Rules::resist(r, f); };
  constexpr bool kSlows = requires(const Record& r, NoForces& f) { Rules::slow(r, f); };
  constexpr Acts kActs = Rules::kActs;
  return kPushes == pushes(kActs) && kResists == resists(kActs) && kSlows == (kActs == Acts::slows);
}

}  // namespace isostep::detail
