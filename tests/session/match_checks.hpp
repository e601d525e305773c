// Checks that hold after every match: all peers confirmed what one process computes from the same inputs.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "session/virtual_match.hpp"

namespace isostep::test {

/// Frames of `machine` whose hash is not that of the straight run, or whose inputs are not the host's.
template <class Game>
std::size_t differences(const Machine<Game>& machine, const Machine<Game>& host,
                        const std::vector<std::uint64_t>& straight) {
  std::size_t count = 0;
  for (Frame frame = machine.first; frame < machine.end(); ++frame) {
    const auto f = static_cast<std::size_t>(frame);
    if (f >= straight.size() || frame >= host.end()) break;
    bool same = machine.hashes[static_cast<std::size_t>(frame - machine.first)] == straight[f];
    for (std::size_t p = 0; p < machine.at(frame).size(); ++p) {
      const auto &ours = machine.at(frame)[p], &theirs = host.at(frame)[p];
      same = same && ours.absent == theirs.absent && ours.input == theirs.input;
    }
    count += same ? 0 : 1;
  }
  return count;
}

template <class Game> void expect_sound_machine(const Machine<Game>& machine, bool may_drop) {
  EXPECT_TRUE(machine.in_order);
  EXPECT_FALSE(machine.heard(SessionEvent::Kind::desync));
  EXPECT_FALSE(machine.heard(SessionEvent::Kind::misuse));
  EXPECT_FALSE(machine.heard(SessionEvent::Kind::bad_snapshot));
  EXPECT_EQ(machine.session.stats().events_lost, 0u);
  if (!may_drop) {
    EXPECT_EQ(machine.session.stats().flooded, 0u);
  }
}

/// Every frame that a machine confirmed, against one process that plays the host's inputs straight through. Machines
/// that did not read for a while `may_drop` what came meanwhile.
template <class Game> void expect_one_history(VirtualMatch<Game>& match, bool may_drop = false) {
  const std::vector<std::uint64_t> straight = match.straight(match.host().end());
  for (std::size_t i = 0; i < match.size(); ++i) {
    SCOPED_TRACE(i == 0 ? "host" : "client " + std::to_string(i));
    const Machine<Game>& machine = match.machine(i);
    expect_sound_machine(machine, may_drop);
    EXPECT_GT(machine.hashes.size(), 0u);
    EXPECT_EQ(differences(machine, match.host(), straight), 0u);
  }
  EXPECT_EQ(match.network().oversized(), 0u);
}

inline transport::NetworkProfile profile(std::string_view text) {
  const Result<transport::NetworkProfile> parsed = transport::parse_profile(text);
  EXPECT_TRUE(parsed.ok()) << text;
  return parsed ? parsed.value() : transport::NetworkProfile{};
}

}  // namespace isostep::test
