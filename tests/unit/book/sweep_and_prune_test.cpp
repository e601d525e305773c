// Sweep and prune: the axis is the one along which boxes are spread, and boxes that move a little keep their places.
// SPDX-License-Identifier: MIT
#include "isostep/book/sweep_and_prune.hpp"

#include "unit/collision/broadphase/laws.hpp"

namespace isostep::test {

INSTANTIATE_TYPED_TEST_SUITE_P(SweepAndPrune, CoarseStructure, EveryScalar<SweepAndPrune>);

namespace sweep_and_prune_test {

template <class S> class SweepAndPrunes : public testing::Test {};
TYPED_TEST_SUITE(SweepAndPrunes, BroadphaseScalars);

TYPED_TEST(SweepAndPrunes, TheListRunsAlongTheAxisOfGreatestSpread) {
  using S = TypeParam;
  for (int axis = 0; axis < 3; ++axis) {
    Beside<SweepAndPrune<S>, S> beside;
    beside.model.slots.resize(200);
    for (std::uint32_t i = 0; i < 200; ++i) {
      Vec3<S> low = {S(i % 5), S(i % 3), S(i % 4)};
      low[axis] = S(i);
      beside.set(i, {low, low + Vec3<S>{S(1), S(1), S(1)}});
    }
    beside.structure.optimise();
    EXPECT_EQ(beside.structure.axis(), axis);
    EXPECT_EQ(beside.structure.sorted(), 200u);
    all_pairs(beside.structure, beside.all);
    EXPECT_EQ(beside.all.keys, beside.model.brute_force());
    EXPECT_GT(beside.all.keys.size(), 20u);
  }
}

TYPED_TEST(SweepAndPrunes, BoxesMoveWithinTheListAndThoseThatLeapWaitBehindIt) {
  using S = TypeParam;
  Beside<SweepAndPrune<S>, S> beside;
  beside.model.slots.resize(400);
  for (std::uint32_t i = 0; i < 400; ++i) beside.set(i, {{S(i), S(0), S(0)}, {S(i) + S(2), S(1), S(1)}});
  beside.structure.optimise();
  EXPECT_EQ(beside.structure.sorted(), 400u);
  const auto move = [&](std::uint32_t slot, int by) {
    const Aabb<S> box = beside.model.slots[slot].box;
    beside.set(slot, {box.low + Vec3<S>{S(by), S(0), S(0)}, box.high + Vec3<S>{S(by), S(0), S(0)}});
    ASSERT_TRUE(beside.structure.validate());
    all_pairs(beside.structure, beside.all);
    ASSERT_EQ(beside.all.keys, beside.model.brute_force());
  };
  move(100, 30);
  move(200, -30);
  move(0, 10);
  move(399, -10);
  EXPECT_EQ(beside.structure.sorted(), 400u);
  move(100, 200);
  move(300, -250);
  move(1, 398);
  EXPECT_EQ(beside.structure.sorted(), 397u);
  for (const std::uint32_t slot : {5u, 100u, 300u}) beside.remove(slot);
  EXPECT_EQ(beside.structure.sorted(), 396u);
  beside.structure.optimise();
  EXPECT_EQ(beside.structure.sorted(), 397u);
  move(7, 1);
}

}  // namespace sweep_and_prune_test
}  // namespace isostep::test
