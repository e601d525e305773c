// The client in the match: inputs, and keeping step with the host.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_core.hpp"

#include <bit>

namespace isostep {
namespace {

constexpr Frame kCatchUpBehind = 6;  // [frames] behind the host at which frames are stepped as fast as they can be
constexpr Frame kCaughtUp = 3;       // [frames]
constexpr int kCatchUp = 4;          // [1/256 period] for each frame that a slow machine is behind,
constexpr int kMostCatchUp = 16;     // but not more: a sixteenth of a period

}  // namespace

void ClientCore::take_packet(const Packet& packet, Time now) {
  const PacketHeader& header = packet.header;
  take_header(host_, header, now);
  stats_.round_trip = host_.round_trip;
  stats_.jitter = host_.meter.jitter(now);
  stats_.loss = host_.meter.loss(now);
  if (header.figured < players()) {
    PlayerStats& figures = stats_.players[header.figured];
    const Frame early = figures.early;
    const std::uint32_t one = 1u << header.figured;
    if ((figured_ & one) != 0 && header.figures.replaced > figures.replaced) {
      tell_of(SessionEvent::Kind::replaced, header.figured);
    }
    figured_ |= one;
    figures = header.figures;
    figures.early = early;
  }
  for (int p = 0; p < players() && is_open_; ++p) {
    if (is_own(p) && host_.acked[p] > accepted_[p]) accepted_[p] = host_.acked[p];
  }
  // Later ones tell of more; and a host that follows another knows what that one made final.
  if (header.final_end == kNoFrame) told_final_ = kLastFrame + 1;
  else if (told_final_ > kLastFrame || header.final_end > told_final_) told_final_ = header.final_end;
  hear_tempo(header.tempo);
  if (runs_) {
    go_at_pace_of(host_.slowest, host_.stretch);
    if (host_.waits_for != 0) stands_for(host_.waits_for);
    else goes_on();
    if (!is_paused()) lean(now);
  }
  take_hash(kHostMachine, header.report);
  if (header.reporter < players() && !is_own(header.reporter)) take_hash(header.reporter, header.passed_on);
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) take_inputs(packet.slices[i], now);
  if (header.started && !runs_) {
    runs_ = true;
    clock_.start(now);
    if (current() == 0) figured_ = ~0u;  // none is replaced yet
    tell_started();
  }
  if (runs_ && !knows_way_ && host_.round_trip > 0) {
    knows_way_ = true;
    // To the host, and on to the others where there are any; with a deadline, what others do comes all the way back.
    const bool is_two_hops = config_.deadline > 0 || welcome_.players > std::popcount(welcome_.hosted | own_);
    const Time way = is_two_hops ? host_.round_trip : host_.round_trip / 2;
    delay_.expect(static_cast<Frame>(way / clock_.period()) + 1);
  }
  if (is_far_ && !header.is_far) lag_ = InputDelay(lag_settings(config_));
  is_far_ = header.is_far;
}

void ClientCore::take_inputs(const InputSlice& slice, Time now) {
  if (slice.player >= players()) {
    ++stats_.refused;
    return;
  }
  InputStream& stream = streams_[slice.player];
  const bool is_ours = is_own(slice.player);
  if (slice.first > stream.end()) return;
  SliceReader reader(slice);
  InputEntry entry;
  bool noted = false;
  for (Frame frame = slice.first; reader.next(entry); ++frame) {
    if (!entry.absent && !rules_.valid(entry.bytes)) {
      ++stats_.refused;
      return;
    }
    // In order: what the host took for our inputs before we know of it up to here.
    if (is_ours && is_open_ && frame == accepted_[slice.player]) take_own(slice.player, entry);
    if (frame < stream.end()) continue;
    if (is_ours && !entry.absent && is_open_) continue;
    if (frame > current() + config_.history / 2) return;
    if (!noted && !is_ours) note_arrival(slice.player, stream.end(), now);
    noted = true;
    stream.append(entry);
  }
  if (reader.failed()) ++stats_.refused;
}

