// Queries of triangle meshes against all triangles, and the trees that find them.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/mesh_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "unit/geometry/triangle_soup.hpp"

namespace isostep::test {
namespace mesh_tree_test {

TEST(MeshTree, queries_find_what_all_triangles_say) {
  Random random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const Soup soup = random_soup(random, 4 + static_cast<std::uint32_t>(trial), 1 + 8 * trial);
    if (soup.triangles.empty()) continue;
    ASSERT_NO_FATAL_FAILURE(expect_queries_find_all(soup.mesh().value(), 3 + static_cast<std::uint32_t>(trial), 200));
  }
  const Surface surface = terrain();
  expect_queries_find_all(triangle_mesh(surface.points, surface.triangles, {}, 10).value(), 4, 500);
}

/// Triangles over the whole range of the grid, where nodes lose nine bits.
Soup far_soup(Random& random, int count) {
  Soup soup;
  const auto draw = [&] { return static_cast<std::int32_t>(random() % (2u * kFar + 1)) - kFar; };
  for (int n = 0; n < count; ++n) {
    MeshPoint p;
    p.x = draw();
    p.y = draw();
    p.z = draw();
    const std::int32_t size = 1 << random() % 22, turn = p.x > 0 ? -size : size;
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(p);
    soup.points.push_back({p.x + turn, p.y, p.z});
    soup.points.push_back({p.x, p.y, p.z > 0 ? p.z - size : p.z + size});
    soup.triangles.push_back({{first, first + 1, first + 2}});
  }
  return soup;
}

TEST(MeshTree, queries_find_all_across_the_whole_grid) {
  Random random(5);
  expect_queries_find_all(far_soup(random, 4000).mesh().value(), 6, 400);
}

TEST(MeshTree, queries_find_what_lies_at_the_ends_of_the_grid) {
  for (const std::int32_t end : {-kFar, kFar}) {
    const Points points = {{end, 0, 0}, {end, 9, 0}, {end, 0, 9}, {0, end, 0}, {9, end, 0},
                           {0, end, 9}, {0, 0, end}, {9, 0, end}, {0, 9, end}};
    const TriangleMesh mesh = triangle_mesh(points, Triangles{{{0, 1, 2}}, {{3, 4, 5}}, {{6, 7, 8}}}, {}, 0).value();
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      MeshBox box = {{INT64_MIN, INT64_MIN, INT64_MIN}, {INT64_MAX, INT64_MAX, INT64_MAX}};
      EXPECT_EQ(queried(mesh, box).size(), 3u);
      (end < 0 ? box.high : box.low)[axis] = end;
      EXPECT_EQ(queried(mesh, box), std::vector<std::uint32_t>{axis});
      (end < 0 ? box.high : box.low)[axis] = end < 0 ? end - 1 : end + 1;
      EXPECT_TRUE(queried(mesh, box).empty());
    }
  }
}

/// Exactly: a node that ended a step too early would lose its last triangle.
template <class G> void expect_nodes_hold_their_triangles(const G& geometry) {
  for (std::uint32_t id = 0; id < geometry.triangle_count(); id += 7) {
    const MeshBox own = geometry.triangle(id).bounds();
    bool sound = true, found = false;
    const auto holds = [&](const MeshBox& node) {
      bool all = true;
      for (int axis = 0; axis < 3; ++axis) {
        sound = sound && node.low[axis] <= node.high[axis];
        all = all && node.low[axis] <= own.low[axis] && own.high[axis] <= node.high[axis];
      }
      return all;
    };
    geometry.traverse(holds, [&](std::uint32_t reached) {
      found = found || reached == id;
      return true;
    });
    ASSERT_TRUE(found) << id;
    ASSERT_TRUE(sound) << "no node is asked for that is not there";
  }
}

TEST(MeshTree, nodes_hold_their_triangles) {
  Random random(15);
  expect_nodes_hold_their_triangles(far_soup(random, 4000).mesh().value());
  const Surface surface = terrain();
  expect_nodes_hold_their_triangles(triangle_mesh(surface.points, surface.triangles, {}, 10).value());
}

TEST(MeshTree, traversals_may_shrink_and_end) {
  const Surface surface = terrain();
  const TriangleMesh mesh = triangle_mesh(surface.points, surface.triangles, {}, 10).value();
  expect_traversals_may_shrink(mesh, 12345);
  expect_visits_end_when_told(mesh);
  EXPECT_TRUE(mesh.traverse([](const MeshBox&) { return false; }, [](std::uint32_t) { return false; }));
}

