// The turn of a session of C: what may be called, what is left in its middle, what is recorded meanwhile.
// SPDX-License-Identifier: MIT
#include <vector>

#include "alone.hpp"

namespace isostep::test {
namespace turn_test {

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

}  // namespace turn_test
}  // namespace isostep::test
