// Triangle meshes against all pairs of triangles, and what is refused, of input and of bytes.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "unit/geometry/baked_surface.hpp"

namespace isostep::test {
namespace {

static_assert(TriangleGeometry<TriangleMesh>);

constexpr std::int32_t kFar = MeshPoint::kLimit - 1;

using Points = std::vector<MeshPoint>;
using Triangles = std::vector<MeshTriangle>;
using Materials = std::vector<std::uint8_t>;
using Place = std::array<std::int32_t, 3>;

Place place_of(MeshPoint p) { return {p.x, p.y, p.z}; }

struct Soup {
  Points points;
  Triangles triangles;
  Materials materials;

  Result<TriangleMesh> mesh(int exponent = 10) const { return triangle_mesh(points, triangles, materials, exponent); }
};

/// Triangles between points of a small grid, as long as no edge would have two in one direction: borders, sheets,
/// folds and ridges as they come. Each triangle has points of its own, so that only their places tell of neighbours.
Soup random_soup(Random& random, std::uint32_t width, int tries) {
  Soup soup;
  std::set<std::pair<Place, Place>> taken;
  const auto draw = [&] { return 3 * static_cast<std::int32_t>(random() % width) - 4; };
  for (int n = 0; n < tries; ++n) {
    MeshPoint p[3];
    for (MeshPoint& point : p) {
      point.x = draw();
      point.y = draw();
      point.z = draw();
    }
    bool fits = !(cross(p[1] - p[0], p[2] - p[0]) == GridVector{0, 0, 0});
    for (int k = 0; k < 3; ++k) fits = fits && !taken.count({place_of(p[k]), place_of(p[(k + 1) % 3])});
    if (!fits) continue;
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (int k = 0; k < 3; ++k) {
      taken.insert({place_of(p[k]), place_of(p[(k + 1) % 3])});
      soup.points.push_back(p[k]);
    }
    soup.triangles.push_back({{first, first + 1, first + 2}});
    soup.materials.push_back(static_cast<std::uint8_t>(random()));
  }
  return soup;
}

/// Six times the volume of a tetrahedron, by its determinant; for small coordinates.
std::int64_t volume(MeshPoint a, MeshPoint b, MeshPoint c, MeshPoint d) {
  const GridVector u = b - a, v = c - a, w = d - a;
  return u.x * (v.y * w.z - v.z * w.y) - u.y * (v.x * w.z - v.z * w.x) + u.z * (v.x * w.y - v.y * w.x);
}

/// Checks all edges against all edges, and counts their kinds.
void expect_neighbours_of_all_pairs(const TriangleMesh& mesh, std::map<EdgeKind, int>& kinds) {
  std::vector<BakedTriangle> all;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) all.push_back(mesh.triangle(t));
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const MeshPoint a = all[t].points[k], b = all[t].points[(k + 1) % 3], c = all[t].points[(k + 2) % 3];
      std::uint32_t neighbour = kNoTriangle;
      EdgeKind kind = EdgeKind::border;
      for (std::uint32_t u = 0; u < all.size(); ++u) {
        for (int j = 0; j < 3; ++j) {
          if (!(all[u].points[j] == b) || !(all[u].points[(j + 1) % 3] == a)) continue;
          ASSERT_EQ(neighbour, kNoTriangle);
          neighbour = u;
          const MeshPoint d = all[u].points[(j + 2) % 3];
          const std::int64_t above = volume(a, b, c, d);
          const bool turned = dot(all[t].normal(), all[u].normal()) < 0;
          kind = above < 0   ? EdgeKind::convex
                 : above > 0 ? EdgeKind::concave
                 : turned    ? EdgeKind::fold
                             : EdgeKind::flat;
          ASSERT_EQ(all[t].opposite[k], d);
          ASSERT_EQ(all[t].neighbour_normal(k), all[u].normal());
          ASSERT_EQ(mesh.edge(t, k).edge(), static_cast<std::uint32_t>(j));
        }
      }
      ASSERT_EQ(mesh.neighbour(t, k), neighbour);
      ASSERT_EQ(all[t].edges[k], kind);
      ASSERT_EQ(all[t].has_neighbour(k), neighbour != kNoTriangle);
      ++kinds[kind];
    }
  }
}

