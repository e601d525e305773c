// The host: what arrives, the log of inputs, and time.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Frame kMostAhead = 128;  // [frames] beyond ours that a client's input may lie

}  // namespace

HostCore::HostCore(const SessionConfig& config, const InputRules& rules)
    : PeerCore(config, rules),
      hosted_(static_cast<std::uint32_t>((std::uint64_t{1} << config.local_players) - 1)),
      guests_(static_cast<std::size_t>(config.max_peers + config.max_strangers)),
      match_(draw(Purpose::match, 0)) {
  for (int p = 0; p < config.local_players; ++p) seats_[p].is_taken = seats_[p].is_open = true;
  for (std::size_t i = 0; i < guests_.size(); ++i) guests_[i].peer = static_cast<PeerId>(i);
  own_life_ = draw(Purpose::life, lives_++);
  if (config.migration > 0) own_token_ = draw(Purpose::token, tokens_++);
}

void HostCore::connected(PeerId peer, Time now) {
  if (peer >= guests_.size()) {
    ++stats_.refused;
    return;
  }
  Guest& guest = guests_[peer];
  if (used_ <= peer) used_ = peer + std::size_t{1};
  if (guest.is_connected) drop(guest);
  clear(guest);
  guest.connect(now);
}

void HostCore::disconnected(PeerId peer, Time now) {
  if (peer >= guests_.size() || !guests_[peer].is_connected) return;
  Guest& guest = guests_[peer];
  // Who hangs up while it hears us leaves; who has lost us looks for another host.
  const bool leaves = guest.lease_from != 0 && now - guest.lease_from <= tenure_.lease();
  const std::uint32_t its = guest.players;
  drop(guest);
  for (int p = 0; p < players(); ++p) {
    if ((its >> p & 1) == 0) continue;
    seats_[p].has_left = leaves;
    seats_[p].left_at = now;
  }
}

void HostCore::begin(Time now) {
  started_ = true;
  began_ = now;
  tenure_.begin(first_term_, config_.migration, 0, hashes_.settled().frame, now);
  clock_.start(now);
  phase_ = hosted_ != 0 ? SessionPhase::playing : SessionPhase::watching;
  for (int p = 0; p < players(); ++p) {
    if (seats_[p].is_taken && (is_local(p) || seats_[p].link >= 0)) seats_[p].is_open = true;
  }
  has_wish_ = wished_.speed != Tempo::kNormal;
  tell_started();
}

void HostCore::receive(PeerId peer, Channel channel, Bytes bytes, Time now) {
  if (peer >= guests_.size() || !guests_[peer].is_connected) {
    ++stats_.refused;
    return;
  }
  Guest& guest = guests_[peer];
  if (channel == Channel::datagram) {
    Packet packet;
    if (!accept_datagram(guest, bytes, now, packet)) return;
    if (guest.stage == Guest::Stage::receives_snapshot && packet.header.match == match_) {
      guest.set_clock(packet.header, now);
      measure(guest, packet.header, now);
      return;
    }
    if (guest.stage != Guest::Stage::live || packet.header.match != match_) {
      ++stats_.refused;
      return;
    }
    if (now - guest.heard > config_.silence / 2) guest.back_at = now;
    guest.heard = now;
    guest.has_spoken = true;
    renew_lease(guest, packet.header, now);
    take_packet(guest, packet, now);
    return;
  }
  if (!accept_message(guest, bytes, now)) return;
  const MessageKind kind = message_kind(bytes).value();
  if (kind == MessageKind::hello && !has_start_) {
    guest.must_close = true;  // nothing was driven here yet: let it come again
  } else if (kind == MessageKind::hello && guest.stage == Guest::Stage::connected) {
    guest.heard = now;
    greet(guest, bytes);
  } else if (kind == MessageKind::farewell && bytes.size() == 1) {
    guest.lease_from = 0;
  } else if (kind == MessageKind::progress && receives_snapshot(guest)) {
    take_progress(guest, bytes, now);
  } else if (kind == MessageKind::enrolled && guest.stage == Guest::Stage::live) {
    if (const Result<std::uint32_t> version = read_enrolled(bytes)) guest.enrolled = version.value();
    else ++stats_.refused;
  } else if ((kind == MessageKind::propose || kind == MessageKind::vote) && guest.stage == Guest::Stage::live) {
    take_vote(guest, kind, bytes);
  } else if (kind == MessageKind::ask && guest.stage == Guest::Stage::live) {
    take_ask(guest, bytes);
  } else if (kind == MessageKind::ready && guest.stage == Guest::Stage::live) {
    guest.heard = now;
    guest.is_ready = true;
  } else if (!take_repair(guest, kind, bytes)) {
    ++stats_.refused;
  }
}

void HostCore::take_packet(Guest& guest, const Packet& packet, Time now) {
  keep_seats(guest);
  take_header(guest, packet.header, now);
  if (guest.repair.stage == RepairService::Stage::receives) measure(guest, packet.header, now);
  // Nobody has final states that we have not: all inputs pass through us.
  if (packet.header.report.frame <= known_end()) {
    const Frame after = guest.player < 0 ? kNoFrame : views_[guest.player].after;
    const bool is_newest = packet.header.report.frame > guest.report.frame && packet.header.report.frame > after;
    if (is_newest) guest.report = packet.header.report;
    if (guest.player >= 0) take_hash(static_cast<std::size_t>(guest.player), packet.header.report);
  } else {
    ++stats_.refused;
  }
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) take_inputs(guest, packet.slices[i], now);
}

