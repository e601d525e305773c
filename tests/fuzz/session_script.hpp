// The script for the sessions' fuzzer: where its bytes go, and the words that it can say.
// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "isostep/session/agreement/repair.hpp"
#include "isostep/session/agreement/verdict.hpp"
#include "unit/session/hostile.hpp"

namespace isostep::fuzz {

using hostile::Buffer;
using hostile::Game;

inline void require(bool condition) {
  if (!condition) __builtin_trap();
}

class Script {
 public:
  Script(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}
  bool over() const { return bytes_.empty(); }
  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_[0];
    bytes_ = bytes_.subspan(1);
    return first;
  }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | byte();
    return value;
  }
  Bytes some(std::size_t size) {
    const Bytes taken = bytes_.first(size < bytes_.size() ? size : bytes_.size());
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }
  Bytes rest() { return some(bytes_.size()); }
  /// Mostly near `now`, seldom anywhere.
  Frame frame(Frame now) {
    const std::uint8_t how = byte();
    if (how >= 240) return static_cast<Frame>(word() % (std::uint32_t{kLastFrame} + 1));
    const Frame near = now + how % 160 - 80;
    return near < 0 ? 0 : near;
  }

 private:
  Bytes bytes_;
};

inline SessionConfig small_config(std::uint8_t options) {
  SessionConfig config;
  config.players = 3;
  config.mode = (options & 1) != 0 ? SessionMode::lockstep : SessionMode::rollback;
  config.window = 6;
  config.most_delay = 8;
  config.kept = 32;
  config.history = (options & 2) != 0 ? 64 : 600;
  config.max_peers = 4;
  config.max_strangers = 0;
  config.reservation = kSecond;
  config.silence = config.patience = kSecond / 2;
  config.most_packets = (options & 4) != 0 ? 120 : 1000000;
  config.repair = (options & 32) != 0;
  return config;
}

/// A session with its game, and the rules that hold whatever happens.
struct Side {
  explicit Side(const SessionConfig& config) : session(config) {}

  void confirmed(Frame frame, std::uint64_t hash) { hashes[frame] = hash; }
  void turn(Time now, const std::function<void(const Outgoing&)>& send) {
    for (int p = 0; p < session.config().players; ++p) {
      if (session.wants_input(p)) session.add_local_input(p, hostile::bot(p, session.current()));
    }
    const int steps = drive(session, game, now, *this);
    require(steps <= 2 * session.config().kept + 8);
    int sent = 0;
    while (const std::optional<Outgoing> out = session.poll_send(now)) {
      require(out->bytes.size() <= (out->channel == Channel::datagram ? kDatagramCap : kReliableCap));
      require(++sent < 1000);
      send(*out);
    }
    require(session.current() >= 0 && session.current() <= kLastFrame + 1);
    const bool runs = session.phase() == SessionPhase::playing || session.phase() == SessionPhase::watching;
    require(!runs || session.confirmed() <= session.current());
    while (const std::optional<SessionEvent> event = session.poll_event()) {
      const bool names = event->kind == SessionEvent::Kind::desync || event->kind == SessionEvent::Kind::outvoted;
      if (names) named |= event->player == 0xff ? 256u : 1u << event->player;
    }
  }
  Session<Game> session;
  Game game;
  std::map<Frame, std::uint64_t> hashes;
  std::uint32_t named = 0;  // whose states differed: a bit each, 256: the host's
};

inline Buffer any_datagram(Script& script, std::uint64_t match, Frame now, std::uint8_t player) {
  PacketHeader header;
  header.match = match;
  header.number = static_cast<std::uint16_t>(script.byte() * 100);
  if (header.number % 7 == 0) header.figured = script.byte() % 40;
  if (header.number % 7 == 0) header.figures = {.waited = script.word(), .loss = script.word() % 1200};
  header.time = static_cast<std::uint16_t>(script.byte() * 256);
  const std::uint8_t flags = script.byte();
  header.has_echo = (flags & 1) != 0;
  if (header.has_echo) header.echo = static_cast<std::uint16_t>(script.word());
  header.started = (flags & 2) == 0;
  header.is_far = (flags & 16) != 0;
  if ((flags & 32) != 0) header.stretch = script.byte() | 1;
  if ((flags & 32) != 0) header.slowest = script.byte() % 8;
  header.frame = script.frame(now);
  if ((flags & 64) != 0) {
    header.tempo = {script.byte(), script.frame(now), static_cast<std::uint8_t>(4 + script.byte() % 13),
                    script.byte() % 2 == 0, static_cast<std::uint8_t>(script.byte() % 9 == 8 ? 0xff : 0)};
  }
  if ((flags & 4) != 0) header.report = {script.frame(now), script.byte()};
  if ((flags & 8) != 0) {
    header.reporter = script.byte() % 8;
    header.passed_on = {script.frame(now), script.byte()};
  }
  header.ack_mask = script.byte();
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    if ((header.ack_mask >> p & 1) == 0) continue;
    header.ack[p] = script.frame(now);
    header.slack[p] = static_cast<std::int8_t>(script.byte());
  }
  std::uint8_t buffer[kDatagramCap];
  PacketWriter writer(header, buffer);
  for (int slices = script.byte() % 3; slices > 0; --slices) {
    InputStream stream(200, 3);
    const Frame first = script.frame(now);
    stream.reset(first);
    for (int runs = script.byte() % 8; runs > 0; --runs) {
      const std::uint8_t kind = script.byte();
      const std::uint8_t input[3] = {kind, script.byte(), 0};
      for (int n = kind % 20; n >= 0; --n)
        stream.append({kind >= 200, kind >= 200 ? Bytes{} : Bytes(input, kind == 99 ? 3 : 2)});
    }
    const std::uint8_t who = script.byte();
    writer.add_slice(who < 160 ? player : who % 8, stream, first);
  }
  return Buffer(writer.bytes().begin(), writer.bytes().end());
}

/// A word of states: what a client says of its own, or a host of all.
inline Buffer any_word_of_states(Script& script, Frame now, bool from_host) {
  Buffer bytes;
  const std::uint8_t how = script.byte();
  if (how % 3 == 0) {
    write_repaired({from_host ? static_cast<std::uint8_t>(script.byte() % 4) : std::uint8_t{0xff}, script.frame(now)},
                   bytes);
  } else if (!from_host && how % 3 == 1) {
    write_resync(bytes);
  } else if (!from_host) {
    write_statement({script.frame(now), script.byte() < 200, script.byte()}, bytes);
  } else if (how < 40) {
    write_inquiry(script.frame(now), bytes);
  } else if (how < 150) {
    Statements statements;
    statements.frame = script.frame(now);
    for (std::size_t m = 0; m < kMachines; ++m) {
      const std::uint8_t what = script.byte();
      statements.of[m] = {what < 160, what < 120, what % 3u};
    }
    write_statements(statements, bytes);
  } else {
    write_offer({{script.frame(now), script.byte()},
                 script.byte() < 128 ? Game{}.hash() : 1,
                 script.byte() < 200 ? script.byte() : script.word()},
                bytes);
  }
  return bytes;
}

}  // namespace isostep::fuzz
