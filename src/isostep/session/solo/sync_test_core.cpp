// The sync test: late inputs, and every frame twice.
// SPDX-License-Identifier: MIT
#include "isostep/session/solo/sync_test_core.hpp"

namespace isostep {

SyncTestCore::SyncTestCore(const SessionConfig& config, const InputRules& rules)
    : SessionCore(config, rules),
      clock_(config.hz),
      said_(static_cast<std::size_t>(config.players), InputStream(config.history, rules.cap)),
      known_(said_),
      hashes_(static_cast<std::size_t>(config.kept)) {}

bool SyncTestCore::add_local_input(int player, Bytes input) {
  if (!wants_input(player) || !rules_.valid(input)) return false;
  return said_[static_cast<std::size_t>(player)].append({false, input});
}

bool SyncTestCore::wants_input(int player) const {
  return player >= 0 && player < players() && said_[static_cast<std::size_t>(player)].end() <= current();
}

void SyncTestCore::step_from(Frame frame, Frame end, bool as_confirmed) {
  if (frame < end) act(RequestKind::load, frame);
  for (; frame < end; ++frame) {
    act(RequestKind::step, frame, as_confirmed);
    act(RequestKind::save, frame + 1);
  }
}

void SyncTestCore::plan(Time now) {
  if (!asked_start_) {
    asked_start_ = true;
    clock_.start(now);
    phase_ = SessionPhase::playing;
    act(RequestKind::save, 0);
    return;
  }
  if (!clock_.is_due(now)) return;
  const Frame frame = current();
  for (InputStream& said : said_) {
    if (said.end() <= frame) said.append({false, Bytes(rules_.neutral, rules_.neutral_size)});
  }
  const Frame told = frame - config_.window;
  for (int p = 0; p < players() && told >= 0; ++p) {
    const auto i = static_cast<std::size_t>(p);
    known_[i].append(said_[i].at(told));
  }
  const Frame wrong = timeline_.first_wrong(known_);
  if (wrong < frame) {
    ++stats_.rollbacks[frame - wrong < 64 ? frame - wrong : 64];
    timeline_.step_again(wrong, known_);
    for (Frame state = wrong + 1; state <= frame; ++state) hash_of(state).state = kNoFrame;
    step_from(wrong, frame, false);
  }
  timeline_.step(known_);
  act(RequestKind::step, frame);
  act(RequestKind::save, frame + 1);
  step_from(frame + 1 > config_.window ? frame + 1 - config_.window : 0, frame + 1, true);
  act(RequestKind::probe, frame + 1);
  clock_.stepped(now);
  limit_ = known_[0].end();
}

void SyncTestCore::unhashed(Frame state, std::size_t byte) {
  if (unhashed_) return;  // one byte a session: there will be more of the same
  unhashed_ = true;
  SessionEvent event{.kind = SessionEvent::Kind::unhashed};
  event.frame = state;
  event.ours = byte;
  tell(event);
}

void SyncTestCore::hash_known(Frame state, std::uint64_t hash) {
  StateHash& known = hash_of(state);
  if (known.state == state && known.hash != hash && !differs_) {
    differs_ = true;  // what follows from it need not be told
    SessionEvent event{.kind = SessionEvent::Kind::desync};
    event.frame = state;
    event.agreed = state - 1;
    event.ours = hash;
    event.theirs = known.hash;
    tell(event);
  }
  known = {state, hash};
  if (state != current()) return;  // the last of this call's hashes
  for (; settled_ < limit_; ++settled_) confirm(settled_ + 1, hash_of(settled_ + 1).hash);
}

}  // namespace isostep
