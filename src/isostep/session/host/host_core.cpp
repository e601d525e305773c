// The host: what arrives, the log of inputs, and time.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/host_core.hpp"

#include "isostep/session/peer/reach.hpp"

namespace isostep {
namespace {

/// [us] from the connection to the hello, which is one way of the line: a second for it to be sent again, and one more.
constexpr Time kGreeting = 2 * kSecond;
/// [us] that count of one turn: nobody can come back while our own process stands still.
constexpr Time kLongestTurn = kSecond;
constexpr Frame kMostAhead = 128;  // [frames] beyond ours that a client's input may lie

}  // namespace

HostCore::HostCore(const SessionConfig& config, const InputRules& rules)
    : PeerCore(config, rules),
      numbers_(config.seed, Leadership::kFirstTerm),
      seats_(config_, static_cast<std::uint32_t>((std::uint64_t{1} << config.local_players) - 1), slack_),
      guests_(static_cast<std::size_t>(config.max_peers + config.max_strangers)),
      match_(numbers_.match()) {
  know_ourselves();
}

void HostCore::know_ourselves() {
  const std::uint64_t life = numbers_.next_life();
  const std::uint64_t token = config_.migration > 0 ? numbers_.next_token() : 0;
  leadership_.know_ourselves(token, life);
}

void HostCore::connected(PeerId peer, Time now) {
  Guest* const guest = guests_.place(peer);
  if (guest == nullptr) {
    ++stats_.refused;
    return;
  }
  if (guest->is_connected) drop(*guest);
  guest->clear();
  guest->connect(now);
}

void HostCore::disconnected(PeerId peer, Time now) {
  Guest* const guest = guests_.find(peer);
  if (guest == nullptr) return;
  // Who hangs up while it hears us leaves; who has lost us looks for another host.
  const bool leaves = guest->lease_from != 0 && now - guest->lease_from <= leadership_.tenure().lease();
  const std::uint32_t its = guest->players;
  drop(*guest);
  for (const int p : EachPlayer(its)) seats_[p].left_at = leaves ? now : 0;
}

void HostCore::begin(Time now) {
  started_ = true;
  deadline_.begin(now);
  leadership_.begin(hashes_.settled().frame, now);
  clock_.start(now);
  phase_ = seats_.hosted() != 0 ? SessionPhase::playing : SessionPhase::watching;
  seats_.begin();
  control_.tempo_desk().begin();
  tell(news_.started(current()));
}

void HostCore::receive(PeerId peer, Channel channel, Bytes bytes, Time now) {
  Guest* const guest = guests_.find(peer);
  if (guest == nullptr) ++stats_.refused;
  else if (channel == Channel::datagram) take_datagram(*guest, bytes, now);
  else if (datagrams_.accept_message(*guest, bytes, now) && !take_message(*guest, bytes, now)) ++stats_.refused;
}

void HostCore::take_datagram(Guest& guest, Bytes bytes, Time now) {
  Packet packet;
  if (!datagrams_.accept(guest, bytes, now, packet)) return;
  const bool is_ours = packet.header.match == match_;
  if (is_ours && guest.stage == Guest::Stage::receives_snapshot) {
    guest.set_clock(packet.header, now);
    guest.measure(packet.header, now);
    return;
  }
  if (!is_ours || !guest.is_live()) {
    ++stats_.refused;
    return;
  }
  if (now - guest.heard > config_.silence / 2) guest.back_at = now;
  guest.heard = now;
  guest.has_spoken = true;
  guest.renew_lease(packet.header, now);
  seats_.keep(guest);
  datagrams_.take_header(guest, packet.header, flow_.ends(guest), is_after_pause(now), now);
  if (guest.repair.stage == RepairService::Stage::receives) guest.measure(packet.header, now);
  // Nobody has final states that we have not: all inputs pass through us.
  const HashReport& report = packet.header.report;
  if (report.frame <= known_end(streams_)) {
    const Frame after = guest.player < 0 ? kNoFrame : views_[guest.player].after;
    if (report.frame > guest.report.frame && report.frame > after) guest.report = report;
    if (guest.player >= 0) views_.hear(static_cast<std::size_t>(guest.player), report);
  } else {
    ++stats_.refused;
  }
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) take_inputs(guest, packet.slices[i], now);
}

