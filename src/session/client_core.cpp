// The client: greeting, joining, keeping step with the host.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_core.hpp"

#include <cstring>

namespace isostep {
namespace {

constexpr Frame kCatchUpBehind = 6;  // [frames] behind the host at which frames are stepped as fast as they can be
constexpr int kCatchUpSteps = 6;     // in one advance
constexpr Frame kCaughtUp = 3;       // [frames]

}  // namespace

ClientCore::ClientCore(const SessionConfig& config, const InputRules& rules) : PeerCore(config, rules) {}

// --- the connection ---

void ClientCore::connected(PeerId host, Time now) {
  host_ = Link{};
  host_.peer = host;
  host_.is_connected = true;
  host_.heard = now;
  host_.datagrams.start(now);
  host_.messages.start(now);
  must_greet_ = true;
  must_close_ = is_greeted_ = must_ready_ = asked_ready_ = false;
  runs_ = is_restoring_ = must_begin_ = false;  // the greeting names the state that we go on from
  if (phase_ == SessionPhase::lost) phase_ = SessionPhase::waiting;
}

void ClientCore::disconnected(PeerId host, Time now) {
  if (host_.is_connected && host == host_.peer) lose(now);
}

void ClientCore::lose(Time) {
  host_.is_connected = false;
  runs_ = false;
  if (phase_ == SessionPhase::refused) return;
  fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
}

void ClientCore::fail(SessionEvent::Kind kind, SessionPhase phase) {
  phase_ = phase;
  SessionEvent event{.kind = kind};
  event.frame = current();
  tell(event);
}

void ClientCore::receive(PeerId host, Channel channel, Bytes bytes, Time now) {
  if (!host_.is_connected || host != host_.peer) {
    ++stats_.refused;
    return;
  }
  if (channel == Channel::datagram) {
    Packet packet;
    if (!accept_datagram(host_, bytes, now, packet)) return;
    if (!is_greeted_ || packet.header.match != welcome_.match) {
      ++stats_.refused;
      return;
    }
    host_.heard = now;
    if (!is_restoring_ && !must_begin_) take_packet(packet, now);
    return;
  }
  // A snapshot's pieces come as fast as the transport brings them.
  const Result<MessageKind> kind = message_kind(bytes);
  if (kind && kind.value() == MessageKind::piece) {
    stats_.bytes_in += bytes.size();
  } else if (!accept_message(host_, bytes, now)) {
    return;
  }
  take_message(kind.value(), bytes, now);
}

void ClientCore::take_message(MessageKind kind, Bytes bytes, Time now) {
  bool good = false;
  if (kind == MessageKind::welcome) {
    if (const Result<Welcome> welcome = read_welcome(bytes)) {
      good = true;
      take_welcome(welcome.value(), now);
    }
  } else if (kind == MessageKind::refuse) {
    if (const Result<Refusal> refusal = read_refusal(bytes)) {
      good = true;
      SessionEvent event{.kind = SessionEvent::Kind::refused};
      event.field = refusal.value();
      tell(event);
      phase_ = SessionPhase::refused;
      runs_ = is_greeted_ = false;
    }
  } else if (kind == MessageKind::piece && is_restoring_) {
    if (const Result<Piece> piece = read_piece(bytes)) {
      good = true;
      take_piece(piece.value());
    }
  } else if (kind == MessageKind::open && is_greeted_ && player_ >= 0) {
    if (const Result<Frame> first = read_open(bytes)) {
      good = true;
      if (is_restoring_ || must_begin_) {
        welcome_.opens = first.value();  // once we are there
      } else {
        open(first.value());
      }
    }
  }
  if (good) {
    host_.heard = now;
  } else {
    ++stats_.refused;
  }
}

// --- joining ---

void ClientCore::take_welcome(const Welcome& welcome, Time now) {
  // Without a snapshot we go on from the state that our greeting named, and from no other: others may be gone.
  const RootReport have = roots_.settled();
  const bool has_start = welcome.start.frame == have.frame && welcome.start.chain == have.chain && !is_spoiled_;
  const bool fits = welcome.players == players() && welcome.snapshot_size <= config_.snapshot_cap &&
                    (welcome.player != 0xff) == (config_.mode != SessionMode::spectator);
  if (!fits || (welcome.snapshot_size == 0 && !has_start)) {
    runs_ = is_greeted_ = is_restoring_ = must_begin_ = false;
    must_close_ = true;
    fail(SessionEvent::Kind::refused, SessionPhase::refused);
    return;
  }
  welcome_ = welcome;
  is_greeted_ = true;
  runs_ = is_open_ = asked_ready_ = must_ready_ = false;
  player_ = welcome.player == 0xff ? -1 : welcome.player;
  token_ = welcome.token;
  phase_ = SessionPhase::joining;
  host_frame_at_ = now;
  told_ = 0;
  is_restoring_ = welcome.snapshot_size > 0;
  must_begin_ = !is_restoring_;
  portable_.clear();
}

void ClientCore::take_piece(const Piece& piece) {
  // Memory grows with what has come, not with what was promised.
  if (piece.offset != portable_.size() || piece.bytes.size() > welcome_.snapshot_size - portable_.size()) {
    ++stats_.refused;
    return;
  }
  portable_.insert(portable_.end(), piece.bytes.begin(), piece.bytes.end());
  must_begin_ = portable_.size() == welcome_.snapshot_size;
}

void ClientCore::restored(bool ok) {
  if (ok) return;
  is_restoring_ = runs_ = is_greeted_ = false;
  is_spoiled_ = must_close_ = true;
  fail(SessionEvent::Kind::bad_snapshot, SessionPhase::refused);
}

void ClientCore::root_known(Frame state, std::uint64_t root) {
  if (is_restoring_ && has_start_ && state == welcome_.start.frame) {
    if (root != welcome_.root) {
      restored(false);
      return;
    }
    is_restoring_ = is_spoiled_ = false;
    roots_.restart(welcome_.start, root);
    confirmed_state_ = state;
    return;
  }
  if (!is_spoiled_) PeerCore::root_known(state, root);
}

void ClientCore::begin_at(const RootReport& start) {
  const Frame frame = start.frame;
  if (is_restoring_) {
    act(RequestKind::restore, frame);
    timeline_.restart(frame);
    act(RequestKind::save, frame);
  } else {
    go_back(frame);
  }
  base_ = frame;
  for (InputStream& stream : streams_) stream.reset(frame);
  for (View& view : views_) view = View{};
  for (bool& is_present : is_present_) is_present = false;
  accepted_ = frame;
  clock_.forget_lean();
  if (welcome_.opens != kNoFrame) open(welcome_.opens);
}

void ClientCore::open(Frame first) {
  InputStream& own = streams_[static_cast<std::size_t>(player_)];
  if (is_open_ || first < own.end() || first > own.end() + config_.history / 2) {
    ++stats_.refused;
    return;
  }
  own.append_absent_until(first);
  is_open_ = true;
  opens_ = accepted_ = host_.acked[player_] = first;
  asked_ready_ = false;
}

bool ClientCore::is_vouched_for() const {
  // Until the host says that nobody plays for us, inputs of ours from before are still on their way.
  const InputStream& own = streams_[static_cast<std::size_t>(player_)];
  if (own.end() == own.begin() || !own.last().absent) return false;
  int needed = 1, vouching = views_[kHostMachine].agreed >= base_ ? 1 : 0;
  for (int p = welcome_.host_players; p < players(); ++p) {
    if (p == player_) continue;
    if (!streams_[static_cast<std::size_t>(p)].last().absent) needed = 2;
    if (views_[p].agreed >= base_) ++vouching;
  }
  return vouching >= needed;
}

// --- inputs ---

void ClientCore::take_packet(const Packet& packet, Time now) {
  const PacketHeader& header = packet.header;
  host_.set_clock(header, now);
  stats_.round_trip = host_.round_trip;
  take_acks(host_, header);
  if (player_ >= 0 && is_open_) {
    const Frame acked = host_.acked[player_];
    if (acked > accepted_) accepted_ = acked;
  }
  if (header.frame >= host_.frame) {
    host_.frame = header.frame;
    host_frame_ =
        std::int64_t{header.frame} * 256 + static_cast<std::int64_t>(host_.round_trip / 2 * 256 / clock_.period());
    host_frame_at_ = now;
    if (runs_) lean(now);
  }
  hear_root(kHostMachine, header.root);
  if (header.reporter < players() && header.reporter != player_) hear_root(header.reporter, header.passed_on);
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) take_inputs(packet.slices[i], now);
  if (header.started && !runs_) {
    runs_ = true;
    clock_.start(now);
    SessionEvent event{.kind = SessionEvent::Kind::started};
    event.frame = current();
    tell(event);
  }
}

