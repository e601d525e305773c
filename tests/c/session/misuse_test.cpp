// A session of C and callers that err: null, rubbish, wrong sizes, destroyed handles, calls in callbacks.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "alone.hpp"

namespace isostep::test {
namespace misuse_test {

TEST_F(Alone, ConfigurationsThatCannotBeAreRefusedByTheNameOfTheField) {
  const iso_game game = tally.describe(false);
  const auto refused = [&](auto change, iso_status status, const char* field) {
    iso_session_config with = config;
    change(with);
    EXPECT_EQ(create(with, game), status) << field;
    EXPECT_NE(std::string(iso_last_error()).find(field), std::string::npos) << iso_last_error();
    const char* const problem = iso_session_config_problem(&with);
    ASSERT_NE(problem, nullptr) << field;
    if (status != ISO_WRONG_SIZE) {
      EXPECT_EQ(std::string(problem).find(field), 0u) << problem;
    }
  };
  EXPECT_EQ(iso_session_config_problem(&config), nullptr);
  refused([](auto& c) { c.mode = 9; }, ISO_BAD_ENUM, "mode");
  refused([](auto& c) { c.predictor = 2; }, ISO_BAD_ENUM, "predictor");
  refused([](auto& c) { c.host = 2; }, ISO_BAD_ENUM, "host");
  refused([](auto& c) { c.votes = 77; }, ISO_BAD_ENUM, "votes");
  refused([](auto& c) { c.players = 33; }, ISO_REFUSED, "players");
  refused([](auto& c) { c.players = -1; }, ISO_REFUSED, "players");
  refused([](auto& c) { c.kept = 5; }, ISO_REFUSED, "kept");
  refused([](auto& c) { c.seed = 0; }, ISO_REFUSED, "seed");
  refused([](auto& c) { c.name[0] = 0; }, ISO_REFUSED, "name");
  refused([](auto& c) { c.name[2] = '\n'; }, ISO_REFUSED, "name");
  refused([](auto& c) { std::memset(c.name, 'x', sizeof c.name); }, ISO_REFUSED, "name");
  refused([](auto& c) { std::memset(c.input_text, 'x', sizeof c.input_text); }, ISO_REFUSED, "input_text");
  refused([](auto& c) { std::memset(c.address, 'x', sizeof c.address); }, ISO_REFUSED, "address");
  refused([](auto& c) { c.credential_size = 257; }, ISO_REFUSED, "credential_size");
  refused([](auto& c) { c.input_cap = 0; }, ISO_REFUSED, "input_cap");
  refused([](auto& c) { c.input_cap = 513; }, ISO_REFUSED, "input_cap");
  refused([](auto& c) { c.input_least = 2; }, ISO_REFUSED, "input_least");
  refused([](auto& c) { c.neutral_size = 0; }, ISO_REFUSED, "neutral_size");
  refused([](auto& c) { c.size = 4; }, ISO_WRONG_SIZE, "config");
  refused([](auto& c) { c.size = 0xffffffffu; }, ISO_WRONG_SIZE, "config");
}

TEST_F(Alone, StructsOfOlderAndNewerCallersAreTaken) {
  const iso_game game = tally.describe(false);
  struct Newer {
    iso_session_config config;
    std::uint64_t more[4];
  } newer{config, {}};
  newer.config.size = sizeof newer;
  iso_session* other = nullptr;
  EXPECT_EQ(iso_session_create(&newer.config, &game, nullptr, 0, &other), ISO_OK);
  EXPECT_EQ(iso_session_destroy(other), ISO_OK);
  newer.more[3] = 1;
  EXPECT_EQ(iso_session_create(&newer.config, &game, nullptr, 0, &other), ISO_WRONG_SIZE);
  struct {
    iso_session_stats stats;
    std::uint64_t more[2];
  } stats{};
  stats.stats.size = sizeof stats;
  stats.more[1] = 5;
  EXPECT_EQ(iso_session_get_stats(session, &stats.stats), ISO_OK);
  EXPECT_EQ(stats.more[1], 0u);
  iso_session_event event{};
  event.size = 16;  // of an older caller: what comes behind stays
  event.agreed = 1234;
  EXPECT_EQ(iso_session_poll_event(session, &event), ISO_OK);
  EXPECT_EQ(event.agreed, 1234);
  event.size = 3;
  EXPECT_EQ(iso_session_poll_event(session, &event), ISO_WRONG_SIZE);
}

TEST_F(Alone, GamesThatAreNoneAreRefused) {
  iso_game empty;
  iso_game_init(&empty);
  EXPECT_EQ(create(config, empty), ISO_NULL);
  iso_game half = tally.describe(true);
  half.hash = nullptr;
  EXPECT_EQ(create(config, half), ISO_NULL);
  half = tally.describe(true);
  half.read = nullptr;
  EXPECT_EQ(create(config, half), ISO_NULL);
  half = tally.describe(false);
  half.block_size = 0;
  EXPECT_EQ(create(config, half), ISO_NULL);
  half.block_size = ~std::size_t{0};
  EXPECT_EQ(create(config, half), ISO_REFUSED);
  half = tally.describe(false);
  half.world = reinterpret_cast<iso_world*>(session);
  EXPECT_EQ(create(config, half), ISO_NOT_ALIVE) << "a session is no world";
  half.size = 0;
  EXPECT_EQ(create(config, half), ISO_WRONG_SIZE);
}

TEST_F(Alone, NullIsRefusedEverywhere) {
  iso_request request{};
  request.size = sizeof request;
  iso_outgoing out{};
  out.size = sizeof out;
  const std::uint8_t* bytes = nullptr;
  const char* text = nullptr;
  std::size_t size = 0;
  const iso_game game = tally.describe(false);
  EXPECT_EQ(iso_session_create(nullptr, &game, nullptr, 0, &session), ISO_NULL);
  session = tally.session;
  EXPECT_EQ(iso_session_create(&config, nullptr, nullptr, 0, &session), ISO_NULL);
  session = tally.session;
  EXPECT_EQ(iso_session_create(&config, &game, nullptr, 7, &session), ISO_NULL);
  session = tally.session;
  EXPECT_EQ(iso_session_create(&config, &game, nullptr, 0, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_config_init(nullptr), ISO_NULL);
  EXPECT_EQ(iso_game_init(nullptr), ISO_NULL);
  EXPECT_NE(iso_session_config_problem(nullptr), nullptr);
  EXPECT_EQ(iso_session_destroy(nullptr), ISO_OK);
  EXPECT_EQ(iso_session_advance(nullptr, 0), ISO_NULL);
  EXPECT_EQ(iso_session_next(session, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_drive(nullptr, 0, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_inputs(nullptr, nullptr), nullptr);
  EXPECT_EQ(iso_session_add_local_input(session, 0, nullptr, 1), ISO_NULL);
  EXPECT_EQ(iso_session_receive(session, 0, ISO_DATAGRAM, nullptr, 1, 0), ISO_NULL);
  EXPECT_EQ(iso_session_poll_send(session, 0, nullptr, &bytes), ISO_NULL);
  EXPECT_EQ(iso_session_poll_send(session, 0, &out, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_poll_connect(session, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_poll_connect(nullptr, &text), ISO_NULL);
  EXPECT_EQ(iso_session_poll_event(session, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_get_stats(session, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_input(session, 0, 0, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_poll_applicant(session, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_refuse(session, 1, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_kick(session, 1, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_save_match(session, &size, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_recorded(session, ISO_RECORD_MATCH, &size, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_phase(nullptr), ISO_OVER);
  EXPECT_EQ(iso_session_current(nullptr), -1);
  EXPECT_EQ(iso_network_create(1, nullptr), ISO_NULL);
  EXPECT_EQ(iso_network_destroy(nullptr), ISO_OK);
  EXPECT_EQ(iso_network_deliver(nullptr, 0, session, 0), ISO_NULL);
}

TEST_F(Alone, WhatIsOutOfRangeIsRefused) {
  std::uint8_t bytes[600] = {};
  EXPECT_EQ(iso_session_add_local_input(session, 0, bytes, 600), ISO_REFUSED) << "above every input";
  EXPECT_EQ(iso_session_add_local_input(session, 0, bytes, 2), ISO_REFUSED) << "above input_cap";
  EXPECT_EQ(iso_session_add_local_input(session, 0, bytes, 0), ISO_REFUSED) << "below input_least";
  EXPECT_EQ(iso_session_add_local_input(session, 0, bytes, 1), ISO_OK);
  for (const int player : {-1, 1, 2, 31, 32, 1 << 30, -(1 << 30)}) {
    EXPECT_EQ(iso_session_add_local_input(session, player, bytes, 1), ISO_REFUSED) << player;
    EXPECT_EQ(iso_session_wants_input(session, player), 0) << player;
    EXPECT_EQ(iso_session_peer_of(session, player), -1) << player;
    EXPECT_EQ(iso_session_kick(session, player, "x"), ISO_REFUSED) << player;
    EXPECT_EQ(iso_session_vote(session, player, 1), ISO_REFUSED) << player;
    EXPECT_EQ(iso_session_propose(session, player, ISO_VOTE_KICK, 7), ISO_REFUSED) << player;
    iso_input input;
    EXPECT_EQ(iso_session_input(session, 5, player, &input), ISO_OK);
    EXPECT_EQ(input.status, ISO_DISCONNECTED);
  }
  for (const std::uint32_t peer : {64u, 65535u, 65536u, 0xffffffffu}) {
    const iso_status status = peer > 65535 ? iso_status{ISO_REFUSED} : iso_status{ISO_OK};
    EXPECT_EQ(iso_session_connected(session, peer, 0, 1), status) << peer;
    EXPECT_EQ(iso_session_receive(session, peer, ISO_RELIABLE, bytes, 600, 0), status) << peer;
    EXPECT_EQ(iso_session_disconnected(session, peer, 0), status) << peer;
  }
  EXPECT_EQ(iso_session_connected(session, 0, 0, 2), ISO_BAD_ENUM);
  EXPECT_EQ(iso_session_receive(session, 0, 2, bytes, 1, 0), ISO_BAD_ENUM);
  EXPECT_EQ(iso_session_propose(session, 0, 0, 0), ISO_BAD_ENUM);
  EXPECT_EQ(iso_session_propose(session, 0, 6, 0), ISO_BAD_ENUM);
  EXPECT_EQ(iso_session_record(session, 2, nullptr), ISO_BAD_ENUM);
  EXPECT_EQ(iso_session_set_speed(session, 3), ISO_REFUSED);
  EXPECT_EQ(iso_session_admit(session, 99), ISO_REFUSED);
  EXPECT_EQ(iso_session_resync(session), ISO_REFUSED) << "of a client";
}

TEST_F(Alone, RubbishFromTheNetworkIsCounted) {
  std::mt19937 dice(4);
  std::vector<std::uint8_t> bytes(20000);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(dice());
  ASSERT_EQ(iso_session_connected(session, 3, 0, 1), ISO_OK);
  for (std::uint64_t now = 0; now < 2000000; now += 1000) {
    const std::size_t size = dice() % (dice() % 8 == 0 ? bytes.size() : 1200);
    ASSERT_EQ(iso_session_receive(session, 3, dice() % 2, bytes.data() + dice() % 100, size - size / 100, now), ISO_OK);
    ASSERT_EQ(iso_session_drive(session, now, nullptr), ISO_OK);
  }
  iso_session_stats stats{};
  stats.size = sizeof stats;
  ASSERT_EQ(iso_session_get_stats(session, &stats), ISO_OK);
  EXPECT_GT(stats.refused + stats.flooded, 500u);
  EXPECT_GT(tally.hashes.size(), 100u) << "the match went on";
}

TEST_F(Alone, CallsFromACallbackAreRefusedAndHarmless) {
  static iso_status statuses[8];
  tally.in_step = [](Tally& game) {
    const std::uint8_t what = 0;
    iso_request request{};
    request.size = sizeof request;
    statuses[0] = iso_session_advance(game.session, 0);
    statuses[1] = iso_session_drive(game.session, 0, nullptr);
    statuses[2] = iso_session_next(game.session, &request);
    statuses[3] = iso_session_destroy(game.session);
    statuses[4] = iso_session_add_local_input(game.session, 0, &what, 1);
    statuses[5] = iso_session_receive(game.session, 0, ISO_DATAGRAM, &what, 1, 0);
    statuses[6] = iso_session_pause(game.session);
    statuses[7] = iso_session_current(game.session);  // to look is allowed
  };
  for (std::uint64_t now = 0; now < 1000000; now += 1000) ASSERT_EQ(iso_session_drive(session, now, nullptr), ISO_OK);
  for (int n = 0; n < 7; ++n) EXPECT_EQ(statuses[n], ISO_CALLED_BACK) << n;
  EXPECT_GT(statuses[7], 30);
  EXPECT_GT(tally.hashes.size(), 30u);
}

TEST_F(Alone, ASessionWithoutAStepIsPulledAndNotDriven) {
  iso_game game = tally.describe(false);
  game.step = nullptr;
  iso_session* other = nullptr;
  ASSERT_EQ(iso_session_create(&config, &game, nullptr, 0, &other), ISO_OK);
  EXPECT_EQ(iso_session_drive(other, 0, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_advance(other, 0), ISO_OK);
  EXPECT_EQ(iso_session_destroy(other), ISO_OK);
}

TEST_F(Alone, WhoHasNoPortableFormSaysSo) {
  iso_game game = tally.describe(true);
  game.write = nullptr;
  game.read = nullptr;
  iso_session* other = nullptr;
  ASSERT_EQ(iso_session_create(&config, &game, nullptr, 0, &other), ISO_OK);
  ASSERT_EQ(iso_session_start(other, 0), ISO_OK);
  for (std::uint64_t now = 0; now < 500000; now += 1000) ASSERT_EQ(iso_session_drive(other, now, nullptr), ISO_OK);
  EXPECT_GT(tally.hashes.size(), 10u);
  std::size_t size = 0;
  EXPECT_EQ(iso_session_save_match(other, nullptr, &size), ISO_REFUSED);
  EXPECT_EQ(iso_session_record(other, ISO_RECORD_MATCH, nullptr), ISO_REFUSED);
  EXPECT_EQ(iso_session_destroy(other), ISO_OK);
}

TEST_F(Alone, WhatWasDestroyedIsRefused) {
  iso_session* other = nullptr;
  const iso_game game = tally.describe(false);
  ASSERT_EQ(iso_session_create(&config, &game, nullptr, 0, &other), ISO_OK);
  ASSERT_EQ(iso_session_destroy(other), ISO_OK);
  EXPECT_EQ(iso_session_destroy(other), ISO_NOT_ALIVE);
  EXPECT_EQ(iso_session_drive(other, 0, nullptr), ISO_NOT_ALIVE);
  EXPECT_EQ(iso_session_phase(other), ISO_OVER);
  iso_network* network = nullptr;
  ASSERT_EQ(iso_network_create(1, &network), ISO_OK);
  EXPECT_EQ(iso_network_deliver(network, 0, other, 0), ISO_NOT_ALIVE);
  EXPECT_EQ(iso_network_deliver(network, 1, session, 0), ISO_REFUSED) << "no such endpoint";
  EXPECT_EQ(iso_network_cut(network, 0), ISO_REFUSED);
  EXPECT_EQ(iso_network_connect(network, 0, 0), ISO_REFUSED);
  std::uint32_t line = 0;
  EXPECT_EQ(iso_network_add_client(network, "latency=wide", &line), ISO_REFUSED);
  EXPECT_NE(std::string(iso_last_error()).find("latency"), std::string::npos) << iso_last_error();
  ASSERT_EQ(iso_network_advance_to(network, 5000), ISO_OK);
  EXPECT_EQ(iso_network_advance_to(network, 4000), ISO_REFUSED);
  ASSERT_EQ(iso_network_destroy(network), ISO_OK);
  EXPECT_EQ(iso_network_destroy(network), ISO_NOT_ALIVE);
  EXPECT_EQ(iso_network_dispatch(network, 0, session, 0), ISO_NOT_ALIVE);
}

}  // namespace misuse_test
}  // namespace isostep::test
