// The cost of a session in a frame, beside the game: every player's machine in one process and in virtual time.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "parts.hpp"
#include "scenes/match.hpp"
#include "timed_match.hpp"
#include "tiny_game.hpp"

namespace isostep::bench {
namespace {

using Game = scenes::Match<float>;
constexpr std::size_t kSettled = 300;  // [frames] until clocks and delays have found their values
constexpr std::size_t kMachines = 2;   // the host, and its first client

SessionConfig config_of(int players, SessionMode mode) {
  SessionConfig config;
  config.players = players;
  config.mode = mode;
  return config;
}

/// The costs by machine and frame, the least of the repetitions.
using Costs = std::vector<std::vector<FrameCost>>;

void keep_least(std::vector<FrameCost>& least, const std::vector<FrameCost>& costs) {
  if (least.empty()) least = costs;
  for (std::size_t i = 0; i < least.size(); ++i) {
    least[i].receive = std::min(least[i].receive, costs[i].receive);
    least[i].drive = std::min(least[i].drive, costs[i].drive);
    least[i].send = std::min(least[i].send, costs[i].send);
  }
}

using InputOf = scenes::MatchInput (*)(int player, Frame frame);
scenes::MatchInput calm_input(int player, Frame frame) { return scenes::bot_input(5, player, frame); }

Costs measure(SessionConfig config, Loop loop, InputOf input, const SessionBenchOptions& options) {
  const transport::NetworkProfile line = transport::parse_profile("latency=100,jitter=30,loss=5").value();
  // Some bodies, so that between its turns the session's memory leaves the first cache, as in a game.
  const scenes::MatchSettings settings = {.players = config.players, .pile = 24, .seed = 3, .substeps = 4};
  Costs least(kMachines);
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    TimedMatch<Game> match(
        config, line, [&] { return std::make_unique<Game>(settings); }, input);
    match.run_to(options.frames, loop);
    for (std::size_t i = 0; i < kMachines; ++i) keep_least(least[i], match.peer(i).costs);
  }
  return least;
}

struct Mean {
  FrameCost cost;
  double p99 = 0, most = 0;
};
Mean mean_of(const std::vector<FrameCost>& costs, int frames) {
  Mean mean;
  std::vector<double> all;
  for (std::size_t i = kSettled; i < static_cast<std::size_t>(frames); ++i) {
    mean.cost.receive += costs[i].receive;
    mean.cost.drive += costs[i].drive;
    mean.cost.send += costs[i].send;
    all.push_back(costs[i].all());
  }
  const double count = static_cast<double>(all.size());
  mean.cost = {mean.cost.receive / count, mean.cost.drive / count, mean.cost.send / count};
  mean.p99 = quantile(all, 0.99);
  mean.most = quantile(all, 1);
  return mean;
}

}  // namespace

void report_overhead(const SessionBenchOptions& options) {
  std::printf(
      "Session overhead, us a frame:\n\n"
      "| players | mode | machine | receive | drive | send | together | p99 | most | turns every ms | restless |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int players : options.players) {
    for (const SessionMode mode : {SessionMode::rollback, SessionMode::lockstep}) {
      const SessionConfig config = config_of(players, mode);
      const Costs woken = measure(config, Loop::woken, calm_input, options);
      const Costs polling = measure(config, Loop::polling, calm_input, options);
      const Costs restless = measure(config, Loop::woken, restless_input, options);
      for (std::size_t i = 0; i < kMachines; ++i) {
        const Mean mean = mean_of(woken[i], options.frames);
        std::printf("| %d | %s | %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f |\n", players,
                    mode == SessionMode::rollback ? "rollback" : "lockstep", i == 0 ? "host" : "client",
                    mean.cost.receive, mean.cost.drive, mean.cost.send, mean.cost.all(), mean.p99, mean.most,
                    mean_of(polling[i], options.frames).cost.all(), mean_of(restless[i], options.frames).cost.all());
      }
      std::fflush(stdout);
    }
  }
}

}  // namespace isostep::bench
