// The effect of each preset on its players: how long inputs wait, what is corrected, how evenly frames come, what it
// sends.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "isostep/session/preset.hpp"
#include "parts.hpp"
#include "timed_match.hpp"
#include "tiny_game.hpp"

namespace isostep::bench {
namespace {

constexpr Frame kSettled = 900, kFrames = 3600 + kSettled;  // delays have found the line, then a minute
constexpr double kUdpIp = 28;                               // [bytes] a datagram

struct Kind {
  const char* name;
  Genre genre;
  int players;
};
struct Line {
  const char* name;
  const char* profile;
};

using Match = TimedMatch<TinyGame>;

/// The counts of one machine since the beginning.
struct Counts {
  std::uint64_t steps;
  std::size_t drives;
  Frame frames;
  double bytes;            // sent, with UDP/IP
  std::uint64_t replaced;  // inputs that came after the deadline
};
Counts counts_of(const TimedPeer<TinyGame>& peer) {
  const SessionStats& stats = peer.session.stats();
  std::uint64_t replaced = 0;
  for (const PlayerStats& player : stats.players) replaced += player.replaced;
  return {stats.steps, peer.drives.size(), peer.session.current(),
          static_cast<double>(stats.bytes_out) + static_cast<double>(stats.datagrams_out) * kUdpIp, replaced};
}

/// The delays and corrections that the players of a match notice, of all machines together.
struct Felt {
  double delay = 0;            // [frames] mean of the machines
  std::vector<double> depths;  // [frames] of each turn's rollback
  std::uint64_t frames = 0, steps = 0;
  Time longest_gap = 0;  // [us] between frames
  int gaps = 0;          // longer than kGap
};
constexpr Time kGap = 50000;  // [us] three frames: seen by everybody

void add(Felt& felt, const TimedPeer<TinyGame>& peer, const Counts& before) {
  const Counts now = counts_of(peer);
  felt.delay += static_cast<double>(peer.session.stats().delay);
  felt.frames += static_cast<std::uint64_t>(now.frames - before.frames);
  felt.steps += now.steps - before.steps;
  for (std::size_t i = before.drives; i < now.drives; ++i) {
    if (peer.drives[i].steps > 0) felt.depths.push_back(peer.drives[i].depth);
  }
  for (auto frame = static_cast<std::size_t>(kSettled); frame < static_cast<std::size_t>(kFrames); ++frame) {
    const Time gap = peer.stepped_at[frame] - peer.stepped_at[frame - 1];
    felt.longest_gap = std::max(felt.longest_gap, gap);
    felt.gaps += gap > kGap ? 1 : 0;
  }
}

void report(const Kind& kind, const Line& line) {
  Match match(
      preset(kind.genre, kind.players), transport::parse_profile(line.profile).value(),
      [] { return std::make_unique<TinyGame>(); },
      [](int player, Frame frame) { return scenes::bot_input(5, player, frame); });
  match.run_to(kSettled, Loop::woken);
  const Time start = match.now();
  std::vector<Counts> before;
  for (std::size_t i = 0; i < match.size(); ++i) before.push_back(counts_of(match.peer(i)));
  match.run_to(kFrames, Loop::woken);
  const double seconds = static_cast<double>(match.now() - start) / 1e6;
  Felt felt;
  for (std::size_t i = 0; i < match.size(); ++i) add(felt, match.peer(i), before[i]);
  const double delay = felt.delay / static_cast<double>(match.size());
  const Counts host = counts_of(match.peer(0));
  std::printf("| %s, %d | %s | %.1f | %.0f | %.0f | %.2f | %.0f | %d | %llu | %.1f |\n", kind.name, kind.players,
              line.name, delay, delay * 1000 / 60, quantile(felt.depths, 0.99),
              static_cast<double>(felt.steps) / static_cast<double>(felt.frames),
              static_cast<double>(felt.longest_gap) / 1000, felt.gaps,
              static_cast<unsigned long long>(host.replaced - before[0].replaced),
              (host.bytes - before[0].bytes) / seconds / 1000);
  std::fflush(stdout);
}

}  // namespace

void report_genres(const SessionBenchOptions&) {
  constexpr Kind kKinds[] = {{"fighting", Genre::fighting, 2},
                             {"brawler", Genre::brawler, 4},
                             {"racing", Genre::racing, 8},
                             {"strategy", Genre::strategy, 8},
                             {"sandbox", Genre::sandbox, 4}};
  constexpr Line kLines[] = {{"20 ms", "latency=10,jitter=2"},
                             {"60 ms +-10, .5 %", "latency=30,jitter=5,loss=0.5"},
                             {"150 ms +-40, 2 %", "latency=75,jitter=20,loss=2"}};
  std::printf(
      "\nPresets: lines are round trips to the host; delay in frames and ms, mean of all machines at the end; "
      "rollback: "
      "frames that 99 of 100 turns do not exceed; steps a frame; the longest time between frames and how many exceed "
      "50 ms, of all machines in a minute; inputs replaced; what the host sends, with UDP/IP, kB/s:\n\n"
      "| genre, players | line | delay | ms | rollback | steps | longest gap, ms | gaps | replaced | host sends |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Kind& kind : kKinds) {
    for (const Line& line : kLines) report(kind, line);
  }
}

}  // namespace isostep::bench
