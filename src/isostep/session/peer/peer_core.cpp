// Prediction and rollback: what host and client do alike in a turn.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/peer_core.hpp"

#include "isostep/session/peer/reach.hpp"

namespace isostep {
namespace {

constexpr int kMostSteps = 6;       // while catching up
constexpr Frame kSlackBucket = 30;  // [frames] of time
constexpr Time kAsk = 1000;         // [us] until a caller that waits for the network should look again

}  // namespace

PeerCore::PeerCore(const SessionConfig& config, const InputRules& rules)
    : SessionCore(config, rules),
      streams_(static_cast<std::size_t>(config.players), InputStream(config.history, rules.cap)),
      hashes_(config.history),
      clock_(config.hz),
      pace_(clock_.period()),
      delay_(delay_settings(config)),
      thrift_(window_of(config) / 2) {
  message_.reserve(kReliableCap);
}

bool PeerCore::add_local_input(int player, Bytes input) {
  if (player < 0 || player >= players() || !is_local(player)) return false;
  if (input.size() > rules_.cap || !rules_.valid(input)) return false;
  inputs_.set(player, input);
  return true;
}

bool PeerCore::wants_input(int player) const {
  return player >= 0 && player < players() && is_local(player) && !inputs_.has(player);
}

Time PeerCore::wait(Time now) const {
  if (!running() || is_paused()) return 10 * kAsk;
  const Time until = clock_.until_due(now);
  return until > 0 ? until : is_blocked_ ? kAsk : 0;
}

Frame PeerCore::final_limit() const {
  const Frame known = known_end(streams_);
  return known < current() ? known : current();
}

void PeerCore::plan(Time now) {
  const bool was_away = is_after_pause(now);
  turns_.begin(now);
  if (was_away && running()) {
    paused(now);
    if (turns_.forgives(now)) delay_.disregard();
  }
  if (running()) follow_tempo(now);
  pace_.begin(now, running() && clock_.is_due(now), was_away || is_blocked_ || is_paused());
  if (!asked_start_) {
    asked_start_ = true;
    ask_start();
    return;
  }
  if (!has_start_) return;
  before_steps(now);
  if (!running()) return;
  Frame wrong = timeline_.first_wrong(streams_);
  if (is_misused_ && hashes_.settled().frame < wrong) wrong = hashes_.settled().frame;
  is_misused_ = false;
  if (wrong < current()) roll_back(wrong);
  // By the clock and not by frames: a match that waits at every one of them is what a longer delay is for.
  if (now >= next_observation_ && !is_paused()) observe(now);
  step_due(now);
  after_steps();
  limit_ = final_limit();
  settle();
  for (std::size_t m = 0; m < kMachines; ++m) tell(views_.compare(m, hashes_));
  stats_.delay = delay_.frames();
}

void PeerCore::observe(Time now) {
  next_observation_ = now + clock_.period();
  const bool is_too_slow = pace_.stretch() > 0 || (stats_.stretch > 0 && pace_.is_dear());
  thrift_.observe(stats_.steps, fresh_, is_too_slow, now);
  observe_delay();
  for (int p = 0; p < players(); ++p) {
    slack_[p].tick(kSlackBucket);
    stats_.players[p].early = early(p);
  }
}

void PeerCore::step_due(Time now) {
  const int most = pace_.most_steps(kMostSteps);
  int steps = 0;
  for (; steps < most && (clock_.is_due(now) || hurries(now) || (steps == 1 && pace_.probes())); ++steps) {
    follow_tempo(now);
    if (is_paused() || (steps >= kDueSteps && !hurries(now))) break;
    for (int p = 0; p < players(); ++p) {
      if (is_local(p)) inputs_.fill(p, streams_[static_cast<std::size_t>(p)], present() + delay_.frames() + 1, rules_);
    }
    before_frame(now);
    const Frame frame = current();
    const bool has_room = frame < kLastFrame && frame - hashes_.settled().frame < config_.kept - 2;
    if (!has_room || frame >= known_end(streams_) + window()) {
      if (!is_blocked_) ++stats_.waits;
      is_blocked_ = true;
      blocked(now);
      break;
    }
    if (is_blocked_) unblocked(now);
    is_blocked_ = false;
    const bool is_again = present() > frame;
    timeline_.step(streams_);
    act(RequestKind::step, frame);
    act(RequestKind::save, frame + 1);
    if (is_again) continue;
    clock_.stepped(now);
    ++fresh_;
  }
  pace_.end(steps);
}

void PeerCore::roll_back(Frame to) {
  const Frame end = current();
  turns_.step_again(end - to);
  const auto depth = static_cast<std::size_t>(end - to);
  ++stats_.rollbacks[depth < 64 ? depth : 64];
  timeline_.step_again(to, streams_);
  hashes_.forget_from(to + 1);
  act(RequestKind::load, to);
  for (Frame frame = to; frame < end; ++frame) {
    act(RequestKind::step, frame);
    act(RequestKind::save, frame + 1);
  }
}

void PeerCore::misused() {
  is_misused_ = true;
  if (!has_start_) asked_start_ = false;
}

void PeerCore::go_back(Frame state) {
  if (current() != state) act(RequestKind::load, state);
  timeline_.restart(state);
  hashes_.forget_from(state + 1);
}

void PeerCore::hash_known(Frame state, std::uint64_t hash) {
  if (!has_start_) {
    has_start_ = true;
    hashes_.restart({state, hash}, hash);
    confirmed_state_ = state;
    return;
  }
  hashes_.report(state, hash);
  settle();
}

void PeerCore::settle() {
  while (hashes_.settle_next(limit_)) {
    const Frame state = hashes_.settled().frame;
    confirm(state, hashes_.hash(state));
    tell_who_plays(state - 1);
  }
}

void PeerCore::tell_who_plays(Frame frame) {
  for (int p = 0; p < players(); ++p) {
    const InputStream& stream = streams_[static_cast<std::size_t>(p)];
    const bool is_present = stream.contains(frame) && !stream.at(frame).absent;
    const std::optional<SessionEvent> event = news_.plays(p, is_present, frame);
    if (!event) continue;
    if (!is_present) delay_.reconsider();
    else views_.was_repaired(static_cast<std::size_t>(p), kNoFrame);  // who comes back has a state that agreed
    tell(*event);
  }
}

void PeerCore::go_at_pace_of(int player, int stretch) {
  const bool was_slow = stats_.stretch > 0;
  stats_.stretch = stretch;
  clock_.stretch(stretch);
  tell(news_.pace(was_slow, stretch > 0, player, current()));
}

void PeerCore::tell_of(SessionEvent::Kind kind, int player) {
  tell(SessionEvent{.kind = kind, .player = static_cast<std::uint8_t>(player), .frame = current()});
}

void PeerCore::note_arrival(int player, Frame end, Time now) {
  if (is_after_pause(now)) return;
  Frame slack = end - present();
  // Who holds us up is late by all that we wait; the others may be waiting as we are.
  if (is_blocked_ && end == known_end(streams_)) slack -= clock_.overdue(now);
  slack_[player].add(slack < -127 ? -127 : slack);
}

void PeerCore::follow_tempo(Time now) {
  if (const std::optional<Tempo> due = tempos_.due_at(current())) take_up(*due, now);
  if (is_paused()) clock_.start(now);
}

void PeerCore::take_up(const Tempo& tempo, Time now) {
  const Tempo before = tempos_.in_force();
  tempos_.take_up(tempo);
  SessionEvent event{.kind = SessionEvent::Kind::paused, .player = tempo.by, .frame = current()};
  event.speed = tempo.speed;
  if (tempo.speed != before.speed) {
    clock_.set_speed(tempo.speed);
    pace_ = StepPace(clock_.nominal());
    delay_.rescale(before.speed, tempo.speed);
    event.kind = SessionEvent::Kind::speed_changed;
    tell(event);
  }
  // What is late for a while is nobody's fault.
  delay_.disregard();
  for (RecentLeast& slack : slack_) slack = RecentLeast{};
  if (tempo.is_paused == before.is_paused) return;
  event.kind = tempo.is_paused ? SessionEvent::Kind::paused : SessionEvent::Kind::unpaused;
  tell(event);
  if (is_blocked_) unblocked(now);
  is_blocked_ = false;
  // The others hear of it when it has reached them, and begin then.
  if (!tempo.is_paused) clock_.start(config_.host ? now + stats_.round_trip / 2 : now);
}

}  // namespace isostep
