// Divergence: who computes something else is named to everybody, soon, and the others play on.
// SPDX-License-Identifier: MIT
//
// A client cannot tell two peers two different inputs: it has one connection, and what the host accepted from it is
// what the host passes on to all. A host can; it is found out because clients compare each other's hashes.
#include <gtest/gtest.h>

#include <algorithm>

#include "isostep/replay/desync_bundle.hpp"
#include "scenes/match.hpp"
#include "session/altered_packet.hpp"
#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace desync_test {

using Kind = SessionEvent::Kind;
constexpr Frame kFault = 300;
/// [frames] The distance between the last state known to be equal and the one known to differ: a machine's hash is
/// passed on with every datagram that is its turn, of which the line loses some.
constexpr Frame kDetectionWindow = 16;

struct Match : VirtualMatch<Toy> {
  Match(const SessionConfig& config, std::string_view line)
      : VirtualMatch(
            config, [] { return std::make_unique<Toy>(); },
            [](int player, Frame frame) { return toy_input(17, player, frame); }) {
    for (int p = 1; p < config.players; ++p) add(profile(line));
  }
};
SessionConfig config_of(int players, SessionMode mode) {
  SessionConfig config;
  config.players = players;
  config.mode = mode;
  return config;
}

class Desync : public testing::TestWithParam<std::tuple<SessionMode, int, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Modes, Desync,
                         testing::Combine(testing::Values(SessionMode::lockstep, SessionMode::rollback),
                                          testing::Values(2, 3, 4, 8), testing::Values("lan", "mobile")));

TEST_P(Desync, OfOneBitOnOneMachineIsToldByEveryOtherOnceAndByTheRightName) {
  const auto [mode, players, line] = GetParam();
  for (std::size_t culprit = 0; culprit < static_cast<std::size_t>(players); ++culprit) {
    SCOPED_TRACE(culprit);
    Match match(config_of(players, mode), line);
    match.machine(culprit).tamper = [](Toy& game, Frame frame) {
      if (frame == kFault) game.state.places[5] ^= 1;
    };
    ASSERT_TRUE(match.run_to(kFault + 300, 120 * kSecond));
    const int name = culprit == 0 ? 0xff : match.machine(culprit).seat;
    const std::size_t reference = culprit == 0 ? 1 : 0;
    const std::vector<std::uint64_t>& right = match.machine(reference).hashes;
    for (std::size_t i = 0; i < match.size(); ++i) {
      SCOPED_TRACE(i);
      const Machine<Toy>& machine = match.machine(i);
      EXPECT_TRUE(machine.in_order);
      if (i == culprit) {  // it sees that all the others differ from it
        EXPECT_EQ(machine.count(Kind::desync), players - 1);
        for (std::size_t f = kFault; f < kFault + 300; ++f) ASSERT_NE(machine.hashes[f], right[f]);
        continue;
      }
      ASSERT_EQ(machine.count(Kind::desync), 1);
      const SessionEvent event = machine.last(Kind::desync);
      EXPECT_EQ(event.player, name);
      // State kFault was still right; the one after it is the first wrong one.
      EXPECT_LE(event.agreed, kFault);
      EXPECT_GT(event.frame, kFault);
      EXPECT_LE(event.frame - event.agreed, kDetectionWindow * (mode == SessionMode::lockstep ? 2 : 1));
      EXPECT_NE(event.ours, event.theirs);
      for (std::size_t f = 0; f < kFault + 300; ++f) ASSERT_EQ(machine.hashes[f], right[f]) << f;
      EXPECT_EQ(machine.session.phase(), SessionPhase::playing);
    }
  }
}

TEST(Desync, ThatHealsIsSeenAllTheSame) {
  Match match(config_of(3, SessionMode::rollback), "wifi");
  // Wrong for two states only.
  std::uint64_t right = 0;
  match.machine(1).tamper = [&](Toy& game, Frame frame) {
    if (frame == kFault) {
      right = game.state.absences[7];
      game.state.absences[7] = 77;  // nobody plays there: no effect on anything else
    }
    if (frame == kFault + 2) game.state.absences[7] = right;
  };
  ASSERT_TRUE(match.run_to(kFault + 200, 60 * kSecond));
  EXPECT_EQ(match.host().hashes[kFault + 100], match.machine(1).hashes[kFault + 100]) << "healed";
  EXPECT_NE(match.host().hashes[kFault], match.machine(1).hashes[kFault]);
  for (const std::size_t i : {0u, 2u}) {
    ASSERT_EQ(match.machine(i).count(Kind::desync), 1);
    EXPECT_EQ(match.machine(i).last(Kind::desync).player, match.machine(1).seat);
  }
}

template <class S> class DesyncOfAWorld : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(DesyncOfAWorld, Scalars);

