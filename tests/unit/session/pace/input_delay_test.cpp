// InputDelay: late inputs raise it at once, early ones lower it slowly, and its bounds hold.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/input_delay.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace input_delay_test {

/// Frames of the same slack until the delay changes, or `limit`.
int until_change(InputDelay& delay, Frame slack, int limit = 2000) {
  const Frame before = delay.frames();
  for (int frame = 1; frame <= limit; ++frame) {
    delay.observe(slack);
    if (delay.frames() != before) return frame;
  }
  return limit;
}

TEST(InputDelay, LateInputsRaiseItByAllThatIsMissing) {
  InputDelay delay({2, 0, 20, 0});
  EXPECT_LE(until_change(delay, -5), 150);  // clocks settle for 90 frames, then 30 are looked at
  EXPECT_EQ(delay.frames(), 7);
}

TEST(InputDelay, TheWorstWithinAPeriodDecides) {
  InputDelay delay({2, 0, 20, 0});
  for (int i = 0; i < 100; ++i) delay.observe(5);
  delay.observe(-3);
  for (int i = 0; i < 30; ++i) delay.observe(5);
  EXPECT_EQ(delay.frames(), 5);
}

TEST(InputDelay, EarlyInputsLowerItOneByOneAndNotBelowTheLeast) {
  InputDelay delay({6, 3, 20, 0});
  const int first = until_change(delay, 10);
  EXPECT_EQ(delay.frames(), 5);
  EXPECT_GE(first, 120) << "four calm periods of 30 frames";
  EXPECT_GE(until_change(delay, 10), 120);
  EXPECT_GE(until_change(delay, 10), 120);
  EXPECT_EQ(delay.frames(), 3);
  EXPECT_EQ(until_change(delay, 10), 2000);
}

TEST(InputDelay, ALittleToSpareIsLeftAlone) {
  for (const Frame slack : {0, 1}) {
    InputDelay delay({6, 0, 20, 0});
    EXPECT_EQ(until_change(delay, slack), 2000) << slack;
  }
}

TEST(InputDelay, NeverLeavesItsBoundsWhateverIsReported) {
  for (const Frame slack : {-128, -127, -1, 0, 1, 126, 127}) {
    InputDelay delay({4, 1, 12, 0});
    for (int i = 0; i < 3000; ++i) {
      delay.observe(slack);
      ASSERT_GE(delay.frames(), 1);
      ASSERT_LE(delay.frames(), 12);
    }
    EXPECT_EQ(delay.frames(), slack < 0 ? 12 : slack < 2 ? 4 : 1);
  }
}

TEST(InputDelay, EqualBoundsFixIt) {
  InputDelay delay({4, 4, 4, 0});
  EXPECT_EQ(until_change(delay, -20), 2000);
  EXPECT_EQ(until_change(delay, 20), 2000);
}

TEST(InputDelay, ARollbackThatIsWelcomeIsNotAvoided) {
  InputDelay delay({4, 0, 20, -3});
  EXPECT_EQ(until_change(delay, -3), 2000);
  EXPECT_LT(until_change(delay, -4), 2000);
  EXPECT_EQ(delay.frames(), 5);
}

TEST(InputDelay, WhatIsDisregardedChangesNothing) {
  InputDelay delay({4, 0, 20, 0});
  EXPECT_EQ(until_change(delay, 0, 110), 110);
  for (int n = 0; n < 5; ++n) {
    delay.observe(-10);
    delay.disregard();
    EXPECT_EQ(until_change(delay, -10, 80), 80);
  }
  EXPECT_EQ(delay.frames(), 4);
}

TEST(InputDelay, GivesUpWhatIsToSpareAtOnceWhenItIsToldToReconsider) {
  InputDelay delay({12, 0, 20, 0});
  delay.reconsider();
  EXPECT_LE(until_change(delay, 9), 121);
  EXPECT_EQ(delay.frames(), 4) << "one frame is kept to spare";
  EXPECT_GE(until_change(delay, 9), 120) << "and once only";
  EXPECT_EQ(delay.frames(), 3);
}

TEST(InputDelay, GrowsByWhatItIsToldUpToItsMost) {
  InputDelay delay({2, 0, 8, 0});
  delay.grow(4);
  EXPECT_EQ(delay.frames(), 6);
  EXPECT_FALSE(delay.is_at_most());
  delay.grow(4);
  EXPECT_EQ(delay.frames(), 8);
  EXPECT_TRUE(delay.is_at_most());
}

TEST(RecentLeast, SaysHowFarTheLeastIsFromTheUsual) {
  RecentLeast least;
  EXPECT_EQ(least.spread(), 0);
  for (int i = 0; i < 100; ++i) least.add(4);
  EXPECT_EQ(least.spread(), 0);
  least.add(-6);
  EXPECT_NEAR(least.spread(), 10, 1);
}

TEST(RecentLeast, RemembersTwoBuckets) {
  RecentLeast least;
  EXPECT_EQ(least.value(), RecentLeast::kNothing);
  least.add(-4);
  least.add(9);
  EXPECT_EQ(least.value(), -4);
  for (int i = 0; i < 10; ++i) least.tick(10);
  EXPECT_EQ(least.value(), -4);
  least.add(3);
  for (int i = 0; i < 9; ++i) least.tick(10);
  EXPECT_EQ(least.value(), -4);
  least.tick(10);
  EXPECT_EQ(least.value(), 3);
  for (int i = 0; i < 10; ++i) least.tick(10);
  EXPECT_EQ(least.value(), RecentLeast::kNothing);
}

}  // namespace input_delay_test
}  // namespace isostep
