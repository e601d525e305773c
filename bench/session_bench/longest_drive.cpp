// The longest drive() of a match: a rollback of eight frames, and the frame that is due, with a thousand bodies.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "parts.hpp"
#include "scenes/match.hpp"
#include "timed_match.hpp"

namespace isostep::bench {
namespace {

constexpr Frame kDepth = 8;
constexpr Frame kLanded = 180, kFrames = 480;  // the pile has come down by then
constexpr int kMostRepeats = 3;

/// Every other player's input comes eight frames late, and nobody's waits.
SessionConfig config_of_depth() {
  SessionConfig config;
  config.window = kDepth;
  config.delay = config.least_delay = config.most_delay = 0;
  return config;
}

struct Sum {
  std::vector<double> plain, deep;  // [ms] drives of one step, and of a rollback of kDepth
  int steps = 0;                    // of the longest
  double longest = 0;
};

template <class S> Sum measure(int repeats) {
  using Game = scenes::Match<S>;
  const transport::NetworkProfile line = transport::parse_profile("latency=130").value();
  const scenes::MatchSettings settings = {.players = 2, .pile = 1000, .seed = 3};
  std::vector<Drive> least[2];
  std::size_t landed[2] = {};
  for (int repeat = 0; repeat < repeats; ++repeat) {
    TimedMatch<Game> match(
        config_of_depth(), line, [&] { return std::make_unique<Game>(settings); },
        [](int player, Frame frame) { return scenes::bot_input(5, player, frame); });
    match.run_to(kLanded, Loop::woken);
    for (std::size_t i = 0; i < 2; ++i) landed[i] = match.peer(i).drives.size();
    match.run_to(kFrames, Loop::woken);
    for (std::size_t i = 0; i < 2; ++i) {
      const std::vector<Drive>& drives = match.peer(i).drives;
      if (least[i].empty()) least[i] = drives;
      for (std::size_t k = 0; k < drives.size(); ++k) least[i][k].ms = std::min(least[i][k].ms, drives[k].ms);
    }
  }
  Sum sum;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = landed[i]; k < least[i].size(); ++k) {
      const Drive& drive = least[i][k];
      if (drive.depth == 0 && drive.steps == 1) sum.plain.push_back(drive.ms);
      if (drive.depth == kDepth) sum.deep.push_back(drive.ms);
      if (drive.depth != kDepth || drive.ms < sum.longest) continue;
      sum.longest = drive.ms;
      sum.steps = drive.steps;
    }
  }
  return sum;
}

template <class S> void report(const SessionBenchOptions& options) {
  const char* name = ScalarTraits<S>::kName;
  if (std::count(options.scalars.begin(), options.scalars.end(), std::string(name)) == 0) return;
  const Sum sum = measure<S>(std::min(options.repeats, kMostRepeats));
  std::printf("| %s | %zu | %.2f | %.1f | %.1f | %d | %.2f |\n", name, sum.deep.size(), median(sum.plain),
              median(sum.deep), sum.longest, sum.steps, sum.longest / (1000.0 / 60));
  std::fflush(stdout);
}

}  // namespace

void report_drives(const SessionBenchOptions& options) {
  std::printf(
      "\nMatch with a pile of 1000, drive() with a rollback of 8 frames, ms of CPU:\n\n"
      "| scalar | such drives | drive of one frame | median | longest | its steps | longest / 16.7 ms |\n"
      "|---|---|---|---|---|---|---|\n");
#define ISO_REPORT(S) report<S>(options);
  ISO_FOR_EACH_SCALAR(ISO_REPORT)
#undef ISO_REPORT
}

}  // namespace isostep::bench
