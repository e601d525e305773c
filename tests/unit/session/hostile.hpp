// A small game for tests of sessions, a peer whose words can be bent, and one that says whatever it likes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "isostep/session/session.hpp"
#include "session/virtual_match.hpp"

namespace isostep::hostile {

using Buffer = std::vector<std::uint8_t>;

struct Pad {
  std::int8_t stick = 0;
  std::uint8_t buttons = 0;

  ISO_FIELDS(stick, buttons)
  bool valid() const { return stick >= -100 && stick <= 100; }
  friend bool operator==(const Pad&, const Pad&) = default;
};

/// Every input of every frame leaves its mark for good.
class Game {
 public:
  using Input = Pad;
  struct Snapshot {
    std::uint64_t frame = 0;
    std::uint64_t marks[kMaxPlayers] = {};
  };
  /// `ballast` [bytes] makes portable snapshots long: by default they take several pieces.
  explicit Game(std::size_t ballast = 40000) : ballast_(ballast) {}

  void save(Snapshot& to) const { to = state_; }
  void load(const Snapshot& from) { state_ = from; }
  std::uint64_t hash() const { return hash_bytes(&state_, sizeof state_) ^ (lies ? 0x10u : 0u); }
  void step(InputView<Pad> inputs) {
    for (std::size_t p = 0; p < inputs.size(); ++p) {
      const bool gone = inputs.status(p) == InputStatus::disconnected;
      const auto word = static_cast<std::uint64_t>(inputs[p].stick + 128) << 9 | std::uint64_t{inputs[p].buttons} << 1;
      state_.marks[p] = state_.marks[p] * 6364136223846793005u + (word | (gone ? 1u : 0u)) + state_.frame;
    }
    ++state_.frame;
  }
  void write_portable(Writer& writer) const {
    writer.write(state_.frame);
    writer.write(state_.marks);
    for (std::size_t i = 0; i < ballast_; ++i) writer.write(static_cast<std::uint8_t>(i));
  }
  Result<void> read_portable(Reader& reader) {
    Snapshot read;
    reader.read(read.frame);
    reader.read(read.marks);
    for (std::size_t i = 0; i < ballast_ && reader.ok(); ++i) {
      if (reader.read<std::uint8_t>() != static_cast<std::uint8_t>(i)) reader.fail(ErrorCode::corrupt, "ballast");
    }
    if (reader.ok()) state_ = read;
    return reader.result("game");
  }

  bool lies = false;  // about its states, not in them

 private:
  Snapshot state_;
  std::size_t ballast_;
};

inline Pad bot(int player, Frame frame) {
  const auto word = static_cast<std::uint32_t>(frame / 7 + player * 1000) * 2654435761u;
  return {static_cast<std::int8_t>(static_cast<int>(word >> 24) % 101 - 50), static_cast<std::uint8_t>(word >> 8)};
}

using Match = test::VirtualMatch<Game>;
inline Match make_match(const SessionConfig& config, std::size_t ballast = 40000) {
  return Match(
      config, [ballast] { return std::make_unique<Game>(ballast); }, bot);
}

/// The first word of a client of `config`, as the session itself would say it.
inline Hello hello_of(const SessionConfig& config) {
  Hello hello;
  hello.identity = config.identity;
  hello.migration = config.migration;
  ShortText<kReplayValueCap> schema, players;
  hello.identity.set("input_schema", schema.append_hex(InputCodec<Pad>::schema()).view(), true);
  hello.identity.set("session_hz", "60", true);
  hello.identity.set("players", players.append_number(static_cast<std::uint64_t>(config.players)).view(), true);
  hello.have = {0, Game{}.hash()};
  return hello;
}

/// A connection and no session behind it.
struct Rogue {
  transport::SimulatedNetwork* network;
  transport::EndpointId id;
  transport::SimulatedNetwork::Port port;
  bool is_connected = false, is_refused = false;
  Refusal refusal;
  Welcome welcome;
  bool is_welcome = false;
  Frame opens = kNoFrame;
  std::size_t pieces = 0;
  PeerId peer = 0;                 // the other side of the connection that was made last
  Buffer roster;                   // the newest one's message
  std::optional<Candidate> asked;  // for its support, last
  Frame host_frame = 0;
  Frame ends[kMaxPlayers] = {};  // of the inputs that came last
  HashReport host_report;

