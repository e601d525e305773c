// A world and a game's own state, saved, hashed and written as one.
// SPDX-License-Identifier: MIT
#include "isostep/state/composite.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "toy.hpp"

namespace isostep {
namespace composite_test {

struct Score {
  std::uint32_t points;
  bool over;

  ISO_FIELDS(points, over)
};
using Both = Composite<toy::Game&, Score&>;
static_assert(Rollbackable<Both> && PortableState<Both> && PlainState<Score> && !PlainState<toy::Game>);
static_assert(!Rollbackable<Score> && !Simulation<Score> && !PortableState<int>);

void step(toy::Game& game, std::uint8_t push) {
  const toy::Input input{push, 1};
  const InputStatus status = InputStatus::confirmed;
  game.step({{&input, 1}, {&status, 1}});
}

TEST(Composite, RestoresBothParts) {
  toy::Game game;
  Score score{1, false};
  Both both = composite(game, score);
  step(game, 3);
  Snapshot<Both> saved;
  both.save(saved);
  const std::uint64_t before = both.hash();
  step(game, 5);
  score = {9, true};
  const std::uint64_t after = both.hash();
  EXPECT_NE(after, before);
  both.load(saved);
  EXPECT_EQ(both.hash(), before);
  EXPECT_EQ(score.points, 1u);
  step(game, 5);
  score = {9, true};
  EXPECT_EQ(both.hash(), after);
}

TEST(Composite, ItsHashSeesEitherPart) {
  toy::Game game;
  Score score{1, false};
  const Both both = composite(game, score);
  const std::uint64_t before = both.hash();
  score.over = true;
  EXPECT_NE(both.hash(), before);
  score.over = false;
  EXPECT_EQ(both.hash(), before);
  step(game, 1);
  EXPECT_NE(both.hash(), before);
}

/// A game as the page of sessions shows it: its parts by value.
struct WholeGame : Composite<toy::Game, Score> {
  WholeGame() : Composite{{}, {1, false}} {}
};
static_assert(Rollbackable<WholeGame> && PortableState<WholeGame>);

TEST(Composite, AGameThatDerivesFromItIsSavedHashedAndWrittenAsOne) {
  WholeGame one, other;
  step(one.world, 3);
  one.user = {7, true};
  WholeGame::Snapshot saved;
  std::as_const(one).save(saved);
  other.load(saved);
  EXPECT_EQ(other.user.points, 7u);
  EXPECT_EQ(other.hash(), one.hash());
  const Both parts = composite(one.world, one.user);
  EXPECT_EQ(one.hash(), parts.hash());
  parts.save(saved);  // the same snapshot
  step(one.world, 4);
  EXPECT_NE(one.hash(), other.hash());
  one.load(saved);
  EXPECT_EQ(one.hash(), other.hash());
  const WholeGame& unchanged = one;
  EXPECT_EQ(composite(unchanged.world, unchanged.user).hash(), one.hash());
}

TEST(Composite, MayHoldAnotherComposite) {
  toy::Game game;
  Score inner{1, false}, outer{2, false};
  Both both = composite(game, inner);
  auto all = composite(both, outer);
  Snapshot<decltype(all)> saved;
  all.save(saved);
  inner.points = 7;
  outer.points = 8;
  all.load(saved);
  EXPECT_EQ(inner.points, 1u);
  EXPECT_EQ(outer.points, 2u);
}

TEST(Composite, ARefusedReadChangesNeitherPart) {
  toy::Game game, other;
  Score score{1, false}, other_score{5, true};
  step(other, 9);
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  composite(other, other_score).write_portable(writer);

  Both both = composite(game, score);
  const std::uint64_t before = both.hash();
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
    Reader reader(Bytes(bytes).first(cut));
    EXPECT_FALSE(both.read_portable(reader));
    EXPECT_EQ(both.hash(), before);
  }
  Reader reader(bytes);
  EXPECT_TRUE(both.read_portable(reader));
  EXPECT_EQ(both.hash(), composite(other, other_score).hash());
}

}  // namespace composite_test
}  // namespace isostep