TEST(TriangleMesh, neighbours_are_what_all_pairs_of_edges_say) {
  Random random(1);
  std::map<EdgeKind, int> kinds;
  for (int trial = 0; trial < 300; ++trial) {
    const Soup soup = random_soup(random, 2 + static_cast<std::uint32_t>(trial % 3), 2 + trial);
    const Result<TriangleMesh> mesh = soup.mesh();
    if (soup.triangles.empty()) continue;
    ASSERT_TRUE(mesh.ok()) << fault_text(mesh);
    ASSERT_NO_FATAL_FAILURE(expect_neighbours_of_all_pairs(mesh.value(), kinds));
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      const BakedTriangle triangle = mesh.value().triangle(t);
      EXPECT_EQ(triangle.material, soup.materials[t]);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(triangle.points[k], soup.points[soup.triangles[t].vertices[k]]);
    }
  }
  for (const EdgeKind kind : {EdgeKind::border, EdgeKind::flat, EdgeKind::convex, EdgeKind::concave, EdgeKind::fold}) {
    EXPECT_GT(kinds[kind], 200) << static_cast<int>(kind);
  }
}

/// Six times the volume is up to 2^72 here, and the least of it that is not 0 is told from 0.
TEST(TriangleMesh, edges_are_told_apart_across_the_whole_grid) {
  constexpr std::int32_t kEnd = kFar - 1;
  const auto kind_with = [](std::int32_t rise) {  // of the fourth point, above the plane x + y + z = 0 of the others
    const Points points = {{-kEnd, kEnd, 0}, {kEnd, -kEnd, 0}, {0, kEnd, -kEnd}, {0, rise - kEnd, kEnd}};
    const TriangleMesh mesh = triangle_mesh(points, Triangles{{{0, 1, 2}}, {{1, 0, 3}}}, {}, 0).value();
    EXPECT_EQ(mesh.triangle(1).edges[0], mesh.triangle(0).edges[0]) << "seen from both sides";
    return mesh.triangle(0).edges[0];
  };
  EXPECT_EQ(kind_with(-1), EdgeKind::convex);
  EXPECT_EQ(kind_with(0), EdgeKind::flat);
  for (std::int32_t rise = 1; rise <= kEnd; rise *= 2) EXPECT_EQ(kind_with(rise), EdgeKind::concave) << rise;
  EXPECT_EQ(kind_with(2 * kEnd), EdgeKind::concave);

  const Points folded = {{-kEnd, kEnd, 0}, {kEnd, -kEnd, 0}, {0, kEnd, -kEnd}, {-kEnd, kEnd - 1, 1}};
  const TriangleMesh mesh = triangle_mesh(folded, Triangles{{{0, 1, 2}}, {{1, 0, 3}}}, {}, 0).value();
  EXPECT_EQ(mesh.triangle(0).edges[0], EdgeKind::flat);
  const Points back = {{-kEnd, kEnd, 0}, {kEnd, -kEnd, 0}, {0, kEnd, -kEnd}, {-kEnd, kEnd + 1, -1}};
  const TriangleMesh sheet = triangle_mesh(back, Triangles{{{0, 1, 2}}, {{1, 0, 3}}}, {}, 0).value();
  EXPECT_EQ(sheet.triangle(0).edges[0], EdgeKind::fold);
}

TEST(TriangleMesh, queries_find_what_all_triangles_say) {
  Random random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const Soup soup = random_soup(random, 4 + static_cast<std::uint32_t>(trial), 1 + 8 * trial);
    if (soup.triangles.empty()) continue;
    ASSERT_NO_FATAL_FAILURE(expect_queries_find_all(soup.mesh().value(), 3 + static_cast<std::uint32_t>(trial), 200));
  }
  const Surface surface = terrain();
  expect_queries_find_all(triangle_mesh(surface.points, surface.triangles, {}, 10).value(), 4, 500);
}

/// Over the whole range of the grid, where nodes lose nine bits.
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

TEST(TriangleMesh, queries_find_all_across_the_whole_grid) {
  Random random(5);
  expect_queries_find_all(far_soup(random, 4000).mesh().value(), 6, 400);
}