bool HostCore::take_message(Guest& guest, Bytes bytes, Time now) {
  const MessageKind kind = message_kind(bytes).value();
  switch (kind) {
    case MessageKind::hello:
      if (!has_start_) {
        guest.due.add(Due::close);  // nothing was driven here yet: let it come again
        return true;
      }
      if (guest.stage != Guest::Stage::connected) return false;
      guest.heard = now;
      admission_.greet(guest, bytes);
      return true;
    case MessageKind::farewell:
      if (bytes.size() == 1) guest.lease_from = 0;
      return bytes.size() == 1;
    case MessageKind::progress: return take_progress(guest, bytes, now);
    default: break;
  }
  if (!guest.is_live()) return false;
  switch (kind) {
    case MessageKind::enrolled: {
      const Result<std::uint32_t> version = read_enrolled(bytes);
      if (version) guest.enrolled = version.value();
      return version.ok();
    }
    case MessageKind::propose:
    case MessageKind::vote:
    case MessageKind::ask: return control_.receive(guest, kind, bytes);
    case MessageKind::ready:
      guest.heard = now;
      guest.is_ready = true;
      return true;
    default: return repairs_.receive(guest, kind, bytes);
  }
}

bool HostCore::take_progress(Guest& guest, Bytes message, Time now) {
  if (!guest.receives_snapshot()) return false;
  const Result<std::uint32_t> arrived = read_progress(message);
  if (!arrived || !guest.transfer.has_arrived(arrived.value())) return false;
  guest.heard = now;
  if (!guest.transfer.is_complete()) return true;
  if (!guest.is_live()) {
    boarding_.go_live(guest, guest.start);
    return true;
  }
  RepairDesk::has_arrived(guest, now);
  return true;
}

void HostCore::take_inputs(Guest& guest, const InputSlice& slice, Time now) {
  if (slice.player >= players() || !guest.has(slice.player) || !seats_[slice.player].is_open) return;
  InputStream& stream = streams_[slice.player];
  if (slice.first > stream.end()) return;
  SliceReader reader(slice);
  InputEntry entry;
  bool noted = false;
  for (Frame frame = slice.first; reader.next(entry); ++frame) {
    if (frame < stream.end()) continue;
    if (entry.absent || !rules_.valid(entry.bytes)) {
      ++stats_.refused;
      return;
    }
    if (frame >= current() + flow_.bounded(kMostAhead)) return;
    if (!noted) note_arrival(slice.player, stream.end(), now);
    noted = true;
    seats_[slice.player].is_late = false;
    stream.append(entry);
  }
  // All of it came too late: by how much, its player has to know to send them earlier.
  const Frame end = slice.first + slice.count;
  if (!noted && deadline_.is_news(slice.player, end)) note_arrival(slice.player, end, now);
  if (reader.failed()) ++stats_.refused;
}

void HostCore::before_steps(Time now) {
  if (started_ && !is_paused()) match_pace_.turn(now, pace_.most_steps(kDueSteps), clock_.nominal());
  if (!started_ && (all_are_here() || must_start_)) begin(now);
  if (!started_ && is_resumed()) after_steps();
  if (now >= next_tending_) {
    next_tending_ = now + clock_.period();
    tend(now);
  }
  for (Guest& guest : guests_) {
    if (guest.is_connected && guest.is_ready) boarding_.open_seats(guest, now);
  }
  lines_.begin_turn(now);
  if (const Tempo* const next = control_.tempo_desk().next(tempos_.in_force())) {
    tempos_.announce(*next, current(), streams_, window());
  }
  // Before guesses are compared: a seat that was closed during the last frame was guessed otherwise.
  if (started_) before_frame(now);
}

void HostCore::before_frame(Time now) {
  if (!leadership_.tenure().is_backed()) return;
  for (int p = 0; p < players(); ++p) {
    if (seats_.is_guests(p) && !seats_[p].is_open)
      streams_[static_cast<std::size_t>(p)].append_absent_until(flow_.horizon(current()));
  }
  if (!deadline_.applies(now)) return;
  const Frame due = current() + (is_blocked_ ? clock_.overdue(now) : 0);
  for (int p = 0; p < players(); ++p) {
    if (is_local(p)) continue;
    std::uint8_t buffer[kInputCap];
    while (deadline_.is_over(p, due, window()))
      deadline_.replace(p, guess_next(rules_, streams_[static_cast<std::size_t>(p)], buffer), due, now);
    if (deadline_.must_tell(p, now)) tell_of(SessionEvent::Kind::replaced, p);
  }
}

void HostCore::after_steps() {
  if (snapshots_.serve(guests_, current())) act(RequestKind::capture, snapshots_.state().frame);
}

