// Sessions in C: the match of src/examples/lockstep_game.cpp, frame by frame as in C++, and between C and C++.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "isostep/store/state.hpp"
#include "match/pucks.hpp"
#include "public_session.hpp"
#include "puck_game.h"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

namespace isostep::test {
namespace match_test {

using S = Q32_32;
using transport::SimulatedNetwork;
constexpr const char* kProfile = "latency=150,jitter=40,loss=5";

using Game = Pucks<S>;

SessionConfig config_of(SessionMode mode) {
  SessionConfig config = config_of(Game());
  config.mode = mode;
  config.most_delay = 40;
  return config;
}

struct Machine {
  Game game;
  Session<Game> session;
  SimulatedNetwork::Port port;
  std::vector<std::uint64_t> hashes;
  int rollbacks = 0;

  Machine(const SessionConfig& config, SimulatedNetwork::Port its_port) : session(config), port(its_port) {}
  void confirmed(Frame, std::uint64_t hash) { hashes.push_back(hash); }
  void rolled_back(Frame) { ++rollbacks; }
  void turn(Time now) {
    const int player = session.local_player();
    transport::deliver(port, session, now);
    if (player >= 0) session.add_local_input(player, push_of(session.current(), player));
    drive(session, game, now, *this);
    transport::dispatch(port, session, now);
  }
};

std::unique_ptr<puck_machine> empty_machine() { return std::make_unique<puck_machine>(); }

std::vector<std::uint64_t> hashes_of(const puck_machine& machine) {
  return {machine.game.hashes, machine.game.hashes + machine.game.count};
}
iso_session_stats stats_of(const iso_session* session) {
  iso_session_stats stats{};
  stats.size = sizeof stats;
  EXPECT_EQ(iso_session_get_stats(session, &stats), ISO_OK);
  return stats;
}

class CMatch : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, CMatch, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(CMatch, IsThatOfCppFrameByFrameWithAndWithoutCallbacks) {
  SimulatedNetwork network;
  SessionConfig config = config_of(GetParam());
  const auto line = network.add_client(transport::parse_profile(kProfile).value());
  Machine client(config, network.port(line));
  config.host = true;
  config.seed = 20;
  Machine host(config, network.port(SimulatedNetwork::kHost));
  network.connect(line);
  for (Time now = 0; host.hashes.size() < PUCK_FRAMES || client.hashes.size() < PUCK_FRAMES; now += 1000) {
    ASSERT_LT(now, 120 * kSecond);
    network.advance_to(now);
    host.turn(now);
    client.turn(now);
  }
  host.hashes.resize(PUCK_FRAMES);
  client.hashes.resize(PUCK_FRAMES);
  EXPECT_EQ(host.hashes, client.hashes);
  EXPECT_GT(host.game.user.touches, 4u) << "nothing happened";