  Rogue(Match& match, const transport::NetworkProfile& profile)
      : network(&match.network()), id(network->add_client(profile)), port(network->port(id)) {
    network->connect(id);
  }
  void listen() {
    while (const auto arrival = port.receive()) {
      if (arrival->kind == transport::ArrivalKind::connected) {
        is_connected = true;
        peer = arrival->peer;
      }
      if (arrival->kind == transport::ArrivalKind::disconnected && arrival->peer == peer) is_connected = false;
      if (arrival->kind != transport::ArrivalKind::message) continue;
      if (arrival->channel == Channel::datagram) {
        const Result<Packet> packet = read_packet(arrival->bytes);
        if (!packet) continue;
        host_frame = packet.value().header.frame;
        host_report = packet.value().header.report;
        for (std::uint8_t i = 0; i < packet.value().slice_count; ++i) {
          const InputSlice& slice = packet.value().slices[i];
          ends[slice.player] = slice.first + slice.count;
        }
        continue;
      }
      const Result<MessageKind> kind = message_kind(arrival->bytes);
      if (!kind) continue;
      if (kind.value() == MessageKind::welcome) {
        is_welcome = true;
        welcome = read_welcome(arrival->bytes).value();
        opens = welcome.opens;
      }
      if (kind.value() == MessageKind::open) opens = read_open(arrival->bytes).value();
      if (kind.value() == MessageKind::refuse) {
        is_refused = true;
        refusal = read_refusal(arrival->bytes).value();
      }
      if (kind.value() == MessageKind::piece) ++pieces;
      if (kind.value() == MessageKind::candidate) asked = read_candidate(arrival->bytes).value();
      if (kind.value() == MessageKind::roster) roster.assign(arrival->bytes.begin(), arrival->bytes.end());
    }
  }
  bool say(Channel channel, const Buffer& bytes) { return port.send(peer, channel, bytes).ok(); }
  bool greet(const Hello& hello) {
    Buffer message;
    write_hello(hello, message);
    return say(Channel::reliable, message);
  }
};

/// An honest session whose words pass through `bend` on their way out: it may change, drop, or add to them.
struct BentPeer {
  using Words = std::vector<std::pair<Channel, Buffer>>;

  transport::SimulatedNetwork* network;
  transport::EndpointId id;
  transport::SimulatedNetwork::Port port;
  Session<Game> session;
  Game game;
  std::function<void(Words&)> bend;
  std::vector<SessionEvent> events;

  BentPeer(Match& match, const SessionConfig& config, const transport::NetworkProfile& profile)
      : network(&match.network()), id(network->add_client(profile)), port(network->port(id)), session(config) {
    network->connect(id);
  }
  void turn(Time now) {
    while (const auto arrival = port.receive()) {
      if (arrival->kind == transport::ArrivalKind::connected) session.connected(arrival->peer, now);
      if (arrival->kind == transport::ArrivalKind::disconnected) session.disconnected(arrival->peer, now);
      if (arrival->kind != transport::ArrivalKind::message) continue;
      session.receive(arrival->peer, arrival->channel, arrival->bytes, now);
    }
    for (int p = 0; p < session.config().players; ++p) {
      if (session.wants_input(p)) session.add_local_input(p, bot(p, session.current()));
    }
    drive(session, game, now);
    Words words;
    while (const auto out = session.poll_send(now)) {
      if (!out->bytes.empty()) words.emplace_back(out->channel, Buffer(out->bytes.begin(), out->bytes.end()));
      if (out->close) port.disconnect(out->peer);
    }
    if (bend) bend(words);
    for (const auto& [channel, bytes] : words) static_cast<void>(port.send(0, channel, bytes).ok());
    while (const auto event = session.poll_event()) events.push_back(*event);
  }
};

}  // namespace isostep::hostile
