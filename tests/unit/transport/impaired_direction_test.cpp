// Fates measured over many packets against the conditions they come from.
// SPDX-License-Identifier: MIT
#include "transport/impaired_direction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace isostep::transport {
namespace impaired_direction_test {

constexpr std::size_t kBytes = 100;

/// Packet i is sent at i * every.
std::vector<Fate> fates(const Conditions& conditions, std::size_t packets, Time every, std::uint64_t seed = 1,
                        std::uint64_t stream = 0) {
  ImpairedDirection direction(conditions, seed, stream);
  std::vector<Fate> result;
  for (std::size_t i = 0; i < packets; ++i) result.push_back(direction.decide(i * every, kBytes));
  return result;
}

/// Four standard deviations of a count of `trials` with this probability.
void expect_share(double count, double trials, double probability, const std::string& what) {
  EXPECT_NEAR(count, trials * probability, 4 * std::sqrt(trials * probability * (1 - probability)) + 1e-9) << what;
}

TEST(ImpairedDirection, ASeedIsOneSchedule) {
  for (const NetworkProfile& profile : named_profiles()) {
    const std::vector<Fate> first = fates(profile.up, 1000, 16667, 7, 3), again = fates(profile.up, 1000, 16667, 7, 3);
    EXPECT_EQ(first, again) << profile.name.view();
    if (profile.up.jitter == 0) continue;
    const std::vector<Fate> seeded = fates(profile.up, 1000, 16667, 8, 3), other = fates(profile.up, 1000, 16667, 7, 4);
    EXPECT_NE(first, seeded) << profile.name.view();
    EXPECT_NE(first, other) << profile.name.view();
  }
}

TEST(ImpairedDirection, EveryPacketTakesSixNumbersInAStatedOrder) {
  const Conditions conditions = {.latency = 1000,
                                 .jitter = 300,
                                 .loss = 200,
                                 .burst = 50,
                                 .burst_length = 3,
                                 .duplication = 300,
                                 .reordering = 250,
                                 .hold = 5000};
  ImpairedDirection direction(conditions, 99, 5);
  Pcg32 numbers = Pcg32::seeded(99, 5);
  const auto below = [&](std::uint64_t bound) { return static_cast<Time>(numbers.next() * bound / (1ull << 32)); };
  int burst_left = 0;
  for (Time now = 0; now < 2000; ++now) {
    const bool lost = below(1000) < 200, begins = below(1000) < 50, doubled = below(1000) < 300,
               held = below(1000) < 250;
    const Time first = 700 + below(601), second = 700 + below(601);
    if (begins && burst_left == 0) burst_left = 3;
    const bool in_burst = burst_left > 0 && burst_left-- > 0;
    const Fate fate = direction.decide(now, kBytes);
    ASSERT_EQ(fate.copies, lost || in_burst ? 0u : doubled ? 2u : 1u) << now;
    ASSERT_EQ(fate.arrives[0], fate.copies > 0 ? now + first + (held ? 5000 : 0) : 0) << now;
    ASSERT_EQ(fate.arrives[1], fate.copies > 1 ? now + second : 0) << now;
  }
}

TEST(ImpairedDirection, OneConditionChangedLeavesTheOthersChoicesAsTheyWere) {
  const std::vector<Fate> clean = fates({.latency = 50000, .jitter = 20000}, 5000, 1000);
  const std::vector<Fate> lossy = fates({.latency = 50000, .jitter = 20000, .loss = 300}, 5000, 1000);
  for (std::size_t i = 0; i < clean.size(); ++i) {
    ASSERT_EQ(lossy[i].arrives[0], lossy[i].copies == 0 ? 0 : clean[i].arrives[0]);
  }
}

class FateInEveryProfile : public testing::TestWithParam<std::tuple<std::size_t, Direction>> {
 protected:
  const NetworkProfile& profile() const { return named_profiles()[std::get<0>(GetParam())]; }
  const Conditions& conditions() const { return profile().of(std::get<1>(GetParam())); }
  /// Blackouts are over by then in no profile, so they are measured by themselves.
  std::vector<Fate> measured() const {
    Conditions lit = conditions();
    lit.blackout = 0;
    return fates(lit, kPackets, 1000, 11 + std::get<0>(GetParam()),
                 static_cast<std::uint64_t>(std::get<1>(GetParam())));
  }
  static constexpr std::size_t kPackets = 500000;
};

TEST_P(FateInEveryProfile, LosesItsShare) {
  const std::vector<Fate> all = measured();
  const double lost = static_cast<double>(std::count_if(all.begin(), all.end(), [](auto& f) { return f.copies == 0; }));
  const double n = kPackets, loss = conditions().loss / 1000.0;
  if (conditions().burst == 0) return expect_share(lost, n, loss, "lost");
  // Bursts are a renewal process: L packets lost, then a geometric number of others. The number of renewals in n has
  // mean n / mu and variance n sigma^2 / mu^3 (Feller 1968, An Introduction to Probability Theory I, XIII.6).
  ASSERT_EQ(conditions().loss, 0u);
  const double p = conditions().burst / 1000.0, length = conditions().burst_length;
  const double mu = length + (1 - p) / p, sigma = std::sqrt(1 - p) / p;
  EXPECT_NEAR(lost, length * n / mu, 4 * length * sigma * std::sqrt(n / (mu * mu * mu)));
}

TEST_P(FateInEveryProfile, DelaysByItsLatencyGiveOrTakeItsJitter) {
  const std::vector<Fate> all = measured();
  const Time low = conditions().latency - conditions().jitter, width = 2 * conditions().jitter + 1;
  double sum = 0, count = 0, held = 0;
  std::vector<double> bins(16);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::uint32_t copy = 0; copy < all[i].copies; ++copy) {
      Time late = all[i].arrives[copy] - i * 1000 - low;
      if (late >= width) {
        ASSERT_EQ(copy, 0u);
        ASSERT_GE(late, conditions().hold);
        late -= conditions().hold;
        ++held;
      }
      ASSERT_LT(late, width);
      sum += static_cast<double>(late);
      ++count;
      ++bins[static_cast<std::size_t>(late * bins.size() / width)];
    }
  }
  expect_share(held, static_cast<double>(kPackets), conditions().reordering / 1000.0, "held back");
  const double half = conditions().jitter;
  EXPECT_NEAR(sum / count, half, 4 * 2 * half / std::sqrt(12 * count) + 1e-9);  // of the uniform distribution
  if (conditions().jitter == 0) return;
  for (const double bin : bins) expect_share(bin, count, 1 / 16.0, "of a sixteenth of the delays");
}

