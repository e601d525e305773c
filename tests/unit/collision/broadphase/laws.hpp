// The laws of every coarse structure, for every scalar: it finds what brute force finds.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "isostep/collision/broadphase/broad_phase.hpp"
#include "sample.hpp"
#include "unit/collision/broadphase/scenes.hpp"
#include "unit/collision/broadphase_model.hpp"

namespace isostep::test {

/// A structure for one scalar.
template <class B, class ScalarOf> struct CoarseCase {
  using Structure = B;
  using S = ScalarOf;
};
template <template <class> class Structure>
using EveryScalar = testing::Types<CoarseCase<Structure<float>, float>, CoarseCase<Structure<double>, double>,
                                   CoarseCase<Structure<Q16_16>, Q16_16>, CoarseCase<Structure<Q32_32>, Q32_32>>;

/// A structure beside the boxes that it should hold, and pairs that are kept from frame to frame.
template <class B, class S> struct Beside {
  Model<S> model;
  B structure;
  PairSet<S> pairs;
  AllPairs<S> all;

  void set(std::uint32_t slot, const Aabb<S>& box) {
    typename Model<S>::Slot& s = model.slots[slot];
    if (s.present && s.box == box) return;
    if (s.present) structure.update(slot, box);
    else structure.insert(slot, box);
    s.present = true;
    s.box = box;
    pairs.mark_moved(slot);
  }
  void remove(std::uint32_t slot) {
    if (!model.slots[slot].present) return;
    model.slots[slot].present = false;
    structure.remove(slot);
    pairs.mark_removed(slot);
  }
  std::vector<std::uint32_t> found(const Aabb<S>& box) const {
    std::vector<std::uint32_t> slots;
    structure.query(box, Collect{&slots});
    std::sort(slots.begin(), slots.end());
    return slots;
  }
  std::uint32_t count() const {
    return static_cast<std::uint32_t>(
        std::count_if(model.slots.begin(), model.slots.end(), [](const auto& s) { return s.present; }));
  }
};

template <class Case> class CoarseStructure : public testing::Test {
 protected:
  using Scalar = typename Case::S;
  using Structure = typename Case::Structure;

  /// Oracle O29: a thousand frames of a scene, each of whose pairs are those of brute force, in the same order.
  void hold_frames_of(CoarseScene scene) {
    Pcg32 random = Pcg32::seeded(29, static_cast<std::uint64_t>(scene));
    Beside<Structure, Scalar> beside;
    beside.model.slots.resize(kSceneSlots);
    std::vector<Body<Scalar>> bodies(kSceneSlots);
    std::uint64_t pairs = 0, changes = 0;
    const int frames = sampled(1000, 250);
    for (int frame = 0; frame < frames; ++frame) {
      const std::vector<std::uint64_t> before = beside.all.keys;
      advance(random, scene, frame, bodies);
      for (std::uint32_t slot = 0; slot < kSceneSlots; ++slot) {
        if (bodies[slot].present) beside.set(slot, bodies[slot].box);
        else beside.remove(slot);
      }
      if (frame % 3 != 0) beside.structure.optimise();
      ASSERT_TRUE(frame % 8 != 0 || beside.structure.validate()) << "frame " << frame;
      const std::vector<std::uint64_t> expected = beside.model.brute_force();
      all_pairs(beside.structure, beside.all);
      ASSERT_EQ(beside.all.keys, expected) << "frame " << frame;
      beside.pairs.update(beside.structure, Everything{});
      ASSERT_EQ(beside.pairs.keys(), expected) << "frame " << frame;
      ASSERT_EQ(beside.structure.size(), beside.count());
      pairs += expected.size();
      changes += before == expected ? 0u : 1u;
    }
    EXPECT_GT(pairs, 10u * static_cast<unsigned>(frames));
    EXPECT_GT(changes, static_cast<unsigned>(frames) / 2u);  // others in every second
  }
};
TYPED_TEST_SUITE_P(CoarseStructure);

TYPED_TEST_P(CoarseStructure, PairsOfBoxesThatAreSpreadAreThoseOfBruteForce) {
  this->hold_frames_of(CoarseScene::spread);
}
TYPED_TEST_P(CoarseStructure, PairsOfClustersAreThoseOfBruteForce) { this->hold_frames_of(CoarseScene::clustered); }
TYPED_TEST_P(CoarseStructure, PairsOfMixedSizesAreThoseOfBruteForce) { this->hold_frames_of(CoarseScene::mixed); }
TYPED_TEST_P(CoarseStructure, PairsOfMovingBoxesAreThoseOfBruteForce) { this->hold_frames_of(CoarseScene::moving); }
TYPED_TEST_P(CoarseStructure, PairsOfBoxesThatComeAndGoAreThoseOfBruteForce) {
  this->hold_frames_of(CoarseScene::come_and_go);
}

TYPED_TEST_P(CoarseStructure, SatisfiesTheConcept) {
  EXPECT_TRUE((BroadPhase<typename TypeParam::Structure, typename TypeParam::S>));
}

TYPED_TEST_P(CoarseStructure, QueriesFindWhatBruteForceFindsOptimisedOrNot) {
  using S = typename TypeParam::S;
  Pcg32 random = Pcg32::seeded(30);
  Beside<typename TypeParam::Structure, S> beside;
  beside.model.slots.resize(150);
  std::size_t hits = 0;
  for (int step = 0; step < 150; ++step) {
    for (int i = 0; i < 25; ++i) {
      const std::uint32_t slot = random_below(random, 150);
      const std::uint32_t what = random_below(random, 5);
      Aabb<S> box = random_box<S>(random, 24);
      if (what == 4) box.high += Vec3<S>{S(9), S(0.5), S(14)};
      if (what == 0) beside.remove(slot);
      else beside.set(slot, box);
    }
    if (step % 4 == 3) beside.structure.optimise();
    ASSERT_TRUE(beside.structure.validate()) << "step " << step;
    for (int i = 0; i < 10; ++i) {
      Aabb<S> box = random_box<S>(random, 24);
      if (i % 3 == 0) box.high += Vec3<S>{S(2), S(3), S(1)};
      if (i == 9) box = {{S(-50), S(-50), S(-50)}, {S(50), S(50), S(50)}};
      const std::vector<std::uint32_t> expected = found(beside.model, box);
      ASSERT_EQ(beside.found(box), expected) << "step " << step;
      hits += expected.size();
    }
    for (std::uint32_t slot = 0; slot < 150; ++slot) {
      ASSERT_EQ(beside.structure.contains(slot), beside.model.slots[slot].present);
      if (!beside.structure.contains(slot)) continue;
      ASSERT_EQ(beside.structure.box(slot), beside.model.slots[slot].box);
    }
  }
  EXPECT_GT(hits, 10000u);
}

TYPED_TEST_P(CoarseStructure, SweepsVisitEveryTouchedBoxOnceAndFindTheNearest) {
  using S = typename TypeParam::S;
  Pcg32 random = Pcg32::seeded(31);
  Beside<typename TypeParam::Structure, S> beside;
  beside.model.slots.resize(400);
  for (std::uint32_t i = 0; i < 400; ++i) beside.set(i, random_box<S>(random, 40));
  beside.set(7, {{S(-60), S(-2), S(-60)}, {S(60), S(-1), S(60)}});
  beside.structure.optimise();
  int touched = 0, visited = 0, visited_for_nearest = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3<S> origin = random_point<S>(random, 44);
    Vec3<S> displacement = random_point<S>(random, 80);
    if (i % 5 == 0) displacement[i % 3] = S(0);
    if (i % 25 == 0) displacement = Vec3<S>::zero();
    const S half = i % 2 == 0 ? S(0) : S(0.5);
    const Sweep<S> sweep = {origin, displacement, {half, half, half}, i % 4 == 3 ? Unit<S>(0.5) : Unit<S>(1)};
    std::vector<std::uint32_t> slots;
    beside.structure.sweep(sweep, AllTouched<S>{&slots});
    visited += static_cast<int>(slots.size());
    std::sort(slots.begin(), slots.end());
    ASSERT_TRUE(std::adjacent_find(slots.begin(), slots.end()) == slots.end()) << "sweep " << i << " visits one twice";
    double nearest = 2;
    for (std::uint32_t slot = 0; slot < 400; ++slot) {
      const double at = entry(sweep, beside.model.slots[slot].box);
      nearest = std::min(nearest, at);
      if (at > 1) continue;
      ++touched;
      ASSERT_TRUE(std::binary_search(slots.begin(), slots.end(), slot)) << "sweep " << i << " misses " << slot;
    }
    double best = 2;
    beside.structure.sweep(sweep, Nearest<S>{&beside.model, &sweep, &best, &visited_for_nearest});
    ASSERT_EQ(best, nearest) << "sweep " << i;
  }
  EXPECT_GT(touched, 300);
  EXPECT_LE(visited, touched + touched / 50);  // the slack shows few boxes that are not touched
  EXPECT_LT(visited_for_nearest, visited);     // and a hit hides what lies behind it
}

