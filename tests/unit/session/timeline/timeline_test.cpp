// Timeline: what is guessed, when a guess is found wrong, and what was played in the end.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/timeline.hpp"

#include <gtest/gtest.h>

#include "isostep/core/random.hpp"

namespace isostep {
namespace timeline_test {

struct Key {
  std::uint8_t down = 0;
  ISO_FIELDS(down)
};
struct Table : testing::Test {
  Table() : streams(2, InputStream(64, 1)), timeline(2, 32, input_rules<Key>()) {}
  void say(int player, std::uint8_t down) { streams[static_cast<std::size_t>(player)].append({false, {&down, 1}}); }
  void leave(int player) { streams[static_cast<std::size_t>(player)].append({true, {}}); }
  int played(Frame frame, int player) const { return timeline.used(frame, player).bytes[0]; }
  InputStatus status(Frame frame, int player) const { return timeline.used(frame, player).status; }

  std::vector<InputStream> streams;
  Timeline timeline;
};

TEST_F(Table, WhatIsKnownIsPlayed) {
  say(0, 7);
  say(1, 8);
  timeline.step(streams);
  EXPECT_EQ(timeline.current(), 1);
  EXPECT_EQ(played(0, 0), 7);
  EXPECT_EQ(played(0, 1), 8);
  EXPECT_EQ(status(0, 0), InputStatus::confirmed);
  EXPECT_EQ(timeline.first_wrong(streams), 1);
}

TEST_F(Table, BeforeTheFirstWordNobodyTouchesAnything) {
  timeline.step(streams);
  EXPECT_EQ(played(0, 0), 0);
  EXPECT_EQ(status(0, 0), InputStatus::predicted);
}

TEST_F(Table, WhatIsNotKnownIsTheLastThatWas) {
  say(0, 7);
  for (int f = 0; f < 5; ++f) timeline.step(streams);
  for (Frame f = 1; f < 5; ++f) {
    EXPECT_EQ(played(f, 0), 7);
    EXPECT_EQ(status(f, 0), InputStatus::predicted);
  }
}

TEST_F(Table, TheFirstWrongGuessIsFoundAndOnlyOnce) {
  for (int f = 0; f < 6; ++f) timeline.step(streams);
  say(0, 0);
  say(0, 0);
  EXPECT_EQ(timeline.first_wrong(streams), 6) << "right so far";
  say(0, 3);
  say(0, 0);
  say(1, 5);
  EXPECT_EQ(timeline.first_wrong(streams), 0) << "player 1 did something in frame 0";
  timeline.step_again(0, streams);
  EXPECT_EQ(timeline.first_wrong(streams), 6);
  EXPECT_EQ(played(2, 0), 3);
  EXPECT_EQ(played(3, 0), 0);
  EXPECT_EQ(status(3, 0), InputStatus::confirmed);
  EXPECT_EQ(status(4, 0), InputStatus::predicted);
  EXPECT_EQ(played(5, 1), 5);
}

TEST_F(Table, FramesThatWereNotSteppedAreNotWrong) {
  timeline.step(streams);
  for (std::uint8_t i = 0; i < 10; ++i) say(0, i);
  for (std::uint8_t i = 0; i < 10; ++i) say(1, 0);
  EXPECT_EQ(timeline.first_wrong(streams), 1);
  for (int f = 1; f < 10; ++f) timeline.step(streams);
  EXPECT_EQ(timeline.first_wrong(streams), 10);
  for (Frame f = 0; f < 10; ++f) EXPECT_EQ(played(f, 0), f);
}

TEST_F(Table, WhoIsGoneStaysGoneUntilHeard) {
  say(0, 9);
  leave(0);
  for (int f = 0; f < 4; ++f) timeline.step(streams);
  EXPECT_EQ(status(1, 0), InputStatus::disconnected);
  EXPECT_EQ(status(3, 0), InputStatus::disconnected) << "a guess, and the best one";
  EXPECT_EQ(played(1, 0), 0);
  EXPECT_EQ(played(3, 0), 0);
  leave(0);
  EXPECT_EQ(timeline.first_wrong(streams), 4);
  say(0, 0);  // there again, and idle: not the same as gone
  EXPECT_EQ(timeline.first_wrong(streams), 3);
}

TEST_F(Table, GoingIsNoticedEvenOfAnIdlePlayer) {
  for (int f = 0; f < 3; ++f) timeline.step(streams);
  leave(1);
  EXPECT_EQ(timeline.first_wrong(streams), 0);
}

TEST_F(Table, WhatWasCutIsComparedAgain) {
  for (int f = 0; f < 5; ++f) say(0, 1);
  for (int f = 0; f < 5; ++f) say(1, 1);
  for (int f = 0; f < 5; ++f) timeline.step(streams);
  EXPECT_EQ(timeline.first_wrong(streams), 5);
  streams[0].truncate(3);
  timeline.recheck(0, 3);
  EXPECT_EQ(timeline.first_wrong(streams), 5);
  leave(0);
  EXPECT_EQ(timeline.first_wrong(streams), 3);
}

TEST_F(Table, StartsAnewAnywhere) {
  for (InputStream& stream : streams) stream.reset(1000);
  timeline.restart(1000);
  EXPECT_EQ(timeline.current(), 1000);
  EXPECT_EQ(timeline.first_wrong(streams), 1000);
  timeline.step(streams);
  EXPECT_EQ(status(1000, 0), InputStatus::predicted);
  say(0, 1);
  EXPECT_EQ(timeline.first_wrong(streams), 1000);
}

TEST_F(Table, WhateverComesInWhateverOrderWhatWasSaidIsPlayedInTheEnd) {
  Pcg32 random = Pcg32::seeded(9);
  std::vector<int> said[2];  // -1: gone
  for (int step = 0; step < 5000; ++step) {
    const int player = static_cast<int>(random.next() % 2);
    std::vector<int>& its = said[player];
    if (its.size() < static_cast<std::size_t>(timeline.current()) + 10) {
      its.push_back(static_cast<int>(random.next() % 4) - 1);
      if (its.back() < 0) leave(player);
      else say(player, static_cast<std::uint8_t>(its.back()));
    }
    const Frame wrong = timeline.first_wrong(streams);
    if (wrong < timeline.current()) timeline.step_again(wrong, streams);
    const auto slowest = static_cast<Frame>(std::min(said[0].size(), said[1].size()));
    if (timeline.current() < slowest + 20) timeline.step(streams);
    for (Frame f = std::max(0, timeline.current() - 30); f < std::min(slowest, timeline.current()); ++f) {
      for (int p = 0; p < 2; ++p) {
        const int what = said[p][static_cast<std::size_t>(f)];
        ASSERT_EQ(status(f, p) == InputStatus::disconnected, what < 0) << f;
        ASSERT_EQ(played(f, p), what < 0 ? 0 : what) << f;
      }
    }
  }
  EXPECT_GT(timeline.current(), 1000);
}

}  // namespace timeline_test
}  // namespace isostep
