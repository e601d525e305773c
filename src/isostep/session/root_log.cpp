// RootLog's ring and chain.
// SPDX-License-Identifier: MIT
#include "isostep/session/root_log.hpp"

#include "isostep/state/hash.hpp"

namespace isostep {

RootLog::RootLog(Frame capacity) : entries_(static_cast<std::size_t>(capacity)) {}

void RootLog::restart(const RootReport& start, std::uint64_t root) {
  for (Entry& entry : entries_) entry = {};
  entries_[slot(start.frame)] = {start.frame, root, start.chain};
  oldest_ = newest_ = start.frame;
  settled_ = start;
}

void RootLog::report(Frame state, std::uint64_t root) {
  if (state <= settled_.frame) return;
  Entry& entry = entries_[slot(state)];
  entry.state = state;
  entry.root = root;
  if (newest_ < state) newest_ = state;
}

void RootLog::forget_from(Frame state) {
  if (state <= settled_.frame) state = settled_.frame + 1;
  for (; newest_ >= state; --newest_) entries_[slot(newest_)].state = kNoFrame;
}

bool RootLog::settle_next(Frame limit) {
  const Frame next = settled_.frame + 1;
  Entry& entry = entries_[slot(next)];
  if (next > limit || entry.state != next) return false;
  HashCombiner chain;
  chain.add(settled_.chain);
  chain.add(entry.root);
  entry.chain = chain.value();
  settled_ = {next, entry.chain};
  const Frame kept = next - static_cast<Frame>(entries_.size()) + 1;
  if (oldest_ < kept) oldest_ = kept;
  return true;
}

}  // namespace isostep
