// The cost of a match of many players to its host: on good lines, with a game that costs nothing.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "parts.hpp"
#include "timed_match.hpp"
#include "tiny_game.hpp"

namespace isostep::bench {
namespace {

constexpr std::size_t kSettled = 300;  // [frames] until clocks and delays have found their values

/// [us a frame] The cost to the host, the least of the repetitions frame by frame.
FrameCost host_cost(int players, const SessionBenchOptions& options, double& out) {
  SessionConfig config;
  config.players = players;
  const transport::NetworkProfile line = transport::parse_profile("latency=30,jitter=5,loss=0.5").value();
  std::vector<FrameCost> least;
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    TimedMatch<TinyGame> match(
        config, line, [] { return std::make_unique<TinyGame>(); },
        [](int player, Frame frame) { return scenes::bot_input(5, player, frame); });
    match.run_to(options.frames, Loop::woken);
    const std::vector<FrameCost>& costs = match.peer(0).costs;
    if (least.empty()) least = costs;
    for (std::size_t i = 0; i < least.size() && i < costs.size(); ++i) {
      least[i].receive = std::min(least[i].receive, costs[i].receive);
      least[i].drive = std::min(least[i].drive, costs[i].drive);
      least[i].send = std::min(least[i].send, costs[i].send);
    }
    out = static_cast<double>(match.peer(0).session.stats().bytes_out) / static_cast<double>(match.now());
  }
  FrameCost sum;
  const double frames = static_cast<double>(options.frames) - static_cast<double>(kSettled);
  for (std::size_t i = kSettled; i < static_cast<std::size_t>(options.frames); ++i) {
    sum.receive += least[i].receive / frames;
    sum.drive += least[i].drive / frames;
    sum.send += least[i].send / frames;
  }
  return sum;
}

}  // namespace

void report_crowds(const SessionBenchOptions& options) {
  std::printf(
      "\nA host of many players, us a frame:\n\n"
      "| players | receive | drive | send | together | kB/s out |\n"
      "|---|---|---|---|---|---|\n");
  for (const int players : {8, 16, 32}) {
    double out = 0;  // [MB/s], for bytes a microsecond are
    const FrameCost cost = host_cost(players, options, out);
    std::printf("| %d | %.1f | %.1f | %.1f | %.1f | %.0f |\n", players, cost.receive, cost.drive, cost.send, cost.all(),
                out * 1000);
    std::fflush(stdout);
  }
}

}  // namespace isostep::bench
