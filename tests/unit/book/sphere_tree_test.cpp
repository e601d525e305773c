// The hierarchy of spheres: spheres that hold what they are made around, both builds, insertion and removal.
// SPDX-License-Identifier: MIT
#include "isostep/book/sphere_tree.hpp"

#include "unit/collision/broadphase/laws.hpp"

namespace isostep::test {

INSTANTIATE_TYPED_TEST_SUITE_P(SphereTree, CoarseStructure, EveryScalar<SphereTree>);

namespace sphere_tree_test {

template <class S> class Spheres : public testing::Test {};
TYPED_TEST_SUITE(Spheres, BroadphaseScalars);

/// [m^2] The squared distance from a sphere's centre to the farthest point of a box, less its squared radius: in
/// double, which holds the sums of coordinates of this size and of 24 or 32 digits exactly, or nearly.
template <class S> double sticks_out(const BoundingSphere<S>& sphere, const Aabb<S>& box) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double c = to_double(sphere.centre[i]);
    const double reach = std::max(c - to_double(box.low[i]), to_double(box.high[i]) - c);
    sum += reach * reach;
  }
  return sum - to_double(sphere.radius) * to_double(sphere.radius);
}

TYPED_TEST(Spheres, SpheresHoldTheBoxesThatTheyAreMadeAround) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(41);
  for (int round = 0; round < 300; ++round) {
    const int reach = round % 3 == 0 ? 1200 : 40;
    Aabb<S> box = random_box<S>(random, reach);
    BoundingSphere<S> all = BoundingSphere<S>::around(box);
    std::vector<Aabb<S>> boxes = {box};
    EXPECT_LE(sticks_out(all, box), 0);
    for (int i = 0; i < 12; ++i) {
      box = random_box<S>(random, reach);
      boxes.push_back(box);
      const BoundingSphere<S> one = BoundingSphere<S>::around(box);
      const BoundingSphere<S> both = i % 2 == 0 ? merge(all, one) : merge(one, all);
      EXPECT_TRUE(overlap(all, both));
      // Around both, and no wider than from end to end of both.
      const double widest = to_double(all.radius) + to_double(one.radius) + to_double(distance(all.centre, one.centre));
      const double larger = std::max(to_double(all.radius), to_double(one.radius));
      EXPECT_LE(to_double(both.radius), std::max(larger, widest / 2) * 1.001 + 0.01);
      all = both;
      for (const Aabb<S>& held : boxes) ASSERT_LE(sticks_out(all, held), 0) << "round " << round;
    }
  }
}

TYPED_TEST(Spheres, SpheresAroundTheWholeWorldReachEverything) {
  using S = TypeParam;
  const S edge = Limits<S>::position() * S(4);
  const Aabb<S> corner = {{edge, edge, edge}, {edge, edge, edge}},
                far_corner = {{-edge, -edge, -edge}, {-edge, -edge, -edge}};
  BoundingSphere<S> all = merge(BoundingSphere<S>::around(corner), BoundingSphere<S>::around(far_corner));
  for (int i = 0; i < 40; ++i)
    all = merge(all, merge(all, BoundingSphere<S>::around(i % 2 == 0 ? corner : far_corner)));
  EXPECT_TRUE(overlap(all, corner));
  EXPECT_TRUE(overlap(all, far_corner));
  EXPECT_TRUE(overlap(all, Aabb<S>{{edge, -edge, edge}, {edge, -edge, edge}}));
}

TYPED_TEST(Spheres, BothBuildsHoldWhatInsertionHolds) {
  using S = TypeParam;
  Pcg32 random = Pcg32::seeded(42);
  Beside<SphereTree<S>, S> beside;
  beside.model.slots.resize(150);
  for (std::uint32_t i = 0; i < 150; ++i) beside.set(i, random_box<S>(random, 24));
  const std::vector<std::uint64_t> expected = beside.model.brute_force();
  EXPECT_GT(expected.size(), 15u);
  for (const HierarchyBuild how : {HierarchyBuild::bottom_up, HierarchyBuild::top_down}) {
    beside.structure.build(how);
    ASSERT_TRUE(beside.structure.validate());
    EXPECT_LE(beside.structure.height(), 24u);
    EXPECT_GE(beside.structure.height(), 8u);
    all_pairs(beside.structure, beside.all);
    EXPECT_EQ(beside.all.keys, expected);
    for (std::uint32_t i = 0; i < 150; i += 2) beside.remove(i);
    for (std::uint32_t i = 0; i < 150; i += 2) beside.set(i, beside.model.slots[i].box);
    ASSERT_TRUE(beside.structure.validate());
    all_pairs(beside.structure, beside.all);
    EXPECT_EQ(beside.all.keys, expected);
  }
}

TYPED_TEST(Spheres, TheBottomUpBuildMergesNearestPairsFirst) {
  using S = TypeParam;
  Hierarchy<S, Aabb<S>> tree;
  const std::uint32_t root = tree.make_root();
  const int places[] = {0, 100, 1, 103, 40};  // 0 and 1 first, then 100 and 103, then 40 with 0 and 1
  for (std::uint32_t i = 0; i < 5; ++i) tree.stage(i, {{S(places[i]), S(0), S(0)}, {S(places[i]), S(0), S(1)}});
  tree.build(root, HierarchyBuild::bottom_up);
  ASSERT_TRUE(tree.validate(root));
  const std::uint32_t siblings[][2] = {{0, 2}, {1, 3}};
  for (const auto& [a, b] : siblings) EXPECT_EQ(tree.leaf_of(a) ^ 1u, tree.leaf_of(b));
  EXPECT_EQ(tree.height(root), 3u);
  EXPECT_EQ(tree.root_volume(root), (Aabb<S>{{S(0), S(0), S(0)}, {S(103), S(0), S(1)}}));
}

TYPED_TEST(Spheres, BoxesInOnePlaceMakeNoListOfTheTree) {
  using S = TypeParam;
  SphereTree<S> tree;
  for (std::uint32_t i = 0; i < 1000; ++i) tree.insert(i, {{S(7), S(7), S(7)}, {S(8), S(8), S(8)}});
  EXPECT_TRUE(tree.validate());
  EXPECT_LE(tree.height(), 20u);  // twice the least
  tree.optimise();
  EXPECT_TRUE(tree.validate());
  EXPECT_LE(tree.height(), 10u);
}

}  // namespace sphere_tree_test
}  // namespace isostep::test
