// Sessions of C across UDP on this machine: a match of two, by nothing but isostep.h and isostep_udp.h.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep_udp.h"
#include "tally_game.hpp"

namespace isostep::test {
namespace udp_test {

TEST(CUdp, TwoPlayTheSameMatch) {
  iso_udp *host_port = nullptr, *client_port = nullptr;
  char problem[160];
  iso_udp_settings settings;
  ASSERT_EQ(iso_udp_settings_init(&settings), ISO_OK);
  std::strcpy(settings.bind_address, "127.0.0.1");
  ASSERT_EQ(iso_udp_listen(0, &settings, &host_port, problem, sizeof problem), ISO_OK) << problem;
  ASSERT_NE(iso_udp_port(host_port), 0);
  ASSERT_EQ(iso_udp_connect("127.0.0.1", iso_udp_port(host_port), nullptr, &client_port, problem, sizeof problem),
            ISO_OK)
      << problem;
  Tally tallies[2];
  iso_session* sessions[2] = {};
  for (int n : {0, 1}) {
    iso_session_config config = tally_config(ISO_ROLLBACK);
    config.host = n == 0;
    config.seed = n == 0 ? 3 : 0;
    const iso_game game = tallies[n].describe(false);
    ASSERT_EQ(iso_session_create(&config, &game, nullptr, 0, &sessions[n]), ISO_OK) << iso_last_error();
  }
  iso_udp* const ports[2] = {host_port, client_port};
  // The sessions' time is virtual: a turn is a millisecond of theirs, however long it takes.
  std::uint64_t now = 0;
  for (; tallies[0].hashes.size() < 200 || tallies[1].hashes.size() < 200; now += 1000) {
    ASSERT_LT(now, 600000000u);
    for (int n : {0, 1}) {
      const std::uint8_t what = tally_input(iso_session_current(sessions[n]), n);
      ASSERT_EQ(iso_udp_deliver(ports[n], sessions[n], now), ISO_OK);
      iso_session_add_local_input(sessions[n], n, &what, 1);
      ASSERT_EQ(iso_session_drive(sessions[n], now, nullptr), ISO_OK);
      ASSERT_EQ(iso_udp_dispatch(ports[n], sessions[n], now), ISO_OK);
    }
    ASSERT_EQ(iso_udp_wait(client_port, 1000), ISO_OK);
  }
  for (Tally& tally : tallies) tally.hashes.resize(200);
  EXPECT_EQ(tallies[0].hashes, tallies[1].hashes);
  EXPECT_NE(tallies[0].hashes[50], tallies[0].hashes[150]);
  iso_udp_statistics statistics{};
  statistics.size = sizeof statistics;
  ASSERT_EQ(iso_udp_get_statistics(host_port, &statistics), ISO_OK);
  EXPECT_GT(statistics.packets_received, 100u);
  for (int n : {0, 1}) {
    EXPECT_EQ(iso_udp_destroy(ports[n]), ISO_OK);
    EXPECT_EQ(iso_session_destroy(sessions[n]), ISO_OK);
  }
  for (iso_udp* port : ports) EXPECT_EQ(iso_udp_port(port), 0);  // also of the one that was opened last
  for (iso_udp* port : ports) EXPECT_EQ(iso_udp_destroy(port), ISO_NOT_ALIVE);
}

/// A machine over UDP whose packets have a key; 0: none.
struct Keyed {
  Tally tally;
  iso_udp* port = nullptr;
  iso_session* session = nullptr;

