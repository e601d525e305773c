// The BSP tree: planes are chosen, boxes cross them, and what lies across one is found from both sides.
// SPDX-License-Identifier: MIT
#include "isostep/book/bsp_tree.hpp"

#include "unit/collision/broadphase/laws.hpp"

namespace isostep::test {

INSTANTIATE_TYPED_TEST_SUITE_P(BspTree, CoarseStructure, EveryScalar<BspTree>);

namespace bsp_tree_test {

template <class S> class BspTrees : public testing::Test {};
TYPED_TEST_SUITE(BspTrees, BroadphaseScalars);

TYPED_TEST(BspTrees, PlanesDivideWhatIsApartAndNotWhatIsInOnePlace) {
  using S = TypeParam;
  BspTree<S> tree;
  for (int i = 0; i < 256; ++i) tree.insert(static_cast<std::uint32_t>(i), {{S(i), S(0), S(0)}, {S(i), S(1), S(1)}});
  EXPECT_EQ(tree.planes(), 0u);
  tree.optimise();
  EXPECT_TRUE(tree.validate());
  EXPECT_EQ(tree.planes(), 15u);  // 16 leaves of 16 boxes
  tree.clear();
  for (std::uint32_t i = 0; i < 256; ++i) tree.insert(i, {{S(7), S(7), S(7)}, {S(8), S(8), S(8)}});
  tree.optimise();
  EXPECT_TRUE(tree.validate());
  EXPECT_EQ(tree.planes(), 0u);
}

TYPED_TEST(BspTrees, BoxesThatCrossPlanesAreFoundOnTheirWay) {
  using S = TypeParam;
  Beside<BspTree<S>, S> beside;
  beside.model.slots.resize(131);
  for (int i = 0; i < 130; ++i)
    beside.set(static_cast<std::uint32_t>(i), {{S(i), S(0), S(0)}, {S(i) + S(0.5), S(1), S(1)}});
  beside.structure.optimise();
  EXPECT_GT(beside.structure.planes(), 6u);
  for (int at = 0; at < 519; ++at) {
    const S low = S(at) * S(0.25);
    beside.set(130, {{low, S(1), S(1)}, {low + S(1), S(2), S(2)}});
    ASSERT_TRUE(beside.structure.validate());
    all_pairs(beside.structure, beside.all);
    ASSERT_EQ(beside.all.keys, beside.model.brute_force());
    ASSERT_GE(beside.all.keys.size(), 1u);
  }
}

}  // namespace bsp_tree_test
}  // namespace isostep::test
