// What the laboratory says while it works, by a clock that the test tells.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tool/lab/progress.hpp"

namespace isostep::tool::lab {
namespace lab_progress_test {

TEST(LabProgress, TheTimeLeftIsThatOfTheWorkLeft) {
  ProgressText text(true, 3, 100, 0);
  EXPECT_EQ(text.begin(), "\r0 of 3 runs\x1b[K");
  EXPECT_EQ(text.done(25, "S1", 30'000), "\r1 of 3 runs, about 1:30 min left: S1\x1b[K");
  EXPECT_EQ(text.done(50, "S2", 60'000), "\r2 of 3 runs, about 20 s left: S2\x1b[K");
  EXPECT_EQ(text.done(25, "S3", 61'000), "\r3 of 3 runs, about 0 s left: S3\x1b[K");
  EXPECT_EQ(text.end(), "\n");
}

TEST(LabProgress, ALogHasALineInTenSecondsAndTheLast) {
  constexpr int kRuns = 1000;
  constexpr double kEach = 50;  // [ms]
  ProgressText text(false, kRuns, kRuns, 0);
  std::string log = text.begin();
  int lines = 0;
  for (int run = 1; run <= kRuns; ++run) {
    const std::string line = text.done(1, "S1", run * kEach);
    lines += line.empty() ? 0 : 1;
    log += line;
  }
  EXPECT_EQ(lines, 5) << "50 s, and the last run ends them";
  EXPECT_EQ(log.find('\r'), std::string::npos);
  EXPECT_EQ(log.find('\x1b'), std::string::npos);
  EXPECT_NE(log.find("\n1000 of 1000 runs, about 0 s left: S1\n"), std::string::npos);
  EXPECT_EQ(text.end(), "");
}

TEST(LabProgress, ATerminalIsNotWrittenToMoreThanTenTimesASecond) {
  ProgressText text(true, 100, 100, 0);
  EXPECT_EQ(text.done(1, "S1", 99), "");
  EXPECT_NE(text.done(1, "S1", 100), "");
  EXPECT_EQ(text.done(1, "S1", 150), "");
}

TEST(LabProgress, NothingToDoIsNothingToSay) {
  ProgressText text(true, 0, 0, 0);
  EXPECT_EQ(text.begin() + text.end(), "");
}

}  // namespace lab_progress_test
}  // namespace isostep::tool::lab
