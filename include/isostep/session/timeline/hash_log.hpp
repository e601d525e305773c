// HashLog: the hashes of the states that were reached, and the hash chain of those that are final.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// A state and its history: `chain` is the hash chain of all states up to `frame`, so a divergence that heals is still
/// detected.
struct HashReport {
  Frame frame = kNoFrame;
  std::uint64_t chain = 0;
};

/// A ring of state hashes. A hash arrives when its state is saved, is forgotten when a rollback makes the state again,
/// and is chained once final: chain f combines chain f - 1 and hash f, so one chain covers all states before it.
class HashLog {
 public:
  explicit HashLog(Frame capacity);

  /// Begins with the final state `start.frame` and its hash. Earlier states are known by the hash chain alone.
  void restart(const HashReport& start, std::uint64_t hash);
  void report(Frame state, std::uint64_t hash);
  void forget_from(Frame state);
  /// Chains the next state, if it is not beyond `limit`. Returns false if it is, or if its hash is not there yet.
  bool settle_next(Frame limit);

  /// The newest final state; kNoFrame before the first.
  HashReport settled() const { return settled_; }
  /// Returns true if the final state is kept. Newer hashes, final or not, take the places of the oldest.
  bool has_chain(Frame state) const {
    return state >= oldest_ && state <= settled_.frame && entries_[slot(state)].state == state;
  }
  std::uint64_t chain(Frame state) const { return entries_[slot(state)].chain; }
  /// Returns the hash of a final state that is kept.
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
