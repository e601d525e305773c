// RecordStore: the registries of all kinds of records, as a state holds them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/registry.hpp"
#include "isostep/dynamics/records/record_list.hpp"
#include "isostep/dynamics/records/rule_checks.hpp"

namespace isostep {

/// Holds the inputs and states of records, each by the slot of its record. Those of free slots are as new. A step
/// writes them, so every copy of a state has its own.
template <class S> struct RecordParts {
#define ISO_INPUT(name, Input, Id, S) std::vector<Input> name##_inputs;
  ISO_FOR_EACH_INPUT(ISO_INPUT, S)
#undef ISO_INPUT
#define ISO_STATE(name, State, Id, S) std::vector<State> name##_states;
  ISO_FOR_EACH_RECORD_STATE(ISO_STATE, S)
#undef ISO_STATE
};

namespace detail {
/// Returns the array of a kind's inputs or states, by the type of its ids. Kinds without them have no such call.
#define ISO_INPUT(name, Input, Id, S) \
  template <class Parts> ISO_INLINE auto& inputs_of(Parts& parts, Id) { return parts.name##_inputs; }
ISO_FOR_EACH_INPUT(ISO_INPUT, S)
#undef ISO_INPUT
#define ISO_STATE(name, State, Id, S) \
  template <class Parts> ISO_INLINE auto& states_of(Parts& parts, Id) { return parts.name##_states; }
ISO_FOR_EACH_RECORD_STATE(ISO_STATE, S)
#undef ISO_STATE
/// Calls visit(array) for the inputs and states that a kind has.
template <class IdType, class Parts, class Visit> ISO_INLINE void for_each_part(Parts& parts, const Visit& visit) {
  if constexpr (requires { inputs_of(parts, IdType{}); }) visit(inputs_of(parts, IdType{}));
  if constexpr (requires { states_of(parts, IdType{}); }) visit(states_of(parts, IdType{}));
}
/// Resets the parts of a slot in which a record begins or has ended.
template <class IdType, class S> ISO_INLINE void renew_parts(RecordParts<S>& parts, std::uint32_t slot) {
  for_each_part<IdType>(parts, [slot](auto& array) ISO_INLINE_LAMBDA {
    if (array.size() <= slot) array.resize(slot + 1);
    array[slot] = {};
  });
}
}  // namespace detail

/// Holds a registry of each kind. Copies share them until one changes: by a command, or by a step in which an explosion
/// ends, a ghost begins or ends, or a joint breaks.
template <class S> struct RecordStore {
#define ISO_REGISTRY(name, Record, Id, S) Registry<Record, Id> name##s;
  ISO_FOR_EACH_RECORD(ISO_REGISTRY, S)
#undef ISO_REGISTRY

  // These are as the compiler makes them, but in one place: inlined into every command that changes records they are
  // minutes of compiling.
  RecordStore();
  RecordStore(const RecordStore&);
  ~RecordStore();
  // These are inlined, so that no file that uses them has weak functions.
  ISO_INLINE RecordStore(RecordStore&&) = default;
  ISO_INLINE RecordStore& operator=(const RecordStore&) = default;
  ISO_INLINE RecordStore& operator=(RecordStore&&) = default;

  /// Calls visit("name", registry) in the order of the list.
  template <class Visitor, class Self> static ISO_INLINE void members(Visitor&& visit, Self&& self) {
#define ISO_VISIT(name, Record, Id, S) visit(#name "s", self.name##s);
    ISO_FOR_EACH_RECORD(ISO_VISIT, S)
#undef ISO_VISIT
  }
  /// Visits the kinds whose bits are set, and after each its inputs and states. The first kind has the lowest bit.
  template <class Visitor, class Self, class Parts>
  static ISO_INLINE void members_of(std::uint32_t kinds, Visitor&& visit, Self&& self, Parts& parts) {
#define ISO_VISIT(name, Record, Id, S)                          \
  if ((kinds & 1u) != 0) {                                      \
    visit(#name "s", self.name##s);                             \
    if constexpr (requires { detail::inputs_of(parts, Id{}); }) \
      visit(#name "_inputs", detail::inputs_of(parts, Id{}));   \
    if constexpr (requires { detail::states_of(parts, Id{}); }) \
      visit(#name "_states", detail::states_of(parts, Id{}));   \
  }                                                             \
  kinds >>= 1;
    ISO_FOR_EACH_RECORD(ISO_VISIT, S)
#undef ISO_VISIT
  }
#define ISO_COUNT(name, Record, Id, S) +1
  static constexpr std::uint32_t kKinds = 0 ISO_FOR_EACH_RECORD(ISO_COUNT, S);
#undef ISO_COUNT
  static_assert(kKinds < 32, "kinds() has a bit for each");
#define ISO_CHECK(name, Record, Id, S)                                                                               \
  static_assert(detail::names_its_bodies<Record>(), #name ": bodies() of its rules has to name each BodyId in it");  \
  static_assert(detail::names_its_joints<Record>(), #name ": joints() of its rules has to name each JointId in it"); \
  static_assert(detail::names_bodies_and_joints_alone<Record>(),                                                     \
                #name ": it names something else than bodies and joints, and would outlive it");                     \
  static_assert(detail::has_a_key_for_only_one<Record>(), #name ": its rules have only_one() or key() alone");       \
  static_assert(detail::acts_as_it_says<Record>(), #name ": its rules have other functions than their kActs says");
  ISO_FOR_EACH_RECORD(ISO_CHECK, S)
#undef ISO_CHECK
  /// Returns the bits of kinds of which one was ever added. A state hashes and writes nothing of the others.
  ISO_INLINE std::uint32_t kinds() const {
    std::uint32_t kinds = 0, bit = 1;
#define ISO_BIT(name, Record, Id, S)                            \
  kinds |= name##s.slot_map().entries().size() == 0 ? 0u : bit; \
  bit <<= 1;
    ISO_FOR_EACH_RECORD(ISO_BIT, S)
#undef ISO_BIT
    return kinds;
  }
};

namespace detail {
/// Returns the registry of an id's type.
#define ISO_REGISTRY(name, Record, Id, S) \
  template <class Records> ISO_INLINE auto& registry_of(Records& records, Id) { return records.name##s; }
ISO_FOR_EACH_RECORD(ISO_REGISTRY, S)
#undef ISO_REGISTRY
/// The id of a kind of record, or of its input.
template <class Record> struct RecordIdOf;
#define ISO_ID_OF(name, Record, Id, S) \
  template <class S> struct RecordIdOf<Record> { using Type = Id; };
ISO_FOR_EACH_RECORD(ISO_ID_OF, S)
ISO_FOR_EACH_INPUT(ISO_ID_OF, S)
#undef ISO_ID_OF

/// Returns the record on that axis of a joint. Null if there is none.
template <class S> AxisDriveId drive_on(const RecordStore<S>& records, JointId joint, JointAxis axis) {
  return records.axis_drives.id_where(
      [&](const AxisDrive<S>& drive) { return drive.joint == joint && drive.axis == axis; });
}
}  // namespace detail

}  // namespace isostep
