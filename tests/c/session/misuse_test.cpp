// What a session of C does with callers that err: null, rubbish, wrong sizes, destroyed handles, calls in callbacks.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tally_game.hpp"

namespace isostep::test {
namespace {

struct Alone : testing::Test {
  Tally tally;
  iso_session* session = nullptr;
  iso_session_config config = tally_config(ISO_ROLLBACK);

  Alone() {
    config.host = 1;
    config.seed = 9;
    const iso_game game = tally.describe(false);
    EXPECT_EQ(iso_session_create(&config, &game, nullptr, 0, &session), ISO_OK) << iso_last_error();
    EXPECT_EQ(iso_session_start(session, 0), ISO_OK);
    tally.session = session;
  }
  ~Alone() override { EXPECT_EQ(iso_session_destroy(session), ISO_OK); }
  iso_status create(const iso_session_config& with, const iso_game& game) {
    iso_session* other = reinterpret_cast<iso_session*>(1);
    const iso_status status = iso_session_create(&with, &game, nullptr, 0, &other);
    EXPECT_EQ(other == nullptr, status != ISO_OK);
    EXPECT_EQ(iso_session_destroy(other), ISO_OK);
    return status;
  }
};

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

/// The next request; a turn that is over begins anew.
iso_request next_of(iso_session* session) {
  iso_request request{};
  request.size = sizeof request;
  EXPECT_EQ(iso_session_next(session, &request), ISO_OK);
  return request;
}

TEST_F(Alone, WithinATurnAllButSavingTheMatchMayBeDone) {
  std::uint64_t now = 0;
  iso_request request{};
  for (; request.kind != ISO_STEP; now += 1000) {
    ASSERT_EQ(iso_session_advance(session, now), ISO_OK);
    do request = next_of(session);
    while (request.kind != ISO_STEP && request.kind != ISO_NOTHING);
  }
  const std::uint8_t what = 0;
  std::size_t size = 0;
  EXPECT_EQ(iso_session_add_local_input(session, 0, &what, 1), ISO_OK);
  EXPECT_EQ(iso_session_connected(session, 3, now, 1), ISO_OK);
  EXPECT_EQ(iso_session_receive(session, 3, ISO_DATAGRAM, &what, 1, now), ISO_OK);
  EXPECT_EQ(iso_session_record(session, ISO_RECORD_MATCH, nullptr), ISO_UNFINISHED);
  EXPECT_EQ(iso_session_save_match(session, nullptr, &size), ISO_UNFINISHED);
  std::uint32_t players = 0;
  ASSERT_NE(iso_session_inputs(session, &players), nullptr);
  EXPECT_EQ(players, 2u);
  tally.step(iso_session_inputs(session, nullptr), players);
  while (request.kind != ISO_NOTHING) request = next_of(session);
  EXPECT_EQ(iso_session_inputs(session, nullptr), nullptr);
  EXPECT_EQ(next_of(session).kind, std::uint32_t{ISO_NOTHING});
  while (poll_event(session).kind != ISO_EVENT_NONE) {}
  EXPECT_EQ(iso_session_drive(session, now, nullptr), ISO_OK);
  EXPECT_EQ(poll_event(session).kind, std::uint32_t{ISO_EVENT_NONE}) << "nothing was left out";
}

/// A turn is left at its n-th request, before the step or after half of it; the game goes on as if nothing had been.
TEST_F(Alone, ATurnThatIsLeftInItsMiddleIsToldAndMadeGood) {
  ASSERT_EQ(iso_session_record(session, ISO_RECORD_MATCH, nullptr), ISO_OK);
  int left = 0, told = 0;
  std::uint64_t now = 0;
  for (int turn = 0; tally.hashes.size() < 200; ++turn, now += 5000) {
    ASSERT_LT(now, 60000000u) << "the match goes on";
    const std::uint8_t what = tally_input(iso_session_current(session), 0);
    ASSERT_EQ(iso_session_add_local_input(session, 0, &what, 1), ISO_OK);
    ASSERT_EQ(iso_session_advance(session, now), ISO_OK);
    int until = turn % 3 == 0 ? 1 + turn / 3 % 2 : 1000;
    for (iso_request request = next_of(session); request.kind != ISO_NOTHING; request = next_of(session)) {
      const bool leaves = --until == 0;
      if (request.kind == ISO_STEP && leaves && turn % 2 == 0) {
        ++left;
        break;
      }
      if (request.kind == ISO_STEP) tally.step(iso_session_inputs(session, nullptr), 2);
      if (request.kind == ISO_FRAME_CONFIRMED) tally.hashes.push_back(request.hash);
      if (request.kind == ISO_STEP && leaves) {
        ++left;
        break;
      }
    }
    for (iso_session_event event = poll_event(session); event.kind != ISO_EVENT_NONE; event = poll_event(session)) {
      told += event.kind == ISO_EVENT_MISUSE ? 1 : 0;
    }
  }
  EXPECT_GT(left, 10);
  EXPECT_EQ(told, left);
  std::size_t size = 0;
  ASSERT_EQ(iso_session_recorded(session, ISO_RECORD_MATCH, nullptr, &size), ISO_SMALL_BUFFER) << iso_last_error();
  std::vector<std::uint8_t> file(size);
  ASSERT_EQ(iso_session_recorded(session, ISO_RECORD_MATCH, file.data(), &size), ISO_OK);
  Tally again;
  const iso_session_config replay = tally_config(ISO_REPLAY);
  const iso_game game = again.describe(false);
  iso_session* player = nullptr;
  ASSERT_EQ(iso_session_create(&replay, &game, file.data(), file.size(), &player), ISO_OK) << iso_last_error();
  for (now = 0; iso_session_phase(player) != ISO_OVER && now < 60000000; now += 5000) {
    ASSERT_EQ(iso_session_drive(player, now, nullptr), ISO_OK);
    ASSERT_EQ(poll_event(player).kind, std::uint32_t{ISO_EVENT_NONE});
  }
  ASSERT_GE(again.hashes.size(), 200u);
  again.hashes.resize(tally.hashes.size());
  EXPECT_EQ(again.hashes, tally.hashes) << "each frame was stepped once, from the state before it";
  EXPECT_EQ(iso_session_destroy(player), ISO_OK);
}

TEST_F(Alone, ARecordingIsTakenInPiecesAsItGrowsAndAtAnyTime) {
  const void* bytes = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(iso_session_flush_recording(session, ISO_RECORD_MATCH, &bytes, &size), ISO_REFUSED);
  EXPECT_EQ(iso_session_flush_recording(session, 2, &bytes, &size), ISO_BAD_ENUM);
  EXPECT_EQ(iso_session_flush_recording(session, ISO_RECORD_MATCH, nullptr, &size), ISO_NULL);
  EXPECT_EQ(iso_session_flush_recording(session, ISO_RECORD_MATCH, &bytes, nullptr), ISO_NULL);
  EXPECT_EQ(iso_session_flush_recording(nullptr, ISO_RECORD_MATCH, &bytes, &size), ISO_NULL);
  ASSERT_EQ(iso_session_record(session, ISO_RECORD_MATCH, nullptr), ISO_OK);
  std::vector<std::uint8_t> file;
  const auto take = [&] {
    ASSERT_EQ(iso_session_flush_recording(session, ISO_RECORD_MATCH, &bytes, &size), ISO_OK) << iso_last_error();
    file.insert(file.end(), static_cast<const std::uint8_t*>(bytes), static_cast<const std::uint8_t*>(bytes) + size);
  };
  take();
  EXPECT_TRUE(file.empty()) << "no frame was stepped";
  for (std::uint64_t now = 0; tally.hashes.size() < 100; now += 5000) {
    ASSERT_EQ(iso_session_drive(session, now, nullptr), ISO_OK);
    if (now % 170000 == 0) take();
  }
  take();
  iso_replay_info info;
  iso_replay_info_init(&info);
  ASSERT_EQ(iso_replay_about(file.data(), file.size(), &info), ISO_OK);
  EXPECT_EQ(info.file, std::uint32_t{ISO_VERIFY_OUTCOME_TRUNCATED});
  EXPECT_EQ(info.frames, tally.hashes.size()) << "a crash now costs nothing";
  size = 0;
  ASSERT_EQ(iso_session_recorded(session, ISO_RECORD_MATCH, nullptr, &size), ISO_SMALL_BUFFER);
  std::vector<std::uint8_t> whole(size);
  ASSERT_EQ(iso_session_recorded(session, ISO_RECORD_MATCH, whole.data(), &size), ISO_OK);
  take();
  EXPECT_EQ(file, whole) << "the pieces are the file";
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

}  // namespace
}  // namespace isostep::test
