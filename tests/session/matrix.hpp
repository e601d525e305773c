// The matrix of networks, players, modes and scalars: matches of a minute, or of a quarter of one in a sample, each
// against one process that plays alone.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "sample.hpp"
#include "scenes/match.hpp"
#include "session/covering.hpp"
#include "session/match_checks.hpp"

namespace isostep::test {

inline constexpr int kMatrixPlayers[] = {2, 4, 8};
inline constexpr SessionMode kMatrixModes[] = {SessionMode::lockstep, SessionMode::rollback};
inline constexpr std::size_t kMatrixScalars = 4;  // float, double, Q16.16, Q32.32
inline constexpr Frame kMatrixFrames = 3600;
inline constexpr Frame kMatrixDarkFrames = 2700;  // until after a blackout
inline constexpr Frame kMatrixFewFrames = 900;

inline std::vector<std::size_t> matrix_sizes() {
  return {transport::named_profiles().size(), std::size(kMatrixPlayers), std::size(kMatrixModes), kMatrixScalars};
}

/// The counts of the rows of one scalar.
struct MatrixTally {
  std::uint64_t depths[9] = {};
  std::uint64_t returns = 0, spawned = 0, contacts = 0;
  int rows = 0;
};

/// [kB/s] The bandwidth of what all clients send, and are sent, per client. At two players that is one player's link.
template <class Game> void check_bandwidth(VirtualMatch<Game>& match, const char* name) {
  double up = 0, down = 0;
  for (std::size_t i = 1; i < match.size(); ++i) {
    const transport::EndpointId id = match.machine(i).endpoint;
    up += static_cast<double>(match.network().statistics(id, transport::Direction::up).datagram_bytes);
    down += static_cast<double>(match.network().statistics(id, transport::Direction::down).datagram_bytes);
  }
  const double scale = 1000.0 * static_cast<double>(match.now()) / 1e6 * static_cast<double>(match.size() - 1);
  if (match.size() == 2) {
    EXPECT_LT(up / scale, 6.0);
    EXPECT_LT(down / scale, 6.0);
  }
  std::printf("%-44s %5.2f kB/s up %5.2f kB/s down per client, %.1f s\n", name, up / scale, down / scale,
              static_cast<double>(match.now()) / 1e6);
}

template <class S> void run_matrix_row(const Row& row, MatrixTally& tally) {
  using Game = scenes::Match<S>;
  const transport::NetworkProfile& line = transport::named_profiles()[row[0]];
  const int players = kMatrixPlayers[row[1]];
  const bool rolls_back = kMatrixModes[row[2]] == SessionMode::rollback;
  const std::string name = std::string(line.name.view()) + ", " + std::to_string(players) + " players, " +
                           (rolls_back ? "rollback, " : "lockstep, ") + std::string(ScalarTraits<S>::kName);
  SCOPED_TRACE(name);
  const bool is_dark = line.name.view().substr(0, 8) == "blackout";
  const Frame frames = sampled(kMatrixFrames, is_dark ? kMatrixDarkFrames : kMatrixFewFrames);
  SessionConfig config;
  config.players = players;
  config.mode = kMatrixModes[row[2]];
  // The way over two severe lines is longer than most_delay: in lockstep the match stands for a third of the time.
  if (!rolls_back && line.name.view() == "severe") config.patience = 30 * kSecond;
  // Crowds cost: the more players, the fewer other bodies and sub-steps.
  const scenes::MatchSettings settings = {
      .players = players, .pile = 12 / players, .seed = 3, .substeps = players > 4 ? 2 : 4};
  VirtualMatch<Game> match(
      config, [&] { return std::make_unique<Game>(settings); },
      [](int player, Frame frame) { return scenes::bot_input(5, player, frame); }, 1 + row[0]);
  for (int p = 1; p < players; ++p) match.add(line).returns = true;
  EXPECT_TRUE(match.run_to(frames, 10 * 60 * kSecond));
  expect_one_history(match);

  std::uint64_t rollbacks = 0;
  for (std::size_t i = 0; i < match.size(); ++i) {
    const Machine<Game>& machine = match.machine(i);
    EXPECT_GE(machine.end(), frames);
    for (std::size_t depth = 1; depth <= 64; ++depth) {
      rollbacks += machine.session.stats().rollbacks[depth];
      if (depth <= 8) tally.depths[depth] += machine.session.stats().rollbacks[depth];
    }
    if (i == 0) continue;
    EXPECT_EQ(machine.heard(SessionEvent::Kind::lost_host), is_dark);
    EXPECT_TRUE(match.host().played(frames - 1, static_cast<int>(i))) << "is not in the match at its end";
    tally.returns += machine.heard(SessionEvent::Kind::lost_host) ? 1 : 0;
    if (!is_dark) {
      EXPECT_EQ(match.host().count(SessionEvent::Kind::left), 0) << "left out on a line that works";
      EXPECT_EQ(machine.first, 0);
    }
  }
  EXPECT_EQ(rollbacks > 0, rolls_back);
  tally.spawned += match.host().game->state().spawn_count;
  ++tally.rows;
  check_bandwidth(match, name.c_str());
}

/// A sample plays the largest match in one mode.
inline bool is_sampled(const Row& row) {
  return kMatrixPlayers[row[1]] < 8 || kMatrixModes[row[2]] == SessionMode::rollback;
}

/// All rows of the scalar with that number.
template <class S> void run_matrix(std::size_t scalar) {
  const std::vector<Row> rows = covering_rows(matrix_sizes());
  ASSERT_TRUE(covers_every_pair(rows, matrix_sizes()));
  MatrixTally tally;
  for (const Row& row : rows) {
    if (row[3] == scalar && (wants_whole() || is_sampled(row))) run_matrix_row<S>(row, tally);
  }
  EXPECT_GE(tally.rows, static_cast<int>(transport::named_profiles().size()));
  for (int depth = 1; depth <= 8; ++depth) EXPECT_GT(tally.depths[depth], 0u) << "no rollback of depth " << depth;
  EXPECT_GT(tally.returns, 0u);
  EXPECT_GT(tally.spawned, 0u);
}

}  // namespace isostep::test
