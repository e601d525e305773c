// That no number of a coarse structure leaves its format with boxes up to the edge of the world: numbers that trap.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/book/bsp_tree.inl"
#include "isostep/book/cell_grid.inl"
#include "isostep/book/cell_tree.inl"
#include "isostep/book/hierarchy.inl"
#include "isostep/book/sphere_tree.inl"
#include "isostep/book/sweep_and_prune.inl"
#include "isostep/collision/broadphase/pairs.inl"
#include "isostep/collision/broadphase/tree.inl"
#include "isostep/store/chosen_broad_phase.hpp"
#include "unit/collision/broadphase_model.hpp"

namespace isostep::test {
namespace coarse_range_test {

/// Corners and ends at random multiples of a sixteenth of the farthest coordinate, and boxes of a metre among them.
template <class S> Aabb<S> drawn_to_the_edge(Pcg32& random) {
  const S part = Limits<S>::position() * S(0.25);
  Vec3<S> low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = random_between(random, -16, 16);
    const int b = random_between(random, -16, 16);
    low[axis] = part * S(min(a, b));
    high[axis] = part * S(max(a, b));
  }
  const std::uint32_t kind = random_below(random, 3);
  if (kind != 0) high = min(low + Vec3<S>{S(1), S(1), S(1)}, high);
  return {low, high};
}

template <class S, class Structure> void hold_to_the_edge(const char* name) {
  constexpr std::uint32_t kSlots = 60;
  Pcg32 random = Pcg32::seeded(61);
  Model<S> model;
  model.slots.resize(kSlots);
  Structure structure;
  AllPairs<S> pairs;
  std::size_t found_pairs = 0, touched = 0;
  for (int frame = 0; frame < 60; ++frame) {
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
      const std::uint32_t what = random_below(random, 4);
      if (frame != 0 && what != 0) continue;
      const Aabb<S> box = drawn_to_the_edge<S>(random);
      if (model.slots[slot].present) structure.update(slot, box);
      else structure.insert(slot, box);
      model.slots[slot].present = true;
      model.slots[slot].box = box;
    }
    if (frame % 2 == 0) structure.optimise();
    all_pairs(structure, pairs);
    ASSERT_EQ(pairs.keys, model.brute_force()) << name;
    found_pairs += pairs.keys.size();
    for (int i = 0; i < 4; ++i) {  // a sweep's ends are within the position limit, its way within twice that
      const S part = Limits<S>::position() * S(0.0625);
      const Vec3<S> origin = random_point<S>(random, 64) * part, target = random_point<S>(random, 64) * part;
      std::vector<std::uint32_t> slots;
      structure.sweep({origin, target - origin, {S(1), S(1), S(1)}, Unit<S>(1)}, AllTouched<S>{&slots});
      touched += slots.size();
    }
  }
  EXPECT_GT(found_pairs, 1000u) << name;
  EXPECT_GT(touched, 200u) << name;
}

TEST(BroadPhaseRange, NoStructureLeavesTheFormatUpToTheEdgeOfTheWorld) {
  using Narrow = Fixed<std::int32_t, 16, Overflow::trap>;
  using Wide = Fixed<std::int64_t, 32, Overflow::trap>;
#define ISO_HOLD(name, Structure)                     \
  hold_to_the_edge<Narrow, Structure<Narrow>>(#name); \
  hold_to_the_edge<Wide, Structure<Wide>>(#name);
  ISO_FOR_EACH_BROAD_PHASE(ISO_HOLD)
#undef ISO_HOLD
}

}  // namespace coarse_range_test
}  // namespace isostep::test