  for (const int by_callbacks : {0, 1}) {
    const auto c_host = empty_machine(), c_client = empty_machine();
    ASSERT_EQ(puck_match(static_cast<std::uint32_t>(GetParam()), kProfile, by_callbacks, c_host.get(), c_client.get()),
              ISO_OK);
    EXPECT_EQ(hashes_of(*c_host), host.hashes);
    EXPECT_EQ(hashes_of(*c_client), host.hashes);
    EXPECT_EQ(c_host->game.touches, host.game.user.touches);
    EXPECT_EQ(c_host->game.rollbacks, host.rollbacks);
    EXPECT_EQ(c_client->game.rollbacks, client.rollbacks);
    EXPECT_EQ(c_host->game.rollbacks + c_client->game.rollbacks > 100, GetParam() == SessionMode::rollback);
    EXPECT_EQ(stats_of(c_host->session).steps, host.session.stats().steps);
    EXPECT_EQ(stats_of(c_client->session).steps, client.session.stats().steps);
    EXPECT_EQ(stats_of(c_client->session).bytes_out, client.session.stats().bytes_out);
    EXPECT_EQ(puck_machine_destroy(c_host.get()), ISO_OK);
    EXPECT_EQ(puck_machine_destroy(c_client.get()), ISO_OK);
  }
}

TEST_P(CMatch, IsPlayedBetweenCAndCpp) {
  SimulatedNetwork network;
  const auto line = network.add_client(transport::parse_profile(kProfile).value());
  iso_session_config config;
  puck_config(static_cast<std::uint32_t>(GetParam()), &config);
  config.most_delay = 40;
  config.input_schema = InputCodec<Push>::schema();
  const auto client = empty_machine();
  ASSERT_EQ(puck_machine_create(client.get(), &config, 0), ISO_OK);
  SimulatedNetwork::Port port = network.port(line);
  SessionConfig rest = config_of(GetParam());
  rest.host = true;
  rest.seed = 20;
  Machine host(rest, network.port(SimulatedNetwork::kHost));
  network.connect(line);
  for (Time now = 0; host.hashes.size() < 900 || client->game.count < 900; now += 1000) {
    ASSERT_LT(now, 60 * kSecond);
    network.advance_to(now);
    host.turn(now);
    c::PublicSession session{client->session};
    transport::deliver(port, session, now);
    const std::int8_t way = puck_way(iso_session_current(client->session), 1);
    iso_session_add_local_input(client->session, 1, &way, 1);
    iso_request request{};
    request.size = sizeof request;
    ASSERT_EQ(iso_session_advance(client->session, now), ISO_OK);
    do {
      ASSERT_EQ(iso_session_next(client->session, &request), ISO_OK);
      if (request.kind == ISO_STEP) puck_game_step(&client->game, iso_session_inputs(client->session, nullptr));
      if (request.kind == ISO_FRAME_CONFIRMED) client->game.hashes[client->game.count++] = request.hash;
    } while (request.kind != ISO_NOTHING);
    transport::dispatch(port, session, now);
    ASSERT_EQ(session.status, ISO_OK);
  }
  host.hashes.resize(900);
  client->game.count = 900;
  EXPECT_EQ(hashes_of(*client), host.hashes);
  EXPECT_EQ(puck_machine_destroy(client.get()), ISO_OK);
}

/// A match in virtual time of any number of machines in C, one endpoint each.
struct Match {
  iso_network* network = nullptr;
  std::vector<std::unique_ptr<puck_machine>> machines;
  Time now = 0;

