// What all sessions share: the list of requests, and the queues to the caller.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/session_core.hpp"

namespace isostep {
namespace {
// Between two polls: a refusal of every connection that the defaults allow for, and as many of the match.
constexpr std::size_t kEvents = 128;
}  // namespace

SessionCore::SessionCore(const SessionConfig& config, const InputRules& rules)
    : config_(config),
      rules_(rules),
      timeline_(config.players, config.kept, rules),
      events_(kEvents),
      confirmed_(static_cast<std::size_t>(config.kept)) {
  actions_.reserve(static_cast<std::size_t>(config.kept) * 4 + 16);
}
SessionCore::~SessionCore() = default;

std::span<const SessionAction> SessionCore::advance(Time now) {
  const bool is_lost = unsaved_ != 0 && awaits_capture();
  is_capturing_ = false;
  if (is_lost) capture_lost();
  if (unsaved_ != 0) {
    unsaved_ = 0;
    misused();
    SessionEvent event{.kind = SessionEvent::Kind::misuse};
    tell(event);
  }
  actions_.clear();
  plan(now);
  return actions_;
}

void SessionCore::saved(Frame state, std::uint64_t hash) {
  if (unsaved_ > 0) --unsaved_;
  hash_known(state, hash);
}

void SessionCore::tell(const SessionEvent& event) {
  events_.push(event);
  stats_.events_lost = events_.lost();
}

std::optional<SessionEvent> SessionCore::poll_event() {
  if (events_.empty()) return std::nullopt;
  return events_.pop();
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
