// The host: seats, the log of inputs, snapshots for late joiners.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Frame kMostAhead = 128;                  // [frames] beyond ours that a client's input may lie
constexpr Frame kNotice = 30;                      // [frames] between a seat's opening and its first frame
constexpr Time kTellBlocked = kSecond / 4;         // [us] before a wait is worth an event
constexpr std::size_t kPiece = kReliableCap - 64;  // [bytes] of a snapshot in one message

std::uint64_t draw64(Pcg32& random) {
  const std::uint64_t high = random.next();
  return high << 32 | random.next();
}

}  // namespace

HostCore::HostCore(const SessionConfig& config, const InputRules& rules)
    : PeerCore(config, rules),
      guests_(static_cast<std::size_t>(config.max_peers)),
      random_(Pcg32::seeded(config.seed)),
      match_(static_cast<std::uint16_t>(random_.next())) {
  for (int p = 0; p < config.local_players; ++p) seats_[p] = {true, -1, 0, true};
  for (std::size_t i = 0; i < guests_.size(); ++i) guests_[i].peer = static_cast<PeerId>(i);
}

void HostCore::connected(PeerId peer, Time now) {
  if (peer >= guests_.size()) return;
  Guest& guest = guests_[peer];
  if (guest.is_connected) drop(guest);
  guest = Guest{};
  guest.peer = peer;
  guest.is_connected = true;
  guest.heard = now;
  guest.datagrams.start(now);
  guest.messages.start(now);
}

void HostCore::disconnected(PeerId peer, Time) {
  if (peer < guests_.size() && guests_[peer].is_connected) drop(guests_[peer]);
}

void HostCore::start(Time now) {
  if (started_ || !has_start_) return;
  started_ = true;
  clock_.start(now);
  phase_ = config_.local_players > 0 ? SessionPhase::playing : SessionPhase::watching;
  for (int p = 0; p < players(); ++p) {
    if (seats_[p].is_taken) seats_[p].is_open = true;
  }
  SessionEvent event{.kind = SessionEvent::Kind::started, .frame = 0};
  tell(event);
}

// --- who comes and goes ---

void HostCore::receive(PeerId peer, Channel channel, Bytes bytes, Time now) {
  if (peer >= guests_.size() || !guests_[peer].is_connected) {
    ++stats_.refused;
    return;
  }
  Guest& guest = guests_[peer];
  if (channel == Channel::datagram) {
    Packet packet;
    if (!accept_datagram(guest, bytes, now, packet)) return;
    if (guest.stage != Guest::Stage::live || packet.header.match != match_) {
      ++stats_.refused;
      return;
    }
    guest.heard = now;
    take_packet(guest, packet, now);
    return;
  }
  if (!accept_message(guest, bytes, now)) return;
  const MessageKind kind = message_kind(bytes).value();
  if (kind == MessageKind::hello && guest.stage == Guest::Stage::connected && has_start_) {
    guest.heard = now;
    greet(guest, bytes, now);
  } else if (kind == MessageKind::progress && guest.stage == Guest::Stage::receives_snapshot) {
    const Result<std::uint32_t> arrived = read_progress(bytes);
    if (arrived && arrived.value() > guest.arrived && arrived.value() <= guest.sent) {
      guest.arrived = arrived.value();
      guest.heard = now;
    } else {
      ++stats_.refused;
    }
  } else if (kind == MessageKind::progress && guest.stage == Guest::Stage::live) {
    guest.heard = now;  // of the last pieces
  } else if (kind == MessageKind::ready && guest.stage == Guest::Stage::live) {
    guest.heard = now;
    open_seat(guest, now);
  } else {
    ++stats_.refused;
  }
}

void HostCore::refuse(Guest& guest, std::string_view key, std::string_view theirs, std::string_view ours) {
  guest.stage = Guest::Stage::refused;
  guest.refusal = {ShortText<kReplayKeyCap>(key), ShortText<kReplayValueCap>(theirs), ShortText<kReplayValueCap>(ours)};
  ++stats_.refused;
  SessionEvent event{.kind = SessionEvent::Kind::refused};
  event.field = guest.refusal;
  tell(event);
}

bool HostCore::is_refused(Guest& guest, const Hello& hello) {
  const HeaderMismatch mismatch = compare_headers(hello.identity, config_.identity);
  if (!mismatch.key.empty()) {
    refuse(guest, mismatch.key.view(), mismatch.in_file.view(), mismatch.here.view());
    return true;
  }
  const bool is_start = hello.have.frame == 0 && roots_.has_chain(0);
  if (!started_ && (!is_start || hello.have.chain != roots_.chain(0))) {
    ShortText<kReplayValueCap> theirs, ours;
    refuse(guest, "start", theirs.append_hex(hello.have.chain).view(), ours.append_hex(roots_.chain(0)).view());
    return true;
  }
  if (!hello.spectator && find_seat(hello) < 0) {
    refuse(guest, "seats", "one more", "all taken");
    return true;
  }
  return false;
}