  Match() { EXPECT_EQ(iso_network_create(7, &network), ISO_OK); }
  ~Match() {
    for (const auto& machine : machines) EXPECT_EQ(puck_machine_destroy(machine.get()), ISO_OK);
    EXPECT_EQ(iso_network_destroy(network), ISO_OK);
  }
  puck_machine& add(const iso_session_config& config, int by_callbacks = 0) {
    machines.push_back(empty_machine());
    puck_machine& machine = *machines.back();
    EXPECT_EQ(puck_machine_create(&machine, &config, by_callbacks), ISO_OK);
    if (machines.size() == 1) return machine;
    EXPECT_EQ(iso_network_add_client(network, "latency=40,jitter=10,loss=2", &machine.endpoint), ISO_OK);
    EXPECT_EQ(iso_network_connect(network, machine.endpoint, 0), ISO_OK);
    return machine;
  }
  void play(Time time) {
    for (const Time end = now + time; now < end; now += 1000) {
      ASSERT_EQ(iso_network_advance_to(network, now), ISO_OK);
      for (const auto& machine : machines) ASSERT_EQ(puck_machine_turn(machine.get(), network, now), ISO_OK);
    }
  }
};

iso_session_config host_of(iso_session_config config) {
  config.host = 1;
  config.seed = 11;
  return config;
}

/// All frames that both have: at least `least`, and equal.
void expect_equal(const puck_game& a, const puck_game& b, std::int32_t least) {
  const std::int32_t first = std::max(a.first, b.first);
  const std::int32_t end = std::min(a.first + a.count, b.first + b.count);
  EXPECT_GE(end - first, least);
  for (std::int32_t frame = first; frame < end; ++frame) {
    ASSERT_EQ(a.hashes[frame - a.first], b.hashes[frame - b.first]) << frame;
  }
}

TEST(CSession, WhoJoinsLateGetsTheStateAndPlaysTheSame) {
  for (const int by_callbacks : {0, 1}) {
    iso_session_config config;
    puck_config(ISO_ROLLBACK, &config);
    config.most_replayed = 60;  // a snapshot, not all the inputs since
    Match match;
    puck_machine& host = match.add(host_of(config), by_callbacks);
    ASSERT_EQ(iso_session_start(host.session, 0), ISO_OK);
    match.play(10 * kSecond);
    EXPECT_GT(host.game.count, 500);
    puck_machine& late = match.add(config, 1 - by_callbacks);
    match.play(10 * kSecond);
    EXPECT_EQ(iso_session_phase(late.session), ISO_PLAYING);
    EXPECT_EQ(iso_session_local_player(late.session), 1);
    EXPECT_GE(late.game.restarts, 1);
    EXPECT_GT(late.game.first, 400);
    expect_equal(host.game, late.game, 400);
    bool joined = false;
    iso_session_event event{};
    event.size = sizeof event;
    while (iso_session_poll_event(host.session, &event) == ISO_OK && event.kind != ISO_EVENT_NONE) {
      joined = joined || (event.kind == ISO_EVENT_JOINED && event.player == 1);
      EXPECT_NE(event.kind, ISO_EVENT_DESYNC);
    }
    EXPECT_TRUE(joined);
  }
}

TEST(CSession, WhoWatchesSeesWhatIsPlayed) {
  iso_session_config config;
  puck_config(ISO_ROLLBACK, &config);
  Match match;
  puck_machine& host = match.add(host_of(config));
  match.add(config);
  config.mode = ISO_SPECTATOR;
  puck_machine& watcher = match.add(config, 1);
  match.play(10 * kSecond);
  EXPECT_EQ(iso_session_phase(watcher.session), ISO_WATCHING);
  EXPECT_EQ(iso_session_local_player(watcher.session), -1);
  expect_equal(host.game, watcher.game, 400);
  iso_player_stats stats{};
  stats.size = sizeof stats;
  ASSERT_EQ(iso_session_get_player_stats(host.session, 1, &stats), ISO_OK);
  EXPECT_NEAR(stats.round_trip, 80000, 40000);
}

TEST(CSession, AWorldThatIsDestroyedFirstEndsItsSessionWithoutHarm) {
  for (const bool in_a_step : {false, true}) {
    iso_session_config config;
    puck_config(ISO_ROLLBACK, &config);
    config = host_of(config);
    const auto machine = empty_machine();
    ASSERT_EQ(puck_machine_create(machine.get(), &config, 0), ISO_OK);
    ASSERT_EQ(iso_session_record(machine->session, ISO_RECORD_WORLD, nullptr), ISO_OK);
    ASSERT_EQ(iso_session_start(machine->session, 0), ISO_OK);
    iso_request request{};
    request.size = sizeof request;
    for (Time now = 0; now < kSecond; now += 1000) {
      ASSERT_EQ(iso_session_advance(machine->session, now), ISO_OK);
      do {
        ASSERT_EQ(iso_session_next(machine->session, &request), ISO_OK);
        if (request.kind == ISO_STEP && request.frame == 20 && in_a_step) break;
        if (request.kind == ISO_STEP) puck_game_step(&machine->game, iso_session_inputs(machine->session, nullptr));
      } while (request.kind != ISO_NOTHING);
      if (request.kind == ISO_STEP) break;
    }
    EXPECT_EQ(request.kind, in_a_step ? iso_request_kind{ISO_STEP} : iso_request_kind{ISO_NOTHING});
    ASSERT_EQ(iso_world_destroy(machine->game.world), ISO_OK);
    EXPECT_EQ(iso_session_next(machine->session, &request), ISO_NOT_ALIVE);
    EXPECT_EQ(iso_session_drive(machine->session, 2 * kSecond, nullptr), ISO_NOT_ALIVE);
    std::size_t size = 0;
    EXPECT_EQ(iso_session_recorded(machine->session, ISO_RECORD_WORLD, nullptr, &size), ISO_NOT_ALIVE);
    EXPECT_GT(iso_session_current(machine->session), 10);
    EXPECT_EQ(iso_session_destroy(machine->session), ISO_OK);
    EXPECT_EQ(iso_world_destroy(machine->game.world), ISO_NOT_ALIVE);
  }
}

TEST(CSession, AWorldHasOneRecordingAtATime) {
  iso_session_config config;
  puck_config(ISO_ROLLBACK, &config);
  config = host_of(config);
  const auto machine = empty_machine();
  ASSERT_EQ(puck_machine_create(machine.get(), &config, 0), ISO_OK);
  ASSERT_EQ(iso_world_keep_log(machine->game.world, 1), ISO_OK);
  EXPECT_EQ(iso_session_record(machine->session, ISO_RECORD_WORLD, nullptr), ISO_REFUSED);
  ASSERT_EQ(iso_world_keep_log(machine->game.world, 0), ISO_OK);
  EXPECT_EQ(iso_session_record(machine->session, ISO_RECORD_WORLD, nullptr), ISO_OK);
  EXPECT_EQ(puck_machine_destroy(machine.get()), ISO_OK);
}

TEST(CSession, AMatchThatWasPutAwayGoesOnInAnotherProcess) {
  iso_session_config config;
  puck_config(ISO_LOCKSTEP, &config);
  std::vector<std::uint8_t> file;
  std::int32_t reached = 0;
  {
    Match match;
    puck_machine& host = match.add(host_of(config));
    match.add(config);
    match.play(5 * kSecond);
    std::size_t size = 0;
    ASSERT_EQ(iso_session_save_match(host.session, nullptr, &size), ISO_SMALL_BUFFER);
    file.resize(size);
    ASSERT_EQ(iso_session_save_match(host.session, file.data(), &size), ISO_OK);
    reached = iso_session_confirmed(host.session);
  }
  EXPECT_GT(reached, 200);
  puck_machine machine{};
  ASSERT_EQ(puck_game_create(&machine.game, 2), ISO_OK);
  iso_game game;
  puck_game_describe(&machine.game, 0, &game);
  config = host_of(config);
  ASSERT_EQ(iso_session_create(&config, &game, file.data(), file.size(), &machine.session), ISO_OK);
  ASSERT_EQ(iso_session_start(machine.session, 0), ISO_OK);
  for (Time now = 0; now < kSecond; now += 1000) ASSERT_EQ(iso_session_drive(machine.session, now, nullptr), ISO_OK);
  EXPECT_GE(machine.game.first, reached - 1);
  EXPECT_GT(machine.game.count, 30);
  EXPECT_EQ(puck_machine_destroy(&machine), ISO_OK);

  file[file.size() / 2] ^= 1;
  puck_machine refused{};
  ASSERT_EQ(puck_game_create(&refused.game, 2), ISO_OK);
  puck_game_describe(&refused.game, 0, &game);
  ASSERT_EQ(iso_session_create(&config, &game, file.data(), file.size(), &refused.session), ISO_OK);
  EXPECT_EQ(iso_session_phase(refused.session), ISO_PHASE_REFUSED);
  iso_session_event event{};
  event.size = sizeof event;
  ASSERT_EQ(iso_session_poll_event(refused.session, &event), ISO_OK);
  EXPECT_EQ(event.kind, ISO_EVENT_REFUSED);
  EXPECT_STREQ(event.key, "saved_match");
  EXPECT_EQ(puck_machine_destroy(&refused), ISO_OK);
}

}  // namespace match_test
}  // namespace isostep::test