TEST_P(FateInEveryProfile, DoublesItsShareOfWhatArrives) {
  const std::vector<Fate> all = measured();
  double arrived = 0, doubled = 0;
  for (const Fate& fate : all) {
    arrived += fate.copies != 0;
    doubled += fate.copies == 2;
  }
  expect_share(doubled, arrived, conditions().duplication / 1000.0, "doubled");
}

TEST_P(FateInEveryProfile, IsDarkExactlyInItsBlackout) {
  Conditions dark = conditions();
  dark.loss = dark.burst = 0;
  const std::vector<Fate> all = fates(dark, 60000, 1000);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool inside = dark.blackout != 0 && i >= 5000 && i < 35000;
    ASSERT_EQ(all[i].copies == 0, inside) << i << " ms";
  }
}

INSTANTIATE_TEST_SUITE_P(All, FateInEveryProfile,
                         testing::Combine(testing::Range<std::size_t>(0, named_profiles().size()),
                                          testing::Values(Direction::up, Direction::down)),
                         [](const auto& tested) {
                           std::string name(named_profiles()[std::get<0>(tested.param)].name.view());
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + (std::get<1>(tested.param) == Direction::up ? "_up" : "_down");
                         });

TEST(ImpairedDirection, ABurstTakesTenPacketsInARow) {
  const std::vector<Fate> all = fates(parse_profile("burst").value().up, 500000, 1000, 3);
  std::size_t run = 0, runs = 0, single = 0;
  for (const Fate& fate : all) {
    if (fate.copies == 0) {
      ++run;
    } else if (run != 0) {
      ASSERT_EQ(run % 10, 0u);
      ++runs;
      single += run == 10;
      run = 0;
    }
  }
  // One burst follows upon another with the chance that any packet begins one.
  expect_share(static_cast<double>(single), static_cast<double>(runs), 0.99, "bursts alone");
  EXPECT_GT(runs, 4000u);
}

TEST(ImpairedDirection, JitterReordersAndAConstantDelayDoesNot) {
  const auto overtaken = [](const char* name) {
    Time latest = 0;
    int count = 0;
    for (const Fate& fate : fates(parse_profile(name).value().up, 6000, 16667)) {
      if (fate.copies == 0) continue;
      count += fate.arrives[0] < latest;
      latest = std::max(latest, fate.arrives[0]);
    }
    return count;
  };
  EXPECT_EQ(overtaken("lan"), 0);
  EXPECT_EQ(overtaken("constant"), 0);
  EXPECT_GT(overtaken("wifi"), 600);
  // Whoever is not held and has a held one among the two before it: 0.9 (1 - 0.9^2). Neighbours are not independent,
  // hence eight deviations of independent ones.
  EXPECT_NEAR(overtaken("reorder"), 6000 * 0.171, 8 * std::sqrt(6000 * 0.171 * 0.829));
}

TEST(ImpairedDirection, ABurstUnderWayGoesOnWhenConditionsChange) {
  ImpairedDirection direction({.burst = 1000, .burst_length = 10}, 1, 0);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(direction.decide(0, kBytes).copies, 0u);
  direction.set_conditions({});
  for (int i = 4; i < 10; ++i) EXPECT_EQ(direction.decide(0, kBytes).copies, 0u);
  EXPECT_EQ(direction.decide(0, kBytes).copies, 1u);
}

TEST(ImpairedDirection, ABottleneckSpacesPacketsAndDropsWhatWouldWaitTooLong) {
  // 100 bytes at 10 kB/s take 10 ms; one packet each 5 ms is twice what passes.
  const std::vector<Fate> all = fates({.latency = 1000, .rate = 10000}, 4000, 5000);
  Time last = 0;
  std::size_t passed = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].copies == 0) continue;
    ++passed;
    ASSERT_TRUE(last == 0 || all[i].arrives[0] - last == 10000);
    last = all[i].arrives[0];
    ASSERT_LE(last - i * 5000, 1000u + 200000u + 10000u);
  }
  EXPECT_NEAR(static_cast<double>(passed), 2000 + 20, 2);  // half of them, and the queue's 200 ms at the end
  for (const Fate& fate : fates({.latency = 1000, .rate = 10000}, 1000, 10000)) EXPECT_EQ(fate.copies, 1u);
}

TEST(ImpairedDirection, ADelayIsNeverNegative) {
  const std::vector<Fate> all = fates({.latency = 1000, .jitter = 5000}, 10000, 0);
  double at_once = 0;
  for (const Fate& fate : all) {
    ASSERT_LE(fate.arrives[0], 6000u);
    at_once += fate.arrives[0] == 0;
  }
  expect_share(at_once, 10000, 4001.0 / 10001, "at once");
}

}  // namespace impaired_direction_test
}  // namespace isostep::transport