int HostCore::find_seat(const Hello& hello) const {
  for (int p = config_.local_players; p < players(); ++p) {
    if (hello.token != 0 && seats_[p].is_taken && seats_[p].token == hello.token) return p;
  }
  for (int p = config_.local_players; p < players(); ++p) {
    if (!seats_[p].is_taken) return p;
  }
  for (int p = config_.local_players; p < players(); ++p) {
    if (seats_[p].link < 0) return p;  // its player is away
  }
  return -1;
}

void HostCore::greet(Guest& guest, Bytes message, Time now) {
  const Result<Hello> read = read_hello(message);
  if (!read) {
    refuse(guest, read.error().place.view(), "unreadable", read.error().message.view());
    return;
  }
  const Hello& hello = read.value();
  if (is_refused(guest, hello)) return;
  if (!hello.spectator) {
    const int player = find_seat(hello);
    Seat& seat = seats_[player];
    if (seat.link >= 0) {  // the same player, from a new address
      Guest& old = guests_[static_cast<std::size_t>(seat.link)];
      unseat(old);
      old.must_close = true;
    }
    seat = {true, static_cast<int>(guest.peer), draw64(random_) | 1u, false, seat.owed};
    guest.player = player;
  }
  guest.must_welcome = true;
  const Frame have = hello.have.frame;
  bool has_inputs = roots_.has_chain(have) && roots_.chain(have) == hello.have.chain;
  for (const InputStream& stream : streams_) has_inputs = has_inputs && stream.begin() <= have;
  if (has_inputs) {
    go_live(guest, have);
    if (!started_ && guest.player >= 0) guest.opens = 0;
  } else {
    guest.stage = Guest::Stage::needs_snapshot;
  }
  bool all_taken = true;
  for (int p = 0; p < players(); ++p) all_taken = all_taken && seats_[p].is_taken;
  if (all_taken) start(now);
}

void HostCore::go_live(Guest& guest, Frame start) {
  guest.stage = Guest::Stage::live;
  guest.start = start;
  for (Frame& acked : guest.acked) acked = start;
}

void HostCore::open_seat(Guest& guest, Time) {
  if (guest.player < 0 || seats_[guest.player].is_open || !started_) return;
  InputStream& stream = streams_[static_cast<std::size_t>(guest.player)];
  const Frame trip = static_cast<Frame>(2 * guest.round_trip / clock_.period());
  // From the horizon, not from what was granted before: who comes and goes must not push its stream out of the log.
  const Frame earliest = horizon() + bounded(kNotice + (trip < 10 * kNotice ? trip : 10 * kNotice));
  guest.opens = stream.end() > earliest ? stream.end() : earliest;
  stream.append_absent_until(guest.opens);
  guest.must_open = true;
  seats_[guest.player].is_open = true;
}

void HostCore::close_seat(int player) {
  Seat& seat = seats_[player];
  if (!seat.is_open) return;
  seat.is_open = false;
  if (!started_) return;
  slack_[player] = RecentLeast{};
}

void HostCore::unseat(Guest& guest) {
  if (guest.player < 0) return;
  close_seat(guest.player);
  seats_[guest.player].link = -1;
  views_[guest.player] = View{};
  if (!started_) seats_[guest.player] = Seat{};
  guest.player = -1;
}

void HostCore::drop(Guest& guest) {
  unseat(guest);
  const PeerId peer = guest.peer;
  guest = Guest{};
  guest.peer = peer;
}

// --- inputs ---

void HostCore::take_packet(Guest& guest, const Packet& packet, Time now) {
  guest.set_clock(packet.header, now);
  guest.frame = packet.header.frame;
  take_acks(guest, packet.header);
  // Nobody has final states that we have not: all inputs pass through us.
  if (packet.header.root.frame <= known_end()) {
    if (packet.header.root.frame > guest.root.frame) guest.root = packet.header.root;
    if (guest.player >= 0) hear_root(static_cast<std::size_t>(guest.player), packet.header.root);
  } else {
    ++stats_.refused;
  }
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) take_inputs(guest, packet.slices[i], now);
}

void HostCore::take_inputs(Guest& guest, const InputSlice& slice, Time now) {
  if (slice.player != guest.player || !seats_[guest.player].is_open) return;
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
    if (!noted) note_arrival(slice.player, now);
    noted = true;
    stream.append(entry);
  }
  if (reader.failed()) ++stats_.refused;
}

