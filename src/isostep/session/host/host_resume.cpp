// A host that goes on with a saved match: from its state, with its seats, and when all of its players are back.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/host_core.hpp"

namespace isostep {

HostCore::HostCore(const SessionConfig& config, const InputRules& rules, SavedMatch&& saved) : HostCore(config, rules) {
  seats_.resume(saved);
  numbers_ = SecretNumbers(config.seed, saved.term + 1);
  match_ = numbers_.match();
  leadership_.resume(saved.term + 1);
  know_ourselves();
  resumed_ = saved.start;
  resumed_hash_ = saved.hash;
  control_.tempo_desk().resume_with(saved.speed);
  portable_ = std::move(saved.state);
  timeline_.restart(resumed_.frame);
  for (InputStream& stream : streams_) stream.reset(resumed_.frame);
}

void HostCore::ask_start() {
  if (!is_resumed()) {
    PeerCore::ask_start();
    return;
  }
  act(RequestKind::restore, resumed_.frame);
  act(RequestKind::save, resumed_.frame);
}

void HostCore::restored(bool ok) {
  if (ok || has_start_) return;
  phase_ = SessionPhase::refused;
  SessionEvent event{.kind = SessionEvent::Kind::bad_snapshot};
  event.frame = resumed_.frame;
  tell(event);
}

void HostCore::hash_known(Frame state, std::uint64_t hash) {
  if (!is_resumed() || has_start_) {
    PeerCore::hash_known(state, hash);
    return;
  }
  if (phase_ == SessionPhase::refused) return;
  if (hash != resumed_hash_) {
    restored(false);
    return;
  }
  has_start_ = true;
  hashes_.restart(resumed_, hash);
  confirmed_state_ = resumed_.frame;
}

/// Of a match that goes on only who has its state counts: until then nobody plays, and nobody is missed.
bool HostCore::all_are_here() const {
  for (int p = 0; p < players(); ++p) {
    const Seat& seat = seats_[p];
    if (is_local(p) || (!is_resumed() && seat.is_taken)) continue;
    const Guest* const guest = guests_.on(seat);
    if (guest == nullptr || !guest->is_live()) return false;
  }
  return true;
}

std::optional<SavedMatch> HostCore::save_match() const {
  if (!started_ || !has_start_) return std::nullopt;
  SavedMatch saved;
  saved.identity = config_.identity;
  saved.start = hashes_.settled();
  saved.hash = hashes_.hash(saved.start.frame);
  saved.hosted = seats_.hosted();
  saved.speed = tempos_.announced().speed;
  saved.term = leadership_.tenure().term();
  saved.players = static_cast<std::uint8_t>(players());
  for (int p = 0; p < players(); ++p) saved.proofs[p] = is_local(p) || !seats_[p].is_kept ? 0 : seats_[p].proof;
  return saved;
}

}  // namespace isostep
