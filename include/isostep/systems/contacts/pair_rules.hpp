// PairRules<S>: which pairs of bodies do not touch in a step, by Ghost, KindGhost, OneWay and SensorMount records.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/kind_table.hpp"
#include "isostep/dynamics/records/one_way.hpp"
#include "isostep/store/body_map.hpp"

namespace isostep {

/// Input:   the state as a step begins, with the last step's contacts; the pairs of the broad phase, ascending.
/// Output:  pairs that do not touch in the step, ascending. Ghost records without those whose bodies are apart by now,
///          and with new ones for bodies that overlap a one-way body from the wrong side.
/// Order:   records end by slot, then begin by pair. Serial: few pairs meet a one-way body for the first time.
/// Keeps:   nothing from step to step but memory.
template <class S> class PairRules {
 public:
  ISO_INLINE PairRules(WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void update(std::span<const std::uint64_t> pairs);

  ISO_INLINE std::span<const std::uint64_t> apart() const { return apart_; }
  ISO_INLINE const Ways<S>& ways() const { return ways_; }
  ISO_INLINE const GhostTable<S>& kinds() const { return kinds_; }

 private:
  enum class Verdict {
    open,    // they have no contact: as they meet
    solid,   // as any two bodies
    nearby,  // from the wrong side, hardly deeper than they touch: no contact
    passes   // from the wrong side
  };
  /// The bodies of a pair, and their one-way records.
  struct Meeting {
    const BodyState<S>*a, *b;  // null: it does not move
    const Way<S>*way_a, *way_b;
  };
  void end_ghosts();
  bool still_meet(BodyId a, BodyId b) const;
  S skin_of(BodyId body) const;
  void add_kinds(std::span<const std::uint64_t> pairs);
  void add_mounts(std::span<const std::uint64_t> pairs);
  void judge_pairs(std::span<const std::uint64_t> pairs);
  bool may_judge(std::uint64_t key) const;
  Verdict judge(std::uint64_t key) const;
  bool is_in_front(const Meeting& pair, const Manifold<S>& manifold, Vec3<S> from_a_to_b) const;
  void begin_ghost(std::uint64_t key);
  void sort();

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Ways<S> ways_;
  GhostTable<S> kinds_;
  std::vector<std::uint64_t> apart_, scratch_;
  std::vector<std::uint32_t> ended_;  // slots of records
  std::vector<std::uint8_t> blind_;   // by body slot, where there are any: 1 of sensors on what is disabled
  std::size_t ghosts_ = 0;            // the first so many of apart_ are ghosts, ascending
};

#define ISO_PAIR_RULES_OF(extern, S) extern template class PairRules<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PAIR_RULES_OF)

}  // namespace isostep
