// The built-in match: it is played, rolled back and rebuilt exactly, and much happens in it.
// SPDX-License-Identifier: MIT
#include "scenes/match.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "isostep/state/hash.hpp"
#include "isostep/state/pack.hpp"

namespace isostep::scenes {
namespace match_test {

static_assert(Simulation<Match<float>> && PortableState<Match<float>> && ReplayableSimulation<Match<float>>);
static_assert(Simulation<Match<Q16_16>> && PortableState<Match<Q32_32>> && ReplayableSimulation<Match<double>>);

using Inputs = std::array<MatchInput, kMostPucks>;
using Statuses = std::array<InputStatus, kMostPucks>;

template <class S> class MatchOf : public ::testing::Test {};
using AllScalars = ::testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(MatchOf, AllScalars);

InputView<MatchInput> view(const Inputs& inputs, const Statuses& statuses, int players) {
  const auto n = static_cast<std::size_t>(players);
  return {{inputs.data(), n}, {statuses.data(), n}};
}
template <class S> void step(Match<S>& match, const Inputs& inputs, const Statuses& statuses = {}) {
  match.step(view(inputs, statuses, match.settings().players));
}

/// Pushes as players push, but every frame other buttons and aims.
Inputs busy_inputs(std::uint64_t seed, int frame) {
  Pcg32 random = Pcg32::seeded(seed, static_cast<std::uint64_t>(frame));
  Inputs inputs;
  for (std::size_t player = 0; player < inputs.size(); ++player) {
    const std::uint32_t word = random.next();
    inputs[player] = bot_input(seed, static_cast<int>(player), frame);
    inputs[player].aim = static_cast<std::uint8_t>(word >> 16);
    inputs[player].buttons = static_cast<std::uint8_t>(word >> 25);
  }
  return inputs;
}
/// Players who come and go.
Statuses statuses_at(int frame) {
  Statuses statuses = {};
  if (frame / 40 % 2 == 1) statuses[1] = InputStatus::disconnected;
  if (frame / 25 % 3 == 2) statuses[2] = InputStatus::disconnected;
  return statuses;
}
template <class S> void play(Match<S>& match, int first, int end, std::uint64_t seed = 5) {
  for (int frame = first; frame < end; ++frame) step(match, busy_inputs(seed, frame), statuses_at(frame));
}
template <class S> std::vector<std::uint8_t> bytes_of(const Match<S>& match) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  match.write_portable(writer);
  return bytes;
}

TYPED_TEST(MatchOf, IsRolledBackExactlyAtEveryFrame) {
  constexpr int kFrames = 200, kDepth = 8;
  const MatchSettings settings{.players = 8, .pile = 30, .seed = 3};
  Match<TypeParam> straight(settings), rolled(settings);
  std::vector<std::uint64_t> hashes = {straight.hash()};
  std::array<Snapshot<Match<TypeParam>>, kDepth> ring;
  for (int frame = 0; frame < kFrames; ++frame) {
    play(straight, frame, frame + 1);
    hashes.push_back(straight.hash());
    rolled.save(ring[frame % kDepth]);
    play(rolled, frame, frame + 1, 1000);  // a guess
    const int back = frame - kDepth + 1;
    if (back < 0) continue;
    for (const std::uint64_t seed : {std::uint64_t{2000}, std::uint64_t{5}}) {  // more guesses, then the truth
      rolled.load(ring[back % kDepth]);
      ASSERT_EQ(rolled.hash(), hashes[back]) << frame;
      for (int again = back; again <= frame; ++again) {
        if (seed == 5) rolled.save(ring[again % kDepth]);
        play(rolled, again, again + 1, seed);
        if (seed == 5) {
          ASSERT_EQ(rolled.hash(), hashes[again + 1]) << "back from " << frame << " to " << again;
        }
      }
    }
  }
  EXPECT_GT(straight.state().spawn_count, kMaxSpawned);
}

TYPED_TEST(MatchOf, IsRebuiltFromItsPortableForm) {
  const MatchSettings settings{.players = 3, .pile = 30, .seed = 9};
  Match<TypeParam> match(settings), rebuilt(settings);
  play(match, 0, 130);
  const std::vector<std::uint8_t> bytes = bytes_of(match);
  Reader reader(bytes);
  ASSERT_TRUE(rebuilt.read_portable(reader));
  EXPECT_EQ(reader.remaining(), 0u);
  EXPECT_EQ(rebuilt.hash(), match.hash());
  EXPECT_EQ(bytes_of(rebuilt), bytes);
  for (int frame = 130; frame < 200; ++frame) {
    play(match, frame, frame + 1);
    play(rebuilt, frame, frame + 1);
    ASSERT_EQ(rebuilt.hash(), match.hash()) << frame;
    ASSERT_TRUE(
        std::equal(match.events().begin(), match.events().end(), rebuilt.events().begin(), rebuilt.events().end()));
  }
}

TYPED_TEST(MatchOf, ARefusedReadChangesNothing) {
  Match<TypeParam> match({.players = 2, .pile = 10}), other({.players = 3, .pile = 10});
  play(match, 0, 20);
  const std::uint64_t before = other.hash();
  const std::vector<std::uint8_t> bytes = bytes_of(match);
  Reader foreign(bytes);
  const Result<void> refused = other.read_portable(foreign);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::incompatible);
  EXPECT_EQ(other.hash(), before);