TYPED_TEST_P(CoarseStructure, PairsOfSomeAreThoseOfBruteForceAndABudgetEndsTheSearch) {
  using S = typename TypeParam::S;
  Pcg32 random = Pcg32::seeded(32);
  Beside<typename TypeParam::Structure, S> beside;
  beside.model.slots.resize(120);
  for (std::uint32_t i = 0; i < 110; ++i) beside.set(i, random_box<S>(random, 14));
  const std::vector<std::uint32_t> slots = {3, 119, 50, 51, 7};  // 119 is not there
  std::vector<std::uint64_t> visited, expected;
  const auto take = [&](std::uint32_t slot, std::uint32_t other) {
    visited.push_back(std::uint64_t{slot} << 32 | other);
  };
  typename TypeParam::Structure::Matches matches;
  EXPECT_TRUE(beside.structure.overlapping_pairs_of(slots, matches, ~std::uint64_t{0}, take));
  for (const std::uint32_t slot : slots) {
    if (!beside.model.slots[slot].present) continue;
    for (const std::uint32_t other : found(beside.model, beside.model.slots[slot].box))
      expected.push_back(std::uint64_t{slot} << 32 | other);
  }
  std::sort(visited.begin(), visited.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(visited, expected);
  EXPECT_GT(expected.size(), 5u);
  visited.clear();
  EXPECT_FALSE(beside.structure.overlapping_pairs_of(slots, matches, 2, take));
  EXPECT_LE(visited.size(), 2u);
  visited.clear();
  EXPECT_FALSE(beside.structure.overlapping_pairs(matches, 3, take));
  EXPECT_LE(visited.size(), 3u);
}

TYPED_TEST_P(CoarseStructure, BoxesThatTouchOverlapAndBoxesARoundingStepApartDoNot) {
  using S = typename TypeParam::S;
  for (const bool optimised : {false, true}) {
    Beside<typename TypeParam::Structure, S> beside;
    beside.model.slots.resize(10);
    beside.set(4, {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}});
    beside.set(2, {{S(1), S(0), S(0)}, {S(2), S(1), S(1)}});
    beside.set(9, {{S(0), S(1) + resolution<S>(), S(0)}, {S(1), S(2), S(1)}});
    beside.set(1, {{S(0), S(-1), S(0)}, {S(1), -S(0), S(1)}});  // in float negative zero, which zero touches
    beside.set(0, {{S(1), S(1), S(1)}, {S(1), S(1), S(1)}});    // a point
    if (optimised) beside.structure.optimise();
    all_pairs(beside.structure, beside.all);
    EXPECT_EQ(beside.all.keys, beside.model.brute_force());
    const std::vector<std::uint64_t> expected = {pair_key(0, 2), pair_key(0, 4), pair_key(1, 2), pair_key(1, 4),
                                                 pair_key(2, 4)};
    EXPECT_EQ(beside.all.keys, expected);
  }
}

