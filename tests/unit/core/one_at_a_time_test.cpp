// A call inside another is told; in builds with assertions a second thread ends the program. This file has them.
// SPDX-License-Identifier: MIT
#if !defined(ISOSTEP_ASSERTS)
#define ISOSTEP_ASSERTS
#endif
#include "isostep/core/one_at_a_time.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace isostep {
namespace one_at_a_time_test {

bool enters(OneAtATime& room) { return OneAtATime::Entry(room).alone(); }

TEST(OneAtATime, LetsNobodyInTwiceAndEverybodyInTurn) {
  OneAtATime room;
  {
    const OneAtATime::Entry entry(room);
    EXPECT_TRUE(entry.alone());
    EXPECT_FALSE(enters(room));
    EXPECT_FALSE(enters(room)) << "who was turned away must not open the door";
  }
  EXPECT_TRUE(enters(room));
  bool other = false;
  std::thread([&] { other = enters(room); }).join();
  EXPECT_TRUE(other);
}

TEST(OneAtATimeDeathTest, EndsTheProgramWhereTwoThreadsMeet) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  OneAtATime room;
  const OneAtATime::Entry entry(room);
  EXPECT_DEATH(std::thread([&] { enters(room); }).join(), "");
}

}  // namespace one_at_a_time_test
}  // namespace isostep