  Match<TypeParam> fresh({.players = 2, .pile = 10});
  const std::uint64_t start = fresh.hash();
  for (const std::size_t size : {std::size_t{0}, std::size_t{9}, bytes.size() / 2, bytes.size() - 1}) {
    Reader cut(Bytes(bytes.data(), size));
    EXPECT_FALSE(fresh.read_portable(cut)) << size;
    EXPECT_EQ(fresh.hash(), start) << size;
  }
}

TYPED_TEST(MatchOf, IsBusyAndStaysWithinTheScalar) {
  Match<TypeParam> match({.players = 8, .pile = 60, .seed = 2});
  const std::uint32_t shapes = match.world().counts().shapes, bodies = match.world().counts().bodies;
  std::array<int, 7> heard = {};
  int added = 0, removed = 0, tethered = 0, least_contacts = 1000;
  std::uint32_t shapes_before = shapes;
  for (int frame = 0; frame < 1500; ++frame) {
    play(match, frame, frame + 1);
    ASSERT_TRUE(match.report().clean()) << frame;
    ASSERT_EQ(match.world().fault(), Fault::none) << frame << describe(match.world().fault());
    ASSERT_LE(match.events().size(), kMaxMatchEvents);
    for (const MatchEvent& event : match.events()) ++heard[static_cast<std::size_t>(event.kind)];
    const WorldCounts counts = match.world().counts();
    added += counts.shapes > shapes_before ? 1 : 0;
    removed += counts.shapes < shapes_before ? 1 : 0;
    shapes_before = counts.shapes;
    ASSERT_EQ(counts.shapes - shapes, counts.bodies - bodies) << "each spawned body has one shape of its own";
    ASSERT_LE(counts.shapes - shapes, kMaxSpawned);
    if (frame >= 60) least_contacts = std::min(least_contacts, static_cast<int>(counts.contacts));
    for (int player = 0; player < 8; ++player) {
      tethered += match.world().contains(match.state().players[player].tether) ? 1 : 0;
    }
  }
  for (std::size_t kind = 0; kind < heard.size(); ++kind) EXPECT_GT(heard[kind], 0) << kind;
  EXPECT_GT(added, 30);
  EXPECT_GT(removed, 5);
  EXPECT_GT(tethered, 0);
  EXPECT_GT(least_contacts, 40);
  EXPECT_GT(match.state().spawn_count, 4 * kMaxSpawned);
  std::set<std::int32_t> scores;
  for (const MatchState::Player& player : match.state().players) scores.insert(player.score);
  EXPECT_GT(scores.size(), 3u);
}

TYPED_TEST(MatchOf, TwoRunsAreEqual) {
  const MatchSettings settings{.players = 5, .pile = 20, .seed = 4};
  Match<TypeParam> a(settings);
  Match<TypeParam> b(settings);
  play(a, 0, 50);
  play(b, 0, 50);
  Match<TypeParam> moved(std::move(b));
  play(a, 50, 100);
  play(moved, 50, 100);
  EXPECT_EQ(a.hash(), moved.hash());
  Match<TypeParam> other({.players = 5, .pile = 20, .seed = 5});
  play(other, 0, 100);
  EXPECT_NE(a.hash(), other.hash());
}

