// What all sessions share: the list of requests, and the queues to the caller.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/session_core.hpp"

namespace isostep {
SessionCore::SessionCore(const SessionConfig& config, const InputRules& rules)
    : config_(config),
      rules_(rules),
      timeline_(config.players, config.kept, rules),
      confirmed_(static_cast<std::size_t>(config.kept)) {
  actions_.reserve(static_cast<std::size_t>(config.kept) * 4 + 16);
}
SessionCore::~SessionCore() = default;

std::span<const SessionAction> SessionCore::advance(Time now) {
  const bool is_lost = undone_ != 0 && awaits_capture();
  is_capturing_ = false;
  if (is_lost) capture_lost();
  if (undone_ != 0) {
    undone_ = 0;
    misused();
    SessionEvent event{.kind = SessionEvent::Kind::misuse};
    tell(event);
  }
  stats_.events_lost = events_.lost();
  actions_.clear();
  plan(now);
  return actions_;
}

void SessionCore::saved(Frame state, std::uint64_t hash) {
  undone_ -= undone_ > 0 ? 1 : 0;
  hash_known(state, hash);
}

std::optional<SessionEvent> SessionCore::poll_event() {
  stats_.events_lost = events_.lost();
  return events_.poll();
}

void SessionCore::confirm(Frame state, std::uint64_t hash) {
  confirmed_state_ = state;
  if (state <= told_state_) return;  // a snapshot may lie before what was told
  told_state_ = state;
  confirmed_.push({state - 1, hash});
}

std::optional<SessionCore::Confirmed> SessionCore::poll_confirmed() {
  if (confirmed_.empty()) return std::nullopt;
  return confirmed_.pop();
}

}  // namespace isostep
