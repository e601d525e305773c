// PartialState<S>: the affected bodies of a state as a state of their own, and its step joined with the known one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/world/resimulation/affected_bodies.hpp"

namespace isostep {

/// Input:   a state and its affected bodies; then that state's step of those alone, and the known step of all.
/// Output:  the state of the affected bodies, with everything that does not move and with all kinematic bodies, which
///          others never push; then the state after the step of all.
/// Keeps:   nothing from call to call but memory.
/// Rule:    what names an affected body comes from the new step, everything else from the known one.
template <class S> class PartialState {
 public:
  ISO_INLINE PartialState(const WorldState<S>& now, const BodyMap<S>& map, const AffectedBodies<S>& affected)
      : now_(now), map_(map), affected_(affected) {}

  /// Fills `part`, and returns the number of its bodies that may move.
  std::size_t take(WorldState<S>& part);
  /// Returns false if the step of the part, from `part` as `take` left it to `stepped`, and the known one are no step
  /// of all: one changed what both depend on, or they put to sleep or woke what the other has.
  bool fit(const WorldState<S>& part, const WorldState<S>& stepped, const WorldState<S>& old_before,
           const WorldState<S>& old_after) const;
  /// Makes the state after the known step that after the step of all. They fit.
  void join(const WorldState<S>& stepped, const WorldState<S>& old_before, WorldState<S>& after);

 private:
  bool is_absent(std::uint32_t slot) const { return slot != kNoBody && absent_[slot] != 0; }
  void take_records(WorldState<S>& part) const;
  template <class Record> bool names_absent(const Record& record) const;
  template <class Record> bool names_affected(const Record& record) const;

  bool changed_ground(const WorldState<S>& part, const WorldState<S>& stepped, const WorldState<S>& old_before,
                      const WorldState<S>& old_after) const;
  bool sleepers_fit(const WorldState<S>& stepped, const WorldState<S>& old_before,
                    const WorldState<S>& old_after) const;
  bool are_affected(const SleepingIslands<S>& a, const SleepingIslands<S>& b, bool expected) const;
  bool same_unaffected(const BodySet<S>& stepped, const BodySet<S>& old) const;
  void join_records(const WorldState<S>& stepped, WorldState<S>& after) const;

  const WorldState<S>& now_;
  const BodyMap<S>& map_;
  const AffectedBodies<S>& affected_;
  std::vector<std::uint8_t> absent_;  // by slot: dynamic bodies that are awake and not affected
  WorldState<S> scratch_;             // its lists alone
};

#define ISO_PARTIAL_STATE_OF(extern, S) extern template class PartialState<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTIAL_STATE_OF)

}  // namespace isostep