void HostCore::take_inputs(Guest& guest, const InputSlice& slice, Time now) {
  if (slice.player >= players() || !has(guest, slice.player) || !seats_[slice.player].is_open) return;
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
    if (frame >= current() + bounded(kMostAhead)) return;
    if (!noted) note_arrival(slice.player, stream.end(), now);
    noted = true;
    seats_[slice.player].is_late = false;
    stream.append(entry);
  }
  if (!noted) note_replaced(slice, now);
  if (reader.failed()) ++stats_.refused;
}

Frame HostCore::horizon() const {
  return hosted_ == 0 ? current() + 1 : streams_[static_cast<std::size_t>(local_player())].end();
}

Frame HostCore::sends_until(int player, const PeerLink& link) const {
  const Guest& guest = static_cast<const Guest&>(link);
  const Frame end = streams_[static_cast<std::size_t>(player)].end(), shown = shown_until(guest);
  if (has(guest, player)) return seats_[player].is_open ? seats_[player].replaced_end : end;
  return shown < end ? shown : end;
}

void HostCore::before_steps(Time now) {
  if (started_ && !is_paused()) turn_rate_.turn(now, pace_.most_steps(kDueSteps), clock_.nominal());
  if (!started_ && (all_are_here() || must_start_)) begin(now);
  if (!started_ && is_resumed()) serve_snapshots();
  if (now >= next_tending_) {
    next_tending_ = now + clock_.period();
    tend_guests(now);
  }
  for (Guest& guest : guests()) {
    if (guest.is_connected && guest.is_ready) open_seats(guest, now);
  }
  reports_count_ = now >= reports_from_;
  grant_tempo();
  // Before guesses are compared: a seat that was closed during the last frame was guessed otherwise.
  if (started_) {
    fill_absent();
    replace_late(now);
  }
}

void HostCore::tend_guests(Time now) {
  tend_places(now);
  stats_.peers = 0;
  for (Guest& guest : guests()) {
    if (!guest.is_connected) continue;
    ++stats_.peers;
    if (now - guest.heard > config_.silence) {
      guest.must_close = true;
      close_seats(guest);
    }
    judge_acknowledgements(guest, now);
    guest.most_burst = is_in_match(guest) ? PeerLink::kPlayersBurst : PeerLink::kBurst;
    const bool receives = guest.stage == Guest::Stage::receives_snapshot;
    bool lags = false;  // inputs that it lacks have fallen out of the log
    for (int p = 0; p < players(); ++p) {
      const Frame lacks = receives ? guest.start : guest.acked[p];
      lags = lags || lacks < streams_[static_cast<std::size_t>(p)].begin();
    }
    if (receives && lags) guest.must_close = true;  // others may wait for a newer one
    if (guest.stage == Guest::Stage::live && lags) {
      close_seats(guest);
      guest.stage = Guest::Stage::needs_snapshot;
      guest.must_welcome = true;
      guest.must_open = guest.is_ready = false;
      guest.repair = RepairService{.next = guest.repair.next};
      guest.opens = kNoFrame;
    }
    tend_repair(guest, now);
    answer_asks(guest, now);
  }
  tend_ballot(now);
  keep_roster();
  tend_inquiry(now);
  judge_lines(now);
  choose_pace(now);
  keep_figures(now);
}

void HostCore::before_frame(Time now) {
  fill_absent();
  replace_late(now);
}

void HostCore::fill_absent() {
  if (!tenure_.is_backed()) return;
  for (int p = 0; p < players(); ++p) {
    if (is_guests(p) && !seats_[p].is_open) streams_[static_cast<std::size_t>(p)].append_absent_until(horizon());
  }
}

void HostCore::blocked(Time now) {
  if (blocked_since_ == 0) blocked_since_ = charged_at_ = now;
  std::uint32_t missing = 0;
  for (int p = 0; p < players(); ++p) {
    if (streams_[static_cast<std::size_t>(p)].end() == known_end()) missing |= 1u << p;
  }
  if (now - blocked_since_ >= kTellBlocked) stands_for(missing);
  charge(now);
}

void HostCore::charge(Time now) {
  const Time passed = now - charged_at_;
  charged_at_ = now;
  if (now - began_ < kFreeStart || !tenure_.is_backed()) return;
  for (int p = 0; p < players(); ++p) {
    Seat& seat = seats_[p];
    if (is_local(p) || !seat.is_open || streams_[static_cast<std::size_t>(p)].end() > current()) continue;
    seat.lost.spend(passed, now);  // each in full: several who are silent at once cost the time of one
    if (seat.lost.spent(now) < config_.patience) continue;
    leave_out(guests_[static_cast<std::size_t>(seat.link)], now);
  }
}

void HostCore::unblocked(Time) {
  blocked_since_ = 0;
  goes_on();
}

}  // namespace isostep