void ClientCore::take_inputs(const InputSlice& slice, Time now) {
  if (slice.player >= players()) {
    ++stats_.refused;
    return;
  }
  InputStream& stream = streams_[slice.player];
  const bool is_own = slice.player == player_;
  if (slice.first > stream.end()) return;
  SliceReader reader(slice);
  InputEntry entry;
  bool noted = false;
  for (Frame frame = slice.first; reader.next(entry); ++frame) {
    if (!entry.absent && !rules_.valid(entry.bytes)) {
      ++stats_.refused;
      return;
    }
    if (is_own && is_open_ && entry.absent && frame >= opens_ && frame >= accepted_) cut_out(frame);
    if (frame < stream.end()) continue;
    if (is_own && !entry.absent && is_open_) continue;
    if (frame > current() + config_.history / 2) return;
    if (!noted && !is_own) note_arrival(slice.player, now);
    noted = true;
    stream.append(entry);
  }
  if (reader.failed()) ++stats_.refused;
}

void ClientCore::cut_out(Frame frame) {
  streams_[static_cast<std::size_t>(player_)].truncate(frame);
  timeline_.recheck(player_, frame);
  is_open_ = asked_ready_ = false;
}

Frame ClientCore::final_limit() const {
  const Frame limit = PeerCore::final_limit();
  return is_open_ && accepted_ < limit ? accepted_ : limit;
}

