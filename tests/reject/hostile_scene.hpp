// The scene in which hostile peers meet honest ones: a host, an honest client, a seat for the rogue, and what must hold
// afterwards.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>

#include "../unit/session/hostile.hpp"

namespace isostep::hostile {

/// The allocations of the whole program, counted in allocation_count.cpp.
struct AllocationCount {
  std::size_t times = 0, bytes = 0;
};
extern AllocationCount allocation_count;

using Kind = SessionEvent::Kind;
using Peer = test::Machine<Game>;

inline constexpr Time kMs = 1000;  // [us]

inline transport::NetworkProfile lan() { return transport::parse_profile("latency=10").value(); }

inline SessionConfig three_players() {
  SessionConfig config;
  config.players = 3;
  config.most_packets = 10000000;  // so that strange packets are read and not only counted
  return config;
}

/// Same hashes at all honest machines as in one process that plays the same inputs.
inline void expect_honest(Match& match, Frame at_least) {
  const std::vector<std::uint64_t> straight = match.straight(match.host().end());
  for (std::size_t i = 0; i < match.size(); ++i) {
    const Peer& peer = match.machine(i);
    EXPECT_TRUE(peer.in_order) << "machine " << i;
    EXPECT_GE(peer.end(), at_least) << "machine " << i;
    for (Frame f = peer.first; f < peer.end() && f < match.host().end(); ++f) {
      ASSERT_EQ(peer.hashes[static_cast<std::size_t>(f - peer.first)], straight[static_cast<std::size_t>(f)])
          << "machine " << i << ", frame " << f;
    }
  }
}
inline void expect_no_desync(std::initializer_list<const Peer*> peers) {
  for (const Peer* peer : peers) EXPECT_FALSE(peer->heard(Kind::desync));
}

/// Host, honest clients, and a seat for the hostile one.
struct Scene {
  explicit Scene(const SessionConfig& its_config = three_players(), std::size_t ballast = 40000)
      : config(its_config), match(make_match(its_config, ballast)) {
    honest = &match.add(lan());
    for (int p = 3; p < config.players; ++p) match.add(lan());
  }
  SessionConfig client_config() const {
    SessionConfig client = config;
    client.local_players = 0;
    return client;
  }
  /// The honest alone from now on must get `frames` further.
  void expect_progress(Frame frames) {
    const Frame from = honest->end();
    EXPECT_TRUE(match.run_to(from + frames, static_cast<Time>(frames) * 20 * kMs + 12 * kSecond));
    expect_honest(match, from + frames);
    expect_no_desync({&match.host(), honest});
  }
  SessionConfig config;
  Match match;
  Peer* honest;
};

/// A rogue that has said hello, at the time when the match runs.
struct SeatedRogue : Scene {
  explicit SeatedRogue(const SessionConfig& its_config = three_players()) : Scene(its_config), rogue(match, lan()) {
    const bool seated = match.run(2 * kSecond, [&] {
      const bool before = rogue.is_connected;
      rogue.listen();
      if (!before && rogue.is_connected) rogue.greet(hello_of(config));
      return rogue.is_welcome && rogue.host_frame > 2;
    });
    EXPECT_TRUE(seated);
    EXPECT_EQ(rogue.opens, 0);
  }
  /// Well formed but for what `change` does to it.
  Buffer packet(const std::function<void(PacketHeader&)>& change, const InputStream* stream = nullptr, Frame first = 0,
                std::uint8_t player = 0xff) {
    PacketHeader header;
    header.match = rogue.welcome.match;
    header.frame = rogue.host_frame;
    header.started = true;
    header.ack_mask = static_cast<std::uint8_t>((1u << config.players) - 1);  // who acknowledges nothing is put out
    for (int p = 0; p < config.players; ++p) header.ack[p] = rogue.ends[p];
    if (change) change(header);
    std::uint8_t buffer[kDatagramCap];
    PacketWriter writer(header, buffer);
    if (stream != nullptr) writer.add_slice(player == 0xff ? rogue.welcome.player : player, *stream, first);
    return Buffer(writer.bytes().begin(), writer.bytes().end());
  }
  /// Inputs of our own up to `end`, as an honest player would send them.
  InputStream stream_to(Frame end) {
    InputStream stream(4096, 2);
    for (Frame f = 0; f < end; ++f) {
      const std::uint8_t bytes[2] = {static_cast<std::uint8_t>(f % 100), 1};
      stream.append({false, bytes});
    }
    return stream;
  }
  /// Keeps the match going while `each` does its worst.
  template <class Each> void play(Time limit, Each&& each) {
    match.run(limit, [&] {
      rogue.listen();
      const Frame end = rogue.host_frame + 10;
      const InputStream stream = stream_to(end);
      rogue.say(Channel::datagram, packet(nullptr, &stream, end > 60 ? end - 60 : 0));
      each();
      return false;
    });
  }
  Rogue rogue;
};

}  // namespace isostep::hostile
