// FrameClock: when frames are due, what happens to a late caller, and how far a client's period may lean.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/frame_clock.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace frame_clock_test {

TEST(FrameClock, StepsAsManyFramesASecondAsItWasTold) {
  for (const int hz : {1, 30, 60, 144, 1000}) {
    FrameClock clock(hz);
    clock.start(500);
    int frames = 0;
    for (Time now = 500; now < 500 + 10 * kSecond; now += 100) {
      while (clock.is_due(now)) {
        clock.stepped(now);
        ++frames;
      }
    }
    EXPECT_NEAR(frames, 10 * hz, 1) << hz;  // the period is whole microseconds
  }
}

TEST(FrameClock, SaysHowLongUntilTheNextAndHowManyAreOverdue) {
  FrameClock clock(100);
  clock.start(1000);
  EXPECT_TRUE(clock.is_due(1000));
  EXPECT_FALSE(clock.is_due(999));
  EXPECT_EQ(clock.until_due(400), 600u);
  EXPECT_EQ(clock.until_due(5000), 0u);
  EXPECT_EQ(clock.overdue(1000), 0);
  EXPECT_EQ(clock.overdue(10999), 0);
  EXPECT_EQ(clock.overdue(11000), 1);
  EXPECT_EQ(clock.overdue(500), 0);
}

TEST(FrameClock, ALittleLatenessIsMadeUpForAndMuchIsForgiven) {
  FrameClock clock(100);
  clock.start(0);
  clock.stepped(15000);  // half a frame late for the second one
  EXPECT_TRUE(clock.is_due(15000));
  clock.stepped(15000);
  EXPECT_EQ(clock.until_due(15000), 5000u);
  FrameClock late(100);
  late.start(0);
  late.stepped(kSecond);  // a hundred frames late: one is stepped now, no others are owed
  EXPECT_TRUE(late.is_due(kSecond));
  late.stepped(kSecond);
  EXPECT_FALSE(late.is_due(kSecond));
}

TEST(FrameClock, LeansByATenthAtMost) {
  FrameClock clock(100);
  const auto interval = [](FrameClock its) {
    its.start(0);
    its.stepped(0);
    return its.until_due(0);
  };
  EXPECT_EQ(interval(clock), 10000u);
  for (int i = 0; i < 200; ++i) clock.lean(256 * 60);
  EXPECT_EQ(interval(clock), 11000u);
  for (int i = 0; i < 400; ++i) clock.lean(-256 * 60);
  EXPECT_EQ(interval(clock), 9000u);
  clock.forget_lean();
  EXPECT_EQ(interval(clock), 10000u);
  EXPECT_EQ(clock.ahead(), 0);
}

TEST(FrameClock, OneFrameAheadIsMadeUpInTwenty) {
  FrameClock clock(100);
  for (int i = 0; i < 200; ++i) clock.lean(256);
  EXPECT_NEAR(clock.ahead(), 256, 8);
  clock.start(0);
  clock.stepped(0);
  EXPECT_NEAR(static_cast<double>(clock.until_due(0)), 10000 * (1 + 1.0 / 20), 20);
}

TEST(FrameClock, TwoClocksThatLeanTowardsAThirdMeetIt) {
  // A client half a second behind at 100 Hz whose estimate is exact: after it has caught up it stays.
  FrameClock host(100), client(100);
  host.start(0);
  client.start(0);
  Frame host_frame = 5, client_frame = 0;
  for (Time now = 0; now < 5 * kSecond; now += 1000) {
    if (host.is_due(now)) {
      host.stepped(now);
      ++host_frame;
      client.lean((client_frame - host_frame) * 256);
    }
    if (client.is_due(now)) {
      client.stepped(now);
      ++client_frame;
    }
  }
  EXPECT_NEAR(client_frame, host_frame, 1);
}

}  // namespace frame_clock_test
}  // namespace isostep