// --- time ---

std::int64_t ClientCore::host_position(Time now) const {
  const Time since = now > host_frame_at_ ? now - host_frame_at_ : 0;
  const Time capped = since < kSecond ? since : kSecond;  // a silent host has probably stopped
  return host_frame_ + static_cast<std::int64_t>(capped * 256 / clock_.period());
}

Frame ClientCore::frames_behind(Time now) const { return static_cast<Frame>(host_position(now) / 256 - current()); }

void ClientCore::lean(Time now) {
  const Time until = clock_.until_due(now);
  const Time done = until < clock_.period() ? clock_.period() - until : 0;
  const std::int64_t ours = std::int64_t{current()} * 256 + static_cast<std::int64_t>(done * 256 / clock_.period());
  const std::int64_t ahead = ours - host_position(now);
  constexpr std::int64_t kCap = 256 * 64;
  clock_.lean(static_cast<std::int32_t>(ahead < -kCap ? -kCap : ahead > kCap ? kCap : ahead));
}

int ClientCore::steps_allowed(Time now) const { return frames_behind(now) > kCatchUpBehind ? kCatchUpSteps : 2; }

void ClientCore::before_steps(Time now) {
  if (host_.is_connected && now - host_.heard > config_.silence) {
    must_close_ = true;
    lose(now);
    return;
  }
  if (must_begin_) {
    must_begin_ = false;
    begin_at(welcome_.start);
  }
  if (!runs_ || is_restoring_) return;
  if (frames_behind(now) > kCatchUpBehind) clock_.start(now);
  if (is_open_) {
    if (current() >= opens_) phase_ = SessionPhase::playing;
  } else if (phase_ == SessionPhase::playing) {
    phase_ = SessionPhase::watching;
  }
  const bool is_near = frames_behind(now) <= kCaughtUp + config_.most_delay;
  if (config_.mode == SessionMode::spectator) {
    if (is_near) phase_ = SessionPhase::watching;
  } else if (!is_open_ && !asked_ready_ && is_near && is_vouched_for()) {
    asked_ready_ = must_ready_ = true;
  }
}

void ClientCore::observe_delay() {
  if (is_open_ && phase_ == SessionPhase::playing && (host_.reported_mask >> player_ & 1) != 0 &&
      host_.slack[player_] != RecentLeast::kNothing) {
    delay_.observe(host_.slack[player_]);
  }
}

std::optional<Outgoing> ClientCore::poll_send(Time now) {
  if (must_close_) {
    must_close_ = false;
    host_.is_connected = false;
    return Outgoing{host_.peer, Channel::reliable, {}, true};
  }
  if (!host_.is_connected) return std::nullopt;
  const auto message = [&] {
    stats_.bytes_out += message_.size();
    return Outgoing{host_.peer, Channel::reliable, message_};
  };
  if (must_greet_ && has_start_) {
    must_greet_ = false;
    Hello hello;
    hello.spectator = config_.mode == SessionMode::spectator;
    hello.token = token_;
    hello.have = is_spoiled_ ? RootReport{0, 0} : roots_.settled();
    hello.identity = config_.identity;
    write_hello(hello, message_);
    return message();
  }
  if (is_restoring_ && portable_.size() >= told_ + kSnapshotFlight / 4) {
    told_ = static_cast<std::uint32_t>(portable_.size());
    write_progress(told_, message_);
    return message();
  }
  if (must_ready_) {
    must_ready_ = false;
    write_ready(message_);
    return message();
  }
  if (!is_greeted_ || is_restoring_ || must_begin_) return std::nullopt;
  if (!host_.may_send(current(), clock_.period(), now)) return std::nullopt;
  PacketHeader header;
  header.match = welcome_.match;
  header.started = runs_;
  for (int p = 0; p < players(); ++p) {
    header.ack_mask = static_cast<std::uint8_t>(header.ack_mask | 1u << p);
    header.ack[p] = p == player_ && is_open_ ? accepted_ : streams_[static_cast<std::size_t>(p)].end();
    const bool measures = phase_ == SessionPhase::playing && p != player_;
    header.slack[p] = static_cast<std::int8_t>(measures ? slack_[p].value() : RecentLeast::kNothing);
  }
  return Outgoing{host_.peer, Channel::datagram, compose(host_, header, now)};
}

}  // namespace isostep
