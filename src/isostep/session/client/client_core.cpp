// The client in the match: inputs, and keeping step with the host.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/client_core.hpp"

#include <bit>

#include "isostep/session/peer/reach.hpp"

namespace isostep {
namespace {

constexpr Frame kCatchUpBehind = 6;  // [frames] behind the host at which frames are stepped as fast as they can be
constexpr Frame kCaughtUp = 3;       // [frames]
constexpr int kCatchUp = 4;          // [1/256 period] for each frame that a slow machine is behind,
constexpr int kMostCatchUp = 16;     // but not more: a sixteenth of a period

/// [1/256 period] by which frames have to be longer for us.
int needed_stretch(const StepPace& pace, const FrameClock& clock) {
  const int needed = pace.stretch();
  if (needed == 0) return 0;
  // Who steps as fast as it can never makes up for what it fell behind, unless the others go slower still for a while.
  const int behind = clock.ahead() < -256 ? -clock.ahead() * kCatchUp / 256 : 0;
  const int more = needed + (behind < kMostCatchUp ? behind : kMostCatchUp);
  return more < StepPace::kLargest ? more : StepPace::kLargest;
}

}  // namespace

void ClientCore::take_packet(const Packet& packet, Time now) {
  const PacketHeader& header = packet.header;
  datagrams_.take_header(host_, header, ends(), is_after_pause(now), now);
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
  own_.hear_acks();
  log_.hear_final(header.final_end);
  tempos_.hear(header.tempo);
  if (standing_ == Standing::runs) {
    go_at_pace_of(host_.slowest, host_.stretch);
    if (host_.waits_for != 0) tell(news_.stands_for(host_.waits_for, current()));
    else tell(news_.goes_on(current()));
    if (!is_paused()) distance_.lean(now, present());
  }
  views_.hear(kHostMachine, header.report);
  if (header.reporter < players() && !own_.has(header.reporter)) views_.hear(header.reporter, header.passed_on);
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) take_inputs(packet.slices[i], now);
  if (header.started && standing_ != Standing::runs) {
    standing_ = Standing::runs;
    clock_.start(now);
    if (current() == 0) figured_ = ~0u;  // none is replaced yet
    tell(news_.started(current()));
  }
  if (standing_ == Standing::runs) {
    // To the host, and on to the others where there are any; with a deadline, what others do comes all the way back.
    const bool is_over_host = config_.deadline > 0 || players() > std::popcount(hosted() | own_.players());
    const Frame way = distance_.find_way(is_over_host);
    if (way > 0) delay_.expect(way);
  }
  distance_.hear(header.is_far);
}

void ClientCore::take_inputs(const InputSlice& slice, Time now) {
  if (slice.player >= players()) {
    ++stats_.refused;
    return;
  }
  InputStream& stream = streams_[slice.player];
  const bool is_ours = own_.has(slice.player);
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
    if (is_local(slice.player) && frame == own_.accepted(slice.player)) own_.take(slice.player, entry);
    if (frame < stream.end()) continue;
    if (is_local(slice.player) && !entry.absent) continue;
    if (frame > current() + config_.history / 2) return;
    if (!noted && !is_ours) note_arrival(slice.player, stream.end(), now);
    noted = true;
    stream.append(entry);
  }
  if (reader.failed()) ++stats_.refused;
}

Frame ClientCore::final_limit() const {
  const Frame limit = PeerCore::final_limit();
  return own_.limit(log_.told_final() < limit ? log_.told_final() : limit);
}

bool ClientCore::hurries(Time now) const {
  return present() > current() || distance_.behind(now, present()) > kCatchUpBehind + distance_.lag();
}

void ClientCore::before_steps(Time now) {
  stats_.peers = host_.is_connected ? 1 : 0;
  const Time silence =
      failover_.can_begin() && config_.migration < config_.silence ? config_.migration : config_.silence;
  if (host_.is_connected && !failover_.search().is_under_way() && now - host_.heard > silence) {
    lose(now, false);
    return;
  }
  failover_.tend(may_stand(), now);
  if (entry_.must_restore_again()) restore(entry_.welcome().start.frame);
  if (entry_.is_due()) begin();
  if (standing_ != Standing::runs) return;
  log_.tend(failover_.search().election());
  tend_repair(now);
  tend_seats(now);
}

