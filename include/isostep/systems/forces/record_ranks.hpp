// RecordRanks<Record>: the records of a kind with priorities, from the lowest to the highest.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/registry.hpp"

namespace isostep {

/// Input:   the registry of a kind as a step begins; the same records in its sub-steps.
/// Output:  their order, ascending by (priority, slot), and whether a higher record hides the effect of a lower one.
/// Keeps:   nothing from step to step but memory.
template <class Record> class RecordRanks {
 public:
  template <class IdType> void rank(const Registry<Record, IdType>& registry);
  /// Calls visit(record) from the lowest priority to the highest.
  template <class Visit> void for_each(const std::vector<Record>& all, const Visit& visit) const {
    for (const std::uint64_t rank : ranks_) visit(at(all, rank));
  }
  /// Calls visit(record) from the highest priority to the lowest.
  template <class Visit> void for_each_down(const std::vector<Record>& all, const Visit& visit) const {
    for (std::size_t i = ranks_.size(); i-- > 0;) visit(at(all, ranks_[i]));
  }
  /// Returns true if hides(record) holds for a record of higher priority.
  template <class Hides>
  bool is_hidden(const std::vector<Record>& all, std::int32_t priority, const Hides& hides) const {
    for (std::size_t i = ranks_.size(); i-- > 0;) {
      const Record& record = at(all, ranks_[i]);
      if (record.priority <= priority) return false;
      if (hides(record)) return true;
    }
    return false;
  }
  ISO_INLINE std::size_t size() const { return ranks_.size(); }

 private:
  static ISO_INLINE const Record& at(const std::vector<Record>& all, std::uint64_t rank) {
    return all[rank & 0xffffffffu];
  }

  std::vector<std::uint64_t> ranks_, scratch_;
};

}  // namespace isostep
