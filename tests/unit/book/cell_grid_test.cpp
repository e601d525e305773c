// The grid and the multi-resolution map: which levels are in use, and long sweeps through many cells.
// SPDX-License-Identifier: MIT
#include "isostep/book/cell_grid.hpp"

#include "unit/collision/broadphase/laws.hpp"

namespace isostep::test {

INSTANTIATE_TYPED_TEST_SUITE_P(Grid, CoarseStructure, EveryScalar<Grid>);
INSTANTIATE_TYPED_TEST_SUITE_P(MultiGrid, CoarseStructure, EveryScalar<MultiGrid>);

namespace cell_grid_test {

template <class S> class CellGrids : public testing::Test {};
TYPED_TEST_SUITE(CellGrids, BroadphaseScalars);

TYPED_TEST(CellGrids, TheMapHasALevelForEverySizeAndTheGridOneForMostAndOneForTheRest) {
  using S = TypeParam;
  Grid<S> grid;
  MultiGrid<S> map;
  S side = S(0.5);
  std::uint32_t slot = 0;
  for (int size = 0; size < 6; ++size, side = side + side) {
    for (int i = 0; i < 1 << (2 * (5 - size)); ++i, ++slot) {  // 1024 small ones, 256, ... 1 large one
      const Aabb<S> box = {{S(i % 32), S(0), S(i / 32)}, {S(i % 32) + side, side, S(i / 32) + side}};
      grid.insert(slot, box);
      map.insert(slot, box);
    }
  }
  grid.optimise();
  EXPECT_EQ(grid.levels(), 2u);
  EXPECT_EQ(map.levels(), 6u);
  AllPairs<S> of_grid, of_map;
  all_pairs(grid, of_grid);
  all_pairs(map, of_map);
  EXPECT_EQ(of_grid.keys, of_map.keys);
  EXPECT_GT(of_grid.keys.size(), 2000u);
  for (std::uint32_t i = 0; i < 1024; ++i) {  // most are large now
    grid.remove(i);
    map.remove(i);
  }
  grid.optimise();
  EXPECT_TRUE(grid.validate());
  EXPECT_EQ(grid.levels(), 2u);
  EXPECT_EQ(map.levels(), 5u);
  all_pairs(grid, of_grid);
  all_pairs(map, of_map);
  EXPECT_EQ(of_grid.keys, of_map.keys);
}

/// Compares with the tree of boxes, whose sweeps are held to brute force: enough boxes that sweeps go from cell to
/// cell.
template <class Structure, class S> void hold_long_sweeps() {
  Pcg32 random = Pcg32::seeded(51);
  Structure grid;
  AabbTree<S> tree;
  for (std::uint32_t slot = 0; slot < 4000; ++slot) {
    const Aabb<S> box = random_box<S>(random, slot % 500 == 7 ? 10 : 120);
    grid.insert(slot, box);
    tree.insert(slot, box);
  }
  grid.optimise();
  tree.optimise();
  std::size_t touched = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3<S> origin = random_point<S>(random, 140), target = random_point<S>(random, 140);
    const S half = i % 3 == 0 ? S(1) : S(0);
    const Sweep<S> sweep = {origin, target - origin, {half, S(0), half}, i % 4 == 3 ? Unit<S>(0.625) : Unit<S>(1)};
    std::vector<std::uint32_t> of_grid, of_tree;
    grid.sweep(sweep, AllTouched<S>{&of_grid});
    tree.sweep(sweep, AllTouched<S>{&of_tree});
    std::sort(of_grid.begin(), of_grid.end());
    std::sort(of_tree.begin(), of_tree.end());
    ASSERT_EQ(of_grid, of_tree) << "sweep " << i;
    touched += of_grid.size();
  }
  EXPECT_GT(touched, 300u);
}
TYPED_TEST(CellGrids, LongSweepsTouchWhatTheyTouchInATree) {
  hold_long_sweeps<Grid<TypeParam>, TypeParam>();
  hold_long_sweeps<MultiGrid<TypeParam>, TypeParam>();
}

TYPED_TEST(CellGrids, NumbersOfCellsFollowCoordinatesToTheEdgeOfTheWorldAndStayThere) {
  using S = TypeParam;
  using Cells = BoxCells<S>;
  const S edge = Limits<S>::position() * S(4);
  EXPECT_LE(Cells::top_level(), 62);
  EXPECT_EQ(Cells::number(edge) >> Cells::top_level(), 0u);
  EXPECT_GT(Cells::number(-edge), 0u);
  EXPECT_EQ(Cells::number(highest<S>()), Cells::number(edge));
  EXPECT_EQ(Cells::number(-highest<S>()), Cells::number(-edge));
  EXPECT_EQ(Cells::number(S(3)) - Cells::number(S(2)), 256u);
  EXPECT_EQ(Cells::number(S(0)), Cells::number(-S(0)));
  EXPECT_LT(Cells::number(-resolution<S>()), Cells::number(S(0)));
  for (int level = 3; level < Cells::top_level(); ++level) {  // zero is a third of a cell away from borders
    const std::uint64_t width = std::uint64_t{1} << level, into = Cells::number(S(0)) % width;
    EXPECT_GE(3 * into + 3, width);
    EXPECT_GE(3 * (width - into) + 3, width);
  }
}

}  // namespace cell_grid_test
}  // namespace isostep::test
