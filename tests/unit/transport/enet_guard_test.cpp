// The ENet packets that pass: those written here by the protocol's own layout, and none that bend it.
// SPDX-License-Identifier: MIT
#include "transport/enet_guard.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "transport/endpoint.hpp"

namespace isostep::transport {
namespace enet_guard_test {

constexpr std::size_t kMostDatagram = cap_of(Channel::datagram);
constexpr std::size_t kMostReliable = cap_of(Channel::reliable);
using Bytevec = std::vector<std::uint8_t>;

// Numbers of commands and their layouts: ENet 1.3.17, include/enet/protocol.h. Big-endian.
enum Command {
  kAcknowledge = 1,
  kConnect,
  kVerify,
  kDisconnect,
  kPing,
  kReliable,
  kUnreliable,
  kFragment,
  kUnsequenced,
  kBandwidth,
  kThrottle,
  kUnreliableFragment
};

struct Packet {
  Bytevec bytes;

  Packet& u8(std::uint32_t value) { return bytes.push_back(static_cast<std::uint8_t>(value)), *this; }
  Packet& u16(std::uint32_t value) { return u8(value >> 8).u8(value); }
  Packet& u32(std::uint32_t value) { return u16(value >> 16).u16(value); }
  Packet& zeros(std::size_t count) { return bytes.resize(bytes.size() + count), *this; }
  Packet& header() { return u16(0x8000).u16(1234); }  // peer 0, with the time sent
  Packet& command(std::uint32_t number) { return u8(number | 0x80).u8(0).u16(1); }
  Packet& unsequenced(std::size_t size) {
    return u8(kUnsequenced | 0x40).u8(0).u16(0).u16(7).u16(static_cast<std::uint32_t>(size)).zeros(size);
  }
  Packet& reliable(std::size_t size) { return command(kReliable).u16(static_cast<std::uint32_t>(size)).zeros(size); }
  Packet& fragment(std::uint32_t count, std::uint32_t total, std::size_t size) {
    return command(kFragment)
        .u16(1)
        .u16(static_cast<std::uint32_t>(size))
        .u32(count)
        .u32(0)
        .u32(total)
        .u32(0)
        .zeros(size);
  }
  Packet& connect(std::uint32_t mtu, std::uint32_t channels) {
    return command(kConnect).u16(0).u8(0xff).u8(0xff).u32(mtu).u32(65536).u32(channels).zeros(28);
  }
};

bool passes(const Packet& packet) { return is_plausible_enet_packet(packet.bytes); }

TEST(EnetGuard, LetsThroughWhatPeersOfOursSend) {
  EXPECT_TRUE(passes(Packet().u16(0)));
  EXPECT_TRUE(passes(Packet().header().connect(kEnetMtu, 2)));
  EXPECT_TRUE(passes(Packet().header().command(kVerify).zeros(40)));
  EXPECT_TRUE(passes(Packet().header().command(kDisconnect).u32(0)));
  EXPECT_TRUE(passes(Packet().header().command(kBandwidth).zeros(8)));
  EXPECT_TRUE(passes(Packet().header().command(kThrottle).zeros(12)));
  EXPECT_TRUE(passes(Packet().u16(0).unsequenced(kMostDatagram)));
  EXPECT_TRUE(passes(Packet().header().reliable(1000).command(kPing).command(kAcknowledge).u32(0).unsequenced(9)));
  EXPECT_TRUE(passes(Packet().header().fragment(2, 2000, kEnetPiece)));
  EXPECT_TRUE(passes(Packet().header().fragment(14, kMostReliable, kEnetPiece)));
}

TEST(EnetGuard, RefusesWhatOnlyTheHostileSend) {
  EXPECT_FALSE(passes(Packet().header().connect(4096, 2)));
  EXPECT_FALSE(passes(Packet().header().connect(576, 2)));
  EXPECT_FALSE(passes(Packet().header().connect(kEnetMtu, 1)));
  EXPECT_FALSE(passes(Packet().header().connect(kEnetMtu, 255)));
  EXPECT_FALSE(passes(Packet().header().fragment(1 << 20, 1, 1)));
  EXPECT_FALSE(passes(Packet().header().fragment(28000, kMostReliable + 1, 9)));
  EXPECT_FALSE(passes(Packet().header().fragment(0, 0, 0).u8(1)));
  EXPECT_FALSE(passes(Packet().header().command(kUnreliable).u16(1).u16(0)));
  EXPECT_FALSE(passes(Packet().header().command(kUnreliableFragment).zeros(20)));
  EXPECT_FALSE(passes(Packet().u16(0x4000).unsequenced(10)));  // compressed
  EXPECT_FALSE(passes(Packet().u16(0).unsequenced(kEnetMtu)));
}

TEST(EnetGuard, RefusesMoreCommandsThanEnetWrites) {
  Packet packet = Packet().header();
  for (int i = 0; i < 32; ++i) packet.command(kPing);
  EXPECT_TRUE(passes(packet));
  EXPECT_FALSE(passes(packet.command(kPing)));
}

TEST(EnetGuard, RefusesEveryPacketThatIsCutAndReadsNothingBehindIt) {
  const Packet whole =
      Packet().header().command(kAcknowledge).u32(0).reliable(40).fragment(2, 2000, 30).unsequenced(20);
  ASSERT_TRUE(passes(whole));
  // At these lengths a cut leaves whole commands.
  const std::initializer_list<std::size_t> kWhole = {4, 12, 58, 112, whole.bytes.size()};
  std::size_t passed = 0;
  for (std::size_t size = 0; size <= whole.bytes.size(); ++size) {
    const Bytevec cut(whole.bytes.begin(), whole.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const bool is_whole = std::find(kWhole.begin(), kWhole.end(), size) != kWhole.end();
    EXPECT_EQ(is_plausible_enet_packet(cut), is_whole) << size;
    passed += is_whole;
  }
  EXPECT_EQ(passed, kWhole.size());
}

TEST(EnetGuard, RefusesCommandsThatDoNotExist) {
  for (const std::uint32_t number : {0u, 13u, 14u, 15u}) {
    EXPECT_FALSE(passes(Packet().header().command(number).zeros(60))) << number;
  }
}

}  // namespace enet_guard_test
}  // namespace isostep::transport