TEST(TriangleMesh, queries_find_what_lies_at_the_ends_of_the_grid) {
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

TEST(TriangleMesh, nodes_hold_their_triangles) {
  Random random(15);
  expect_nodes_hold_their_triangles(far_soup(random, 4000).mesh().value());
  const Surface surface = terrain();
  expect_nodes_hold_their_triangles(triangle_mesh(surface.points, surface.triangles, {}, 10).value());
}

TEST(TriangleMesh, traversals_may_shrink_and_end) {
  const Surface surface = terrain();
  const TriangleMesh mesh = triangle_mesh(surface.points, surface.triangles, {}, 10).value();
  expect_traversals_may_shrink(mesh, 12345);
  expect_visits_end_when_told(mesh);
  EXPECT_TRUE(mesh.traverse([](const MeshBox&) { return false; }, [](std::uint32_t) { return false; }));
}

/// The one order of a tree: that of its leaves, of which a box leaves some out.
TEST(TriangleMesh, queries_keep_the_order_of_the_tree) {
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

TEST(TriangleMesh, a_tree_has_no_more_levels_than_it_may) {
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
TEST(TriangleMesh, a_tree_of_equal_boxes_is_halved) {
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

TEST(TriangleMesh, permuted_triangles_change_ids_only) {
  Random random(10);
  const Surface surface = terrain();
  Materials materials;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) materials.push_back(static_cast<std::uint8_t>(t % 251));
  const TriangleMesh mesh = triangle_mesh(surface.points, surface.triangles, materials, 10).value();
  std::vector<std::uint32_t> old_id(surface.triangles.size());
  for (std::uint32_t t = 0; t < old_id.size(); ++t) old_id[t] = t;
  std::shuffle(old_id.begin(), old_id.end(), random);
  Triangles triangles;
  Materials permuted;
  for (const std::uint32_t t : old_id) {
    triangles.push_back(surface.triangles[t]);
    permuted.push_back(materials[t]);
  }
  const TriangleMesh other = triangle_mesh(surface.points, triangles, permuted, 10).value();
  for (std::uint32_t t = 0; t < old_id.size(); ++t) {
    ASSERT_TRUE(other.triangle(t) == mesh.triangle(old_id[t]));
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t across = other.neighbour(t, k);
      ASSERT_EQ(across == kNoTriangle ? across : old_id[across], mesh.neighbour(old_id[t], k));
    }
  }
  BoxDraws draws(11, mesh.bounds());
  for (int n = 0; n < 100; ++n) {
    const MeshBox box = draws.box();
    std::vector<std::uint32_t> ids = queried(mesh, box), others;
    for (const std::uint32_t t : queried(other, box)) others.push_back(old_id[t]);
    std::sort(ids.begin(), ids.end());
    std::sort(others.begin(), others.end());
    ASSERT_EQ(ids, others);
  }
}

TEST(TriangleMesh, equal_points_unused_points_and_their_order_change_nothing) {
  Random random(12);
  const Soup soup = random_soup(random, 4, 300);  // with points of its own for each triangle
  const TriangleMesh mesh = soup.mesh().value();
  EXPECT_LT(mesh.points().size(), 65u) << "a grid of 4 x 4 x 4";

  Points shared(mesh.points().begin(), mesh.points().end());
  for (std::int32_t i = 0; i < 50; ++i) shared.push_back({1000 + i, 7, 7});
  std::shuffle(shared.begin(), shared.end(), random);
  Triangles triangles;
  for (const MeshTriangle& triangle : soup.triangles) {
    MeshTriangle other = {};
    for (int k = 0; k < 3; ++k) {
      const auto at = std::find(shared.begin(), shared.end(), soup.points[triangle.vertices[k]]);
      other.vertices[k] = static_cast<std::uint32_t>(at - shared.begin());
    }
    triangles.push_back(other);
  }
  EXPECT_EQ(triangle_mesh(shared, triangles, soup.materials, 10).value().bytes(), mesh.bytes());
}

const Points kSquare = {{0, 0, 0}, {0, 0, 8}, {8, 0, 0}, {8, 0, 8}, {4, 5, 4}, {4, 9, 4}};
std::string fault_of(const Triangles& triangles, const Points& points = kSquare) {
  return fault_text(triangle_mesh(points, triangles, {}, 10));
}

TEST(TriangleMesh, names_what_it_refuses) {
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 1}}}), "");
  EXPECT_EQ(fault_of({}), "triangles: there are no triangles");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 6}}}), "triangles[1]: vertex 6 of 6 points");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 2}}}), "triangles[1]: the triangle has no area: its points lie on a line");
  EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{0, 0, 0}, {kFar, 1, -kFar}, {-kFar, -1, kFar}}),
            "triangles[0]: the triangle has no area: its points lie on a line");
  EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{0, 0, 0}, {kFar, 1, -kFar}, {-kFar, -1, kFar - 1}}), "");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{1, 2, 3}}}),
            "triangles[1]: the triangle runs along an edge in the same direction as triangle 0");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{3, 2, 1}}, {{1, 4, 2}}}),
            "triangles[2]: the triangle is the third at an edge of triangle 0: 3 are there, at most 2 are possible");
  EXPECT_EQ(fault_of({{{3, 2, 1}}, {{0, 1, 2}}, {{1, 2, 0}}}),
            "triangles[2]: the triangle is there already, as triangle 1");
  EXPECT_EQ(fault_of({{{3, 2, 1}}, {{0, 1, 4}}, {{1, 3, 2}}}),
            "triangles[2]: the triangle is there already, as triangle 0");
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{0, 2, 1}}}), "") << "a sheet with two sides";
  EXPECT_EQ(fault_of({{{0, 1, 2}}, {{0, 2, 1}}, {{1, 4, 2}}}),
            "triangles[2]: the triangle is the third at an edge of triangle 0: 3 are there, at most 2 are possible");
  for (const std::int32_t out : {MeshPoint::kLimit, -MeshPoint::kLimit, INT32_MIN, INT32_MAX}) {
    for (const MeshPoint p : {MeshPoint{out, 0, 0}, MeshPoint{0, out, 0}, MeshPoint{0, 0, out}}) {
      EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, p}),
                "points[3]: a coordinate has more than 23 bits and a sign");
    }
  }
  EXPECT_EQ(fault_of({{{0, 1, 2}}}, {{kFar, -kFar, 0}, {0, kFar, -kFar}, {-kFar, 0, kFar}}), "");
}

