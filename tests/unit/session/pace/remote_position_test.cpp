// RemotePosition: the middle of what was said, extrapolated, whatever single datagrams claim.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/remote_position.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace remote_position_test {

constexpr Time kPeriod = 10000;  // [us]
/// The key of a number, ascending for negative ones too.
constexpr auto kItself = [](int value) {
  return static_cast<std::uint64_t>(std::int64_t{value} + (std::int64_t{1} << 32));
};

TEST(RecentMedian, IsTheMiddleOfTheLastNine) {
  RecentMedian<int> recent;
  recent.add(5);
  EXPECT_EQ(recent.median(kItself), 5);
  recent.add(9);
  EXPECT_EQ(recent.median(kItself), 9) << "of two the upper one";
  recent.add(1);
  EXPECT_EQ(recent.median(kItself), 5);
  for (int n = 0; n < RecentMedian<int>::kValues; ++n) recent.add(100 + n);
  EXPECT_EQ(recent.count(), RecentMedian<int>::kValues);
  EXPECT_EQ(recent.median(kItself), 104) << "what came before is forgotten";
}

TEST(RecentMedian, FourOfNineMayBeAnything) {
  for (const int wrong : {-1000000, 0, 1000000}) {
    RecentMedian<int> recent;
    for (int n = 0; n < 9; ++n) recent.add(n % 2 == 0 ? 50 : wrong);
    EXPECT_EQ(recent.median(kItself), 50);
  }
}

TEST(RemotePosition, GoesOnWithTimeForASecond) {
  RemotePosition position;
  EXPECT_FALSE(position.is_known());
  EXPECT_EQ(position.at(0, kPeriod), 0);
  position.heard(100, 5000, kPeriod);
  EXPECT_EQ(position.at(5000, kPeriod), 100 * 256);
  EXPECT_EQ(position.at(4000, kPeriod), 100 * 256) << "a time before that is that";
  EXPECT_EQ(position.at(10000, kPeriod), 100 * 256 + 128);
  EXPECT_EQ(position.at(5000 + kSecond, kPeriod), 200 * 256);
  EXPECT_EQ(position.at(5000 + 9 * kSecond, kPeriod), 200 * 256) << "a silent peer has stopped";
}

TEST(RemotePosition, WhatIsFarOffIsNotNearAndDoesNotMoveIt) {
  RemotePosition position;
  Time now = 0;
  for (Frame frame = 1000; frame < 1020; ++frame, now += kPeriod) {
    EXPECT_TRUE(position.is_near(frame, now, kPeriod));
    position.heard(frame, now, kPeriod);
  }
  const std::int64_t before = position.at(now, kPeriod);
  for (const Frame forged : {Frame{0}, Frame{985}, Frame{1050}, kLastFrame}) {
    EXPECT_FALSE(position.is_near(forged, now, kPeriod)) << forged;
  }
  position.heard(kLastFrame, now, kPeriod);
  position.heard(0, now, kPeriod);
  EXPECT_NEAR(static_cast<double>(position.at(now, kPeriod) - before), 0, 256);
}

TEST(RemotePosition, FollowsAPeerThatIsReallyElsewhere) {
  RemotePosition position;
  Time now = 0;
  for (Frame frame = 0; frame < 20; ++frame, now += kPeriod) position.heard(frame, now, kPeriod);
  for (Frame frame = 500; frame < 505; ++frame, now += kPeriod) position.heard(frame, now, kPeriod);
  EXPECT_TRUE(position.is_near(505, now, kPeriod)) << "five datagrams are enough";
}

}  // namespace remote_position_test
}  // namespace isostep