TYPED_TEST(DesyncOfAWorld, ByTheLastBitsOfOneSpeedIsFound) {
  using Game = scenes::Match<TypeParam>;
  const scenes::MatchSettings settings = {.players = 3, .pile = 6, .substeps = 2};
  VirtualMatch<Game> match(
      config_of(3, SessionMode::rollback), [&] { return std::make_unique<Game>(settings); },
      [](int player, Frame frame) { return scenes::bot_input(4, player, frame); });
  for (int p = 1; p < 3; ++p) match.add(profile("wifi"));
  match.machine(2).tamper = [](Game& game, Frame frame) {
    if (frame != kFault) return;
    World<TypeParam>& world = game.world();
    Vec3<TypeParam> velocity = world.velocity(game.puck(0));
    // The last bit of a zero is a number that rounding flushes: the faster axis. Damping may round away the very last.
    const int axis = abs(velocity.x) < abs(velocity.z) ? 2 : 0;
    velocity[axis] = field_from_bits<TypeParam>(field_bits(velocity[axis]) ^ 8u);
    world.set_velocity(game.puck(0), velocity, world.angular_velocity(game.puck(0)));
  };
  ASSERT_TRUE(match.run_to(kFault + 120, 60 * kSecond));
  for (const std::size_t i : {0u, 1u}) {
    ASSERT_EQ(match.machine(i).count(Kind::desync), 1);
    EXPECT_EQ(match.machine(i).last(Kind::desync).player, match.machine(2).seat);
    EXPECT_LE(match.machine(i).last(Kind::desync).agreed, kFault);
    EXPECT_GT(match.machine(i).last(Kind::desync).frame, kFault);
  }
  EXPECT_EQ(match.machine(2).count(Kind::desync), 2);
}

// The state that repairs a machine comes a round trip after the verdict: what went wrong can be written down before.
TEST(DesyncOfAWorldThatIsRepaired, LeavesABundle) {
  using Game = scenes::Match<float>;
  const scenes::MatchSettings settings = {.players = 3, .pile = 6, .substeps = 2};
  SessionConfig config = config_of(3, SessionMode::rollback);
  config.repair = true;
  VirtualMatch<Game> match(
      config, [&] { return std::make_unique<Game>(settings); },
      [](int player, Frame frame) { return scenes::bot_input(4, player, frame); });
  for (int p = 1; p < 3; ++p) match.add(profile("wifi"));
  Machine<Game>& wrong = match.machine(1);
  wrong.tamper = [&](Game& game, Frame frame) {
    if (frame != kFault || wrong.restarts > 0) return;
    Vec3<float> velocity = game.world().velocity(game.puck(0));
    velocity.y += 0.125f;
    game.world().set_velocity(game.puck(0), velocity, game.world().angular_velocity(game.puck(0)));
  };
  FrameHistory<float> history(wrong.game->world());
  wrong.will_step = [&](Frame frame) { history.before_step(frame); };
  wrong.stepped = [&](const Game&, Frame frame) { history.after_step(frame); };
  wrong.went_back = [&](Frame frame) { history.rolled_back(frame); };
  wrong.was_confirmed = [&](Frame frame, std::uint64_t hash) { history.confirmed(frame, hash); };
  std::vector<std::uint8_t> bundle;
  int restarts = -1;
  wrong.after_turn = [&] {
    if (restarts >= 0 || !wrong.heard(Kind::outvoted)) return;
    restarts = wrong.restarts;
    const Frame agreed = wrong.last(Kind::desync).agreed;
    EXPECT_TRUE(write_bundle(sink_to(bundle), history, "match", {.player = 1, .agreed = agreed, .states = 4}).ok());
    EXPECT_NE(history.find(kFault), nullptr);
  };
  ASSERT_TRUE(match.run_to(kFault + 120, 60 * kSecond));
  EXPECT_EQ(restarts, 0) << "before the repair";
  EXPECT_EQ(wrong.restarts, 1);
  EXPECT_EQ(wrong.last(Kind::outvoted).player, wrong.seat);
  EXPECT_GT(bundle.size(), 1000u);
  const Frame end = std::min(wrong.end(), match.host().end());
  EXPECT_EQ(wrong.hashes[static_cast<std::size_t>(end - 1 - wrong.first)],
            match.host().hashes[static_cast<std::size_t>(end - 1)]);
}

// A host that passes on other inputs to one of two clients. Player 0's are its own; the other client's have been
// accepted from a third machine. Each of the two that differ sees it.
TEST(Desync, OfAHostThatTellsTwoPeersTwoThingsIsFound) {
  for (const bool of_another : {false, true}) {
    SCOPED_TRACE(of_another);
    Match match(config_of(3, SessionMode::rollback), "wifi");
    ASSERT_TRUE(match.run_to(60, 60 * kSecond));
    const int liar = of_another ? match.machine(2).seat : 0;
    int lies = 0;
    match.machine(1).middle = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
      if (channel != Channel::datagram) return;
      alter_packet(bytes, NothingAltered{}, [&](int player, Frame frame, std::vector<std::uint8_t>& input) {
        if (player != liar || frame != kFault) return;
        input[0] ^= 1;
        ++lies;
      });
    };
    ASSERT_TRUE(match.run_to(kFault + 200, 60 * kSecond));
    EXPECT_GT(lies, 0);
    EXPECT_NE(match.machine(1).hashes[kFault], match.machine(2).hashes[kFault]);
    const SessionEvent seen = match.machine(2).last(Kind::desync);
    EXPECT_EQ(seen.player, match.machine(1).seat) << "the other client's states are not ours";
    EXPECT_LE(seen.agreed, kFault);
    EXPECT_GT(seen.frame, kFault);
    EXPECT_TRUE(match.machine(1).heard(Kind::desync, match.machine(2).seat));
    EXPECT_GT(match.machine(2).end(), kFault + 199);
  }
}

}  // namespace desync_test
}  // namespace isostep::test
