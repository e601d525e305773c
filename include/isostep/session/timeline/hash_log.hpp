// HashLog: the hashes of the states that were reached, and the hash chain of those that are final.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// A state's place in a player's history: `chain` is the hash chain of all states up to `frame`, so a divergence that
/// heals is still seen.
struct HashReport {
  Frame frame = kNoFrame;
  std::uint64_t chain = 0;
};

/// A ring over states. Hashes arrive as states are saved, are forgotten when a rollback makes the state anew, and are
/// chained once final: chain f combines chain f - 1 and hash f, so one chain vouches for all states before it.
class HashLog {
 public:
  explicit HashLog(Frame capacity);

  /// State `start.frame` is final, with this hash; what was before is known by the hash chain alone.
  void restart(const HashReport& start, std::uint64_t hash);
  void report(Frame state, std::uint64_t hash);
  void forget_from(Frame state);
  /// Chains one state more, up to `limit`; false when its hash is not there yet.
  bool settle_next(Frame limit);

  /// The newest final state; kNoFrame before the first.
  HashReport settled() const { return settled_; }
  /// A final state that is kept: newer hashes, final or not, take the places of the oldest.
  bool has_chain(Frame state) const {
    return state >= oldest_ && state <= settled_.frame && entries_[slot(state)].state == state;
  }
  std::uint64_t chain(Frame state) const { return entries_[slot(state)].chain; }
  /// Of a final state that is kept.
  std::uint64_t hash(Frame state) const { return entries_[slot(state)].hash; }

 private:
  struct Entry {
    Frame state = kNoFrame;  // whose hash this is
    std::uint64_t hash = 0, chain = 0;
  };
  std::size_t slot(Frame state) const { return static_cast<std::size_t>(state) % entries_.size(); }

  std::vector<Entry> entries_;
  Frame oldest_ = 0, newest_ = kNoFrame;  // whose hash is kept, or reported
  HashReport settled_;
};

}  // namespace isostep