void ClientCore::take_own(int player, const InputEntry& entry) {
  InputStream& stream = streams_[static_cast<std::size_t>(player)];
  Frame& accepted = accepted_[player];
  if (entry.absent && accepted >= opens_) {
    cut_out();
    return;
  }
  if (accepted == stream.end()) {
    stream.append(entry);
  } else if (!same_input(stream.at(accepted), entry)) {
    stream.replace(accepted, entry);
    timeline_.recheck(player, accepted);
  }
  host_.acked[player] = ++accepted;
}

void ClientCore::cut_out() {
  for (int p = 0; p < players(); ++p) {
    if (!is_own(p)) continue;
    streams_[static_cast<std::size_t>(p)].truncate(accepted_[p]);
    timeline_.recheck(p, accepted_[p]);
  }
  is_open_ = asked_ready_ = false;
}

bool ClientCore::has_all_until(Frame end) const {
  for (int p = 0; p < players(); ++p) {
    if (final_end(p) < end) return false;
  }
  return true;
}

void ClientCore::take_back_former() {
  if (!former_.are_kept()) return;
  former_.are_given_back();
  for (int p = 0; p < players(); ++p) {
    InputStream& stream = streams_[static_cast<std::size_t>(p)];
    const InputStream& former = former_.of(p);
    for (Frame frame = final_end(p); former.contains(frame); ++frame) {
      if (frame == stream.end()) {
        stream.append(former.at(frame));
      } else if (!same_input(stream.at(frame), former.at(frame))) {
        stream.replace(frame, former.at(frame));
        timeline_.recheck(p, frame);
      }
      if (is_told_by_us(p)) accepted_[p] = frame + 1;
    }
  }
}

Frame ClientCore::final_limit() const {
  Frame limit = PeerCore::final_limit();
  if (told_final_ < limit) limit = told_final_;
  for (int p = 0; p < players() && is_open_; ++p) {
    if (is_own(p) && accepted_[p] < limit) limit = accepted_[p];
  }
  return limit;
}

std::int64_t ClientCore::host_position(Time now) const {
  const auto way = static_cast<std::int64_t>(host_.round_trip / 2 * 256 / clock_.period());
  return host_.position.at(now, clock_.period()) + way - std::int64_t{config_.broadcast_delay} * 256;
}

Frame ClientCore::frames_behind(Time now) const { return static_cast<Frame>(host_position(now) / 256 - present()); }

void ClientCore::lean(Time now) {
  const Time until = clock_.until_due(now);
  const Time done = until < clock_.period() ? clock_.period() - until : 0;
  const std::int64_t ours = std::int64_t{present()} * 256 + static_cast<std::int64_t>(done * 256 / clock_.period());
  const std::int64_t ahead = ours + std::int64_t{lag_.frames()} * 256 - host_position(now);
  constexpr std::int64_t kCap = 256 * 64;
  clock_.lean(static_cast<std::int32_t>(ahead < -kCap ? -kCap : ahead > kCap ? kCap : ahead));
}

bool ClientCore::hurries(Time now) const {
  return present() > current() || frames_behind(now) > kCatchUpBehind + lag_.frames();
}

