// Late joins: into a running match, by its inputs alone or by a snapshot that is checked.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/session/protocol/message.hpp"
#include "scenes/match.hpp"
#include "session/altered_packet.hpp"
#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace joining_test {

constexpr Frame kShortHistory = 128;  // [frames] two seconds: who joins after them needs a snapshot

VirtualMatch<Toy> toy_match(const SessionConfig& config, std::size_t ballast = 0) {
  return VirtualMatch<Toy>(
      config, [ballast] { return std::make_unique<Toy>(ballast); },
      [](int player, Frame frame) { return toy_input(3, player, frame); });
}
SessionConfig config_of(int players, Frame history = 1200) {
  SessionConfig config;
  config.players = players;
  config.history = history;
  return config;
}
/// All clients but the last are there; the match begins without it, and runs for some frames.
template <class Game>
void start_without_last(VirtualMatch<Game>& match, int players, Frame frames, const transport::NetworkProfile& line) {
  for (int p = 1; p < players - 1; ++p) match.add(line);
  match.run(kSecond, [] { return false; });
  ASSERT_EQ(match.host().session.phase(), SessionPhase::waiting);
  match.host().session.start(match.now());
  ASSERT_TRUE(match.run_to(frames, 60 * kSecond));
}
/// Its inputs take effect: the straight run with them and the one without differ (expect_one_history compares values).
template <class Game> void expect_joined(VirtualMatch<Game>& match, Machine<Game>& joiner, int player, Frame after) {
  const SessionEvent joined = joiner.last(SessionEvent::Kind::joined, player);
  ASSERT_GT(joined.frame, after);
  for (std::size_t i = 0; i < match.size(); ++i) {
    EXPECT_EQ(match.machine(i).count(SessionEvent::Kind::joined, player), 1);
    EXPECT_EQ(match.machine(i).last(SessionEvent::Kind::joined, player).frame, joined.frame);
  }
  for (Frame frame = 0; frame < match.host().end(); ++frame) {
    ASSERT_EQ(match.host().played(frame, player), frame >= joined.frame) << frame;
  }
  bool differs_from_none = false;
  for (Frame frame = joined.frame; frame < match.host().end(); ++frame) {
    const auto& said = match.host().at(frame)[static_cast<std::size_t>(player)];
    differs_from_none = differs_from_none || !(said.input == typename Game::Input{});
  }
  EXPECT_TRUE(differs_from_none);
}

class LateJoin : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Players, LateJoin, testing::Values(2, 3, 4));

TEST_P(LateJoin, NeedsNoSnapshotWhileTheHostHasAllInputs) {
  const int players = GetParam();
  VirtualMatch<Toy> match = toy_match(config_of(players));
  start_without_last(match, players, 300, profile("wifi"));
  Machine<Toy>& joiner = match.add(profile("wifi"));
  ASSERT_TRUE(match.run_to(1200, 60 * kSecond));
  EXPECT_EQ(joiner.restarts, 0);
  EXPECT_EQ(joiner.first, 0);
  expect_joined(match, joiner, players - 1, 300);
  expect_one_history(match);
}

TEST_P(LateJoin, BringsASnapshotInPiecesWhenTheFirstInputsAreGone) {
  const int players = GetParam();
  VirtualMatch<Toy> match = toy_match(config_of(players, kShortHistory), 5000);  // 40 kB
  start_without_last(match, players, 600, profile("lan"));
  Machine<Toy>& joiner = match.add(profile("lan"));
  int pieces = 0;
  joiner.middle = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
    const Result<MessageKind> kind = message_kind(bytes);
    pieces += channel == Channel::reliable && kind && kind.value() == MessageKind::piece ? 1 : 0;
  };
  ASSERT_TRUE(match.run_to(1500, 60 * kSecond));
  EXPECT_GT(pieces, 3);
  EXPECT_EQ(joiner.restarts, 1);
  EXPECT_GE(joiner.first, 590);
  expect_joined(match, joiner, players - 1, 600);
  expect_one_history(match);
}

template <class S> class LateJoinOfAWorld : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(LateJoinOfAWorld, Scalars);

TYPED_TEST(LateJoinOfAWorld, ContinuesContactsJointsAndSpawnedBodies) {
  using Game = scenes::Match<TypeParam>;
  const scenes::MatchSettings settings = {.players = 3, .pile = 10, .substeps = 4};
  VirtualMatch<Game> match(
      config_of(3, kShortHistory), [&] { return std::make_unique<Game>(settings); },
      [](int player, Frame frame) { return scenes::bot_input(9, player, frame); });
  start_without_last(match, 3, 600, profile("wifi"));
  ASSERT_GT(match.host().game->state().spawn_count, 0u);
  Machine<Game>& joiner = match.add(profile("wifi"));
  ASSERT_TRUE(match.run_to(1200, 60 * kSecond));
  EXPECT_EQ(joiner.restarts, 1);
  EXPECT_GT(joiner.first, 500);
  expect_joined(match, joiner, 2, 600);
  expect_one_history(match);
}