void HostCore::tend(Time now) {
  const Time turn = now - turn_at_ < kLongestTurn ? now - turn_at_ : kLongestTurn;
  turn_at_ = now;
  seats_.pass(is_paused() ? 0 : turn);
  stats_.peers = 0;
  for (Guest& guest : guests_) {
    if (!guest.is_connected) continue;
    ++stats_.peers;
    tend(guest, now);
  }
  control_.tend(now);
  leadership_.keep_roster();
  tend_inquiry(now);
  lines_.judge();
  for (Guest& guest : guests_) {
    const bool is_covered = !is_out_of_reach(config_, clock_.period(), guest.round_trip, guest.is_too_far);
    if (!LineJudge::loses(guest, is_covered, now)) continue;
    seats_.close(guest);
    tell_of(SessionEvent::Kind::too_far, guest.player);
  }
  const MatchPace::Choice pace = match_pace_.choose({news_.slowest(), stats_.stretch}, now);
  go_at_pace_of(pace.player, pace.stretch);
  if (match_pace_.is_too_slow(now)) {
    const bool may_go = leadership_.tenure().is_backed();
    is_too_slow_ = may_go && leadership_.could_others(match_pace_.unfit(flow_, now));
  }
  if (started_) figures_.keep(players(), now);
}

void HostCore::tend(Guest& guest, Time now) {
  if (guest.stage == Guest::Stage::connected && !guest.due.has(Due::close) && now - guest.heard > kGreeting) {
    guest.due.add(Due::close);  // and not refused: a machine that stood still comes again
    ++stats_.refused;
  }
  if (now - guest.heard > config_.silence) {
    guest.due.add(Due::close);
    seats_.close(guest);
  }
  if (guest.is_live() && !flow_.tend(guest, now)) {
    ++stats_.put_out;
    guest.due.add(Due::close);
    seats_.close(guest);
  }
  guest.most_burst = seats_.play(guest) ? PeerLink::kPlayersBurst : PeerLink::kBurst;
  const bool receives = guest.stage == Guest::Stage::receives_snapshot;
  bool lags = false;  // inputs that it lacks have fallen out of the log
  for (int p = 0; p < players(); ++p) {
    const Frame lacks = receives ? guest.start : guest.acked[p];
    lags = lags || lacks < streams_[static_cast<std::size_t>(p)].begin();
  }
  if (receives && lags) guest.due.add(Due::close);  // others may wait for a newer one
  if (guest.is_live() && lags) {
    seats_.close(guest);
    guest.fall_behind();
  }
  const bool waits = guest.repair.stage == RepairService::Stage::waits && now >= guest.repair.next;
  if (waits) guest.repair.stage = RepairService::Stage::needs;
  control_.answer_asks(guest, now);
}

void HostCore::observe_delay() {
  stats_.round_trip = lines_.longest_round_trip();
  Frame least = RecentLeast::kNothing;
  for (const int p : EachPlayer(seats_.hosted())) {
    const Frame slack = lines_.slack_of(p, current(), stats_.stretch > 0);
    if (slack < least) least = slack;
  }
  if (least != RecentLeast::kNothing) delay_.observe(least);
}

void HostCore::paused(Time now) {
  lines_.excuse(now);
  deadline_.excuse(now);
}

void HostCore::blocked(Time now) {
  std::uint32_t missing = 0;
  for (int p = 0; p < players(); ++p) {
    if (streams_[static_cast<std::size_t>(p)].end() == known_end(streams_)) missing |= 1u << p;
  }
  if (deadline_.stands(now, kTellBlocked)) tell(news_.stands_for(missing, current()));
  deadline_.charge(current(), leadership_.tenure().is_backed(), now);
}

void HostCore::unblocked(Time) {
  deadline_.goes_on();
  tell(news_.goes_on(current()));
}

void HostCore::drop(Guest& guest) {
  departures_.unseat(guest);
  if (guest.stage == Guest::Stage::receives_snapshot) {
    const Time frames = config_.silence / clock_.period(), most = static_cast<Time>(config_.history);
    snapshots_.hold_until(current() + static_cast<Frame>(frames < most ? frames : most));
  }
  guest.clear();
}

SnapshotProgress HostCore::snapshot_progress(PeerId peer) const {
  const Guest* const guest = guests_.find(peer);
  return guest != nullptr && guest->receives_snapshot() ? guest->transfer.progress() : SnapshotProgress{};
}

}  // namespace isostep