TYPED_TEST(MatchOf, EveryInputOfEveryPlayerReachesTheHash) {
  const MatchSettings settings{.players = 8, .pile = 5, .seed = 1};
  Match<TypeParam> match(settings);
  Snapshot<Match<TypeParam>> start;
  match.save(start);
  std::set<std::uint64_t> seen;
  std::size_t tried = 0;
  const auto try_inputs = [&](const Inputs& inputs, const Statuses& statuses) {
    match.load(start);
    step(match, inputs, statuses);
    seen.insert(match.hash());
    ++tried;
  };
  try_inputs({}, {});
  for (std::size_t player = 0; player < 8; ++player) {
    const auto alone = [&](MatchInput input) {
      Inputs inputs = {};
      inputs[player] = input;
      try_inputs(inputs, {});
    };
    for (const std::int8_t push : {-128, -1, 1, 127}) {
      alone({.push_x = push});
      alone({.push_z = push});
    }
    for (unsigned action = 0; action < kMatchActions; ++action) {
      if (action == static_cast<unsigned>(MatchAction::tilt)) continue;
      alone({.buttons = static_cast<std::uint8_t>(1u << action)});
    }
    const auto tilt = static_cast<std::uint8_t>(1u << static_cast<unsigned>(MatchAction::tilt));
    for (const std::uint8_t aim : {0, 1, 64, 128}) alone({.buttons = tilt, .aim = aim});
    Statuses gone = {};
    gone[player] = InputStatus::disconnected;
    try_inputs({}, gone);
  }
  EXPECT_EQ(seen.size(), tried);
}

TYPED_TEST(MatchOf, APredictedInputGivesWhatAConfirmedOneGives) {
  Match<TypeParam> a({.players = 3, .pile = 5}), b({.players = 3, .pile = 5});
  Statuses predicted;
  predicted.fill(InputStatus::predicted);
  for (int frame = 0; frame < 30; ++frame) {
    step(a, busy_inputs(1, frame));
    step(b, busy_inputs(1, frame), predicted);
  }
  EXPECT_EQ(a.hash(), b.hash());
}

TYPED_TEST(MatchOf, AnInvalidInputIsNoInput) {
  Match<TypeParam> a({.players = 2, .pile = 0}), b({.players = 2, .pile = 0});
  Inputs inputs = {};
  inputs[0] = {100, 100, 0xff, 7};
  EXPECT_FALSE(inputs[0].valid());
  step(a, inputs);
  step(b, {});
  EXPECT_EQ(a.hash(), b.hash());
}

TYPED_TEST(MatchOf, ReplaysWhatItWroteDown) {
  const MatchSettings settings{.players = 4, .pile = 10};
  Match<TypeParam> played(settings), replayed(settings);
  std::vector<std::uint8_t> bytes;
  for (int frame = 0; frame < 60; ++frame) {
    const Inputs inputs = busy_inputs(7, frame);
    const Statuses statuses = statuses_at(frame);
    bytes.clear();
    Writer writer(bytes);
    played.write_inputs(view(inputs, statuses, 4), writer);
    ASSERT_EQ(bytes.size(), 20u);
    step(played, inputs, statuses);
    ASSERT_TRUE(replayed.step_recorded(bytes));
    ASSERT_EQ(replayed.hash(), played.hash()) << frame;
  }
  const std::uint64_t before = replayed.hash();
  std::vector<std::uint8_t> bad = bytes;
  bad.push_back(0);
  EXPECT_FALSE(replayed.step_recorded(bad)) << "a byte too many";
  bad.resize(19);
  EXPECT_FALSE(replayed.step_recorded(bad)) << "a byte too few";
  bad = bytes;
  bad[2] = 0x80;
  EXPECT_FALSE(replayed.step_recorded(bad)) << "a button that does not exist";
  bad = bytes;
  bad[4] = 2;
  EXPECT_FALSE(replayed.step_recorded(bad)) << "neither here nor gone";
  EXPECT_EQ(replayed.hash(), before);
}