TEST(LateJoin, TwoAtOnceShareOneSnapshot) {
  VirtualMatch<Toy> match = toy_match(config_of(4, kShortHistory), 3000);
  match.add(profile("lan"));
  match.run(kSecond, [] { return false; });
  match.host().session.start(match.now());
  ASSERT_TRUE(match.run_to(600, 60 * kSecond));
  Machine<Toy>& one = match.add(profile("lan"));
  Machine<Toy>& other = match.add(profile("lan"));
  ASSERT_TRUE(match.run_to(1500, 60 * kSecond));
  EXPECT_EQ(one.restarts, 1);
  EXPECT_EQ(other.restarts, 1);
  EXPECT_EQ(one.first, other.first);
  EXPECT_TRUE(match.host().played(1499, 2));
  EXPECT_TRUE(match.host().played(1499, 3));
  expect_one_history(match);
}

TEST(LateJoin, SucceedsOnALineThatLosesAndReorders) {
  VirtualMatch<Toy> match = toy_match(config_of(3, 600), 5000);
  start_without_last(match, 3, 900, profile("lan"));
  Machine<Toy>& joiner = match.add(profile("severe"));
  ASSERT_TRUE(match.run_to(2400, 90 * kSecond));
  EXPECT_EQ(joiner.restarts, 1);
  expect_joined(match, joiner, 2, 900);
  expect_one_history(match);
}

// --- snapshots that are not what the host says they are ---

/// Changes byte `at` of a snapshot when this message is the piece that holds it.
bool alter_snapshot(Channel channel, std::vector<std::uint8_t>& bytes, std::size_t at, std::uint8_t bits) {
  const Result<MessageKind> kind = message_kind(bytes);
  if (channel != Channel::reliable || !kind || kind.value() != MessageKind::piece) return false;
  const Piece piece = read_piece(bytes).value();
  if (at < piece.offset || at - piece.offset >= piece.bytes.size()) return false;
  bytes[bytes.size() - piece.bytes.size() + (at - piece.offset)] ^= bits;
  return true;
}

TEST(TamperedSnapshot, IsRefusedWhicheverByteChangedOnTheWay) {
  for (const std::size_t at : {0u, 7u, 8u, 100u, 135u, 136u, 1000u, 16000u}) {
    SCOPED_TRACE(at);
    VirtualMatch<Toy> match = toy_match(config_of(3, kShortHistory), 5000);
    start_without_last(match, 3, 300, profile("lan"));
    Machine<Toy>& joiner = match.add(profile("lan"));
    bool done = false;
    joiner.middle = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
      done = done || alter_snapshot(channel, bytes, at, 0x10);
    };
    ASSERT_TRUE(match.run(20 * kSecond, [&] { return joiner.heard(SessionEvent::Kind::bad_snapshot); }));
    EXPECT_TRUE(done);
    EXPECT_EQ(joiner.session.phase(), SessionPhase::refused);
    EXPECT_EQ(joiner.hashes.size(), 0u) << "it confirmed a state that nobody vouches for";
    // The others are not concerned.
    match.run(5 * kSecond, [] { return false; });
    EXPECT_FALSE(match.host().heard(SessionEvent::Kind::joined, 2));
    EXPECT_GT(match.host().end(), 500);
    EXPECT_EQ(differences(match.machine(1), match.host(), match.straight(match.host().end())), 0u);
  }
}

TEST(TamperedSnapshot, OfAWorldIsRefused) {
  using Game = scenes::Match<Q16_16>;
  for (const std::size_t at : {3u, 60u, 500u, 1500u, 3001u, 5000u}) {
    SCOPED_TRACE(at);
    VirtualMatch<Game> match(
        config_of(3, kShortHistory),
        [&] { return std::make_unique<Game>(scenes::MatchSettings{.players = 3, .pile = 6, .substeps = 2}); },
        [](int player, Frame frame) { return scenes::bot_input(9, player, frame); });
    start_without_last(match, 3, 200, profile("lan"));
    Machine<Game>& joiner = match.add(profile("lan"));
    bool done = false;
    joiner.middle = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
      done = done || alter_snapshot(channel, bytes, at, 0x01);
    };
    EXPECT_TRUE(match.run(20 * kSecond, [&] { return joiner.heard(SessionEvent::Kind::bad_snapshot); }));
    EXPECT_TRUE(done);
    EXPECT_EQ(joiner.hashes.size(), 0u);
  }
}

