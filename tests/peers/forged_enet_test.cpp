// A match over ENet with a machine on the line that alters what it sees, a hundred thousand times: nobody notices.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "enet_machine.hpp"
#include "isostep/core/random.hpp"
#include "unit/transport/middle.hpp"

namespace isostep::test {
namespace forged_enet_test {

using transport::EnetTransport;
using transport::Middle;
using Bytevec = Middle::Bytevec;

constexpr Time kPatience = 600 * kSecond;

SessionConfig config_of(bool host) {
  SessionConfig config;
  config.players = 2;
  config.mode = SessionMode::lockstep;
  config.host = host;
  config.seed = host ? 7 : 0;
  config.silence = config.patience = kPatience;
  return config;
}

struct Machine : RememberingMachine {
  Machine(EnetTransport its_port, bool host) : RememberingMachine(std::move(its_port), config_of(host)) {}
  int bad_events() {
    using Kind = SessionEvent::Kind;
    return count(Kind::left) + count(Kind::lost_host) + count(Kind::desync);
  }
};

TEST(ForgedOverEnet, AHundredThousandAlteredDatagramsLeaveAMatchRunning) {
  const transport::EnetSettings settings = {.bind_address = "127.0.0.1", .timeout = kPatience};
  Machine host(std::move(EnetTransport::listen(0, settings).value()), true);
  Middle middle(host.port.port());
  Machine client(std::move(EnetTransport::connect("127.0.0.1", middle.port(), settings).value()), false);
  Time now = 0;  // of the sessions: virtual
  const auto turn = [&] {
    now += 4000;
    host.turn(now);
    middle.turn();
    client.turn(now);
    middle.turn();
  };
  const auto play_to = [&](Frame frame) {
    for (const transport::Deadline deadline; std::min(host.end(), client.end()) < frame && !deadline.over();) turn();
  };
  play_to(60);
  Pcg32 random = Pcg32::seeded(1);
  const std::uint64_t before = host.port.statistics().implausible + client.port.statistics().implausible;
  std::uint32_t said = 0;
  for (; said < 100000; ++said) {
    const auto& seen = said % 4 < 2 ? middle.up : middle.down;
    // Of the newest, whose numbers are those that come next.
    const std::size_t newest = std::min<std::size_t>(seen.size(), 64);
    Bytevec bytes = seen[seen.size() - 1 - random_below(random, static_cast<std::uint32_t>(newest))];
    const auto size = static_cast<std::uint32_t>(bytes.size());
    switch (random_below(random, 4)) {
      case 0: bytes.resize(random_below(random, size)); break;
      case 1: bytes.push_back(static_cast<std::uint8_t>(random.next())); break;
      default: bytes[random_below(random, size)] ^= static_cast<std::uint8_t>(1 + random_below(random, 255));
    }
    said % 2 == 0 ? middle.say_to_host(bytes) : middle.say_to_client(bytes);
    if (said % 50 == 49) turn();
  }
  const Frame reached = std::max(host.end(), client.end());
  EXPECT_GT(reached, 300);
  play_to(reached + 120);
  ASSERT_GE(std::min(host.end(), client.end()), reached + 120);
  for (Frame frame = 0; frame < reached + 120; ++frame) {
    ASSERT_EQ(host.hashes.at(frame), client.hashes.at(frame)) << frame;
  }
  EXPECT_EQ(host.bad_events() + client.bad_events(), 0);
  EXPECT_EQ(host.session.stats().refused + client.session.stats().refused, 0u);
  const std::uint64_t refused = host.port.statistics().implausible + client.port.statistics().implausible - before;
  EXPECT_LE(refused, said);
  EXPECT_GT(refused, said / 10 * 9) << "the system drops some where its buffers are full";
}

}  // namespace forged_enet_test
}  // namespace isostep::test
