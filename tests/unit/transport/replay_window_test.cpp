// The window of datagrams that have come, against a list of all of them.
// SPDX-License-Identifier: MIT
#include "transport/replay_window.hpp"

#include <gtest/gtest.h>

#include <set>

#include "isostep/core/random.hpp"

namespace isostep::transport {
namespace replay_window_test {

TEST(ReplayWindow, TellsWhatAListOfAllThatHaveComeTells) {
  Pcg32 random = Pcg32::seeded(7);
  ReplayWindow window;
  std::set<std::uint32_t> come;
  std::uint32_t newest = 0;
  int fresh = 0, stale = 0;
  for (int i = 0; i < 200000; ++i) {
    // Mostly near the newest, on both sides of the window's end; now and then far ahead.
    const std::uint32_t back = random_below(random, 2 * ReplayWindow::kSize),
                        leap = random_below(random, 20) == 0 ? 3000 : 4;
    const std::uint32_t number = i % 3 == 0 ? newest + random_below(random, leap) : newest - std::min(newest, back);
    const bool is_known = come.count(number) != 0;
    const bool is_old = !come.empty() && newest >= ReplayWindow::kSize && number <= newest - ReplayWindow::kSize;
    ASSERT_EQ(window.is_fresh(number), !is_known && !is_old) << number << " after " << newest;
    if (is_known || is_old) {
      ++stale;
      continue;
    }
    ++fresh;
    window.mark(number);
    come.insert(number);
    newest = std::max(newest, number);
  }
  EXPECT_GT(fresh, 50000);
  EXPECT_GT(stale, 50000);
}

TEST(ReplayWindow, GoesBeyondThirtyTwoBits) {
  ReplayWindow window;
  const std::uint64_t last = std::uint64_t{1} << 40;
  window.mark(3);
  window.mark(last);
  EXPECT_FALSE(window.is_fresh(last));
  EXPECT_FALSE(window.is_fresh(3));
  EXPECT_TRUE(window.is_fresh(last - 1));
  EXPECT_TRUE(window.is_fresh(last - ReplayWindow::kSize + 1));
  EXPECT_FALSE(window.is_fresh(last - ReplayWindow::kSize));
}

}  // namespace replay_window_test
}  // namespace isostep::transport