/// A host that shows joiners another state than it plays: written down, its game has one bit more.
struct TwoFaced : Toy {
  using Toy::Toy;
  bool lies = false;
  void write_portable(Writer& writer) const {
    Toy other = *this;
    if (lies) other.state.places[0] ^= 1;
    other.write_portable(writer);
  }
};

TEST(TamperedSnapshot, IsRefusedWhenTheHostCapturesAnotherStateThanItPlays) {
  VirtualMatch<TwoFaced> match(
      config_of(3, kShortHistory), [] { return std::make_unique<TwoFaced>(); },
      [](int player, Frame frame) { return toy_input(3, player, frame); });
  start_without_last(match, 3, 300, profile("lan"));
  match.host().game->lies = true;
  Machine<TwoFaced>& joiner = match.add(profile("lan"));
  ASSERT_TRUE(match.run(20 * kSecond, [&] { return joiner.heard(SessionEvent::Kind::bad_snapshot); }));
  EXPECT_EQ(joiner.hashes.size(), 0u);
}

// A host and its snapshot agree with each other; a third machine does not. After five seconds the host's
// word counts, and then there are three that can judge.
TEST(LateJoin, IsAdmittedLaterWhileThePeersDisagree) {
  VirtualMatch<Toy> match = toy_match(config_of(3, kShortHistory));
  match.add(profile("lan"));
  match.machine(1).tamper = [](Toy& game, Frame frame) {
    if (frame == 100) game.state.places[4] ^= 1;
  };
  match.run(kSecond, [] { return false; });
  match.host().session.start(match.now());
  ASSERT_TRUE(match.run_to(400, 60 * kSecond));
  ASSERT_TRUE(match.host().heard(SessionEvent::Kind::desync));
  Machine<Toy>& joiner = match.add(profile("lan"));
  const Frame from = match.host().end();
  match.run(5 * kSecond, [] { return false; });
  EXPECT_EQ(joiner.restarts, 1);
  EXPECT_GT(joiner.hashes.size(), 200u) << "it sees the match";
  EXPECT_FALSE(joiner.heard(SessionEvent::Kind::joined, 2)) << "but has no part in it";
  EXPECT_NE(joiner.session.phase(), SessionPhase::playing);
  EXPECT_EQ(joiner.last(SessionEvent::Kind::desync).player, 1);
  EXPECT_FALSE(match.host().heard(SessionEvent::Kind::joined, 2));
  for (Frame frame = from; frame < match.host().end(); ++frame) ASSERT_FALSE(match.host().played(frame, 2));
  match.run(5 * kSecond, [] { return false; });
  EXPECT_EQ(joiner.session.phase(), SessionPhase::playing);
  for (std::size_t i = 0; i < match.size(); ++i) {
    EXPECT_EQ(match.machine(i).last(SessionEvent::Kind::outvoted).player, 1) << i;
  }
}

// The host's word alone is enough when there is nobody else to ask, or when nobody answers for five seconds.
void expect_a_second_machine_is_asked(bool asked_early) {
  VirtualMatch<Toy> match = toy_match(config_of(3, kShortHistory));
  start_without_last(match, 3, 400, profile("lan"));
  Machine<Toy>& joiner = match.add(profile("lan"));
  // What the host passes on of player 1's hashes does not arrive.
  bool passes_on = false;
  joiner.middle = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
    if (channel != Channel::datagram || passes_on) return;
    alter_packet(
        bytes, [](PacketHeader& header) { header.reporter = 0xff; }, NothingAltered{});
  };
  match.run(4 * kSecond, [] { return false; });
  EXPECT_FALSE(joiner.heard(SessionEvent::Kind::joined, 2));
  EXPECT_EQ(joiner.restarts, 1);
  passes_on = asked_early;
  const Time before = match.now();
  ASSERT_TRUE(match.run(10 * kSecond, [&] { return joiner.heard(SessionEvent::Kind::joined, 2); }));
  EXPECT_EQ(match.now() < before + kSecond, asked_early);
  ASSERT_TRUE(match.run_to(match.host().end() + 300, 30 * kSecond));
  expect_one_history(match);
}
TEST(LateJoin, AsksASecondMachineBeforeItPlays) { expect_a_second_machine_is_asked(true); }
TEST(LateJoin, TakesTheHostsWordWhenNobodyElseSpeaks) { expect_a_second_machine_is_asked(false); }

}  // namespace joining_test
}  // namespace isostep::test
