// PeerLink: how much a peer may say, and how far away it is.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/peer_link.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace peer_link_test {

TEST(Allowance, ASteadyPeerWithinItIsAlwaysHeard) {
  for (const std::uint32_t most : {1u, 2u, 60u, 480u, 1000000u}) {
    Allowance allowance;
    allowance.start(0);
    for (Time i = 1; i <= 1000; ++i) ASSERT_TRUE(allowance.spend(most, (i * kSecond + most - 1) / most)) << most;
  }
}

TEST(Allowance, AFloodIsCutDownToIt) {
  Allowance allowance;
  allowance.start(0);
  int heard = 0;
  for (Time now = 0; now < 10 * kSecond; now += 10) heard += allowance.spend(480, now) ? 1 : 0;  // 100,000 a second
  EXPECT_GE(heard, 4799);
  EXPECT_LE(heard, 4800 + 16);
}

TEST(Allowance, SilenceSavesUpAQuarterOfASecond) {
  Allowance allowance;
  allowance.start(0);
  allowance.spend(400, 0);
  int heard = 0;
  for (int i = 0; i < 1000; ++i) heard += allowance.spend(400, 3600 * kSecond) ? 1 : 0;
  EXPECT_EQ(heard, 100);
}

TEST(Allowance, TheLargestDoesNotOverflow) {
  Allowance allowance;
  allowance.start(0);
  for (Time now = 0; now < 100 * kSecond; now += kSecond) ASSERT_TRUE(allowance.spend(0xffffffffu, now));
  ASSERT_TRUE(allowance.spend(0xffffffffu, ~Time{0}));
}

PacketHeader echo(std::uint16_t echo_ms) {
  PacketHeader header;
  header.has_echo = true;
  header.echo = echo_ms;
  return header;
}

TEST(PeerLink, TheRoundTripIsWhatTheEchoIsOldAndIsSmoothed) {
  PeerLink link;
  link.set_clock(PacketHeader{}, 5000000);
  EXPECT_TRUE(link.has_clock);
  EXPECT_EQ(link.round_trip, 0u);
  link.set_clock(echo(4950), 5000000);
  EXPECT_EQ(link.round_trip, 50000u);
  link.set_clock(echo(4910), 5000000);  // 90 ms: an eighth of the difference
  EXPECT_EQ(link.round_trip, 55000u);
}

TEST(PeerLink, ClocksThatWrapAreFollowed) {
  PeerLink link;
  link.set_clock(echo(65500), Time{65536 + 14} * 1000);
  EXPECT_EQ(link.round_trip, 50000u);
}

TEST(PeerLink, AnEchoFromTheFutureIsIgnored) {
  PeerLink link;
  link.set_clock(echo(5001), 5000000);
  EXPECT_EQ(link.round_trip, 0u);
  for (std::uint32_t any = 0; any < 65536; ++any) {
    link.set_clock(echo(static_cast<std::uint16_t>(any)), 5000000);
    ASSERT_LE(link.round_trip, 32767000u);
  }
}

}  // namespace peer_link_test
}  // namespace isostep
