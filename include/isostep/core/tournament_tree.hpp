// TournamentTree: the first of many by an order that changes, at O(log n) a change.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Players 0..count-1 meet in pairs, the winners in pairs, and so on. `before(i, j)` is a strict total order of
/// players, so the result depends on who plays, not on the order in which they changed.
class TournamentTree {
 public:
  /// Lets all meet anew.
  template <class Before> ISO_INLINE void plant(std::uint32_t count, const Before& before) {
    count_ = count;
    if (winner_.size() < 2 * std::size_t{count}) winner_.resize(2 * std::size_t{count});
    for (std::uint32_t i = 0; i < count; ++i) winner_[std::size_t{count} + i] = i;
    for (std::size_t n = count; --n > 0;) {
      const std::uint32_t left = winner_[2 * n], right = winner_[2 * n + 1];
      winner_[n] = before(left, right) ? left : right;
    }
  }
  /// Handles a change of one player.
  template <class Before> ISO_INLINE void replay(std::uint32_t index, const Before& before) {
    for (std::size_t n = (std::size_t{count_} + index) / 2; n > 0; n /= 2) {
      const std::uint32_t left = winner_[2 * n], right = winner_[2 * n + 1];
      const std::uint32_t best = before(left, right) ? left : right;
      if (best == winner_[n] && best != index) return;  // it lost here before and loses again
      winner_[n] = best;
    }
  }
  /// Returns the index of the winner. There is at least one.
  ISO_INLINE std::uint32_t first() const { return winner_[1]; }

 private:
  std::vector<std::uint32_t> winner_;  // winner_[n] of winner_[2 n] and winner_[2 n + 1]; leaves from count_ on
  std::uint32_t count_ = 0;
};

}  // namespace isostep