Frame HostCore::horizon() const { return config_.local_players > 0 ? streams_[0].end() : current() + 1; }

bool HostCore::sends(int player, const Link& link) const {
  const Guest& guest = static_cast<const Guest&>(link);
  return player != guest.player || !seats_[player].is_open;
}

// --- time ---

void HostCore::before_steps(Time now) {
  for (Guest& guest : guests_) {
    if (!guest.is_connected) continue;
    if (now - guest.heard > config_.silence) {
      guest.must_close = true;
      if (guest.player >= 0) close_seat(guest.player);
    }
    const bool receives = guest.stage == Guest::Stage::receives_snapshot;
    bool lags = false;  // inputs that it lacks have fallen out of the log
    for (int p = 0; p < players(); ++p) {
      const Frame lacks = receives ? guest.start : guest.acked[p];
      lags = lags || lacks < streams_[static_cast<std::size_t>(p)].begin();
    }
    if (receives && lags) guest.must_close = true;  // others may wait for a newer one
    if (guest.stage == Guest::Stage::live && lags) {
      if (guest.player >= 0) close_seat(guest.player);
      guest.stage = Guest::Stage::needs_snapshot;
      guest.must_welcome = true;
      guest.opens = kNoFrame;
    }
  }
  // Before guesses are compared: a seat that was closed during the last frame was guessed otherwise.
  if (started_) fill_absent();
}

void HostCore::before_frame(Time) { fill_absent(); }

void HostCore::fill_absent() {
  for (int p = config_.local_players; p < players(); ++p) {
    if (!seats_[p].is_open) streams_[static_cast<std::size_t>(p)].append_absent_until(horizon());
  }
}

void HostCore::observe_delay() {
  Frame least = RecentLeast::kNothing;
  Time farthest = 0;
  for (const Guest& guest : guests_) {
    if (guest.stage != Guest::Stage::live || guest.player < 0 || !seats_[guest.player].is_open) continue;
    if (guest.round_trip > farthest) farthest = guest.round_trip;
    for (int p = 0; p < config_.local_players; ++p) {
      if ((guest.reported_mask >> p & 1) != 0 && guest.slack[p] < least) least = guest.slack[p];
    }
  }
  stats_.round_trip = farthest;
  if (least != RecentLeast::kNothing) delay_.observe(least);
}

void HostCore::blocked(Time now) {
  if (blocked_since_ == 0) blocked_since_ = charged_at_ = now;
  const Time waited = now - blocked_since_;
  std::uint32_t missing = 0;
  for (int p = 0; p < players(); ++p) {
    if (streams_[static_cast<std::size_t>(p)].end() == known_end()) missing |= 1u << p;
  }
  if (waited >= kTellBlocked && !told_blocked_) {
    told_blocked_ = true;
    SessionEvent event{.kind = SessionEvent::Kind::waiting_for};
    event.players = missing;
    event.frame = current();
    tell(event);
  }
  charge(now);
}

void HostCore::charge(Time now) {
  const Time passed = now - charged_at_;
  const Time ran = static_cast<Time>(current() - charged_frame_) * clock_.period();
  charged_at_ = now;
  charged_frame_ = current();
  for (int p = config_.local_players; p < players(); ++p) {
    Time& owed = seats_[p].owed;
    owed = owed > ran ? owed - ran : 0;
    if (!seats_[p].is_open || streams_[static_cast<std::size_t>(p)].end() > current()) continue;
    owed += passed;
    if (owed >= config_.patience) close_seat(p);
  }
}

void HostCore::unblocked(Time) {
  blocked_since_ = 0;
  if (!told_blocked_) return;
  told_blocked_ = false;
  SessionEvent event{.kind = SessionEvent::Kind::resumed};
  event.frame = current();
  tell(event);
}

// --- snapshots and sending ---

void HostCore::serve_snapshots() {
  bool wanted = false, in_use = false;
  for (const Guest& guest : guests_) {
    wanted = wanted || guest.stage == Guest::Stage::needs_snapshot;
    in_use = in_use || guest.stage == Guest::Stage::receives_snapshot;
  }
  if (!wanted) return;
  // One of this second serves everybody: who comes again and again costs no more than that.
  const RootReport now = roots_.settled();
  if (snapshot_.frame == kNoFrame || now.frame - snapshot_.frame > bounded(config_.hz)) {
    if (in_use) return;
    // A state that is final: the present one may rest on guesses.
    snapshot_ = now;
    snapshot_root_ = roots_.root(now.frame);
    act(RequestKind::capture, now.frame);
  }
  for (Guest& guest : guests_) {
    if (guest.stage != Guest::Stage::needs_snapshot) continue;
    guest.stage = Guest::Stage::receives_snapshot;
    guest.start = snapshot_.frame;
    guest.sent = guest.arrived = 0;
  }
}