/// The one order of a tree: that of its leaves, of which a box leaves some out.
TEST(MeshTree, queries_keep_the_order_of_the_tree) {
  const Surface surface = terrain();
  const TriangleMesh mesh = triangle_mesh(surface.points, surface.triangles, {}, 10).value();
  const std::span<const std::uint32_t> order = mesh.tree().order();
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  BoxDraws draws(7, mesh.bounds());
  for (int n = 0; n < 200; ++n) {
    std::vector<std::uint32_t> ranks;
    for (const std::uint32_t id : queried(mesh, draws.box())) ranks.push_back(rank[id]);
    ASSERT_TRUE(std::is_sorted(ranks.begin(), ranks.end()));
  }
  EXPECT_EQ(queried(mesh, mesh.bounds()), std::vector<std::uint32_t>(order.begin(), order.end()));
}

int depth_of(const MeshTree& tree, std::uint32_t node) {
  int deepest = 0;
  for (const std::uint32_t child : tree.nodes()[node].children) {
    if (!(child & MeshNode::kLeaf)) deepest = std::max(deepest, depth_of(tree, child));
  }
  return 1 + deepest;
}

/// Boxes that become smaller towards a corner, so that surface area alone would cut them off a few at a time.
std::vector<MeshBox> uneven_boxes(std::uint32_t seed, int count) {
  Random random(seed);
  std::vector<MeshBox> boxes;
  for (int n = 0; n < count; ++n) {
    MeshBox box;
    const std::uint32_t scale = random() % 23;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = random() % (1u << scale);
      box.high[axis] = box.low[axis] + random() % (1u << scale);
    }
    boxes.push_back(box);
  }
  return boxes;
}

TEST(MeshTree, a_tree_has_no_more_levels_than_it_may) {
  int shortened = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const int count = trial < 100 ? 1 + trial * 7 : 1536 << (trial % 3);  // the last fill a tree
    const std::vector<MeshBox> boxes = uneven_boxes(static_cast<std::uint32_t>(trial), count);
    int least = 1;
    while (MeshTree::capacity(least) < boxes.size()) ++least;
    const MeshTree free = MeshTree::build(boxes), tree = MeshTree::build(boxes, least);
    ASSERT_LE(depth_of(free, 0), MeshTree::kLevels);
    ASSERT_LE(depth_of(tree, 0), least) << count;
    shortened += depth_of(free, 0) > least ? 1 : 0;
    for (const MeshTree* each : {&free, &tree}) {
      const MeshBox box = boxes[boxes.size() / 2];
      std::set<std::uint32_t> found;
      each->query(box, [&](std::uint32_t triangle) { return found.insert(triangle).second; });
      for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].touches(box)) continue;
        ASSERT_TRUE(found.count(i)) << i;
      }
    }
  }
  EXPECT_GT(shortened, 50);
}

/// Boxes that are all one: nothing tells their centres apart.
TEST(MeshTree, a_tree_of_equal_boxes_is_halved) {
  const std::vector<MeshBox> boxes(5000, MeshBox{{-7, 0, 7}, {100, 0, 9}});
  const MeshTree tree = MeshTree::build(boxes);
  EXPECT_LE(depth_of(tree, 0), 7);
  std::vector<std::uint32_t> found;
  tree.query({{100, 0, 9}, {100, 0, 9}}, [&](std::uint32_t triangle) {
    found.push_back(triangle);
    return true;
  });
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), 5000u);
  for (std::uint32_t i = 0; i < 5000; ++i) EXPECT_EQ(found[i], i);
}

TEST(MeshTree, a_triangle_takes_at_most_40_bytes) {
  const Surface surface = terrain();
  const Result<TriangleMesh> mesh = triangle_mesh(surface.points, surface.triangles, {}, 10);
  const double each = static_cast<double>(mesh.value().memory()) / mesh.value().triangle_count();
  std::printf("mesh: %.2f bytes a triangle, %zu nodes, depth %d\n", each, mesh.value().tree().nodes().size(),
              depth_of(mesh.value().tree(), 0));
  EXPECT_LE(each, 40);
  print_build_time("mesh", mesh.value().triangle_count(),
                   [&] { EXPECT_TRUE(triangle_mesh(surface.points, surface.triangles, {}, 10).ok()); });
}

}  // namespace mesh_tree_test
}  // namespace isostep::test
