// The traffic of a player's link: the session's own bytes, and what ENet, UDP and IP put around them.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "parts.hpp"
#include "timed_match.hpp"
#include "tiny_game.hpp"

namespace isostep::bench {
namespace {

constexpr Frame kSettled = 300, kFrames = 3600 + kSettled;
constexpr double kEnet = 18.7, kUdpIp = 28;  // [bytes] a datagram; ENet's is a mean that was measured, with our tag

struct Traffic {
  double bytes = 0, datagrams = 0;  // up to now, or [1/s]
};
Traffic operator-(const Traffic& a, const Traffic& b) { return {a.bytes - b.bytes, a.datagrams - b.datagrams}; }

/// The traffic of all clients together.
Traffic traffic(TimedMatch<TinyGame>& match, transport::Direction direction) {
  Traffic sum;
  for (std::size_t i = 1; i < match.size(); ++i) {
    const auto& statistics = match.network().statistics(match.peer(i).endpoint, direction);
    sum.bytes += static_cast<double>(statistics.datagram_bytes);
    sum.datagrams += static_cast<double>(statistics.datagrams);
  }
  return sum;
}

void print_direction(const Traffic& traffic) {
  const auto with = [&](double around) { return (traffic.bytes + traffic.datagrams * around) / 1000; };
  std::printf(" %.0f | %.2f | %.2f | %.2f |", traffic.bytes / traffic.datagrams, with(0), with(kEnet),
              with(kEnet + kUdpIp));
}

struct Line {
  const char* name;
  const char* profile;
};
struct Player {
  const char* name;
  scenes::MatchInput (*input)(int player, Frame frame);
};

/// The mode does not matter: lockstep's datagrams are those of rollback.
void report(int players, const Line& line, const Player& player) {
  SessionConfig config;
  config.players = players;
  TimedMatch<TinyGame> match(
      config, transport::parse_profile(line.profile).value(), [] { return std::make_unique<TinyGame>(); },
      player.input);
  Traffic sums[2];
  match.run_to(kSettled, Loop::woken);
  const Time start = match.now();
  for (int i = 0; i < 2; ++i) sums[i] = traffic(match, transport::kDirections[i]);
  match.run_to(kFrames, Loop::woken);
  std::printf("| %d | %s | %s |", players, line.name, player.name);
  const double seconds = static_cast<double>(match.now() - start) / 1e6 * (players - 1);
  for (int i = 0; i < 2; ++i) {
    const Traffic over = traffic(match, transport::kDirections[i]) - sums[i];
    print_direction({over.bytes / seconds, over.datagrams / seconds});
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

void report_bandwidth(const SessionBenchOptions& options) {
  constexpr Line kLines[] = {{"100 ms, 5 %", "latency=50,loss=5"},
                             {"200 ms +-60, 5 %", "latency=100,jitter=30,loss=5"}};
  constexpr Player kPlayers[] = {{"bot", [](int player, Frame frame) { return scenes::bot_input(5, player, frame); }},
                                 {"restless", restless_input}};
  std::printf(
      "\nBandwidth of one client's link, bytes a datagram and kB/s: the session's, with ENet, with UDP/IP as well:\n\n"
      "| players | round trip, loss | inputs | up: bytes | kB/s | ENet | UDP/IP | down: bytes | kB/s | ENet | UDP/IP "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int players : options.players) {
    for (const Line& line : kLines) {
      for (const Player& player : kPlayers) report(players, line, player);
    }
  }
}

}  // namespace isostep::bench