TEST(TriangleMesh, names_exponents_materials_and_counts_that_it_refuses) {
  const Triangles one = {{{0, 1, 2}}};
  for (const int exponent : {-1, 17, INT32_MIN, INT32_MAX}) {
    EXPECT_EQ(fault_text(triangle_mesh(kSquare, one, {}, exponent)), "exponent: the exponent of a step is 0 to 16");
  }
  EXPECT_EQ(triangle_mesh(kSquare, one, {}, 16).value().exponent(), 16);
  EXPECT_EQ(fault_text(triangle_mesh(kSquare, one, Materials{1, 2}, 0)), "materials: 2 materials for 1 triangles");
  EXPECT_EQ(triangle_mesh(kSquare, one, Materials{255}, 0).value().triangle(0).material, 255);
  EXPECT_EQ(triangle_mesh(kSquare, one, {}, 0).value().triangle(0).material, 0);

  const Triangles many(TriangleMesh::kMaxTriangles + 1, one[0]);
  EXPECT_EQ(fault_of(many), "triangles: 4194305 triangles, at most 4194304 are possible");
  const Points crowd(TriangleMesh::kMaxPoints + 1, MeshPoint{});
  EXPECT_EQ(fault_of(one, crowd), "points: 12582913 points, at most 12582912 are possible");
}

void expect_same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.triangle_count(), b.triangle_count());
  for (std::uint32_t t = 0; t < a.triangle_count(); ++t) ASSERT_TRUE(a.triangle(t) == b.triangle(t));
}

TEST(TriangleMesh, bytes_give_the_mesh_again) {
  Random random(13);
  for (int trial = 0; trial < 50; ++trial) {
    const Soup soup = random_soup(random, 3, 1 + 4 * trial);
    if (soup.triangles.empty()) continue;
    const TriangleMesh mesh = soup.mesh(trial % 17).value();
    const std::vector<std::uint8_t> bytes = mesh.bytes();
    EXPECT_EQ(bytes.size(), 12 + 12 * mesh.points().size() + 13 * mesh.triangles().size());
    const Result<TriangleMesh> again = read_triangle_mesh(bytes);
    ASSERT_TRUE(again.ok()) << fault_text(again);
    EXPECT_EQ(again.value().exponent(), trial % 17);
    EXPECT_EQ(again.value().bytes(), bytes);
    expect_same_triangles(mesh, again.value());
    EXPECT_EQ(queried(mesh, mesh.bounds()), queried(again.value(), mesh.bounds()));
  }
}

