// The quad-tree and the oct-tree: cells are divided and joined, and the root grows.
// SPDX-License-Identifier: MIT
#include "isostep/book/cell_tree.hpp"

#include "unit/collision/broadphase/laws.hpp"

namespace isostep::test {

INSTANTIATE_TYPED_TEST_SUITE_P(QuadTree, CoarseStructure, EveryScalar<QuadTree>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctTree, CoarseStructure, EveryScalar<OctTree>);

namespace cell_tree_test {

template <class S> class CellTrees : public testing::Test {};
TYPED_TEST_SUITE(CellTrees, BroadphaseScalars);

template <class Tree, class S> void hold_division(std::uint32_t most_divided) {
  Tree tree;
  std::uint32_t slot = 0;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z) {
        const Vec3<S> low = {S(4 * x), S(4 * y), S(4 * z)};
        tree.insert(slot++, {low, low + Vec3<S>{S(0.5), S(0.5), S(0.5)}});
      }
    }
  }
  EXPECT_TRUE(tree.validate());
  EXPECT_GE(tree.divided(), 16u);  // 512 boxes, and at most 8 in a cell that is not divided
  EXPECT_LE(tree.divided(), most_divided);
  const std::uint32_t cells = tree.divided();
  tree.insert(slot, {{S(200), S(0), S(200)}, {S(400), S(1), S(201)}});  // beyond the root
  EXPECT_TRUE(tree.validate());
  EXPECT_GT(tree.divided(), cells);
  for (std::uint32_t i = 0; i <= slot; ++i) {
    tree.remove(i);
    ASSERT_TRUE(i % 16 != 0 || tree.validate());
  }
  EXPECT_TRUE(tree.validate());
  EXPECT_EQ(tree.divided(), 0u);
}
TYPED_TEST(CellTrees, CellsAreDividedWhereBoxesAreAndJoinedWhenTheyAreGone) {
  hold_division<OctTree<TypeParam>, TypeParam>(200);
  hold_division<QuadTree<TypeParam>, TypeParam>(400);
}

TYPED_TEST(CellTrees, ABoxOnTheBorderOfALargeCellIsInASmallOne) {
  using S = TypeParam;
  OctTree<S> tree;
  for (int i = 0; i < 1024; ++i) {  // side by side: some lie across the border of every cell
    const Vec3<S> low = {S(i) * S(0.25), S(0), S(0)};
    tree.insert(static_cast<std::uint32_t>(i), {low, low + Vec3<S>{S(0.25), S(0.25), S(0.25)}});
  }
  // Were those across borders left with the border, a query would compare them all; here it is cells of a few boxes.
  EXPECT_GE(tree.divided(), 100u);
  AllPairs<S> pairs;
  all_pairs(tree, pairs);
  EXPECT_EQ(pairs.keys.size(), 1023u);
}

}  // namespace cell_tree_test
}  // namespace isostep::test
