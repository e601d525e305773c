// The pairs of boxes that overlap, against brute force.
// SPDX-License-Identifier: MIT
#include "unit/collision/broadphase_model.hpp"

namespace isostep::test {
namespace broadphase_pairs_test {

template <class S> class BroadphasePairs : public testing::Test {};
TYPED_TEST_SUITE(BroadphasePairs, BroadphaseScalars);

TYPED_TEST(BroadphasePairs, ThousandsOfRandomChangesLeaveThePairsOfBruteForce) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(11);
  for (const std::uint32_t slots : {1u, 3u, 20u, 150u}) {
    Model<S> model;
    model.slots.resize(slots);
    AabbTree<S> tree;
    PairSet<S> pairs;
    for (int step = 0; step < 250; ++step) {
      const std::uint32_t changes = random_below(random, step % 10 == 0 ? slots * 2 : 8);
      for (std::uint32_t i = 0; i < changes; ++i) churn(random, model, tree, pairs, 14);
      if (step % 3 != 0) tree.optimise();
      ASSERT_TRUE(tree.validate());
      pairs.update(tree, Filter<S>{&model});
      ASSERT_EQ(pairs.keys(), model.brute_force()) << slots << " slots, step " << step;
    }
  }
}

TYPED_TEST(BroadphasePairs, PairsDoNotDependOnHowTheTreeCameAbout) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(12);
  Model<S> model;
  model.slots.resize(200);
  AabbTree<S> old_tree;
  PairSet<S> old_pairs;
  for (int step = 0; step < 40; ++step) {
    for (int i = 0; i < 60; ++i) churn(random, model, old_tree, old_pairs, 10);
    old_pairs.update(old_tree, Filter<S>{&model});
    AabbTree<S> inserted;  // backwards, one by one
    AabbTree<S> built;     // at once
    PairSet<S> inserted_pairs;
    PairSet<S> built_pairs;
    for (std::uint32_t i = 200; i-- > 0;) {
      if (!model.slots[i].present) continue;
      inserted.insert(i, model.slots[i].box);
      inserted_pairs.mark_moved(i);
      built.stage(i, model.slots[i].box);
      built_pairs.mark_moved(i);
    }
    built.rebuild();
    ASSERT_TRUE(inserted.validate());
    ASSERT_TRUE(built.validate());
    inserted_pairs.update(inserted, Filter<S>{&model});
    built_pairs.update(built, Filter<S>{&model});
    ASSERT_EQ(old_pairs.keys(), inserted_pairs.keys());
    ASSERT_EQ(old_pairs.keys(), built_pairs.keys());
  }
  EXPECT_GT(old_pairs.keys().size(), 50u);
}

TYPED_TEST(BroadphasePairs, BoxesThatTouchArePairsAndBoxesARoundingStepApartAreNot) {
  using S = TypeParam;
  AabbTree<S> tree;
  PairSet<S> pairs;
  const Aabb<S> unit = {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}};
  tree.insert(4, unit);
  tree.insert(2, {{S(1), S(0), S(0)}, {S(2), S(1), S(1)}});
  tree.insert(9, {{S(0), S(1) + resolution<S>(), S(0)}, {S(1), S(2), S(1)}});
  for (const std::uint32_t slot : {2u, 4u, 9u}) pairs.mark_moved(slot);
  pairs.update(tree, Everything{});
  EXPECT_EQ(pairs.keys(), std::vector<std::uint64_t>{pair_key(4, 2)});
  EXPECT_EQ(pair_a(pairs.keys()[0]), 2u);
  EXPECT_EQ(pair_b(pairs.keys()[0]), 4u);
}

