// KindTable: finds the record of two kinds of material.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/lower_bound.hpp"
#include "isostep/core/registry.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/records/kind_ghost.hpp"
#include "isostep/dynamics/records/kind_response.hpp"
#include "isostep/dynamics/records/material_pair.hpp"

namespace isostep {

/// A table of records by pairs of kinds, ascending, for one step. Keeps nothing from step to step but memory.
template <class Record, class IdType> class KindTable {
 public:
  /// Builds the table. The records must stay where they are until the next call.
  ISO_INLINE void update(const Registry<Record, IdType>& pairs) {
    rows_.clear();
    records_ = pairs.all().data();
    for (std::uint32_t slot = 0; slot < pairs.all().size(); ++slot) {
      if (pairs.is_taken(slot)) rows_.push_back({kinds_key(records_[slot].kind_a, records_[slot].kind_b), slot});
    }
    if (rows_.empty()) return;
    scratch_.resize(rows_.size());
    stable_sort(rows_.data(), scratch_.data(), static_cast<std::uint32_t>(rows_.size()), Key{});
  }
  ISO_INLINE bool empty() const { return rows_.empty(); }
  /// Returns the record of two kinds. Null if there is none, and for kind 0.
  ISO_INLINE const Record* find(std::uint32_t kind_a, std::uint32_t kind_b) const {
    if (rows_.empty() || kind_a == 0 || kind_b == 0) return nullptr;
    const std::uint64_t key = kinds_key(kind_a, kind_b);
    const std::size_t at =
        lower_bound(rows_.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return rows_[i].kinds < key; });
    return at < rows_.size() && rows_[at].kinds == key ? &records_[rows_[at].slot] : nullptr;
  }

 private:
  struct Row {
    std::uint64_t kinds;
    std::uint32_t slot;
  };
  struct Key {
    ISO_INLINE constexpr std::uint64_t operator()(const Row& row) const { return row.kinds; }
  };

  std::vector<Row> rows_, scratch_;
  const Record* records_ = nullptr;
};

template <class S> using MaterialTable = KindTable<MaterialPair<S>, MaterialPairId>;
template <class S> using GhostTable = KindTable<KindGhost<S>, KindGhostId>;
template <class S> using ResponseTable = KindTable<KindResponse<S>, KindResponseId>;

}  // namespace isostep
