// The client on its way into the match: the connection, the host's answer, snapshots, the seat.
// SPDX-License-Identifier: MIT
#include <bit>

#include "isostep/session/client/client_core.hpp"

namespace isostep {
namespace {
int seats_wished(const SessionConfig& config) { return config.local_players > 1 ? config.local_players : 1; }
}  // namespace

ClientCore::ClientCore(const SessionConfig& config, const InputRules& rules)
    : PeerCore(config, rules), failover_{parts_, log_, HostSearch(config.token), message_} {
  if (config.migration > 0)
    failover_.callers().make_room(static_cast<std::size_t>(config.max_peers + config.max_strangers));
}

void ClientCore::connected(PeerId host, Time now) {
  if (host_.is_connected && host_.peer != host) leave_host();  // of two that were asked for, the later
  host_ = PeerLink{};
  host_.peer = host;
  host_.connect(now);
  due_.add(MessageKind::hello);
  due_.drop(MessageKind::ready);
  wishes_.forget();
  end_ballot(ballot_, current(), events_);
  tempos_.forget();
  failover_.is_connected();
  // The greeting names the state that we go on from.
  standing_ = Standing::unknown;
  own_.stop_asking();
  repair_.leave();
  repair_.inquire(kNoFrame);
  entry_.leave();
  if (phase_ == SessionPhase::lost || phase_ == SessionPhase::refused) phase_ = SessionPhase::waiting;
}

void ClientCore::disconnected(PeerId peer, Time now) {
  failover_.callers().disconnected(peer);
  if (!is_host(peer)) return;
  host_.is_connected = false;
  lose(now, now - host_.heard <= config_.migration / 2);
}

void ClientCore::leave_host() { partings_.leave(host_, is_greeted() || failover_.search().is_under_way()); }

void ClientCore::lose(Time now, bool knocks) {
  leave_host();
  if (is_greeted()) standing_ = Standing::greeted;
  const bool seeks = failover_.search().is_under_way() && !failover_.search().election().has_given_up();
  if (seeks) failover_.search().election().was_turned_away(now);
  if (phase_ == SessionPhase::refused || seeks) return;
  if (failover_.can_begin()) failover_.begin(now, knocks);
  else parts_.fail(SessionEvent::Kind::lost_host, SessionPhase::lost);
}

void ClientCore::receive(PeerId host, Channel channel, Bytes bytes, Time now) {
  if (!is_host(host)) {
    failover_.receive_call(host, channel, bytes, now);
    return;
  }
  if (channel == Channel::datagram) {
    Packet packet;
    if (!datagrams_.accept(host_, bytes, now, packet)) return;
    if (!is_greeted() || packet.header.match != match() || !is_of(packet.header, players())) {
      ++stats_.refused;
      return;
    }
    host_.heard = now;
    if (entry_.is_restoring()) host_.set_clock(packet.header, now);
    if (!entry_.is_under_way()) take_packet(packet, now);
    return;
  }
  // A snapshot's pieces come as fast as the transport brings them.
  const Result<MessageKind> kind = message_kind(bytes);
  if (kind && kind.value() == MessageKind::piece) {
    stats_.bytes_in += bytes.size();
  } else if (!datagrams_.accept_message(host_, bytes, now)) {
    return;
  }
  if (take_message(kind.value(), bytes, now)) host_.heard = now;
  else ++stats_.refused;
}

bool ClientCore::take_message(MessageKind kind, Bytes bytes, Time now) {
  if (kind == MessageKind::welcome) {
    const Result<Welcome> welcome = read_welcome(bytes);
    if (welcome) take_welcome(welcome.value(), now);
    return welcome.ok();
  }
  if (kind == MessageKind::refuse) {
    const Result<Refusal> refusal = read_refusal(bytes);
    if (!refusal) return false;
    SessionEvent event{.kind = SessionEvent::Kind::refused};
    event.field = refusal.value();
    tell(event);
    phase_ = SessionPhase::refused;
    standing_ = Standing::unknown;
    entry_.leave();
    failover_.search().election().end();
    return true;
  }
  if (kind == MessageKind::piece && (entry_.is_restoring() || repair_.receives())) {
    const Result<Piece> piece = read_piece(bytes);
    if (!piece) return false;
    if (arrival_.take(piece.value())) entry_.has_pieces();
    else ++stats_.refused;
    return true;
  }
  if (kind == MessageKind::open && is_greeted() && own_.players() != 0) {
    const Result<Frame> first = read_open(bytes);
    if (!first) return false;
    if (entry_.is_under_way()) entry_.keep_opened(first.value());
    else if (!own_.open(first.value(), config_.history / 2)) ++stats_.refused;
    return true;
  }
  if (kind == MessageKind::ballot && is_greeted()) {
    const Result<Ballot> ballot = read_ballot(bytes);
    if (!ballot || !ballot.value().is_of(players())) return false;
    ballot_ = ballot.value();
    tell(event_of(ballot_, current()));
    return true;
  }
  if (kind == MessageKind::farewell && is_greeted() && bytes.size() == 1) {
    leave_host();
    lose(now, false);
    return true;
  }
  return failover_.receive(kind, bytes, may_stand(), now) || comparison_.receive(kind, bytes);
}

void ClientCore::take_welcome(const Welcome& welcome, Time now) {
  if (welcome.term != 0 && !failover_.search().election().may_follow(welcome.term)) {
    // We support another, or did: whoever is the host of an earlier term learns by our hello that it is over.
    leave_host();
    lose(now, false);
    return;
  }
  const int seats = config_.mode == SessionMode::spectator ? 0 : seats_wished(config_);
  if (!entry_.fits(welcome, hashes_.settled()) || welcome.players != players() ||
      welcome.snapshot_size > config_.snapshot_cap || std::popcount(welcome.seated()) != seats) {
    standing_ = Standing::unknown;
    entry_.leave();
    failover_.search().election().end();
    leave_host();
    parts_.fail(SessionEvent::Kind::refused, SessionPhase::refused);
    return;
  }
  log_.follow(welcome, failover_.search().election().log_term());
  repair_.leave();
  own_.sit(welcome.seated());
  entry_.begin(welcome);
  standing_ = Standing::greeted;
  due_.drop(MessageKind::ready);
  failover_.search().is_welcome(welcome);
  failover_.end();
  phase_ = SessionPhase::joining;
}

void ClientCore::write_own_hello() {
  Hello hello;
  hello.spectator = config_.mode == SessionMode::spectator;
  hello.seat = config_.seat;
  hello.seats = seats_wished(config_);
  hello.token = token();
  hello.life = failover_.search().life();
  hello.term = failover_.search().election().term();
  hello.migration = config_.migration;
  entry_.describe(hashes_.settled(), hello);
  hello.credential = config_.credential;
  hello.address = config_.address;
  hello.identity = config_.identity;
  write_hello(hello, message_);
}

void ClientCore::restored(bool ok) {
  if (ok) return;
  standing_ = Standing::unknown;
  repair_.leave();
  leave_host();
  entry_.spoil();
  parts_.fail(SessionEvent::Kind::bad_snapshot, SessionPhase::refused);
}

void ClientCore::hash_known(Frame state, std::uint64_t hash) {
  if (has_start_ && entry_.is_restored_by(state)) {
    if (!entry_.has_hash(hash)) {
      restored(false);
      return;
    }
    hashes_.restart(entry_.welcome().start, hash);
    confirmed_state_ = state;
  } else if (repair_.restores() && state == repair_.offer().start.frame) {
    finish_repair(hash);
  } else if (!entry_.is_spoiled()) {
    PeerCore::hash_known(state, hash);
  }
}

void ClientCore::restore(Frame frame) {
  act(RequestKind::restore, frame);
  timeline_.restart(frame);
  act(RequestKind::save, frame);
}

void ClientCore::begin() {
  const Welcome& welcome = entry_.welcome();
  const Frame frame = welcome.start.frame;
  entry_.was_begun();
  if (entry_.is_restoring()) {
    restore(frame);
  } else {
    go_back(frame);
  }
  own_.begin_at(frame);
  log_.begin_at(frame);
  for (std::size_t machine = 0; machine < kMachines; ++machine) views_.was_repaired(machine, kNoFrame);
  distance_.restart();
  if (entry_.opened() != kNoFrame && !own_.open(entry_.opened(), config_.history / 2)) ++stats_.refused;
  // What was ours before is told to us, and compared: see OwnSeats::take.
  if (welcome.opens != kNoFrame) own_.go_on_from(welcome.opens);
}

}  // namespace isostep