void ClientCore::before_steps(Time now) {
  stats_.peers = host_.is_connected ? 1 : 0;
  const Time silence = can_fail_over() && config_.migration < config_.silence ? config_.migration : config_.silence;
  if (host_.is_connected && !failover_.seeks() && now - host_.heard > silence) {
    lose(now, false);
    return;
  }
  tend_callers(now);
  if (failover_.seeks()) seek_on(now);
  if (must_begin_) {
    must_begin_ = false;
    begin_at(welcome_.start);
  }
  if (!runs_ || is_restoring_) return;
  const bool is_of_host = failover_.election.log_term() == welcome_.term;
  const Frame needed = is_of_host ? former_.end() : welcome_.term_start;
  if ((!is_of_host || former_.are_kept()) && has_all_until(needed)) {
    failover_.election.has_log_of(welcome_.term);
    former_.forget();
  }
  tend_repair(now);
  if (is_open_) {
    if (current() >= opens_) phase_ = SessionPhase::playing;
  } else if (phase_ == SessionPhase::playing) {
    phase_ = SessionPhase::watching;
  }
  judge_distance();
  const bool is_near = frames_behind(now) <= kCaughtUp + config_.most_delay;
  if (is_near && near_since_ == 0) near_since_ = now;
  if (config_.mode == SessionMode::spectator) {
    if (is_near) phase_ = SessionPhase::watching;
  } else if (!is_open_ && !asked_ready_ && !is_too_far_ && is_near && pace_.stretch() <= kMostStretch &&
             is_vouched_for(now)) {
    asked_ready_ = must_ready_ = true;
  }
}

void ClientCore::judge_distance() {
  const bool was_too_far = is_too_far_;
  const Time trip = host_.round_trip;
  is_too_far_ = player_ >= 0 && (was_too_far ? is_still_beyond(trip) : is_beyond(trip));
  if (is_too_far_ && !was_too_far) tell_of(SessionEvent::Kind::too_far, player_);
}

bool ClientCore::propose(int player, const Proposal& proposal) {
  if (player < 0 || player >= players() || !is_local(player) || !host_.is_connected) return false;
  if (!proposal.is_sound() || ballot_.is_open()) return false;
  must_propose_ = true;
  proposal_ = {static_cast<std::uint8_t>(player), proposal};
  return true;
}

bool ClientCore::vote(int player, bool yes) {
  if (player < 0 || player >= players() || !is_local(player) || !host_.is_connected || !ballot_.is_open()) return false;
  const std::uint32_t own = 1u << player;
  if ((ballot_.voters & own) == 0) return false;
  if (votes_.number != ballot_.number) votes_ = {ballot_.number, 0, 0};
  votes_.yes = yes ? votes_.yes | own : votes_.yes & ~own;
  votes_.no = yes ? votes_.no & ~own : votes_.no | own;
  return true;
}

bool ClientCore::ask(const Ask& ask) {
  if (!is_open_ || !host_.is_connected) return false;
  must_ask_ = true;
  ask_ = ask;
  return true;
}

void ClientCore::blocked(Time now) {
  // Whose inputs are missing the host knows; that nothing comes of the host itself we see.
  if (now - host_.heard >= kTellBlocked) stands_for(welcome_.hosted);
}

Frame ClientCore::worst_slack() const {
  Frame worst = RecentLeast::kNothing;
  for (int p = 0; p < players(); ++p) {
    if (!is_own(p) && slack_[p].value() < worst) worst = slack_[p].value();
  }
  return worst;
}

void ClientCore::observe_delay() {
  if (!is_open_ || phase_ != SessionPhase::playing) return;
  Frame least = RecentLeast::kNothing;  // of all our players: they wait alike
  for (int p = 0; p < players(); ++p) {
    if (is_own(p) && (host_.reported_mask >> p & 1) != 0 && host_.slack[p] < least) least = host_.slack[p];
  }
  if (least != RecentLeast::kNothing) delay_.observe(least);
  const Frame worst = worst_slack(), before = lag_.frames();
  if (!is_far_ || worst == RecentLeast::kNothing) return;
  lag_.observe(worst);
  if (lag_.frames() > before) delay_.grow(lag_.frames() - before);
}

Frame ClientCore::early(int player) const {
  if (!is_own(player)) return PeerCore::early(player);
  return host_.slack[player] == RecentLeast::kNothing ? 0 : host_.slack[player];
}

