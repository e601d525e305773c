// iso_session_go_on: a match that stands for lack of a majority, or of its host, goes on with those who are here.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tally_game.hpp"

namespace isostep::test {
namespace go_on_test {

constexpr std::uint64_t kSecond = 1000000;

/// Machines with migration on a network in virtual time; machine 0 is the host.
struct Migrating {
  std::vector<Tally> tallies;
  std::vector<iso_session*> sessions;
  std::vector<char> are_silent;
  iso_network* network = nullptr;
  std::uint64_t now = 0;

  Migrating(std::uint32_t machines, iso_session_mode mode)
      : tallies(machines), sessions(machines), are_silent(machines) {
    EXPECT_EQ(iso_network_create(5, &network), ISO_OK);
    for (std::uint32_t n = 0; n < machines; ++n) {
      iso_session_config config = tally_config(mode);
      config.host = n == 0;
      config.seed = 3 + n;  // each may become the host
      config.players = static_cast<std::int32_t>(machines);
      config.migration = kSecond;
      std::strcpy(config.address, std::to_string(n).c_str());
      const iso_game game = tallies[n].describe(false);
      EXPECT_EQ(iso_session_create(&config, &game, nullptr, 0, &sessions[n]), ISO_OK) << iso_last_error();
      if (n == 0) continue;
      std::uint32_t endpoint = 0;
      EXPECT_EQ(iso_network_add_client(network, "latency=20", &endpoint), ISO_OK);
      EXPECT_EQ(endpoint, n);
      EXPECT_EQ(iso_network_connect(network, endpoint, 0), ISO_OK);
    }
  }
  Migrating(const Migrating&) = delete;
  ~Migrating() {
    EXPECT_EQ(iso_network_destroy(network), ISO_OK);
    for (iso_session* session : sessions) EXPECT_EQ(iso_session_destroy(session), ISO_OK);
  }

  void vanish(std::uint32_t n) {
    are_silent[n] = 1;
    EXPECT_EQ(iso_network_set_silent(network, n, 1), ISO_OK);
  }
  void pass(std::uint64_t time) {
    for (const std::uint64_t end = now + time; now < end && !testing::Test::HasFailure(); now += 2000) {
      EXPECT_EQ(iso_network_advance_to(network, now), ISO_OK);
      for (std::uint32_t n = 0; n < sessions.size(); ++n) {
        if (are_silent[n] != 0) continue;  // its process has ended
        const std::int32_t player = iso_session_local_player(sessions[n]);
        const std::uint8_t what = tally_input(iso_session_current(sessions[n]), player);
        EXPECT_EQ(iso_network_deliver(network, n, sessions[n], now), ISO_OK);
        iso_session_add_local_input(sessions[n], player, &what, 1);
        EXPECT_EQ(iso_session_drive(sessions[n], now, nullptr), ISO_OK);
        EXPECT_EQ(iso_network_dispatch(network, n, sessions[n], now), ISO_OK);
      }
    }
  }
  std::size_t finals(std::size_t n) const { return tallies[n].hashes.size(); }
  iso_status go_on(std::size_t n) { return iso_session_go_on(sessions[n], now); }
};

void stands_until_it_goes_on(Migrating& match, std::size_t left) {
  match.pass(6 * kSecond);
  EXPECT_GT(match.finals(left), 200u);
  EXPECT_EQ(match.go_on(left), ISO_REFUSED) << "all are here";
  EXPECT_NE(std::string(iso_last_error()).find("go_on"), std::string::npos) << iso_last_error();
  for (std::uint32_t n = 0; n < match.sessions.size(); ++n) {
    if (n != left) match.vanish(n);
  }
  match.pass(4 * kSecond);
  const std::size_t stood = match.finals(left);
  match.pass(20 * kSecond);
  EXPECT_EQ(match.finals(left), stood) << "the others may play elsewhere";
  ASSERT_EQ(match.go_on(left), ISO_OK) << iso_last_error();
  match.pass(5 * kSecond);
  EXPECT_GT(match.finals(left), stood + 200);
  EXPECT_EQ(match.go_on(left), ISO_REFUSED) << "it goes on";
  EXPECT_NE(match.tallies[left].hashes[stood + 30], match.tallies[left].hashes[stood + 150]);
}

TEST(GoOn, AClientWhoseHostIsGonePlaysOnAlone) {
  for (const iso_session_mode mode : {ISO_LOCKSTEP, ISO_ROLLBACK}) {
    SCOPED_TRACE(mode);
    Migrating match(2, mode);
    stands_until_it_goes_on(match, 1);
  }
}

TEST(GoOn, AHostWhoseMajorityIsGonePlaysOnAlone) {
  for (const iso_session_mode mode : {ISO_LOCKSTEP, ISO_ROLLBACK}) {
    SCOPED_TRACE(mode);
    Migrating match(3, mode);
    stands_until_it_goes_on(match, 0);
  }
}

TEST(GoOn, WithoutMigrationItIsRefused) {
  Tally tally;
  iso_session_config config = tally_config(ISO_ROLLBACK);
  config.host = 1;
  config.seed = 9;
  const iso_game game = tally.describe(false);
  iso_session* session = nullptr;
  ASSERT_EQ(iso_session_create(&config, &game, nullptr, 0, &session), ISO_OK);
  EXPECT_EQ(iso_session_go_on(session, 0), ISO_REFUSED);
  EXPECT_EQ(iso_session_go_on(nullptr, 0), ISO_NULL);
  EXPECT_EQ(iso_session_destroy(session), ISO_OK);
  EXPECT_EQ(iso_session_go_on(session, 0), ISO_NOT_ALIVE);
}

}  // namespace go_on_test
}  // namespace isostep::test
