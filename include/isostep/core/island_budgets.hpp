// IslandBudgets: the iterations and looks that a solver has left for each island, whatever others cost.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/disjoint_sets.hpp"

namespace isostep {

/// Rows that share a moving member make an island. A solver with a limit must stop in each island where it would if
/// there were no other: a world's order, and what else is in it, must not affect an island's future.
class IslandBudgets {
 public:
  static constexpr std::uint32_t kNobody = 0xffffffffu;
  struct Ends {
    std::uint32_t a, b;  // of 0..members-1, or kNobody
  };
  struct Budget {
    std::uint32_t first_row;  // the least; next_of() leads on
    std::uint32_t rows;
    std::uint32_t iterations;  // left
    std::uint64_t looks;       // left
  };

  /// Finds the islands; `ends_of(row)` returns whom a row moves. A row that moves nobody is an island by itself.
  template <class EndsOf> ISO_INLINE void find(std::uint32_t members, std::uint32_t rows, const EndsOf& ends_of) {
    sets_.begin(members);
    of_member_.assign(members, kNobody);
    of_row_.resize(rows);
    next_.resize(rows);
    budgets_.clear();
    for (std::uint32_t row = 0; row < rows; ++row) {
      const Ends ends = ends_of(row);
      if (ends.a != kNobody && ends.b != kNobody) sets_.join(ends.a, ends.b);
    }
    for (std::uint32_t row = rows; row-- > 0;) {
      const Ends ends = ends_of(row);
      const std::uint32_t member = ends.a != kNobody ? ends.a : ends.b;
      std::uint32_t own = kNobody;
      std::uint32_t& budget = member != kNobody ? of_member_[sets_.find(member)] : own;
      if (budget == kNobody) {
        budget = static_cast<std::uint32_t>(budgets_.size());
        budgets_.push_back({kNobody, 0, 0, 0});
      }
      of_row_[row] = budget;
      Budget& of = budgets_[budget];
      next_[row] = of.first_row;
      of.first_row = row;
      ++of.rows;
    }
  }
  /// Fills the budgets; put(budget) sets what may be spent on the budget's rows.
  template <class Put> ISO_INLINE void fill(const Put& put) {
    for (Budget& budget : budgets_) put(budget);
  }

  ISO_INLINE Budget& budget_of(std::uint32_t row) { return budgets_[of_row_[row]]; }
  /// Returns the next row of its island, ascending; kNobody after the last.
  ISO_INLINE std::uint32_t next_of(std::uint32_t row) const { return next_[row]; }

 private:
  DisjointSets sets_;
  std::vector<std::uint32_t> of_member_;  // budget, by root
  std::vector<std::uint32_t> of_row_;     // budget
  std::vector<std::uint32_t> next_;       // row of the same island
  std::vector<Budget> budgets_;
};

}  // namespace isostep
