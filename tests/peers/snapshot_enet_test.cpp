// A snapshot over ENet and a relay with a bottleneck: it arrives, and after a cut goes on from what is there.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "enet_machine.hpp"
#include "session/bulky_game.hpp"
#include "transport/udp_relay.hpp"

namespace isostep::test {
namespace snapshot_enet_test {

using transport::EnetTransport;
using transport::UdpRelay;

constexpr std::uint64_t kSize = 1000000;  // [bytes] of the snapshot, more than kSnapshotFlight by far

template <class T> T whole(Result<T> result) { return std::move(result.value()); }

/// Patient, for a test waits for what happens and never for a time: a machine that stalls plays the same match later.
SessionConfig patient_config(bool host) {
  SessionConfig config;
  config.host = host;
  config.seed = host ? 1 : 0;
  config.local_players = host ? 1 : 0;
  config.silence = config.patience = 600 * kSecond;
  config.most_replayed = 0;  // nobody joins by inputs alone
  return config;
}

struct Machine {
  Machine(EnetTransport its_port, bool host)
      : port(std::move(its_port)), session(patient_config(host)), game(kSize / 8) {}

  void turn(Time now) {
    port.poll();
    while (const std::optional<transport::Arrival> arrival = port.receive()) {
      if (arrival->kind == transport::ArrivalKind::connected) session.connected(arrival->peer, now);
      if (arrival->kind == transport::ArrivalKind::disconnected) session.disconnected(arrival->peer, now);
      if (arrival->kind != transport::ArrivalKind::message) continue;
      if (arrival->channel == Channel::reliable) reliable_bytes += arrival->bytes.size();
      session.receive(arrival->peer, arrival->channel, arrival->bytes, now);
    }
    const int player = session.local_player();
    if (player >= 0) session.add_local_input(player, toy_input(1, player, session.current()));
    drive(session, game, now);
    while (const std::optional<Outgoing> out = session.poll_send(now)) {
      if (!out->bytes.empty()) static_cast<void>(port.send(out->peer, out->channel, out->bytes).ok());
      if (out->close) port.disconnect(out->peer);
    }
    port.flush();
    while (const std::optional<SessionEvent> event = session.poll_event()) {
      is_desynced = is_desynced || event->kind == SessionEvent::Kind::desync;
    }
  }

  EnetTransport port;
  Session<Bulky> session;
  Bulky game;
  std::uint64_t reliable_bytes = 0;
  bool is_desynced = false;
};

/// A host that plays alone, a relay, and a client behind it.
struct Match {
  Match(EnetTransport host_port, UdpRelay its_relay)
      : relay(std::move(its_relay)),
        host(std::move(host_port), true),
        client(whole(EnetTransport::connect("127.0.0.1", relay.port(), {.timeout = 600 * kSecond})), false) {
    host.session.start(steady_now());
  }
  static Match over(const char* line) {
    EnetTransport port = whole(EnetTransport::listen(0, {.timeout = 600 * kSecond}));
    UdpRelay relay =
        whole(UdpRelay::open({.target_port = port.port(), .profile = transport::parse_profile(line).value()}));
    return Match(std::move(port), std::move(relay));
  }
  template <class Done> bool run(Done&& done) {
    for (const Time end = steady_now() + 600 * kSecond; steady_now() < end;) {
      EXPECT_TRUE(relay.turn(1000).ok());
      host.turn(steady_now());
      client.turn(steady_now());
      if (done()) return true;
    }
    return false;
  }
  bool plays() const { return client.session.phase() == SessionPhase::playing; }

  UdpRelay relay;
  Machine host, client;
};

TEST(SnapshotOverEnet, ArrivesThroughABottleneck) {
  Match match = Match::over("latency=20,rate=500");
  bool is_told = false;
  EXPECT_TRUE(match.run([&] {
    const SnapshotProgress has = match.client.session.snapshot_progress();
    is_told = is_told || (has.arrived > 0 && has.arrived < has.size);
    return match.plays();
  }));
  EXPECT_TRUE(is_told);
  EXPECT_FALSE(match.host.is_desynced || match.client.is_desynced);
}

TEST(SnapshotOverEnet, GoesOnAfterACut) {
  Match match = Match::over("latency=20,rate=500");
  ASSERT_TRUE(match.run([&] { return match.client.session.snapshot_progress().arrived > kSize / 2; }));
  ASSERT_TRUE(match.client.port.connect_again().ok());
  match.client.session.disconnected(0, steady_now());
  EXPECT_EQ(match.client.session.phase(), SessionPhase::lost);
  EXPECT_TRUE(match.run([&] { return match.plays(); }));
  EXPECT_LT(match.client.reliable_bytes, kSize * 3 / 2) << "it began anew";
  EXPECT_FALSE(match.host.is_desynced || match.client.is_desynced);
}

}  // namespace snapshot_enet_test
}  // namespace isostep::test
