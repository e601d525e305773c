// problem_of: every rule of a configuration is found by name when it is broken, and only then.
// SPDX-License-Identifier: MIT
#include "isostep/session/config.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "hostile.hpp"
#include "isostep/session/session.hpp"

namespace isostep {
namespace config_test {

std::string problem_with(const std::function<void(SessionConfig&)>& change) {
  SessionConfig config;
  change(config);
  const char* problem = problem_of(config);
  return problem == nullptr ? "" : problem;
}
#define PROBLEM(...) problem_with([](SessionConfig& c) { __VA_ARGS__; })

bool names(const std::string& problem, const std::string& field) { return problem.rfind(field, 0) == 0; }

TEST(SessionConfig, TheDefaultIsFine) {
  EXPECT_EQ(PROBLEM(c.players = 2), "");
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback, SessionMode::spectator,
                                 SessionMode::sync_test, SessionMode::replay}) {
    SessionConfig config;
    config.mode = mode;
    EXPECT_EQ(problem_of(config), nullptr);
  }
}

TEST(SessionConfig, EveryBrokenRuleIsNamed) {
  EXPECT_TRUE(names(PROBLEM(c.players = 0), "players"));
  EXPECT_TRUE(names(PROBLEM(c.players = 33), "players"));
  EXPECT_TRUE(names(PROBLEM(c.players = -1), "players"));
  EXPECT_TRUE(names(PROBLEM(c.local_players = -1), "local_players"));
  EXPECT_TRUE(names(PROBLEM(c.local_players = 3), "local_players"));
  EXPECT_TRUE(names(PROBLEM(c.hz = 0), "hz"));
  EXPECT_TRUE(names(PROBLEM(c.hz = 1001), "hz"));
  EXPECT_TRUE(names(PROBLEM(c.window = -1), "window"));
  EXPECT_TRUE(names(PROBLEM(c.window = 61), "window"));
  EXPECT_TRUE(names(PROBLEM(c.window = 0; c.mode = SessionMode::sync_test), "window"));
  EXPECT_TRUE(names(PROBLEM(c.least_delay = -1), "least_delay"));
  EXPECT_TRUE(names(PROBLEM(c.least_delay = 5; c.delay = 5; c.most_delay = 4), "least_delay"));
  EXPECT_TRUE(names(PROBLEM(c.most_delay = 61), "least_delay, most_delay"));
  EXPECT_TRUE(names(PROBLEM(c.delay = 21), "delay"));
  EXPECT_TRUE(names(PROBLEM(c.least_delay = 3), "delay"));
  EXPECT_TRUE(names(PROBLEM(c.deadline = -1), "deadline"));
  EXPECT_TRUE(names(PROBLEM(c.deadline = 61), "deadline"));
  EXPECT_TRUE(names(PROBLEM(c.kept = 39), "kept"));
  EXPECT_TRUE(names(PROBLEM(c.kept = 4097; c.history = 10000), "kept"));
  EXPECT_TRUE(names(PROBLEM(c.history = 127), "history"));
  EXPECT_TRUE(names(PROBLEM(c.history = (1 << 20) + 1), "history"));
  EXPECT_TRUE(names(PROBLEM(c.most_replayed = -1), "most_replayed"));
  EXPECT_TRUE(names(PROBLEM(c.max_peers = 0), "max_peers"));
  EXPECT_TRUE(names(PROBLEM(c.max_peers = 257), "max_peers"));
  EXPECT_TRUE(names(PROBLEM(c.max_strangers = -1), "max_strangers"));
  EXPECT_TRUE(names(PROBLEM(c.max_strangers = 1025), "max_strangers"));
  EXPECT_TRUE(names(PROBLEM(c.migration = kSecond / 4 - 1), "migration"));
  EXPECT_TRUE(names(PROBLEM(c.migration = std::numeric_limits<Time>::max()), "migration"));
  EXPECT_TRUE(names(PROBLEM(c.seat = -2), "seat"));
  EXPECT_TRUE(names(PROBLEM(c.seat = 2), "seat"));
  EXPECT_TRUE(names(PROBLEM(c.credential.resize(kCredentialCap + 1)), "credential"));
  EXPECT_TRUE(names(PROBLEM(c.most_packets = 119), "most_packets"));
  EXPECT_TRUE(names(PROBLEM(c.relays = true), "relays"));
  EXPECT_TRUE(names(PROBLEM(c.relays = c.host = true; c.mode = SessionMode::spectator; c.seed = 1), "relays"));
  EXPECT_TRUE(names(PROBLEM(c.broadcast_delay = 60; c.mode = SessionMode::spectator), "broadcast_delay"));
  EXPECT_TRUE(names(PROBLEM(c.broadcast_delay = -1), "broadcast_delay"));
  EXPECT_TRUE(
      names(PROBLEM(c.broadcast_delay = 3537; c.relays = true; c.mode = SessionMode::spectator), "broadcast_delay"));
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback, SessionMode::spectator}) {
    SessionConfig config;
    config.host = true;
    config.mode = mode;
    ASSERT_NE(problem_of(config), nullptr);
    EXPECT_TRUE(names(problem_of(config), "seed")) << "there is no default that two matches could share";
  }
}