TYPED_TEST(MatchOf, AJumpLeavesTheFloorAndWaits) {
  Match<TypeParam> match({.players = 2, .pile = 0});
  Inputs inputs = {};
  inputs[1].buttons = 1u << static_cast<unsigned>(MatchAction::jump);
  step(match, inputs);
  ASSERT_EQ(match.events().size(), 1u);
  EXPECT_EQ(match.events()[0], (MatchEvent{MatchEventKind::jump, 1, match.puck(1).slot}));
  EXPECT_NEAR(to_double(match.world().velocity(match.puck(1)).y), 4.5 - 10.0 / 60, 0.02);
  step(match, inputs);
  EXPECT_TRUE(match.events().empty()) << "the button is held, but must wait";
}

TYPED_TEST(MatchOf, ARopeIsTiedAndUntied) {
  Match<TypeParam> match({.players = 2, .pile = 60});
  const std::uint32_t joints = match.world().counts().joints;
  Inputs inputs = {}, tie = {};
  tie[0].buttons = 1u << static_cast<unsigned>(MatchAction::tether);
  inputs[0].push_x = -128;  // towards the pile
  for (int frame = 0; frame < 60; ++frame) step(match, inputs);
  step(match, tie);
  ASSERT_EQ(match.world().counts().joints, joints + 1);
  for (int frame = 0; frame < 45; ++frame) step(match, {});
  step(match, tie);
  EXPECT_EQ(match.world().counts().joints, joints);
}

TEST(MatchSettings, AreBroughtIntoRange) {
  const Match<float> many({.players = 99, .pile = -1, .hz = 1000, .substeps = 64});
  EXPECT_EQ(many.settings().players, 8);
  EXPECT_EQ(many.settings().pile, 0);
  EXPECT_EQ(many.settings().hz, 1000);
  EXPECT_EQ(many.settings().substeps, 16);
  EXPECT_EQ(many.world().settings().substeps, 16);
}

TEST(MatchRecords, AreTheirCanonicalBytes) {
  const auto numbered = [](auto record) {
    std::uint8_t bytes[sizeof record];
    for (std::size_t i = 0; i < sizeof bytes; ++i) bytes[i] = static_cast<std::uint8_t>(i * 131 + i / 256 + 1);
    std::memcpy(static_cast<void*>(&record), bytes, sizeof record);
    return record;
  };
  EXPECT_TRUE(memory_is_canonical(numbered(MatchInput{})));
  EXPECT_TRUE(memory_is_canonical(numbered(MatchState{})));
  EXPECT_TRUE(memory_is_canonical(numbered(MatchSettings{})));
  EXPECT_TRUE(memory_is_canonical(numbered(MatchEvent{})));
}

TEST(BotInput, IsHeldLikeAHumans) {
  constexpr int kFrames = 6000;
  for (int player = 0; player < 8; ++player) {
    int repeated = 0;
    std::uint8_t buttons = 0;
    for (Frame frame = 1; frame < kFrames; ++frame) {
      const MatchInput input = bot_input(11, player, frame);
      ASSERT_TRUE(input.valid());
      repeated += input == bot_input(11, player, frame - 1) ? 1 : 0;
      buttons |= input.buttons;
    }
    EXPECT_GT(repeated, kFrames * 3 / 4) << player;
    EXPECT_LT(repeated, kFrames * 19 / 20) << player;
    EXPECT_EQ(buttons, 0x7f) << player;
  }
}

TEST(BotInput, DependsOnSeedPlayerAndFrame) {
  int seeds = 0, players = 0;
  for (Frame frame = 0; frame < 1000; ++frame) {
    seeds += bot_input(1, 0, frame) == bot_input(2, 0, frame) ? 0 : 1;
    players += bot_input(1, 0, frame) == bot_input(1, 1, frame) ? 0 : 1;
    EXPECT_EQ(bot_input(1, 3, frame), bot_input(1, 3, frame));
  }
  EXPECT_GT(seeds, 700);
  EXPECT_GT(players, 700);
}

}  // namespace match_test
}  // namespace isostep::scenes
