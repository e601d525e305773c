// Looks at a match while it runs: how evenly every machine steps, and for how long its inputs wait.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {

/// Players on equal lines. What a player does is the frame in which it was asked.
struct ToyMatch : VirtualMatch<Toy> {
  ToyMatch(const SessionConfig& config, std::string_view line, std::uint64_t seed = 1)
      : VirtualMatch(
            config, [] { return std::make_unique<Toy>(); },
            [](int, Frame frame) {
              return ToyInput{0, 0, static_cast<std::uint16_t>(frame)};
            },
            seed) {
    for (int p = 1; p < config.players; ++p) add(profile(line));
  }
  void pass(Time time) {
    run(time, [] { return false; });
  }
  /// A machine that does nothing for a while: what arrives meanwhile waits for it.
  void hitch(std::size_t i, Time time) {
    machine(i).plays = false;
    pass(time);
    machine(i).plays = true;
  }
};

inline SessionConfig config_of(int players, SessionMode mode) {
  SessionConfig config;
  config.players = players;
  config.mode = mode;
  return config;
}

/// The record of one machine since the watch began.
struct PaceRecord {
  Frame last = 0, first = 0;
  Time since = 0;               // [us] when it stepped last
  std::vector<Time> intervals;  // [us] between steps; 0 within one turn
  Frame least_delay = 0, most_delay = 0, delay = 0;

  Time worst() const { return intervals.empty() ? 0 : *std::max_element(intervals.begin(), intervals.end()); }
  std::size_t gaps(Time longer_than) const {
    return static_cast<std::size_t>(
        std::count_if(intervals.begin(), intervals.end(), [&](Time time) { return time > longer_than; }));
  }
  /// The interval that so many of a hundred do not exceed.
  Time percentile(std::size_t percent) const {
    std::vector<Time> sorted = intervals;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0 : sorted[(sorted.size() - 1) * percent / 100];
  }
};

/// Call `look` at the end of every tick.
template <class Game> class PaceWatch {
 public:
  explicit PaceWatch(VirtualMatch<Game>& match) : match_(match), records_(match.size()), began_(match.now()) {
    for (std::size_t i = 0; i < records_.size(); ++i) {
      PaceRecord& record = records_[i];
      record.first = record.last = match.machine(i).session.current();
      record.since = began_;
      record.delay = record.least_delay = record.most_delay = match.machine(i).session.stats().delay;
    }
  }
  void look() {
    for (std::size_t i = 0; i < records_.size(); ++i) {
      PaceRecord& record = records_[i];
      const auto& session = match_.machine(i).session;
      record.delay = session.stats().delay;
      record.least_delay = std::min(record.least_delay, record.delay);
      record.most_delay = std::max(record.most_delay, record.delay);
      for (; record.last < session.current(); ++record.last) {
        record.intervals.push_back(match_.now() - record.since);
        record.since = match_.now();
      }
    }
  }
  void watch(Time time) {
    match_.run(time, [&] {
      look();
      return false;
    });
  }
  const PaceRecord& operator[](std::size_t i) const { return records_[i]; }
  std::size_t size() const { return records_.size(); }
  /// [frames/100 s] The pace of one machine.
  Frame hundred_seconds(std::size_t i) const {
    const Time time = match_.now() - began_;
    return static_cast<Frame>(static_cast<Time>(records_[i].last - records_[i].first) * 100 * kSecond / time);
  }

 private:
  VirtualMatch<Game>& match_;
  std::vector<PaceRecord> records_;
  Time began_;
};

}  // namespace isostep::test
