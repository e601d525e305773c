// The game's own state in sessions of C: as a block and by callbacks alike; what the sync test finds; recordings.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tally_game.hpp"

namespace isostep::test {
namespace state_test {

constexpr std::uint64_t kSecond = 1000000;  // [us]

/// A sync test of two players on one machine, for so many seconds.
std::vector<iso_session_event> sync_test(Tally& tally, bool by_callbacks, int seconds) {
  const iso_session_config config = tally_config(ISO_SYNC_TEST);
  const iso_game game = tally.describe(by_callbacks);
  iso_session* session = nullptr;
  std::vector<iso_session_event> events;
  EXPECT_EQ(iso_session_create(&config, &game, nullptr, 0, &session), ISO_OK) << iso_last_error();
  for (std::uint64_t now = 0; now < seconds * kSecond; now += 4000) {
    for (int p : {0, 1}) {
      const std::uint8_t what = tally_input(iso_session_current(session), p);
      if (iso_session_wants_input(session, p)) iso_session_add_local_input(session, p, &what, 1);
    }
    EXPECT_EQ(iso_session_drive(session, now, nullptr), ISO_OK);
    for (iso_session_event event = poll_event(session); event.kind != ISO_EVENT_NONE; event = poll_event(session)) {
      events.push_back(event);
    }
  }
  EXPECT_EQ(iso_session_destroy(session), ISO_OK);
  return events;
}
const iso_session_event* find(const std::vector<iso_session_event>& events, iso_event_kind kind) {
  for (const iso_session_event& event : events) {
    if (event.kind == kind) return &event;
  }
  return nullptr;
}

TEST(CState, PassesTheSyncTestAsBlockAndByCallbacksWithTheSameHashes) {
  Tally block, callbacks;
  for (const auto& events : {sync_test(block, false, 10), sync_test(callbacks, true, 10)}) {
    EXPECT_EQ(find(events, ISO_EVENT_DESYNC), nullptr);
    EXPECT_EQ(find(events, ISO_EVENT_UNHASHED), nullptr);
  }
  ASSERT_GT(block.hashes.size(), 500u);
  EXPECT_EQ(block.hashes, callbacks.hashes);
  EXPECT_NE(block.hashes[100], block.hashes[200]) << "nothing happened";
  EXPECT_GT(block.rollbacks, 400);
  EXPECT_LT(callbacks.largest_slot, tally_config(ISO_SYNC_TEST).kept);
}

TEST(CState, TheSyncTestFindsWhatIsForgotten) {
  Tally tally;
  tally.forgets = true;
  EXPECT_NE(find(sync_test(tally, false, 2), ISO_EVENT_DESYNC), nullptr);
}

TEST(CState, TheSyncTestFindsTheByteThatAHashMisses) {
  for (const std::size_t blind : {std::size_t{0}, std::size_t{7}, Tally::kSize - 1}) {
    Tally tally;
    tally.blind = blind;
    const std::vector<iso_session_event> events = sync_test(tally, true, 10);
    const iso_session_event* const found = find(events, ISO_EVENT_UNHASHED);
    ASSERT_NE(found, nullptr) << blind;
    EXPECT_EQ(found->ours, blind);
  }
}

/// Host and client of a match in virtual time.
struct Pair {
  Tally tallies[2];
  iso_session* sessions[2] = {};
  iso_network* network = nullptr;
  std::uint32_t line = 0;
  std::uint64_t now = 0;