TEST(TriangleMesh, bytes_are_as_written_down) {
  const Points points = {{1, -2, 3}, {4, 5, 6}, {-7, 8, 0x123456}};
  const std::vector<std::uint8_t> expected = {
      9,    0,    0,    0,                                                     // exponent
      3,    0,    0,    0,    1, 0, 0, 0, 0xfe, 0xff, 0xff, 0xff, 3, 0, 0, 0,  // points
      4,    0,    0,    0,    5, 0, 0, 0, 6,    0,    0,    0,                 //
      0xf9, 0xff, 0xff, 0xff, 8, 0, 0, 0, 0x56, 0x34, 0x12, 0,                 //
      1,    0,    0,    0,    0, 0, 0, 0, 1,    0,    0,    0,    2, 0, 0, 0,  // triangles
      77};
  EXPECT_EQ(triangle_mesh(points, Triangles{{{0, 1, 2}}}, Materials{77}, 9).value().bytes(), expected);
}

TEST(TriangleMesh, other_bytes_are_refused_or_are_a_mesh_with_those_bytes) {
  Random random(14);
  const Soup soup = random_soup(random, 3, 60);
  const std::vector<std::uint8_t> whole = soup.mesh().value().bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_FALSE(read_triangle_mesh({whole.data(), size}).ok()) << size;
  }
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::uint8_t> bytes = whole;
    for (int n = 0; n <= trial % 3; ++n) {
      std::uint8_t& byte = bytes[random() % bytes.size()];
      byte = static_cast<std::uint8_t>(trial % 2 == 0 ? random() : byte ^ 1u << random() % 8);
    }
    if (trial % 7 == 0) bytes.push_back(0);
    const Result<TriangleMesh> mesh = read_triangle_mesh(bytes);
    ++(mesh.ok() ? accepted : refused);
    if (!mesh) continue;
    ASSERT_EQ(mesh.value().bytes(), bytes);
    std::map<EdgeKind, int> kinds;
    if (trial % 50 != 0) continue;
    ASSERT_NO_FATAL_FAILURE(expect_neighbours_of_all_pairs(mesh.value(), kinds));
  }
  EXPECT_GT(refused, 5000);
  EXPECT_GT(accepted, 1000) << "materials and places may be others";
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::uint8_t> bytes(random() % 100);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4);
    ASSERT_FALSE(read_triangle_mesh(bytes).ok());
  }
}

TEST(TriangleMesh, bytes_have_one_form) {
  std::vector<std::uint8_t> bytes = triangle_mesh(kSquare, Triangles{{{0, 1, 2}}, {{3, 2, 1}}}, {}, 0).value().bytes();
  bytes[4 + 4 + 4 * 12 + 4 + 4] = 2;  // the first triangle's second and third vertices change places
  bytes[4 + 4 + 4 * 12 + 4 + 8] = 1;
  bytes[4 + 4 + 4 * 12 + 4 + 12 + 4] = 1;
  bytes[4 + 4 + 4 * 12 + 4 + 12 + 8] = 2;
  EXPECT_EQ(fault_text(read_triangle_mesh(bytes)),
            "points: points are not each used, once, in the order of the triangles");
}

TEST(TriangleMesh, a_triangle_takes_at_most_40_bytes) {
  const Surface surface = terrain();
  const Result<TriangleMesh> mesh = triangle_mesh(surface.points, surface.triangles, {}, 10);
  const double each = static_cast<double>(mesh.value().memory()) / mesh.value().triangle_count();
  std::printf("mesh: %.2f bytes a triangle, %zu nodes, depth %d\n", each, mesh.value().tree().nodes().size(),
              depth_of(mesh.value().tree(), 0));
  EXPECT_LE(each, 40);
  print_build_time("mesh", mesh.value().triangle_count(),
                   [&] { EXPECT_TRUE(triangle_mesh(surface.points, surface.triangles, {}, 10).ok()); });
}

}  // namespace
}  // namespace isostep::test
