// Prediction and rollback, local inputs, datagrams: what host and client do alike.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/peer_core.hpp"

namespace isostep {
namespace {

constexpr int kMostSteps = 6;       // while catching up
constexpr Frame kSlackBucket = 30;  // [frames] of time
constexpr Time kAsk = 1000;         // [us] until a caller that waits for the network should look again

Frame window_of(const SessionConfig& config) { return config.mode == SessionMode::rollback ? config.window : 0; }

/// [frames] an input waits at most. Who would lose its inputs to the deadline waits up to half a second for them.
Frame longest_delay(const SessionConfig& config) {
  const bool is_fixed = config.least_delay == config.most_delay;
  const Frame half = config.hz / 2 < kMostDelay ? config.hz / 2 : kMostDelay;
  return config.deadline == 0 || is_fixed || half < config.most_delay ? config.most_delay : half;
}

InputDelay::Settings delay_settings(const SessionConfig& config) {
  InputDelay::Settings settings{config.delay, config.least_delay, config.most_delay};
  // Half the window is a rollback that every frame affords; the other half is for what the network does at its worst.
  const Frame window = window_of(config);
  settings.wanted_slack = -(window / 2);
  settings.latest_slack = -window;
  settings.limit = config.host ? config.most_delay : longest_delay(config);
  // Who waits longer for what others do than the window steps without it falls behind until its inputs are replaced.
  if (config.deadline > 0 && settings.latest_slack < -config.deadline) settings.latest_slack = -config.deadline;
  if (settings.wanted_slack < settings.latest_slack) settings.wanted_slack = settings.latest_slack;
  return settings;
}

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

Frame PeerCore::known_end() const {
  Frame end = streams_[0].end();
  for (const InputStream& stream : streams_) {
    if (stream.end() < end) end = stream.end();
  }
  return end;
}

Frame PeerCore::final_limit() const {
  const Frame known = known_end();
  return known < current() ? known : current();
}

bool PeerCore::is_beyond(Time round_trip) const {
  if (config_.deadline == 0) return false;
  // Others' inputs of a frame come a whole round trip after ours of it are sent.
  const Time delay = static_cast<Time>(longest_delay(config_)), window = static_cast<Time>(window_of(config_));
  const Time deadline = static_cast<Time>(config_.deadline);
  return round_trip > (delay + window) * clock_.period() || round_trip / 2 > (delay + deadline) * clock_.period();
}

bool PeerCore::may_step() const {
  if (current() >= kLastFrame || current() - hashes_.settled().frame >= config_.kept - 2) return false;
  return current() < known_end() + window();
}

void PeerCore::plan(Time now) {
  const bool was_away = is_after_pause(now);
  has_turned_ = true;
  last_turn_ = now;
  stepped_again_ = 0;
  if (was_away && running()) paused(now);
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
  if (now >= next_observation_ && !is_paused()) {
    next_observation_ = now + clock_.period();
    const bool is_too_slow = pace_.stretch() > 0 || (stats_.stretch > 0 && pace_.is_dear());
    thrift_.observe(stats_.steps, fresh_, is_too_slow, now);
    observe_delay();
    for (int p = 0; p < players(); ++p) {
      slack_[p].tick(kSlackBucket);
      stats_.players[p].early = early(p);
    }
  }
  const int most = pace_.most_steps(kMostSteps);
  int steps = 0;
  for (; steps < most && (clock_.is_due(now) || hurries(now) || (steps == 1 && pace_.probes())); ++steps) {
    follow_tempo(now);
    if (is_paused() || (steps >= kDueSteps && !hurries(now))) break;
    for (int p = 0; p < players(); ++p) {
      if (!is_local(p)) continue;
      inputs_.fill(p, streams_[static_cast<std::size_t>(p)], present() + delay_.frames() + 1,
                   [&](const InputStream& stream, auto& buffer) { return guess_next(stream, buffer); });
    }
    before_frame(now);
    if (!may_step()) {
      if (!is_blocked_) ++stats_.waits;
      is_blocked_ = true;
      blocked(now);
      break;
    }
    if (is_blocked_) unblocked(now);
    is_blocked_ = false;
    const Frame frame = current();
    const bool is_again = present() > frame;
    timeline_.step(streams_);
    act(RequestKind::step, frame);
    act(RequestKind::save, frame + 1);
    if (is_again) continue;
    clock_.stepped(now);
    ++fresh_;
  }
  pace_.end(steps);
  after_steps();
  limit_ = final_limit();
  settle();
  for (std::size_t m = 0; m < kMachines; ++m) {
    if (const std::optional<SessionEvent> event = views_.compare(m, hashes_)) tell(*event);
  }
  stats_.delay = delay_.frames();
}

void PeerCore::roll_back(Frame to) {
  const Frame end = current();
  stepped_again_ = end - to;
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

Bytes PeerCore::guess_next(const InputStream& stream, std::uint8_t (&buffer)[kInputCap]) const {
  const InputEntry last = stream.last();
  const Bytes before = last.absent ? Bytes(rules_.neutral, rules_.neutral_size) : last.bytes;
  return {buffer, rules_.predict(before, 1, buffer)};
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
    if (is_present == is_present_[p]) continue;
    is_present_[p] = is_present;
    if (!is_present) delay_.reconsider();
    if (is_present) was_repaired(static_cast<std::size_t>(p), kNoFrame);  // who comes back has a state that agreed
    SessionEvent event{.kind = is_present ? SessionEvent::Kind::joined : SessionEvent::Kind::left};
    event.player = static_cast<std::uint8_t>(p);
    event.frame = frame;
    tell(event);
  }
}

Verdict PeerCore::tell_verdict(const Statements& statements) {
  const Verdict verdict = judge(statements);
  SessionEvent event{.kind = SessionEvent::Kind::undecided, .frame = statements.frame};
  if (!verdict.is_decided) tell(event);
  event.kind = SessionEvent::Kind::outvoted;
  event.theirs = verdict.chain;
  const std::uint64_t news = views_.take(verdict);
  for (std::size_t m = 0; m < kMachines; ++m) {
    if ((news >> m & 1) == 0) continue;
    event.player = m == kHostMachine ? 0xff : static_cast<std::uint8_t>(m);
    event.ours = statements.of[m].chain;
    tell(event);
  }
  return verdict;
}

void PeerCore::tell_ballot() {
  using Kind = SessionEvent::Kind;
  const bool is_open = ballot_.outcome == Ballot::Outcome::open;
  const bool has_passed = ballot_.outcome == Ballot::Outcome::passed;
  SessionEvent event{.kind = is_open ? Kind::vote : has_passed ? Kind::vote_passed : Kind::vote_failed};
  event.player = ballot_.by;
  event.frame = current();
  event.ballot = ballot_;
  tell(event);
}

void PeerCore::end_ballot() {
  const bool was_open = ballot_.is_open();
  ballot_.outcome = Ballot::Outcome::failed;
  if (was_open) tell_ballot();
  ballot_ = Ballot{};
}

bool PeerCore::accept_datagram(PeerLink& link, Bytes bytes, Time now, Packet& packet) {
  ++stats_.datagrams_in;
  stats_.bytes_in += bytes.size();
  if (!link.datagrams.spend(config_.most_packets, now)) {
    ++stats_.flooded;
    return false;
  }
  const Result<Packet> read = read_packet(bytes);
  if (!read) {
    ++stats_.refused;
    return false;
  }
  packet = read.value();
  return true;
}

bool PeerCore::accept_message(PeerLink& link, Bytes bytes, Time now) {
  stats_.bytes_in += bytes.size();
  if (!link.messages.spend(config_.most_packets, now)) {
    ++stats_.flooded;
    return false;
  }
  if (!message_kind(bytes)) {
    ++stats_.refused;
    return false;
  }
  return true;
}

void PeerCore::take_header(PeerLink& link, const PacketHeader& header, Time now) {
  // Of an old or forged datagram only what stays true is taken: what was had, and the inputs.
  const bool is_current = link.position.is_near(header.frame, now, clock_.period());
  link.position.heard(header.frame, now, clock_.period());
  if (!link.position.is_near(link.newest_frame, now, clock_.period())) link.newest_frame = 0;
  if (is_current) link.meter.arrived(header.number, now);
  if (is_current && !is_after_pause(now)) {
    link.meter.measured(header.time, now);
    link.set_clock(header, now);
  }
  if (is_current && link.is_newest(header)) {
    link.newest_frame = header.frame;
    link.newest_time = header.time;
    link.stretch = header.stretch;
    link.slowest = header.slowest;
    link.spares = header.spares < window_of(config_) / 2 ? header.spares : window_of(config_) / 2;
    link.waits_for = header.waits_for;
  }
  for (int p = 0; p < players(); ++p) {
    if ((header.ack_mask >> p & 1) == 0) continue;
    // Nobody has what was never sent; and what was had once stays had.
    const Frame ack = header.ack[p];
    if (ack > link.acked[p] && ack <= streams_[static_cast<std::size_t>(p)].end()) {
      link.acked[p] = ack;
      if (sends(p, link)) {
        link.acked_at = now;
        link.may_burst = true;
      }
    }
    if (!is_current) continue;
    link.slack[p] = header.slack[p];
    link.reported_mask |= 1u << p;
  }
}

Bytes PeerCore::compose(PeerLink& link, PacketHeader header, Time now, Frame most) {
  header.number = link.datagrams_out++;
  header.time = static_cast<std::uint16_t>(now / 1000);
  header.has_echo = link.has_clock;
  const Time waited = (now - link.clock_at) / 1000;
  header.echo = static_cast<std::uint16_t>(link.clock + waited);
  header.waited = static_cast<std::uint8_t>(waited < 255 ? waited : 255);
  header.frame = present();
  header.report = hashes_.settled();
  PacketWriter writer(header, buffer_);
  const bool continues = link.continues_burst(now);
  link.burst = continues ? link.burst + 1 : 1;
  if (continues) link.may_burst = false;
  // In turns, so that one player's long inputs cannot keep another's out for ever.
  bool is_left = false;
  Frame added = 0;
  for (int i = 0; i < players(); ++i) {
    const int p = (i + current()) % players();
    const Frame until = sends_until(p, link);
    const InputStream& stream = streams_[static_cast<std::size_t>(p)];
    const Frame first = continues && link.burst_end[p] > link.acked[p] ? link.burst_end[p] : link.acked[p];
    const Frame few = until - first < most ? until - first : most;
    const Frame count = writer.add_slice(static_cast<std::uint8_t>(p), stream, first, few);
    link.burst_end[p] = first + count;
    added += count;
    is_left = is_left || link.burst_end[p] < until;
  }
  link.has_more = is_left && added > 0;
  if (!continues) link.next_send = now + clock_.period();
  link.sent_frame = present();
  ++stats_.datagrams_out;
  stats_.bytes_out += writer.bytes().size();
  return writer.bytes();
}

}  // namespace isostep