int ClientCore::needed_stretch() const {
  const int needed = pace_.stretch();
  if (needed == 0) return 0;
  // Who steps as fast as it can never makes up for what it fell behind, unless the others go slower still for a while.
  const int behind = clock_.ahead() < -256 ? -clock_.ahead() * kCatchUp / 256 : 0;
  const int more = needed + (behind < kMostCatchUp ? behind : kMostCatchUp);
  return more < StepPace::kLargest ? more : StepPace::kLargest;
}

std::optional<Outgoing> ClientCore::poll_send(Time now) {
  if (!farewells_.empty()) {
    const PeerId peer = farewells_.back();
    farewells_.pop_back();
    write_farewell(message_);
    hang_up(peer);
    return written(peer);
  }
  if (!hang_ups_.empty()) {
    const PeerId peer = hang_ups_.back();
    hang_ups_.pop_back();
    return Outgoing{peer, Channel::reliable, {}, true};
  }
  if (std::optional<Outgoing> out = next_failover_message()) return out;
  if (!host_.is_connected) return std::nullopt;
  const auto message = [&] { return written(host_.peer); };
  if (must_greet_ && has_start_) {
    must_greet_ = false;
    Hello hello;
    hello.spectator = config_.mode == SessionMode::spectator;
    hello.seat = config_.seat;
    hello.seats = seats_wished();
    hello.token = token_;
    hello.life = failover_.life;
    hello.term = failover_.election.term();
    hello.migration = config_.migration;
    hello.have = is_spoiled_ ? HashReport{0, 0} : hashes_.settled();
    if (partial_.frame != kNoFrame) {
      hello.partial = partial_;
      hello.partial_size = static_cast<std::uint32_t>(portable_.size());
    }
    hello.credential = config_.credential;
    hello.address = config_.address;
    hello.identity = config_.identity;
    write_hello(hello, message_);
    return message();
  }
  if (is_greeted_ && runs_) {
    if (std::optional<Outgoing> out = next_repair_message()) return out;
  }
  // Often, for the host sends as arrives; but the host allows a peer only so many messages.
  const bool is_whole = portable_.size() == welcome_.snapshot_size;
  if (is_greeted_ && told_ < portable_.size() && (is_whole || now >= next_progress_)) {
    next_progress_ = now + clock_.period();
    told_ = static_cast<std::uint32_t>(portable_.size());
    write_progress(told_, message_);
    return message();
  }
  if (must_propose_ && is_greeted_) {
    must_propose_ = false;
    write_proposal(proposal_, message_);
    return message();
  }
  if ((votes_.yes | votes_.no) != 0 && is_greeted_) {
    write_votes(votes_, message_);
    votes_ = Votes{};
    return message();
  }
  if (must_ask_ && is_greeted_) {
    must_ask_ = false;
    write_ask(ask_, message_);
    return message();
  }
  if (must_ready_) {
    must_ready_ = false;
    write_ready(message_);
    return message();
  }
  if (!is_greeted_ || must_begin_) return std::nullopt;
  if (!host_.may_send(present(), clock_.period(), now)) return std::nullopt;
  PacketHeader header;
  header.match = welcome_.match;
  header.started = runs_;
  header.stretch = static_cast<std::uint8_t>(needed_stretch());
  header.spares = static_cast<std::uint8_t>(thrift_.frames());
  for (int p = 0; p < players(); ++p) {
    header.ack_mask |= 1u << p;
    header.ack[p] = is_own(p) && is_open_ ? accepted_[p] : streams_[static_cast<std::size_t>(p)].end();
    // Who may run later does so before it asks the others to wait; and that a snapshot fills our line is our affair.
    const bool is_ours = (is_far_ && !lag_.is_at_most()) || repair_.stage == Repair::Stage::receives;
    const bool measures = phase_ == SessionPhase::playing && !is_own(p) && !is_ours;
    header.slack[p] = static_cast<std::int8_t>(measures ? slack_[p].value() : RecentLeast::kNothing);
  }
  return Outgoing{host_.peer, Channel::datagram, compose(host_, header, now)};
}

}  // namespace isostep