TYPED_TEST_P(CoarseStructure, BoxesAtFourTimesThePositionLimitAreHandledLikeOthers) {
  using S = typename TypeParam::S;
  const S far_out = Limits<S>::position() * S(4);
  Pcg32 random = Pcg32::seeded(33);
  Beside<typename TypeParam::Structure, S> beside;
  beside.model.slots.resize(80);
  for (int round = 0; round < 4; ++round) {
    for (std::uint32_t i = 0; i < 80; ++i) {
      Aabb<S> box = random_box<S>(random, 12);
      const std::uint32_t kind = (i + static_cast<std::uint32_t>(round) * 3u) % 20u;
      if (kind == 0) box = {{-far_out, -far_out, -far_out}, {far_out, S(0), far_out}};
      if (kind == 1) box = {{far_out - S(1), S(-1), far_out - S(1)}, {far_out, S(1), far_out}};
      if (kind == 2) box = {{-far_out, -far_out, -far_out}, {-far_out, -far_out, -far_out}};
      beside.set(i, box);
    }
    if (round % 2 == 0) beside.structure.optimise();
    ASSERT_TRUE(beside.structure.validate());
    all_pairs(beside.structure, beside.all);
    EXPECT_EQ(beside.all.keys, beside.model.brute_force());
    const Aabb<S> world = {{-far_out, -far_out, -far_out}, {far_out, far_out, far_out}};
    EXPECT_EQ(beside.found(world).size(), 80u);
    const Sweep<S> sweep = {{S(0), S(100), S(0)}, {S(0), S(-200), S(0)}, Vec3<S>::zero(), Unit<S>(1)};
    std::vector<std::uint32_t> slots;
    beside.structure.sweep(sweep, AllTouched<S>{&slots});
    EXPECT_GE(slots.size(), 4u);  // the four that fill the lower half of the world
  }
}

