// Which bodies pass each other by records.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/store/body_map.hpp"

namespace isostep {

/// Returns true if two bodies pass each other by a Ghost or a KindGhost. Searches all these records: for single pairs.
template <class S>
bool are_ghosts(const WorldState<S>& state, const BodyMap<S>& map, std::uint32_t a, std::uint32_t b) {
  const RecordStore<S>& records = *state.records;
  const auto is_of_both = [&](const Ghost<S>& ghost) {
    return (ghost.a.slot == a && ghost.b.slot == b) || (ghost.a.slot == b && ghost.b.slot == a);
  };
  if (records.ghosts.id_where(is_of_both)) return true;
  const auto kind_of = [&](std::uint32_t slot) { return map.properties_at(map.location(slot)).material.kind; };
  const std::uint64_t kinds = kinds_key(kind_of(a), kind_of(b));
  const auto is_of_kinds = [&](const KindGhost<S>& ghost) { return kinds_key(ghost.kind_a, ghost.kind_b) == kinds; };
  return static_cast<bool>(records.kind_ghosts.id_where(is_of_kinds));
}

}  // namespace isostep
