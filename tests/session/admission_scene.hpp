// Matches whose players come and go, for tests of who is let in: machines, strangers, and what each was told.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "session/match_checks.hpp"
#include "unit/session/hostile.hpp"

namespace isostep::test {

using Kind = SessionEvent::Kind;
using Player = Machine<hostile::Game>;

inline constexpr const char* kLine = "latency=30,jitter=5,loss=0.5";

/// A host who plays, and clients on good lines who come back when their line drops.
struct OpenMatch {
  explicit OpenMatch(const SessionConfig& its_config)
      : config(its_config), match(hostile::make_match(its_config, 100)) {
    client = config;
    client.local_players = 0;
    client.asks_admission = false;
  }
  Player& come(const SessionConfig& its_config) {
    Player& player = match.add(profile(kLine), its_config);
    player.returns = true;
    return player;
  }
  Player& come() { return come(client); }
  /// The configuration with the seat of a former process, and nothing else of it.
  SessionConfig with_token(std::uint64_t token) const {
    SessionConfig its = client;
    its.token = token;
    return its;
  }
  SessionConfig with_seat(int seat) const {
    SessionConfig its = client;
    its.seat = seat;
    return its;
  }
  SessionConfig as_spectator() const {
    SessionConfig its = client;
    its.mode = SessionMode::spectator;
    return its;
  }
  void pass(Time time) {
    match.run(time, [] { return false; });
  }
  bool plays(const Player& player, Time within) {
    return match.run(within, [&] { return player.session.phase() == SessionPhase::playing; });
  }
  /// The reason of a refusal, as "seats: reserved"; "" when there is none.
  std::string refusal_of(const Player& player, Time within = kSecond) {
    match.run(within, [&] { return player.heard(Kind::refused); });
    const Refusal& field = player.last(Kind::refused).field;
    if (!player.heard(Kind::refused)) return "";
    return std::string(field.key.view()) + ": " + std::string(field.here.view());
  }
  /// Its line drops, and it does not know how to come back.
  void drop(Player& player) {
    player.returns = false;
    match.network().cut(player.endpoint);
  }
  void crash(Player& player) {
    player.plays = false;
    match.network().set_silent(player.endpoint, true);
  }
  Session<hostile::Game>& host() { return match.host().session; }

  SessionConfig config, client;
  hostile::Match match;
};

inline SessionConfig players_of(int players) {
  SessionConfig config;
  config.players = players;
  return config;
}

/// Everybody plays.
struct FullMatch : OpenMatch {
  explicit FullMatch(const SessionConfig& its_config) : OpenMatch(its_config) {
    for (int p = 1; p < its_config.players; ++p) players.push_back(&come());
    EXPECT_TRUE(match.run_to(300, 20 * kSecond));
  }
  Player& player(int p) {
    for (Player* one : players) {
      if (one->session.local_player() == p) return *one;
    }
    return match.host();
  }
  std::vector<Player*> players;
};

}  // namespace isostep::test
