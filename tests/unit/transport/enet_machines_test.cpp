// Machines that both connect and accept, as those of a match that goes on without its host.
// SPDX-License-Identifier: MIT
#include "unit/transport/enet_bench.hpp"

namespace isostep::transport {
namespace enet_machines_test {

std::string address_of(const EnetTransport& machine) { return "127.0.0.1:" + std::to_string(machine.port()); }

TEST(EnetTransport, MachinesThatListenConnectToEachOtherAndTellWhoAsked) {
  EnetTransport a = listen_here(), b = listen_here(), c = listen_here();
  Bench bench{{&a, &b, &c}};
  ASSERT_TRUE(b.connect_to(address_of(a)).ok());
  ASSERT_TRUE(c.connect_to(address_of(a)).ok());
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected, 2));
  ASSERT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected));
  // While it has one connection it asks for another, and they ask each other at the same time.
  ASSERT_TRUE(bench.turn_until_heard(2, ArrivalKind::connected));
  ASSERT_TRUE(c.connect_to(address_of(b)).ok());
  ASSERT_TRUE(b.connect_to(address_of(c)).ok());
  ASSERT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected, 3));
  ASSERT_TRUE(bench.turn_until_heard(2, ArrivalKind::connected, 3));
  const std::size_t asked[] = {0, 2, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t outgoing = 0;
    for (const Heard& heard : bench.heard[i]) outgoing += heard.incoming ? 0 : 1;
    EXPECT_EQ(outgoing, asked[i]) << i;
  }
  for (EnetTransport* machine : bench.endpoints) {
    EXPECT_TRUE(machine->send(0, Channel::reliable, Bytevec(3)).ok());
    EXPECT_TRUE(machine->send(1, Channel::reliable, Bytevec(3)).ok());
  }
  for (const std::size_t i : {0u, 1u, 2u}) EXPECT_TRUE(bench.turn_until_heard(i, ArrivalKind::message, 2));
}

TEST(EnetTransport, ANewAttemptTakesThePlaceOfTheOneUnderWay) {
  const UdpSocket silent;
  EnetTransport a = listen_here({.max_peers = 1, .timeout = kPatience}), b = listen_here();
  Bench bench{{&a, &b}};
  ASSERT_TRUE(a.connect_to("127.0.0.1", silent.port()).ok());
  for (int i = 0; i < 5; ++i) bench.turn();
  ASSERT_TRUE(a.connect_to(address_of(b)).ok());
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected));
  EXPECT_EQ(bench.count(0, ArrivalKind::disconnected), 0u);
  EXPECT_EQ(a.connect_to(address_of(b)).error().code, ErrorCode::limit);
  ASSERT_TRUE(a.connect_again().ok());
  EXPECT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected, 2));
  EXPECT_TRUE(bench.turn_until_heard(1, ArrivalKind::disconnected));
}

TEST(EnetTransport, ConnectingAgainLeavesNoConnectionThatOthersAskedFor) {
  EnetTransport a = listen_here({.max_peers = 2, .timeout = kPatience}), b = listen_here(), c = listen_here();
  Bench bench{{&a, &b, &c}};
  ASSERT_TRUE(a.connect_to(address_of(b)).ok());
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected));
  ASSERT_TRUE(bench.turn_until_heard(1, ArrivalKind::connected));
  b.disconnect(0);
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::disconnected));
  ASSERT_TRUE(c.connect_to(address_of(a)).ok());
  ASSERT_TRUE(bench.turn_until_heard(2, ArrivalKind::connected));
  EXPECT_EQ(bench.heard[0].back().peer, 0u);  // the place of the connection that is over
  ASSERT_TRUE(a.connect_again().ok());
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::connected, 3));
  EXPECT_TRUE(c.send(0, Channel::reliable, Bytevec(1)).ok());
  EXPECT_TRUE(bench.turn_until_heard(0, ArrivalKind::message));
}

TEST(EnetTransport, WhoOnlyConnectsAcceptsNobody) {
  const UdpSocket silent;
  EnetTransport host = listen_here({.timeout = 100 * kMs}), client = connect_to(silent.port());
  // Its port is the system's choice: the silent socket hears from which one it asks.
  const std::optional<UdpSocket::Got> asked = silent.receive(10000);
  ASSERT_TRUE(asked.has_value());
  client.disconnect(0);
  Bench bench{{&host, &client}};
  ASSERT_TRUE(host.connect_to("127.0.0.1", asked->from).ok());
  ASSERT_TRUE(bench.turn_until_heard(0, ArrivalKind::disconnected));
  EXPECT_EQ(bench.heard[1].size(), 0u);
}

TEST(EnetTransport, AnAddressThatOthersTellIsNotLookedUp) {
  EnetTransport machine = listen_here();
  for (const char* text : {"", ":", "localhost:4000", "127.0.0.1", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:65536",
                           "127.0.0.1:40 ", "127.0.0.1:-4", "127.0.0.1:+4", "1.2.3:4", "[::1]:4000", "\n"}) {
    EXPECT_FALSE(machine.connect_to(text).ok()) << text;
  }
  EXPECT_FALSE(machine.connect_to("127.0.0.1", 0).ok());
}

}  // namespace enet_machines_test
}  // namespace isostep::transport
