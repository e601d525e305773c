// The tree of boxes: what queries and sweeps find in it, against brute force, and how high it grows.
// SPDX-License-Identifier: MIT
#include "unit/collision/broadphase_model.hpp"

namespace isostep::test {
namespace broadphase_tree_test {

template <class S> class BroadphaseTree : public testing::Test {};
TYPED_TEST_SUITE(BroadphaseTree, BroadphaseScalars);

TYPED_TEST(BroadphaseTree, QueriesFindWhatBruteForceFindsOptimisedOrNot) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(13);
  Model<S> model;
  model.slots.resize(120);
  AabbTree<S> tree;
  PairSet<S> pairs;
  for (int step = 0; step < 200; ++step) {
    for (int i = 0; i < 15; ++i) churn(random, model, tree, pairs, 20);
    if (step % 4 == 3) tree.optimise();
    if (step % 50 == 49) tree.rebuild();
    ASSERT_TRUE(tree.validate());
    for (int i = 0; i < 10; ++i) {
      Aabb<S> box = random_box<S>(random, 20);
      box.high += Vec3<S>{S(2), S(3), S(1)};
      ASSERT_EQ(found(tree, box), found(model, box));
    }
    for (std::uint32_t i = 0; i < 120; ++i) {
      ASSERT_EQ(tree.contains(i), model.slots[i].present);
      if (!tree.contains(i)) continue;
      ASSERT_EQ(tree.box(i), model.slots[i].box);
    }
  }
}

TYPED_TEST(BroadphaseTree, AVisitorThatSaysNoSeesNoFurtherLeaf) {
  using S = TypeParam;
  struct First {
    int* seen;
    bool operator()(std::uint32_t) const { return ++*seen < 3; }
  };
  AabbTree<S> tree;
  const Aabb<S> box = {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}};
  for (std::uint32_t i = 0; i < 20; ++i) tree.insert(i, box);
  int seen = 0;
  tree.query(box, First{&seen});
  EXPECT_EQ(seen, 3);
}

TYPED_TEST(BroadphaseTree, SortedAndCoincidentInsertionsStayBelowTheGreatestHeight) {
  using S = TypeParam;
  AabbTree<S> tree;
  for (int i = 0; i < 400; ++i) {
    tree.insert(static_cast<std::uint32_t>(i), {{S(i), S(0), S(0)}, {S(i + 1), S(1), S(1)}});
    ASSERT_LE(tree.height(), AabbTree<S>::kMaxHeight);
  }
  for (std::uint32_t i = 400; i < 800; ++i) {
    tree.insert(i, {{S(7), S(7), S(7)}, {S(8), S(8), S(8)}});
    ASSERT_LE(tree.height(), AabbTree<S>::kMaxHeight);
  }
  ASSERT_TRUE(tree.validate());
  EXPECT_EQ(tree.size(), 800u);
  tree.rebuild();
  ASSERT_TRUE(tree.validate());
  EXPECT_EQ(found(tree, Aabb<S>{{S(7), S(7), S(7)}, {S(8), S(8), S(8)}}).size(), 400u);
  EXPECT_EQ(found(tree, Aabb<S>{{S(100), S(0), S(0)}, {S(101), S(1), S(1)}}),
            (std::vector<std::uint32_t>{99, 100, 101}));
}

TYPED_TEST(BroadphaseTree, BoxesInOnePlaceMakeNoListOfTheTree) {
  using S = TypeParam;
  AabbTree<S> tree;
  for (std::uint32_t i = 0; i < 1000; ++i) tree.insert(i, {{S(7), S(7), S(7)}, {S(8), S(8), S(8)}});
  EXPECT_LE(tree.height(), 20u);  // twice the least
}

TYPED_TEST(BroadphaseTree, BoxesThatShrinkTowardsAPointInPowersOfTwoStayBelowTheGreatestHeight) {
  using S = TypeParam;
  AabbTree<S> tree;
  S at = S(256);
  for (std::uint32_t i = 0; i < 120; ++i, at = at * S(0.5)) {
    for (std::uint32_t k = 0; k < 6; ++k) {
      Vec3<S> corner = Vec3<S>::zero();
      corner[static_cast<int>(k % 3)] = k < 3 ? at : -at;
      tree.insert(i * 6 + k, {corner, corner});
    }
  }
  tree.rebuild();
  EXPECT_LE(tree.height(), AabbTree<S>::kMaxHeight);
  EXPECT_TRUE(tree.validate());
}

TYPED_TEST(BroadphaseTree, BoxesAtFourTimesThePositionLimitAreHandledLikeOthers) {
  using S = TypeParam;
  const S far_out = Limits<S>::position() * S(4);
  Pcg32 random = Pcg32::seeded(14);
  Model<S> model;
  model.slots.resize(60);
  AabbTree<S> tree;
  PairSet<S> pairs;
  for (std::uint32_t i = 0; i < 60; ++i) {
    Aabb<S> box = random_box<S>(random, 12);
    if (i % 20 == 0) box = {{-far_out, -far_out, -far_out}, {far_out, S(0), far_out}};
    if (i % 20 == 1) box = {{far_out - S(1), S(-1), far_out - S(1)}, {far_out, S(1), far_out}};
    model.slots[i] = {true, true, 0, box};
    tree.insert(i, box);
    pairs.mark_moved(i);
  }
  tree.optimise();
  ASSERT_TRUE(tree.validate());
  pairs.update(tree, Everything{});
  EXPECT_EQ(pairs.keys(), model.brute_force());
}

TYPED_TEST(BroadphaseTree, SweepsVisitEveryTouchedBoxAndFindTheNearest) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(15);
  Model<S> model;
  model.slots.resize(300);
  AabbTree<S> tree;
  for (std::uint32_t i = 0; i < 300; ++i) {
    model.slots[i] = {true, true, 0, random_box<S>(random, 28)};
    tree.insert(i, model.slots[i].box);
  }
  int touched = 0;
  int visited = 0;
  int visited_for_nearest = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3<S> origin = random_point<S>(random, 32);
    Vec3<S> displacement = random_point<S>(random, 60);
    if (i % 5 == 0) displacement[i % 3] = S(0);
    if (i % 25 == 0) displacement = Vec3<S>::zero();
    const S half = i % 2 == 0 ? S(0) : S(0.5);
    const Sweep<S> sweep = {origin, displacement, {half, half, half}, i % 4 == 3 ? Unit<S>(0.5) : Unit<S>(1)};
    std::vector<std::uint32_t> slots;
    tree.sweep(sweep, AllTouched<S>{&slots});
    visited += static_cast<int>(slots.size());
    double nearest = 2;
    for (std::uint32_t slot = 0; slot < 300; ++slot) {
      const double at = entry(sweep, model.slots[slot].box);
      nearest = std::min(nearest, at);
      if (at > 1) continue;
      ++touched;
      EXPECT_EQ(std::count(slots.begin(), slots.end(), slot), 1) << "sweep " << i << " misses " << slot;
    }
    double best = 2;
    tree.sweep(sweep, Nearest<S>{&model, &sweep, &best, &visited_for_nearest});
    EXPECT_EQ(best, nearest) << "sweep " << i;
  }
  EXPECT_GT(touched, 300);
  EXPECT_LE(visited, touched + touched / 50);  // the slack shows few leaves that are not touched
  EXPECT_LT(visited_for_nearest, visited);     // and a hit hides what lies behind it
}

}  // namespace broadphase_tree_test
}  // namespace isostep::test
