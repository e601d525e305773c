// Recorded matches: a session plays them again, and refuses what is damaged or of another game.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/replay/recorder.hpp"
#include "scenes/match.hpp"
#include "session/match_checks.hpp"
#include "session/recorded_play.hpp"

namespace isostep::test {
namespace replay_test {

constexpr Frame kFrames = 600;

/// A match over a bad line in which a player goes and comes back, recorded on two machines.
template <class S> struct RecordedMatch {
  using Game = scenes::Match<S>;
  scenes::MatchSettings settings = {.players = 3, .pile = 8, .substeps = 2};
  SessionConfig config;
  std::vector<std::uint8_t> files[2];
  std::vector<std::uint64_t> hashes;
  std::uint64_t rollbacks = 0;
  bool someone_left = false;

  RecordedMatch() {
    config.players = 3;
    const Game first(settings);
    config.identity = make_replay_header(identity_of_world(first.world().settings(), "match")).value();
    VirtualMatch<Game> match(
        config, [this] { return std::make_unique<Game>(settings); },
        [](int player, Frame frame) { return scenes::bot_input(41, player, frame); });
    for (int p = 1; p < 3; ++p) match.add(profile("mobile")).returns = true;
    MachineRecorder<Game> ours(match.host(), files[0], kFrames), others(match.machine(1), files[1], kFrames);
    EXPECT_TRUE(match.run_to(200, 60 * kSecond));
    match.network().cut(match.machine(2).endpoint);
    EXPECT_TRUE(match.run_to(kFrames, 60 * kSecond));
    for (MachineRecorder<Game>* each : {&ours, &others}) EXPECT_TRUE(each->recorder.finish().ok());
    hashes.assign(match.host().hashes.begin(), match.host().hashes.begin() + kFrames);
    someone_left = match.host().heard(SessionEvent::Kind::left);
    for (const std::uint64_t count : match.host().session.stats().rollbacks) rollbacks += count;
  }
};

template <class S> class MatchReplay : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(MatchReplay, Scalars);

TYPED_TEST(MatchReplay, GivesTheHashesOfTheMatchWhoeverRecordedIt) {
  using Game = scenes::Match<TypeParam>;
  const RecordedMatch<TypeParam> match;
  EXPECT_GT(match.rollbacks, 0u);
  EXPECT_TRUE(match.someone_left);
  EXPECT_EQ(match.files[0], match.files[1]);
  for (const std::vector<std::uint8_t>& file : match.files) {
    const Played<Game> played = play(match.config, file, Game(match.settings));
    EXPECT_TRUE(played.events.empty());
    EXPECT_EQ(played.phase, SessionPhase::over);
    EXPECT_EQ(played.hashes, match.hashes);
  }
}

TEST(MatchReplayRefuses, OrStopsWhereTheFileIsDamaged) {
  using Game = scenes::Match<Q16_16>;
  const RecordedMatch<Q16_16> match;
  Pcg32 random = Pcg32::seeded(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<std::uint8_t> file = match.files[0];
    const std::size_t at = random.next() % file.size();
    SCOPED_TRACE(at);
    file[at] ^= static_cast<std::uint8_t>(1u << random.next() % 8);
    const Played<Game> played = play(match.config, file, Game(match.settings));
    EXPECT_EQ(played.phase, SessionPhase::over);
    EXPECT_TRUE(played.heard(SessionEvent::Kind::refused) || played.heard(SessionEvent::Kind::desync));
    for (std::size_t f = 0; f < played.hashes.size(); ++f) ASSERT_EQ(played.hashes[f], match.hashes[f]);
  }
}

TEST(MatchReplayRefuses, AFileThatEndsEarlyAfterItsWholeBlocks) {
  using Game = scenes::Match<Q16_16>;
  const RecordedMatch<Q16_16> match;
  for (const std::size_t percent : {0u, 1u, 30u, 60u, 99u}) {
    SCOPED_TRACE(percent);
    const Bytes beginning = Bytes(match.files[0]).first(match.files[0].size() * percent / 100);
    const Played<Game> played = play(match.config, beginning, Game(match.settings));
    EXPECT_TRUE(played.heard(SessionEvent::Kind::refused));
    EXPECT_EQ(played.phase, SessionPhase::over);
    EXPECT_LE(played.hashes.size(), match.hashes.size());
    for (std::size_t f = 0; f < played.hashes.size(); ++f) ASSERT_EQ(played.hashes[f], match.hashes[f]);
  }
}

TEST(MatchReplayRefuses, AnotherGameByTheFieldThatDiffers) {
  using Game = scenes::Match<Q16_16>;
  const RecordedMatch<Q16_16> match;
  SessionConfig config = match.config;
  config.identity.set("scene", "another", true);
  Played<Game> played = play(config, match.files[0], Game(match.settings));
  ASSERT_EQ(played.events.size(), 1u);
  EXPECT_EQ(played.events[0].field.key.view(), "scene");
  EXPECT_TRUE(played.hashes.empty());
  config = match.config;
  config.players = 4;
  played = play(config, match.files[0], Game({.players = 4, .pile = 8, .substeps = 2}));
  ASSERT_EQ(played.events.size(), 1u);
  EXPECT_EQ(played.events[0].field.key.view(), "players");
}

}  // namespace replay_test
}  // namespace isostep::test