TEST(SessionConfig, TheEdgesAreFine) {
  EXPECT_EQ(PROBLEM(c.players = 1; c.local_players = 0), "");
  EXPECT_EQ(PROBLEM(c.players = 32; c.local_players = 32), "");
  EXPECT_EQ(PROBLEM(c.hz = 1), "");
  EXPECT_EQ(PROBLEM(c.hz = 1000; c.most_packets = 2000), "");
  EXPECT_EQ(PROBLEM(c.window = 0), "");
  EXPECT_EQ(PROBLEM(c.window = 60; c.kept = 144), "");
  EXPECT_EQ(PROBLEM(c.delay = 0; c.most_delay = 0), "");
  EXPECT_EQ(PROBLEM(c.delay = c.least_delay = c.most_delay = 60; c.kept = 80), "");
  EXPECT_EQ(PROBLEM(c.kept = 40; c.history = 80), "");
  EXPECT_EQ(PROBLEM(c.kept = 4096; c.history = 8192), "");
  EXPECT_EQ(PROBLEM(c.max_peers = 256), "");
  EXPECT_EQ(PROBLEM(c.max_strangers = 0), "");
  EXPECT_EQ(PROBLEM(c.max_strangers = 1024), "");
  EXPECT_EQ(PROBLEM(c.seat = 1), "");
  EXPECT_EQ(PROBLEM(c.reservation = 0), "");
  EXPECT_EQ(PROBLEM(c.credential.resize(kCredentialCap)), "");
  EXPECT_EQ(PROBLEM(c.most_packets = 120), "");
  EXPECT_EQ(PROBLEM(c.host = true; c.seed = 1), "");
  EXPECT_EQ(PROBLEM(c.broadcast_delay = 36000; c.history = 72200; c.relays = true; c.mode = SessionMode::spectator),
            "");
  EXPECT_EQ(PROBLEM(c.host = true; c.mode = SessionMode::sync_test), "");
}

TEST(SessionConfig, ASessionOfABrokenOneIsRefusedAndSaysWhy) {
  SessionConfig config;
  config.players = 33;
  Session<hostile::Game> session(config);
  hostile::Game game;
  EXPECT_EQ(session.phase(), SessionPhase::refused);
  const auto event = session.poll_event();
  ASSERT_TRUE(event.has_value());
  EXPECT_EQ(event->kind, SessionEvent::Kind::refused);
  EXPECT_EQ(event->field.here.view(), "players: 1 to 32");
  session.connected(0, 0);
  session.receive(0, Channel::datagram, {}, 0);
  EXPECT_EQ(drive(session, game, 0), 0);
  EXPECT_FALSE(session.poll_send(0).has_value());
  EXPECT_FALSE(session.add_local_input(0, {}));
}

TEST(SessionConfig, PatienceWithoutEndIsWithoutEnd) {
  SessionConfig config;
  config.silence = config.patience = std::numeric_limits<Time>::max();
  hostile::Match match = hostile::make_match(config);
  match.add(transport::parse_profile("latency=10").value());
  EXPECT_TRUE(match.run_to(100, 5 * kSecond));
}

}  // namespace config_test
}  // namespace isostep
