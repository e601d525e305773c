// Named profiles are those of the design, and the text form says what it means or is refused.
// SPDX-License-Identifier: MIT
#include "transport/network_profile.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace isostep::transport {
namespace network_profile_test {

const NetworkProfile& named(const std::string& name) {
  for (const NetworkProfile& profile : named_profiles()) {
    if (profile.name.view() == name) return profile;
  }
  ADD_FAILURE() << "no profile " << name;
  return named_profiles().front();
}

TEST(NetworkProfile, EveryNameIsThereOnceAndParsesToItself) {
  std::set<std::string> names;
  for (const NetworkProfile& profile : named_profiles()) {
    const std::string name(profile.name.view());
    EXPECT_TRUE(names.insert(name).second) << name;
    const Result<NetworkProfile> parsed = parse_profile(name);
    ASSERT_TRUE(parsed.ok()) << name;
    EXPECT_EQ(parsed.value().name, profile.name);
    EXPECT_EQ(parsed.value().up, profile.up);
    EXPECT_EQ(parsed.value().down, profile.down);
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"loopback", "lan", "wifi", "mobile", "severe", "burst", "duplicate", "reorder",
                                   "asymmetric", "constant", "blackout", "blackout-up", "blackout-down"}));
}

TEST(NetworkProfile, DelaysAndLossesAreThoseOfTheDesign) {
  const auto expect = [](const char* name, std::uint32_t latency, std::uint32_t jitter, std::uint32_t loss) {
    for (const Direction direction : kDirections) {
      const Conditions& conditions = named(name).of(direction);
      EXPECT_EQ(conditions.latency, latency * 1000) << name;
      EXPECT_EQ(conditions.jitter, jitter * 1000) << name;
      EXPECT_EQ(conditions.loss, loss * 10) << name;
    }
  };
  expect("loopback", 0, 0, 0);
  expect("lan", 10, 0, 0);
  expect("wifi", 50, 20, 1);
  expect("mobile", 100, 20, 5);
  expect("severe", 200, 20, 15);
  EXPECT_EQ(named("asymmetric").up, (Conditions{.latency = 10000}));
  EXPECT_EQ(named("asymmetric").down, (Conditions{.latency = 200000}));
  EXPECT_EQ(named("constant").up, (Conditions{.latency = 100000}));
  EXPECT_EQ(named("burst").up.burst_length, 10u);
  EXPECT_EQ(named("duplicate").up.duplication, 20u);
  EXPECT_GT(named("reorder").up.reordering, 0u);
  EXPECT_EQ(named("blackout").up.blackout, 30 * kSecond);
  EXPECT_EQ(named("blackout").down.blackout, 30 * kSecond);
  EXPECT_EQ(named("blackout-up").down.blackout, 0u);
  EXPECT_EQ(named("blackout-down").up.blackout, 0u);
}

TEST(NetworkProfile, TextSetsBothDirectionsOrOne) {
  const Result<NetworkProfile> target = parse_profile("latency=100,jitter=30,loss=5");
  ASSERT_TRUE(target.ok());
  EXPECT_EQ(target.value().name.view(), "explicit");
  EXPECT_EQ(target.value().up, (Conditions{.latency = 100000, .jitter = 30000, .loss = 50}));
  EXPECT_EQ(target.value().down, target.value().up);

  const Result<NetworkProfile> changed = parse_profile("lan,down.loss=2.5,up.latency=0.25");
  ASSERT_TRUE(changed.ok());
  EXPECT_EQ(changed.value().up, (Conditions{.latency = 250}));
  EXPECT_EQ(changed.value().down, (Conditions{.latency = 10000, .loss = 25}));

  const Result<NetworkProfile> all = parse_profile(
      "burst=1.5,burst-length=7,duplication=2,reordering=3,hold=40,rate=12.5,blackout-start=1000,blackout=30000");
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(all.value().up, (Conditions{.burst = 15,
                                        .burst_length = 7,
                                        .duplication = 20,
                                        .reordering = 30,
                                        .hold = 40000,
                                        .rate = 12500,
                                        .blackout_start = 1 * kSecond,
                                        .blackout = 30 * kSecond}));
}

TEST(NetworkProfile, TextThatIsNotOneIsRefusedByItsItem) {
  const struct {
    const char* text;
    const char* place;
  } kWrong[] = {{"", ""},
                {"wify", "wify"},
                {"latency=100,", ""},
                {"latency=100,wifi", "wifi"},  // a name comes first
                {"latency", "latency"},
                {"latency=", "latency="},
                {"latency=.5", "latency=.5"},
                {"latency=5.", "latency=5."},
                {"latency=-5", "latency=-5"},
                {"latency=1e3", "latency=1e3"},
                {"latency=1.2.3", "latency=1.2.3"},
                {"latency= 5", "latency= 5"},
                {"latency=60000.001", "latency=60000.001"},
                {"latency=0.0001", "latency=0.0001"},
                {"latency=99999999999999999999999", "latency=99999999999999999999999"},
                {"loss=100.1", "loss=100.1"},
                {"loss=0.55", "loss=0.55"},
                {"left.loss=5", "left.loss=5"},
                {"up.down.loss=5", "up.down.loss=5"},
                {"Loss=5", "Loss=5"},
                {"burst=1", "burst"},
                {"hold=20", "reordering"}};
  for (const auto& wrong : kWrong) {
    const Result<NetworkProfile> parsed = parse_profile(wrong.text);
    ASSERT_FALSE(parsed.ok()) << wrong.text;
    EXPECT_EQ(parsed.error().place.view(), wrong.place) << wrong.text;
  }
  EXPECT_TRUE(parse_profile("latency=60000,loss=100").ok());
}

}  // namespace network_profile_test
}  // namespace isostep::transport