TYPED_TEST(BroadphasePairs, ASlotTakenAgainBetweenTwoUpdatesHasThePairsOfItsNewBoxOnly) {
  using S = TypeParam;
  AabbTree<S> tree;
  PairSet<S> pairs;
  for (int i = 0; i < 40; ++i) {  // a row of boxes, each of which touches the next
    const std::uint32_t slot = static_cast<std::uint32_t>(i);
    tree.insert(slot, {{S(i), S(0), S(0)}, {S(i + 1), S(1), S(1)}});
    pairs.mark_moved(slot);
  }
  pairs.update(tree, Everything{});
  EXPECT_EQ(pairs.keys().size(), 39u);
  tree.remove(10);
  pairs.mark_removed(10);
  tree.insert(10, {{S(20), S(2), S(0)}, {S(20) + S(0.5), S(3), S(1)}});
  pairs.mark_moved(10);
  pairs.update(tree, Everything{});
  EXPECT_EQ(pairs.keys().size(), 37u);
  tree.update(10, {{S(20) + S(0.25), S(1), S(0)}, {S(20) + S(0.5), S(3), S(1)}});
  pairs.mark_moved(10);
  pairs.update(tree, Everything{});
  EXPECT_EQ(pairs.keys().size(), 38u);
  EXPECT_TRUE(std::count(pairs.keys().begin(), pairs.keys().end(), pair_key(10, 20)) == 1);
}

TYPED_TEST(BroadphasePairs, MorePairsThanTheBudgetAreForTheCallerToChooseUntilThereAreFewer) {
  using S = TypeParam;
  AabbTree<S> tree;
  PairSet<S> pairs;
  const Aabb<S> box = {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}};
  for (std::uint32_t i = 0; i < 6; ++i) {
    tree.insert(i, box);
    pairs.mark_moved(i);
  }
  EXPECT_FALSE(pairs.update(tree, Everything{}, 14));
  std::vector<std::uint64_t> chosen = {pair_key(0, 1), pair_key(2, 3)};
  pairs.choose(chosen, false);
  EXPECT_EQ(pairs.keys().size(), 2u);
  EXPECT_FALSE(pairs.update(tree, Everything{}, 15));  // what was chosen is not the set to go on from
  std::vector<std::uint64_t> all;
  for (std::uint32_t a = 0; a < 6; ++a) {
    for (std::uint32_t b = a + 1; b < 6; ++b) all.push_back(pair_key(a, b));
  }
  pairs.choose(all, true);
  tree.remove(5);
  pairs.mark_removed(5);
  EXPECT_TRUE(pairs.update(tree, Everything{}, 15));
  EXPECT_EQ(pairs.keys().size(), 10u);
  EXPECT_FALSE(pairs.update(tree, Everything{}, 9));  // a lower budget alone
}

TYPED_TEST(BroadphasePairs, AClearedTreeAndPairSetStartAfresh) {
  using S = TypeParam;
  AabbTree<S> tree;
  PairSet<S> pairs;
  const Aabb<S> box = {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}};
  for (std::uint32_t round = 0; round < 3; ++round) {
    for (std::uint32_t i = 0; i < 5; ++i) {
      tree.insert(i + round, box);
      pairs.mark_moved(i + round);
    }
    pairs.update(tree, Everything{});
    EXPECT_EQ(pairs.keys().size(), 10u);
    EXPECT_EQ(tree.size(), 5u);
    tree.clear();
    pairs.clear();
    EXPECT_TRUE(tree.validate());
    EXPECT_TRUE(pairs.keys().empty());
    EXPECT_EQ(tree.height(), 0u);
    EXPECT_TRUE(found(tree, box).empty());
  }
}

TYPED_TEST(BroadphasePairs, AnEmptiedTreeLeavesNoPairs) {
  using S = TypeParam;
  AabbTree<S> tree;
  PairSet<S> pairs;
  pairs.update(tree, Everything{});
  EXPECT_TRUE(pairs.keys().empty());
  const Aabb<S> box = {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}};
  for (std::uint32_t i = 0; i < 6; ++i) {
    tree.insert(i, box);
    pairs.mark_moved(i);
  }
  pairs.update(tree, Everything{});
  EXPECT_EQ(pairs.keys().size(), 15u);
  for (std::uint32_t i = 0; i < 6; ++i) {
    tree.remove(i);
    pairs.mark_removed(i);
    EXPECT_TRUE(tree.validate());
  }
  pairs.update(tree, Everything{});
  EXPECT_TRUE(pairs.keys().empty());
}

}  // namespace broadphase_pairs_test
}  // namespace isostep::test