void ClientCore::tend_seats(Time now) {
  if (own_.is_open()) {
    if (current() >= own_.opens()) phase_ = SessionPhase::playing;
  } else if (phase_ == SessionPhase::playing) {
    phase_ = SessionPhase::watching;
  }
  const bool was_too_far = is_too_far_;
  is_too_far_ = own_.first() >= 0 && is_out_of_reach(config_, clock_.period(), host_.round_trip, was_too_far);
  if (is_too_far_ && !was_too_far) tell_of(SessionEvent::Kind::too_far, own_.first());
  const bool is_near = distance_.behind(now, present()) <= kCaughtUp + config_.most_delay;
  if (is_near) own_.is_near(now);
  if (config_.mode == SessionMode::spectator) {
    if (is_near) phase_ = SessionPhase::watching;
    return;
  }
  if (!own_.is_closed() || is_too_far_ || !is_near || pace_.stretch() > kMostStretch) return;
  if (!own_.are_vouched_for(views_.agreeing_since(own_.base()), views_.differing(), hosted(), now)) return;
  own_.ask();
  due_.add(MessageKind::ready);
}

void ClientCore::blocked(Time now) {
  // Whose inputs are missing the host knows; that nothing comes of the host itself we see.
  if (now - host_.heard >= kTellBlocked) tell(news_.stands_for(hosted(), current()));
}

void ClientCore::observe_delay() {
  if (!own_.is_open() || phase_ != SessionPhase::playing) return;
  // Of all our players: they wait alike. And of the others, how early the latest of a second's inputs came.
  Frame least = RecentLeast::kNothing, theirs = RecentLeast::kNothing;
  for (int p = 0; p < players(); ++p) {
    if (!own_.has(p)) {
      if (slack_[p].value() < theirs) theirs = slack_[p].value();
    } else if ((host_.reported_mask >> p & 1) != 0 && host_.slack[p] < least) {
      least = host_.slack[p];
    }
  }
  if (least != RecentLeast::kNothing) delay_.observe(least);
  const Frame later = distance_.observe(theirs);
  if (later > 0) delay_.grow(later);
}

Frame ClientCore::early(int player) const {
  if (!own_.has(player)) return PeerCore::early(player);
  return host_.slack[player] == RecentLeast::kNothing ? 0 : host_.slack[player];
}

std::optional<Outgoing> ClientCore::poll_send(Time now) {
  std::optional<PeerId> to = partings_.write_next(message_);
  if (!to) to = failover_.write_next(message_);
  if (!to && host_.is_connected && write_to_host(now)) to = host_.peer;
  if (to) {
    stats_.bytes_out += message_.size();
    return Outgoing{*to, Channel::reliable, message_, message_.empty()};
  }
  if (!host_.is_connected || !is_greeted() || entry_.is_due()) return std::nullopt;
  if (!host_.may_send(present(), clock_.period(), now)) return std::nullopt;
  return Outgoing{host_.peer, Channel::datagram,
                  datagrams_.compose(host_, header(), ends(), present(), kSliceFrames, now)};
}

bool ClientCore::write_to_host(Time now) {
  if (has_start_ && due_.take(MessageKind::hello)) {
    write_own_hello();
    return true;
  }
  if (standing_ == Standing::runs && repair_.write_next(message_)) return true;
  if (is_greeted() && arrival_.write_next(now, clock_.period(), message_)) return true;
  if (is_greeted() && wishes_.write_next(message_)) return true;
  if (!due_.take(MessageKind::ready)) return false;
  write_ready(message_);
  return true;
}

SendEnds ClientCore::ends() const {
  SendEnds ends;
  for (int p = 0; p < players(); ++p) ends.of[p] = is_local(p) ? streams_[static_cast<std::size_t>(p)].end() : 0;
  return ends;
}

PacketHeader ClientCore::header() const {
  PacketHeader header;
  header.match = match();
  header.started = standing_ == Standing::runs;
  header.stretch = static_cast<std::uint8_t>(needed_stretch(pace_, clock_));
  header.spares = static_cast<std::uint8_t>(thrift_.frames());
  // Who may run later does so before it asks the others to wait; and that a snapshot fills our line is our affair.
  const bool is_ours = distance_.may_lag_more() || repair_.receives();
  const bool measures = phase_ == SessionPhase::playing && !is_ours;
  for (int p = 0; p < players(); ++p) {
    header.ack_mask |= 1u << p;
    header.ack[p] = is_local(p) ? own_.accepted(p) : streams_[static_cast<std::size_t>(p)].end();
    header.slack[p] = static_cast<std::int8_t>(measures && !own_.has(p) ? slack_[p].value() : RecentLeast::kNothing);
  }
  return header;
}

}  // namespace isostep