TYPED_TEST_P(CoarseStructure, AVisitorThatSaysNoSeesNoFurtherBox) {
  using S = typename TypeParam::S;
  struct First {
    int* seen;
    bool operator()(std::uint32_t) const { return ++*seen < 3; }
  };
  typename TypeParam::Structure structure;
  const Aabb<S> box = {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}};
  for (std::uint32_t i = 0; i < 200; ++i) structure.insert(i, box);
  for (int round = 0; round < 2; ++round, structure.optimise()) {
    int seen = 0;
    structure.query(box, First{&seen});
    EXPECT_EQ(seen, 3);
  }
}

TYPED_TEST_P(CoarseStructure, AnEmptyOrClearedOrEmptiedStructureFindsNothingAndStartsAfresh) {
  using S = typename TypeParam::S;
  Beside<typename TypeParam::Structure, S> beside;
  const Aabb<S> box = {{S(0), S(0), S(0)}, {S(1), S(1), S(1)}};
  const Sweep<S> sweep = {Vec3<S>::zero(), {S(1), S(1), S(1)}, Vec3<S>::zero(), Unit<S>(1)};
  for (std::uint32_t round = 0; round < 4; ++round) {
    std::vector<std::uint32_t> slots;
    beside.structure.sweep(sweep, AllTouched<S>{&slots});
    EXPECT_TRUE(slots.empty());
    EXPECT_TRUE(beside.found(box).empty());
    beside.structure.optimise();
    all_pairs(beside.structure, beside.all);
    EXPECT_TRUE(beside.all.keys.empty());
    EXPECT_EQ(beside.structure.size(), 0u);
    EXPECT_TRUE(beside.structure.validate());
    for (std::uint32_t i = 0; i < 40; ++i) beside.structure.insert(i + round, box);
    beside.structure.optimise();
    all_pairs(beside.structure, beside.all);
    EXPECT_EQ(beside.all.keys.size(), 40u * 39u / 2u);
    if (round % 2 == 0) beside.structure.clear();
    for (std::uint32_t i = 0; i < 40 && round % 2 != 0; ++i) beside.structure.remove(i + round);
  }
}

REGISTER_TYPED_TEST_SUITE_P(CoarseStructure, PairsOfBoxesThatAreSpreadAreThoseOfBruteForce,
                            PairsOfClustersAreThoseOfBruteForce, PairsOfMixedSizesAreThoseOfBruteForce,
                            PairsOfMovingBoxesAreThoseOfBruteForce, PairsOfBoxesThatComeAndGoAreThoseOfBruteForce,
                            SatisfiesTheConcept, QueriesFindWhatBruteForceFindsOptimisedOrNot,
                            SweepsVisitEveryTouchedBoxOnceAndFindTheNearest,
                            PairsOfSomeAreThoseOfBruteForceAndABudgetEndsTheSearch,
                            BoxesThatTouchOverlapAndBoxesARoundingStepApartDoNot,
                            BoxesAtFourTimesThePositionLimitAreHandledLikeOthers, AVisitorThatSaysNoSeesNoFurtherBox,
                            AnEmptyOrClearedOrEmptiedStructureFindsNothingAndStartsAfresh);

}  // namespace isostep::test
