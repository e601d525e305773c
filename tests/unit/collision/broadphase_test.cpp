// AabbTree and PairSet against brute force, whatever happened before.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/random.hpp"
#include "isostep/geometry/limits.hpp"

namespace isostep {
namespace {

template <class S> class Broadphase : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Broadphase, Scalars);

/// A whole number of quarters, so that every scalar holds the same boxes and boxes often touch exactly.
template <class S> S quarters(Pcg32& random, int low, int high) {
  return S(random_between(random, low, high)) * S(0.25);
}
template <class S> Vec3<S> random_point(Pcg32& random, int reach) {
  const S x = quarters<S>(random, -reach, reach);
  const S y = quarters<S>(random, -reach, reach);
  const S z = quarters<S>(random, -reach, reach);
  return {x, y, z};
}
template <class S> Aabb<S> random_box(Pcg32& random, int reach) {
  const Vec3<S> low = random_point<S>(random, reach);
  const S x = quarters<S>(random, 0, 6);
  const S y = quarters<S>(random, 0, 6);
  const S z = quarters<S>(random, 0, 6);
  return {low, low + Vec3<S>{x, y, z}};
}

/// Boxes by slot, and what a filter says of each.
template <class S> struct Model {
  struct Slot {
    bool present = false;
    bool movable = true;
    std::uint32_t group = 0;
    Aabb<S> box{};
  };
  std::vector<Slot> slots;

  bool may_collide(std::uint32_t a, std::uint32_t b) const {
    if (!slots[a].movable && !slots[b].movable) return false;
    return slots[a].group == 0 || slots[a].group != slots[b].group;
  }
  std::vector<std::uint64_t> brute_force() const {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t a = 0; a < slots.size(); ++a) {
      for (std::uint32_t b = a + 1; b < slots.size(); ++b) {
        if (!slots[a].present || !slots[b].present || !may_collide(a, b)) continue;
        if (overlap(slots[a].box, slots[b].box)) keys.push_back(std::uint64_t{a} << 32 | b);
      }
    }
    return keys;
  }
};
template <class S> struct Filter {
  const Model<S>* model;
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    EXPECT_LT(a, b);
    return model->may_collide(a, b);
  }
};
struct Everything {
  bool operator()(std::uint32_t, std::uint32_t) const { return true; }
};

struct Collect {
  std::vector<std::uint32_t>* slots;
  bool operator()(std::uint32_t slot) const {
    slots->push_back(slot);
    return true;
  }
};
template <class S> std::vector<std::uint32_t> found(const AabbTree<S>& tree, const Aabb<S>& box) {
  std::vector<std::uint32_t> slots;
  tree.query(box, Collect{&slots});
  std::sort(slots.begin(), slots.end());
  return slots;
}
template <class S> std::vector<std::uint32_t> found(const Model<S>& model, const Aabb<S>& box) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < model.slots.size(); ++i) {
    if (model.slots[i].present && overlap(model.slots[i].box, box)) slots.push_back(i);
  }
  return slots;
}

/// One random insertion, removal, move or change of filter, done to model, tree and pairs alike.
template <class S> void churn(Pcg32& random, Model<S>& model, AabbTree<S>& tree, PairSet<S>& pairs, int reach) {
  const std::uint32_t slot = random_below(random, static_cast<std::uint32_t>(model.slots.size()));
  typename Model<S>::Slot& s = model.slots[slot];
  const std::uint32_t what = random_below(random, 10);
  if (!s.present) {
    s = {true, what < 7, what % 3, random_box<S>(random, reach)};
    tree.insert(slot, s.box);
    pairs.mark_moved(slot);
  } else if (what < 2) {
    s.present = false;
    tree.remove(slot);
    pairs.mark_removed(slot);
  } else if (what < 4) {
    s.group = random_below(random, 3);
    s.movable = what == 2;
    pairs.mark_moved(slot);
  } else {
    const Vec3<S> by = random_point<S>(random, what == 9 ? 30 : 2);  // a nudge, or a leap
    s.box = what == 8 ? random_box<S>(random, reach) : Aabb<S>{s.box.low + by, s.box.high + by};
    tree.update(slot, s.box);
    pairs.mark_moved(slot);
  }
}

TYPED_TEST(Broadphase, ThousandsOfRandomChangesLeaveThePairsOfBruteForce) {
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

TYPED_TEST(Broadphase, PairsDoNotDependOnHowTheTreeCameAbout) {
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

TYPED_TEST(Broadphase, QueriesFindWhatBruteForceFindsOptimisedOrNot) {
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

TYPED_TEST(Broadphase, AVisitorThatSaysNoSeesNoFurtherLeaf) {
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

TYPED_TEST(Broadphase, BoxesThatTouchArePairsAndBoxesARoundingStepApartAreNot) {
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

TYPED_TEST(Broadphase, ASlotTakenAgainBetweenTwoUpdatesHasThePairsOfItsNewBoxOnly) {
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

TYPED_TEST(Broadphase, SortedAndCoincidentInsertionsStayBelowTheGreatestHeight) {
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

TYPED_TEST(Broadphase, BoxesInOnePlaceMakeNoListOfTheTree) {
  using S = TypeParam;
  AabbTree<S> tree;
  for (std::uint32_t i = 0; i < 1000; ++i) tree.insert(i, {{S(7), S(7), S(7)}, {S(8), S(8), S(8)}});
  EXPECT_LE(tree.height(), 20u);  // twice the least
}

TYPED_TEST(Broadphase, MorePairsThanTheBudgetAreForTheCallerToChooseUntilThereAreFewer) {
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

TYPED_TEST(Broadphase, BoxesThatShrinkTowardsAPointInPowersOfTwoStayBelowTheGreatestHeight) {
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

TYPED_TEST(Broadphase, BoxesAtFourTimesThePositionLimitAreHandledLikeOthers) {
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

/// The fraction at which a segment enters a box grown by `half`, by slabs in double, or 2 for a miss.
template <class S> double entry(const Sweep<S>& sweep, const Aabb<S>& box) {
  double from = 0;
  double to = to_double(sweep.max_fraction);
  for (int i = 0; i < 3; ++i) {
    const double o = to_double(sweep.origin[i]);
    const double d = to_double(sweep.displacement[i]);
    const double low = to_double(box.low[i]) - to_double(sweep.half[i]);
    const double high = to_double(box.high[i]) + to_double(sweep.half[i]);
    if (d == 0) {
      if (o < low || o > high) return 2;
      continue;
    }
    from = std::max(from, std::min((low - o) / d, (high - o) / d));
    to = std::min(to, std::max((low - o) / d, (high - o) / d));
  }
  return from <= to ? from : 2;
}

template <class S> struct AllTouched {
  std::vector<std::uint32_t>* slots;
  Unit<S> operator()(std::uint32_t slot, Unit<S> fraction) const {
    slots->push_back(slot);
    return fraction;
  }
};
template <class S> struct Nearest {
  const Model<S>* model;
  const Sweep<S>* sweep;
  double* best;
  int* visits;
  Unit<S> operator()(std::uint32_t slot, Unit<S> fraction) const {
    ++*visits;
    const double at = entry(*sweep, model->slots[slot].box);
    if (at >= *best) return fraction;
    *best = at;
    return from_double<Unit<S>>(at);
  }
};

TYPED_TEST(Broadphase, SweepsVisitEveryTouchedBoxAndFindTheNearest) {
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

TYPED_TEST(Broadphase, AClearedTreeAndPairSetStartAfresh) {
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

TYPED_TEST(Broadphase, AnEmptiedTreeLeavesNoPairs) {
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

}  // namespace
}  // namespace isostep
