// HashLog's ring and hash chain.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/hash_log.hpp"

#include "isostep/state/hash.hpp"

namespace isostep {

HashLog::HashLog(Frame capacity) : entries_(static_cast<std::size_t>(capacity)) {}

void HashLog::restart(const HashReport& start, std::uint64_t hash) {
  for (Entry& entry : entries_) entry = {};
  entries_[slot(start.frame)] = {start.frame, hash, start.chain};
  oldest_ = newest_ = start.frame;
  settled_ = start;
}

void HashLog::report(Frame state, std::uint64_t hash) {
  if (state <= settled_.frame) return;
  Entry& entry = entries_[slot(state)];
  entry.state = state;
  entry.hash = hash;
  if (newest_ < state) newest_ = state;
}

void HashLog::forget_from(Frame state) {
  if (state <= settled_.frame) state = settled_.frame + 1;
  for (; newest_ >= state; --newest_) entries_[slot(newest_)].state = kNoFrame;
}

bool HashLog::settle_next(Frame limit) {
  const Frame next = settled_.frame + 1;
  Entry& entry = entries_[slot(next)];
  if (next > limit || entry.state != next) return false;
  HashCombiner chain;
  chain.add(settled_.chain);
  chain.add(entry.hash);
  entry.chain = chain.value();
  settled_ = {next, entry.chain};
  const Frame kept = next - static_cast<Frame>(entries_.size()) + 1;
  if (oldest_ < kept) oldest_ = kept;
  return true;
}

}  // namespace isostep
