// A match over ENet that goes on without its host: what a game needs for it is dispatch() and an address.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>

#include "isostep/session/session.hpp"
#include "session/toy_game.hpp"
#include "transport/enet_transport.hpp"
#include "transport/pump.hpp"

namespace isostep::test {
namespace {

using transport::EnetTransport;

Time steady_now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<Time>(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
}

EnetTransport listen() {
  return std::move(EnetTransport::listen(0, {.bind_address = "127.0.0.1", .timeout = 600 * kSecond}).value());
}

/// Patient, for a test waits for what happens and never for a time; but a host is missed soon.
SessionConfig config_of(int number, const EnetTransport& port) {
  SessionConfig config;
  config.players = 3;
  config.host = number == 0;
  config.local_players = number == 0 ? 1 : 0;
  config.seed = static_cast<std::uint64_t>(number) + 1;
  config.silence = config.patience = 600 * kSecond;
  config.migration = kSecond;
  config.address = Address("127.0.0.1:" + std::to_string(port.port()));
  return config;
}

struct Machine {
  explicit Machine(int number) : port(listen()), session(config_of(number, port)) {}

  void confirmed(Frame frame, std::uint64_t hash) { hashes[frame] = hash; }
  void turn(Time now) {
    port.poll();
    transport::deliver(port, session, now);
    const int player = session.local_player();
    if (player >= 0) session.add_local_input(player, toy_input(1, player, session.current()));
    drive(session, game, now, *this);
    transport::dispatch(port, session, now);
    port.flush();
    while (const std::optional<SessionEvent> event = session.poll_event()) {
      has_new_host = has_new_host || event->kind == SessionEvent::Kind::new_host;
      is_desynced = is_desynced || event->kind == SessionEvent::Kind::desync;
    }
  }
  Frame end() const { return hashes.empty() ? 0 : hashes.rbegin()->first + 1; }

  EnetTransport port;
  Session<Toy> session;
  Toy game;
  std::map<Frame, std::uint64_t> hashes;
  bool has_new_host = false, is_desynced = false;
};

TEST(MigrationOverEnet, TheMatchGoesOnWhenItsHostTakesNoTurnsAnyMore) {
  std::unique_ptr<Machine> machines[3];
  for (int number = 0; number < 3; ++number) machines[number] = std::make_unique<Machine>(number);
  for (const int client : {1, 2}) {
    ASSERT_TRUE(machines[client]->port.connect_to(machines[0]->session.config().address.view()).ok());
  }
  const auto run = [&](int first, const auto& done) {
    for (const Time end = steady_now() + 600 * kSecond; steady_now() < end;) {
      for (int number = first; number < 3; ++number) machines[number]->turn(steady_now());
      if (done()) return true;
      machines[first]->port.wait(1000);
    }
    return false;
  };
  ASSERT_TRUE(
      run(0, [&] { return machines[1]->session.stats().machines + machines[2]->session.stats().machines == 6; }));
  ASSERT_TRUE(run(1, [&] { return machines[1]->has_new_host && machines[2]->has_new_host; }));
  const Frame until = std::max(machines[1]->end(), machines[2]->end()) + 60;
  ASSERT_TRUE(run(1, [&] { return machines[1]->end() > until && machines[2]->end() > until; }));
  int hosts = 0;
  for (const int client : {1, 2}) {
    hosts += machines[client]->session.config().host ? 1 : 0;
    EXPECT_EQ(machines[client]->session.phase(), SessionPhase::playing);
    EXPECT_FALSE(machines[client]->is_desynced);
  }
  EXPECT_EQ(hosts, 1);
  for (Frame frame = 0; frame <= until; ++frame) {
    ASSERT_EQ(machines[1]->hashes.at(frame), machines[2]->hashes.at(frame)) << frame;
  }

  // The old host comes back to life, learns that it is alone, and is a player of the match that went on.
  ASSERT_TRUE(run(0, [&] {
    return !machines[0]->session.config().host && machines[0]->session.phase() == SessionPhase::playing &&
           machines[0]->end() > until;
  }));
  EXPECT_FALSE(machines[0]->is_desynced);
}

}  // namespace
}  // namespace isostep::test
