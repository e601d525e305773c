// StallBudget: a sum over the last minute, held against a list of all that was spent.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/stall_budget.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "isostep/core/random.hpp"

namespace isostep {
namespace stall_budget_test {

TEST(StallBudget, ForgetsWhatIsAMinuteOld) {
  StallBudget budget;
  budget.spend(3 * kSecond, 100 * kSecond);
  budget.spend(1 * kSecond, 110 * kSecond);
  EXPECT_EQ(budget.spent(110 * kSecond), 4 * kSecond);
  EXPECT_EQ(budget.spent(154 * kSecond), 4 * kSecond);
  EXPECT_EQ(budget.spent(160 * kSecond), 1 * kSecond);
  EXPECT_EQ(budget.spent(170 * kSecond), 0u);
  budget.spend(kSecond, 1'000'000 * kSecond);
  EXPECT_EQ(budget.spent(1'000'000 * kSecond), kSecond) << "after any pause";
}

TEST(StallBudget, IsTheSumOfFiftyFiveToSixtySeconds) {
  Pcg32 random = Pcg32::seeded(1);
  StallBudget budget;
  std::vector<std::pair<Time, Time>> all;
  Time now = 0;
  for (int n = 0; n < 3000; ++n) {
    now += random.next() % 400000;
    const Time time = random.next() % 1000;
    budget.spend(time, now);
    all.emplace_back(now, time);
    Time least = 0, most = 0;
    for (const auto& [when, spent] : all) {
      if (when + 55 * kSecond > now) least += spent;
      if (when + 60 * kSecond > now) most += spent;
    }
    ASSERT_GE(budget.spent(now), least);
    ASSERT_LE(budget.spent(now), most);
  }
}

}  // namespace stall_budget_test
}  // namespace isostep
