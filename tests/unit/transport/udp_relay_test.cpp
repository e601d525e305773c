// The relay between plain sockets: what passes, when, for whom, and what bounds it.
// SPDX-License-Identifier: MIT
#include "transport/udp_relay.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "isostep/core/bytes.hpp"
#include "transport/impaired_direction.hpp"
#include "unit/transport/udp.hpp"

namespace isostep::transport {
namespace udp_relay_test {

using Bytevec = std::vector<std::uint8_t>;

UdpRelay open_relay(const UdpSocket& target, const char* profile, RelaySettings settings = {}) {
  settings.target_port = target.port();
  settings.profile = parse_profile(profile).value();
  Result<UdpRelay> relay = UdpRelay::open(settings);
  EXPECT_TRUE(relay.ok()) << (relay.ok() ? "" : std::string(relay.error().message.view()));
  return std::move(relay.value());
}
/// Turns the relay until the socket got something.
std::optional<UdpSocket::Got> receive(UdpRelay& relay, const UdpSocket& socket) {
  for (const Deadline deadline; !deadline.over();) {
    if (auto got = socket.receive()) return got;
    EXPECT_TRUE(relay.turn(1000).ok());
  }
  return std::nullopt;
}
Bytevec numbered(std::uint32_t number) {
  Bytevec bytes(4);
  store_le(bytes.data(), number);
  return bytes;
}

TEST(UdpRelay, ForwardsToTheTargetAndBackAndKeepsClientsApart) {
  const UdpSocket target, first, second;
  UdpRelay relay = open_relay(target, "loopback");
  first.send(relay.port(), {1, 2, 3});
  const auto from_first = receive(relay, target);
  second.send(relay.port(), {4});
  const auto from_second = receive(relay, target);
  ASSERT_TRUE(from_first && from_second);
  EXPECT_EQ(from_first->bytes, (Bytevec{1, 2, 3}));
  EXPECT_EQ(from_second->bytes, Bytevec{4});
  EXPECT_NE(from_first->from, from_second->from);

  target.send(from_second->from, {5});
  target.send(from_first->from, {6});
  const auto to_first = receive(relay, first), to_second = receive(relay, second);
  ASSERT_TRUE(to_first && to_second);
  EXPECT_EQ(to_first->bytes, Bytevec{6});
  EXPECT_EQ(to_second->bytes, Bytevec{5});
  EXPECT_EQ(to_first->from, relay.port());

  EXPECT_EQ(relay.statistics().clients, 2u);
  EXPECT_EQ(relay.statistics().up.forwarded, 2u);
  EXPECT_EQ(relay.statistics().up.forwarded_bytes, 4u);
  EXPECT_EQ(relay.statistics().down.received_bytes, 2u);
}

/// The system may be without IPv6, and then nothing of it can be tried.
std::optional<UdpRelay> open_ipv6(const char* address, std::uint16_t target) {
  Result<UdpRelay> relay = UdpRelay::open({.listen_address = address, .target_port = target});
  if (!relay) return std::nullopt;
  return std::move(relay.value());
}
UdpRelay open_to_ipv6(std::uint16_t port) {
  Result<UdpRelay> relay = UdpRelay::open({.target_address = "::1", .target_port = port});
  EXPECT_TRUE(relay.ok());
  return std::move(relay.value());
}

TEST(UdpRelay, IsTheWayIntoIPv6AndOutOfIt) {
  for (const char* address : {"::1", "::"}) {
    const UdpSocket target, first, second;
    std::optional<UdpRelay> out = open_ipv6(address, target.port());
    if (!out) GTEST_SKIP() << "no IPv6";
    UdpRelay in = open_to_ipv6(out->port());
    const auto receive_by_both = [&](const UdpSocket& socket) -> std::optional<UdpSocket::Got> {
      for (const Deadline deadline; !deadline.over();) {
        if (auto got = socket.receive()) return got;
        EXPECT_TRUE(in.turn(0).ok() && out->turn(1000).ok());
      }
      return std::nullopt;
    };
    first.send(in.port(), {1});
    const auto from_first = receive_by_both(target);
    second.send(in.port(), {2, 3});
    const auto from_second = receive_by_both(target);
    ASSERT_TRUE(from_first && from_second);
    EXPECT_EQ(from_first->bytes, Bytevec{1});
    EXPECT_EQ(from_second->bytes, (Bytevec{2, 3}));
    EXPECT_NE(from_first->from, from_second->from) << "two ports of one IPv6 address are two clients";
    target.send(from_first->from, {4});
    target.send(from_second->from, {5});
    const auto to_first = receive_by_both(first), to_second = receive_by_both(second);
    ASSERT_TRUE(to_first && to_second);
    EXPECT_EQ(to_first->bytes, Bytevec{4});
    EXPECT_EQ(to_second->bytes, Bytevec{5});
    EXPECT_EQ(out->statistics().clients, 2u);
  }
}

TEST(UdpRelay, OnEveryAddressHearsIPv4AsWell) {
  const UdpSocket target, client;
  std::optional<UdpRelay> relay = open_ipv6("::", target.port());
  if (!relay) GTEST_SKIP() << "no IPv6";
  client.send(relay->port(), {1});
  const auto got = receive(*relay, target);
  ASSERT_TRUE(got.has_value());
  target.send(got->from, {2});
  EXPECT_TRUE(receive(*relay, client).has_value());
}

TEST(UdpRelay, LosesAndDoublesExactlyThePacketsOfItsSeed) {
  const UdpSocket target, client;
  const char* text = "loss=20,duplication=10,burst=1,burst-length=4";
  UdpRelay relay = open_relay(target, text, {.seed = 77});
  ImpairedDirection schedule(parse_profile(text).value().up, 77, 0);
  Bytevec expected, counts(500);
  // Taken as they come: a socket holds only some hundred packets.
  const auto take = [&](int milliseconds) {
    while (const auto got = target.receive(milliseconds)) ++counts[load_le<std::uint32_t>(got->bytes.data())];
  };
  for (std::uint32_t i = 0; i < counts.size(); ++i) {
    expected.push_back(static_cast<std::uint8_t>(schedule.decide(0, 4).copies));
    client.send(relay.port(), numbered(i));
    ASSERT_TRUE(relay.turn(0).ok());
    take(0);
  }
  for (const Deadline deadline; !deadline.over() && relay.statistics().up.received < counts.size();) {
    ASSERT_TRUE(relay.turn(1000).ok());
    take(0);
  }
  take(200);
  EXPECT_EQ(counts, expected);
}

TEST(UdpRelay, HoldsPacketsForTheirDelay) {
  const UdpSocket target, client;
  UdpRelay relay = open_relay(target, "latency=60");
  const auto sent = std::chrono::steady_clock::now();
  client.send(relay.port(), {1});
  ASSERT_TRUE(receive(relay, target).has_value());
  EXPECT_GE(std::chrono::steady_clock::now() - sent, std::chrono::milliseconds(60));
}

TEST(UdpRelay, QueueAndClientsAreBounded) {
  const UdpSocket target, first, second;
  UdpRelay relay = open_relay(target, "latency=60000", {.max_clients = 1, .max_queued = 10});
  for (std::uint8_t i = 0; i < 25; ++i) first.send(relay.port(), {i});
  for (std::uint8_t i = 0; i < 5; ++i) second.send(relay.port(), {i});
  for (const Deadline deadline; !deadline.over() && relay.statistics().turned_away < 5;) {
    ASSERT_TRUE(relay.turn(1000).ok());
  }
  EXPECT_EQ(relay.statistics().turned_away, 5u);
  EXPECT_EQ(relay.statistics().clients, 1u);
  EXPECT_EQ(relay.statistics().up.received, 25u);
  EXPECT_EQ(relay.statistics().up.overflowed, 15u);
}

TEST(UdpRelay, DropsPacketsThatNoPeerOfOursSends) {
  const UdpSocket target, client;
  UdpRelay relay = open_relay(target, "loopback");
  client.send(relay.port(), Bytevec(UdpRelay::kLargestPacket + 1));
  client.send(relay.port(), Bytevec(UdpRelay::kLargestPacket, 3));
  const auto got = receive(relay, target);
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->bytes, Bytevec(UdpRelay::kLargestPacket, 3));
  EXPECT_EQ(relay.statistics().up.overflowed, 1u);
}

TEST(UdpRelay, ATargetThatIsNotThereDoesNotEndTheRelay) {
  const UdpSocket client;
  auto target = std::make_unique<UdpSocket>();
  UdpRelay relay = open_relay(*target, "loopback");
  target.reset();
  for (std::uint8_t i = 0; i < 20; ++i) {
    client.send(relay.port(), {i});
    ASSERT_TRUE(relay.turn(1000).ok());
  }
  for (const Deadline deadline; !deadline.over() && relay.statistics().up.received < 20;) {
    ASSERT_TRUE(relay.turn(1000).ok());
  }
  EXPECT_EQ(relay.statistics().up.forwarded + relay.statistics().up.unsent, 20u);
}

TEST(UdpRelay, RunsInAThreadUntilToldToStop) {
  const UdpSocket target, client;
  UdpRelay relay = open_relay(target, "latency=1");
  std::atomic<bool> stop = false;
  std::thread thread([&] { EXPECT_TRUE(relay.run(stop).ok()); });
  client.send(relay.port(), {42});
  const auto got = target.receive(600000);
  stop = true;
  thread.join();
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->bytes, Bytevec{42});
}

TEST(UdpRelay, RefusesAddressesThatAreNot) {
  EXPECT_FALSE(UdpRelay::open({.target_port = 0}).ok());
  EXPECT_FALSE(UdpRelay::open({.listen_address = "203.0.113.1", .target_port = 9}).ok());  // RFC 5737: nobody's
  const UdpSocket taken;
  EXPECT_FALSE(UdpRelay::open({.listen_port = taken.port(), .target_port = 9}).ok());
}

}  // namespace udp_relay_test
}  // namespace isostep::transport