  Keyed(std::uint8_t key, const Keyed* host) {
    iso_udp_settings settings;
    EXPECT_EQ(iso_udp_settings_init(&settings), ISO_OK);
    for (const std::uint8_t byte : settings.key) EXPECT_EQ(byte, 0);
    if (key != 0) settings.key[15] = key;
    char problem[160] = "";
    const iso_status opened = host == nullptr ? iso_udp_listen(0, &settings, &port, problem, sizeof problem)
                                              : iso_udp_connect("127.0.0.1", iso_udp_port(host->port), &settings, &port,
                                                                problem, sizeof problem);
    EXPECT_EQ(opened, ISO_OK) << problem;
    iso_session_config config = tally_config(ISO_ROLLBACK);
    config.host = host == nullptr;
    config.seed = host == nullptr ? 3 : 0;
    const iso_game game = tally.describe(false);
    EXPECT_EQ(iso_session_create(&config, &game, nullptr, 0, &session), ISO_OK) << iso_last_error();
  }
  Keyed(const Keyed&) = delete;
  ~Keyed() {
    EXPECT_EQ(iso_udp_destroy(port), ISO_OK);
    EXPECT_EQ(iso_session_destroy(session), ISO_OK);
  }
  void turn(std::uint64_t now) {
    const std::uint8_t what = 1;
    EXPECT_EQ(iso_udp_deliver(port, session, now), ISO_OK);
    iso_session_add_local_input(session, iso_session_local_player(session), &what, 1);
    EXPECT_EQ(iso_session_drive(session, now, nullptr), ISO_OK);
    EXPECT_EQ(iso_udp_dispatch(port, session, now), ISO_OK);
  }
  iso_udp_statistics statistics() const {
    iso_udp_statistics statistics{};
    statistics.size = sizeof statistics;
    EXPECT_EQ(iso_udp_get_statistics(port, &statistics), ISO_OK);
    return statistics;
  }
};

TEST(CUdp, WhoHasAnotherKeyOrNoneIsNoPeer) {
  for (const std::uint8_t key : {7, 0}) {
    Keyed host(key, nullptr), stranger(9, &host), keyless(key == 0 ? 8 : 0, &host), client(key, &host);
    std::uint64_t now = 0;
    for (; client.tally.hashes.size() < 100 || stranger.statistics().packets_sent < 3; now += 1000) {
      ASSERT_LT(now, 600000000u);
      for (Keyed* one : {&host, &stranger, &keyless, &client}) one->turn(now);
      ASSERT_EQ(iso_udp_wait(client.port, 1000), ISO_OK);
    }
    for (Keyed* one : {&stranger, &keyless}) {
      EXPECT_EQ(iso_session_phase(one->session), ISO_WAITING) << int{key};
      EXPECT_TRUE(one->tally.hashes.empty());
      EXPECT_EQ(one->statistics().packets_received, 0u) << "who lacks the key is not answered";
    }
    EXPECT_GE(host.statistics().implausible, 4u);
    iso_session_stats stats{};
    stats.size = sizeof stats;
    ASSERT_EQ(iso_session_get_stats(host.session, &stats), ISO_OK);
    EXPECT_EQ(stats.peers, 1);
  }
}

TEST(CUdp, WhatCannotBeOpenedSaysWhy) {
  iso_udp* port = nullptr;
  char problem[160] = "";
  iso_udp_settings settings;
  ASSERT_EQ(iso_udp_settings_init(&settings), ISO_OK);
  std::strcpy(settings.bind_address, "192.0.2.1");  // an address for documentation, of no machine
  EXPECT_EQ(iso_udp_listen(0, &settings, &port, problem, sizeof problem), ISO_REFUSED);
  EXPECT_NE(problem[0], 0);
  EXPECT_EQ(port, nullptr);
  std::memset(settings.bind_address, 'x', sizeof settings.bind_address);
  EXPECT_EQ(iso_udp_listen(0, &settings, &port, nullptr, 0), ISO_REFUSED);
  EXPECT_EQ(iso_udp_listen(0, nullptr, nullptr, nullptr, 0), ISO_NULL);
  EXPECT_EQ(iso_udp_connect(nullptr, 1, nullptr, &port, nullptr, 0), ISO_NULL);
  EXPECT_EQ(iso_udp_deliver(nullptr, nullptr, 0), ISO_NULL);
}

}  // namespace udp_test
}  // namespace isostep::test
