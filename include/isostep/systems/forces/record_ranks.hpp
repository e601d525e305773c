// RecordRanks<Record>: the records of a kind with priorities, from the lowest to the highest.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/registry.hpp"

namespace isostep {

/// Input:   the registry of a kind as a step begins; in its sub-steps the same records.
/// Output:  their order, ascending by (priority, slot), and whether a higher one hides what a lower one does.
/// Keeps:   nothing from step to step but memory.
template <class Record> class RecordRanks {
 public:
  template <class IdType> void rank(const Registry<Record, IdType>& registry);
  /// Calls visit(record), the lowest first.
  template <class Visit> void for_each(const std::vector<Record>& all, const Visit& visit) const {
    for (const std::uint64_t rank : ranks_) visit(at(all, rank));
  }
  /// Calls visit(record), the highest first.
  template <class Visit> void for_each_down(const std::vector<Record>& all, const Visit& visit) const {
    for (std::size_t i = ranks_.size(); i-- > 0;) visit(at(all, ranks_[i]));
  }
  /// A record of a higher priority hides(record).
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
