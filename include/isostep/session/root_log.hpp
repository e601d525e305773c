// RootLog: the roots of the states that were reached, and the chain of those that are final.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/packet.hpp"

namespace isostep {

/// A ring over states. Roots arrive as states are saved, are forgotten when a rollback makes the state anew, and are
/// chained once final: chain f = hash(chain f - 1, root f), so one chain vouches for all states before it.
class RootLog {
 public:
  explicit RootLog(Frame capacity);

  /// State `start.frame` is final, with this root; what was before is known by the chain alone.
  void restart(const RootReport& start, std::uint64_t root);
  void report(Frame state, std::uint64_t root);
  void forget_from(Frame state);
  /// Chains one state more, up to `limit`; false when its root is not there yet.
  bool settle_next(Frame limit);

  /// The newest final state; kNoFrame before the first.
  RootReport settled() const { return settled_; }
  /// A final state that is kept: newer roots, final or not, take the places of the oldest.
  bool has_chain(Frame state) const {
    return state >= oldest_ && state <= settled_.frame && entries_[slot(state)].state == state;
  }
  std::uint64_t chain(Frame state) const { return entries_[slot(state)].chain; }
  /// Of a final state that is kept.
  std::uint64_t root(Frame state) const { return entries_[slot(state)].root; }

 private:
  struct Entry {
    Frame state = kNoFrame;  // whose root this is
    std::uint64_t root = 0, chain = 0;
  };
  std::size_t slot(Frame state) const { return static_cast<std::size_t>(state) % entries_.size(); }

  std::vector<Entry> entries_;
  Frame oldest_ = 0, newest_ = kNoFrame;  // whose root is kept, or reported
  RootReport settled_;
};

}  // namespace isostep