std::optional<Outgoing> HostCore::poll_send(Time now) {
  for (std::size_t i = 0; i < guests_.size(); ++i) {
    Guest& guest = guests_[next_guest_];
    next_guest_ = (next_guest_ + 1) % guests_.size();
    if (!guest.is_connected) continue;
    if (std::optional<Outgoing> out = next_message(guest)) {
      next_guest_ = guest.peer;  // all of its messages, in order
      return out;
    }
    if (std::optional<Outgoing> out = next_datagram(guest, now)) return out;
  }
  return std::nullopt;
}

std::optional<Outgoing> HostCore::next_message(Guest& guest) {
  const auto message = [&] {
    stats_.bytes_out += message_.size();
    return Outgoing{guest.peer, Channel::reliable, message_};
  };
  if (guest.stage == Guest::Stage::refused && !guest.must_close) {
    guest.must_close = true;
    write_refusal(guest.refusal, message_);
    return message();
  }
  if (guest.must_close) {
    const PeerId peer = guest.peer;
    drop(guest);
    return Outgoing{peer, Channel::reliable, {}, true};
  }
  const bool sending = guest.stage == Guest::Stage::receives_snapshot;
  if (sending && portable_.empty()) {  // the game has no portable form
    unseat(guest);
    refuse(guest, "snapshot", "needed", "none");
    return next_message(guest);
  }
  if (guest.must_welcome && (sending || guest.stage == Guest::Stage::live)) {
    guest.must_welcome = false;
    Welcome welcome;
    welcome.match = match_;
    welcome.players = static_cast<std::uint8_t>(players());
    welcome.host_players = static_cast<std::uint8_t>(config_.local_players);
    welcome.player = guest.player < 0 ? 0xff : static_cast<std::uint8_t>(guest.player);
    welcome.token = guest.player < 0 ? 0 : seats_[guest.player].token;
    welcome.start = sending ? snapshot_ : RootReport{guest.start, roots_.chain(guest.start)};
    welcome.root = sending ? snapshot_root_ : roots_.root(guest.start);
    guest.size = welcome.snapshot_size = sending ? static_cast<std::uint32_t>(portable_.size()) : 0;
    welcome.opens = guest.opens;
    write_welcome(welcome, message_);
    return message();
  }
  if (sending && guest.sent < guest.size && guest.sent - guest.arrived < kSnapshotFlight) {
    const std::size_t rest = guest.size - guest.sent;
    const Bytes bytes = Bytes(portable_).subspan(guest.sent, rest < kPiece ? rest : kPiece);
    write_piece({guest.sent, bytes}, message_);
    guest.sent += static_cast<std::uint32_t>(bytes.size());
    if (guest.sent == guest.size) go_live(guest, guest.start);
    return message();
  }
  if (guest.must_open) {
    guest.must_open = false;
    write_open(guest.opens, message_);
    return message();
  }
  return std::nullopt;
}

std::optional<Outgoing> HostCore::next_datagram(Guest& guest, Time now) {
  if (guest.stage != Guest::Stage::live) return std::nullopt;
  if (!guest.may_send(current(), clock_.period(), now)) return std::nullopt;
  PacketHeader header;
  header.match = match_;
  header.started = started_;
  // A closed seat acknowledges nothing: its frames are not the player's, who would take its own for accepted.
  if (guest.player >= 0 && seats_[guest.player].is_open) {
    const auto p = static_cast<std::size_t>(guest.player);
    header.ack_mask = static_cast<std::uint8_t>(1u << p);
    header.ack[p] = streams_[p].end();
    Frame slack = slack_[p].value();
    for (const Guest& other : guests_) {
      const bool counts = other.stage == Guest::Stage::live && other.player >= 0 && seats_[other.player].is_open;
      if (counts && (other.reported_mask >> p & 1) != 0 && other.slack[p] < slack) slack = other.slack[p];
    }
    header.slack[p] = static_cast<std::int8_t>(slack);
  }
  // One other machine's word on its states with every datagram, in turns.
  for (std::size_t i = 0; i < guests_.size(); ++i) {
    guest.next_reporter = (guest.next_reporter + 1) % guests_.size();
    const Guest& other = guests_[guest.next_reporter];
    if (&other == &guest || other.player < 0 || other.root.frame == kNoFrame) continue;
    header.reporter = static_cast<std::uint8_t>(other.player);
    header.passed_on = other.root;
    break;
  }
  return Outgoing{guest.peer, Channel::datagram, compose(guest, header, now)};
}

}  // namespace isostep