  explicit Pair(bool by_callbacks, iso_session_config config = tally_config(ISO_ROLLBACK)) {
    EXPECT_EQ(iso_network_create(5, &network), ISO_OK);
    EXPECT_EQ(iso_network_add_client(network, "latency=60,jitter=20,loss=5", &line), ISO_OK);
    EXPECT_EQ(iso_network_connect(network, line, 0), ISO_OK);
    for (int n : {1, 0}) {
      config.host = n == 0;
      config.seed = n == 0 ? 3 : 0;
      tallies[n].session = nullptr;
      const iso_game game = tallies[n].describe(by_callbacks);
      EXPECT_EQ(iso_session_create(&config, &game, nullptr, 0, &sessions[n]), ISO_OK) << iso_last_error();
      tallies[n].session = sessions[n];
    }
  }
  ~Pair() {
    for (iso_session* session : sessions) EXPECT_EQ(iso_session_destroy(session), ISO_OK);
    EXPECT_EQ(iso_network_destroy(network), ISO_OK);
  }
  void play(std::uint64_t time) {
    for (const std::uint64_t end = now + time; now < end; now += 1000) {
      ASSERT_EQ(iso_network_advance_to(network, now), ISO_OK);
      for (std::uint32_t n : {0u, 1u}) {
        const std::uint8_t what = tally_input(iso_session_current(sessions[n]), static_cast<int>(n));
        ASSERT_EQ(iso_network_deliver(network, n == 0 ? 0 : line, sessions[n], now), ISO_OK);
        iso_session_add_local_input(sessions[n], static_cast<int>(n), &what, 1);
        ASSERT_EQ(iso_session_drive(sessions[n], now, nullptr), ISO_OK);
        ASSERT_EQ(iso_network_dispatch(network, n == 0 ? 0 : line, sessions[n], now), ISO_OK);
      }
    }
  }
};

TEST(CState, AMatchIsTheSameAsBlockAndByCallbacks) {
  Pair block(false), callbacks(true);
  block.play(10 * kSecond);
  callbacks.play(10 * kSecond);
  for (int n : {0, 1}) {
    EXPECT_GT(block.tallies[n].hashes.size(), 400u);
    EXPECT_EQ(block.tallies[n].hashes, callbacks.tallies[n].hashes);
    EXPECT_GT(block.tallies[n].rollbacks, 50);
    EXPECT_EQ(block.tallies[n].rollbacks, callbacks.tallies[n].rollbacks);
    EXPECT_LT(callbacks.tallies[n].largest_slot, tally_config(ISO_ROLLBACK).kept);
  }
}

TEST(CState, GuessesAreThoseOfThePredictor) {
  std::uint64_t steps[3];
  for (int kind : {0, 1, 2}) {
    iso_session_config config = tally_config(ISO_ROLLBACK);
    config.predictor = kind == 1 ? ISO_PREDICT_NEUTRAL : ISO_REPEAT_LAST;
    Pair pair(false, config);
    if (kind == 2) {  // as a callback: the same game with a guess that is never right
      for (int n : {0, 1}) {
        ASSERT_EQ(iso_session_destroy(pair.sessions[n]), ISO_OK);
        config.host = n == 0;
        config.seed = n == 0 ? 3 : 0;
        iso_game game = pair.tallies[n].describe(false);
        game.predict = [](void* user, const void*, std::size_t, std::int32_t, void* to) -> std::size_t {
          ++Tally::of(user).guesses;
          *static_cast<std::uint8_t*>(to) = 0xff;
          return 1;
        };
        ASSERT_EQ(iso_session_create(&config, &game, nullptr, 0, &pair.sessions[n]), ISO_OK);
      }
    }
    pair.play(10 * kSecond);
    EXPECT_EQ(pair.tallies[0].guesses > 100, kind == 2);
    const std::size_t both = std::min(pair.tallies[0].hashes.size(), pair.tallies[1].hashes.size());
    EXPECT_GT(both, 400u);
    pair.tallies[0].hashes.resize(both);
    pair.tallies[1].hashes.resize(both);
    EXPECT_EQ(pair.tallies[0].hashes, pair.tallies[1].hashes);
    iso_session_stats stats{};
    stats.size = sizeof stats;
    ASSERT_EQ(iso_session_get_stats(pair.sessions[0], &stats), ISO_OK);
    steps[kind] = stats.steps;
  }
  EXPECT_LT(steps[0], steps[1]) << "inputs last for some frames: to repeat them is the better guess";
  EXPECT_LT(steps[0], steps[2]);
}

std::vector<std::uint8_t> recorded(iso_session* session, iso_recording kind) {
  std::size_t size = 0;
  EXPECT_EQ(iso_session_recorded(session, kind, nullptr, &size), ISO_SMALL_BUFFER) << iso_last_error();
  std::vector<std::uint8_t> bytes(size);
  EXPECT_EQ(iso_session_recorded(session, kind, bytes.data(), &size), ISO_OK);
  return bytes;
}

/// Plays a recording to its end; the events.
std::vector<iso_session_event> play_again(Tally& tally, const std::vector<std::uint8_t>& file, iso_phase& phase) {
  const iso_session_config config = tally_config(ISO_REPLAY);
  const iso_game game = tally.describe(false);
  iso_session* session = nullptr;
  std::vector<iso_session_event> events;
  EXPECT_EQ(iso_session_create(&config, &game, file.data(), file.size(), &session), ISO_OK) << iso_last_error();
  for (std::uint64_t now = 0; now < 20 * kSecond && iso_session_phase(session) != ISO_OVER; now += 4000) {
    EXPECT_EQ(iso_session_drive(session, now, nullptr), ISO_OK);
    for (iso_session_event event = poll_event(session); event.kind != ISO_EVENT_NONE; event = poll_event(session)) {
      events.push_back(event);
    }
  }
  phase = iso_session_phase(session);
  EXPECT_EQ(iso_session_destroy(session), ISO_OK);
  return events;
}

TEST(CState, AMatchIsPlayedAgainFromItsRecordingAndAnAlteredOneIsNot) {
  Pair pair(false);
  ASSERT_EQ(iso_session_record(pair.sessions[1], ISO_RECORD_MATCH, nullptr), ISO_OK);
  EXPECT_EQ(iso_session_record(pair.sessions[1], ISO_RECORD_MATCH, nullptr), ISO_REFUSED) << "one at a time";
  EXPECT_EQ(iso_session_record(pair.sessions[1], ISO_RECORD_WORLD, nullptr), ISO_REFUSED) << "there is no world";
  pair.play(5 * kSecond);
  std::vector<std::uint8_t> file = recorded(pair.sessions[1], ISO_RECORD_MATCH);

  Tally again;
  iso_phase phase = ISO_WAITING;
  EXPECT_TRUE(play_again(again, file, phase).empty());
  EXPECT_EQ(phase, ISO_OVER);
  EXPECT_GT(again.hashes.size(), 200u);
  EXPECT_EQ(again.hashes, pair.tallies[1].hashes);

  int refused = 0, tries = 0;
  for (std::size_t at = 0; at < file.size(); at += 1 + file.size() / 50, ++tries) {
    std::vector<std::uint8_t> altered = file;
    altered[at] ^= 1;
    Tally other;
    refused += play_again(other, altered, phase).empty() ? 0 : 1;
  }
  EXPECT_EQ(refused, tries);
  file.resize(file.size() / 2);
  Tally cut;
  EXPECT_FALSE(play_again(cut, file, phase).empty());
}

}  // namespace state_test
}  // namespace isostep::test
