// The common part of the tests of static geometry: a terrain, random boxes, and what all triangles say of a box.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "isostep/geometry/baked/height_field.hpp"
#include "isostep/geometry/baked/triangle_mesh.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::test {

/// Draws of 32 bits, as uint32_t on every machine.
class Random {
 public:
  using result_type = std::uint32_t;
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return 0xffffffffu; }

  explicit Random(std::uint32_t seed) : draws_(seed) {}
  std::uint32_t operator()() { return static_cast<std::uint32_t>(draws_()); }

 private:
  std::mt19937 draws_;
};

/// Heights and triangles of one surface, in steps of 1/1024 m, from the corner at the origin.
struct Surface {
  HeightGrid grid;
  std::vector<std::int16_t> heights;
  std::vector<MeshPoint> points;
  std::vector<MeshTriangle> triangles;  // numbered as those of a height field
};

inline Surface surface_of(const HeightGrid& grid, const std::vector<std::int16_t>& heights) {
  Surface surface{grid, heights, {}, {}};
  const auto step = [](std::uint32_t v) { return static_cast<std::int32_t>(v); };
  for (std::uint32_t k = 0; k < grid.rows; ++k) {
    for (std::uint32_t i = 0; i < grid.columns; ++i) {
      const std::int32_t y = heights[k * grid.columns + i] * (1 << grid.height_shift);
      surface.points.push_back({step(i * grid.pitch), y, step(k * grid.pitch)});
      if (i + 1 == grid.columns || k + 1 == grid.rows) continue;
      const std::uint32_t at = k * grid.columns + i, below = at + grid.columns;
      surface.triangles.push_back({{at, below, at + 1}});
      surface.triangles.push_back({{below + 1, at + 1, below}});
    }
  }
  return surface;
}

/// 20 000 triangles of waves in a bowl: 101 x 101 heights, half a metre apart.
inline Surface terrain() {
  constexpr double kTurn = 6.283185307179586;
  std::vector<std::int16_t> heights;
  for (int k = 0; k < 101; ++k) {
    for (int i = 0; i < 101; ++i) {
      const double x = 0.5 * i - 25, z = 0.5 * k - 25;
      const double y = 0.75 * isostep::sin(kTurn * i / 25) * isostep::cos(kTurn * k / 20) +
                       0.125 * isostep::sin(kTurn * (i + 2 * k) / 9) + 0.006 * (x * x + z * z);
      heights.push_back(static_cast<std::int16_t>(std::floor(1024 * y + 0.5)));
    }
  }
  return surface_of({10, 0, 101, 101, 512}, heights);
}

inline bool operator==(const BakedTriangle& a, const BakedTriangle& b) {
  bool same = a.material == b.material;
  for (int k = 0; k < 3; ++k) {
    same = same && a.points[k] == b.points[k] && a.opposite[k] == b.opposite[k] && a.edges[k] == b.edges[k];
  }
  return same;
}

/// Boxes of all sizes in and around others; now and then one without an end, and one that is empty.
class BoxDraws {
 public:
  BoxDraws(std::uint32_t seed, const MeshBox& around) : random_(seed), around_(around) {}

  MeshBox box() {
    MeshBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t width = around_.high[axis] - around_.low[axis] + 4;
      const std::int64_t size = between(0, width) >> between(0, 12);
      box.low[axis] = between(around_.low[axis] - 2 - size, around_.high[axis] + 2);
      box.high[axis] = box.low[axis] + size;
      const std::int64_t kind = between(0, 40);
      if (kind == 0) box.low[axis] = INT64_MIN;
      if (kind == 1) box.high[axis] = INT64_MAX;
      if (kind == 2) box.high[axis] = box.low[axis] - 1;
    }
    return box;
  }
  /// Both ends included.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 random_;
  MeshBox around_;
};

template <class G> std::vector<std::uint32_t> queried(const G& geometry, const MeshBox& box) {
  std::vector<std::uint32_t> ids;
  EXPECT_TRUE(geometry.query(box, [&](std::uint32_t id) {
    ids.push_back(id);
    return true;
  }));
  return ids;
}

/// The triangles in a box by brute force, ascending. It compares boxes by itself: neither ends before the other begins.
template <class G> std::vector<std::uint32_t> by_brute_force(const G& geometry, const MeshBox& box) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < geometry.triangle_count(); ++id) {
    if (!geometry.has_triangle(id)) continue;
    const BakedTriangle triangle = geometry.triangle(id);
    bool apart = false;
    const auto compare = [&](int axis, std::int32_t MeshPoint::*of) {
      const std::int64_t a = triangle.points[0].*of, b = triangle.points[1].*of, c = triangle.points[2].*of;
      const bool empty = box.high[axis] < box.low[axis];
      apart = apart || empty || std::max({a, b, c}) < box.low[axis] || std::min({a, b, c}) > box.high[axis];
    };
    compare(0, &MeshPoint::x);
    compare(1, &MeshPoint::y);
    compare(2, &MeshPoint::z);
    if (!apart) ids.push_back(id);
  }
  return ids;
}

template <class G> void expect_queries_find_all(const G& geometry, std::uint32_t seed, int boxes) {
  BoxDraws draws(seed, geometry.bounds());
  std::size_t found = 0, none = 0;
  for (int n = 0; n < boxes; ++n) {
    const MeshBox box = draws.box();
    std::vector<std::uint32_t> ids = queried(geometry, box);
    std::sort(ids.begin(), ids.end());
    ASSERT_EQ(ids, by_brute_force(geometry, box)) << n;
    found += ids.size();
    none += ids.empty() ? 1 : 0;

    std::vector<std::uint32_t> reached;
    geometry.traverse([&](const MeshBox& node) { return node.touches(box); },
                      [&](std::uint32_t id) {
                        reached.push_back(id);
                        return true;
                      });
    std::sort(reached.begin(), reached.end());
    ASSERT_EQ(std::adjacent_find(reached.begin(), reached.end()), reached.end()) << n;
    ASSERT_TRUE(std::includes(reached.begin(), reached.end(), ids.begin(), ids.end())) << n;
  }
  EXPECT_GT(found, 0u);
  EXPECT_GT(none, 0u);
  EXPECT_LT(none, static_cast<std::size_t>(boxes));
}

/// The nearest to a place on the x axis, by a traversal that becomes stricter with each triangle that it finds.
template <class G> void expect_traversals_may_shrink(const G& geometry, std::int64_t place) {
  std::int64_t nearest = INT64_MAX, shrunk = INT64_MAX;
  std::uint32_t all = 0, visited = 0;
  const auto distance = [&](const MeshBox& box) {
    return std::max<std::int64_t>({0, box.low[0] - place, place - box.high[0]}) +
           (box.low[1] - geometry.bounds().low[1]);
  };
  for (std::uint32_t id = 0; id < geometry.triangle_count(); ++id) {
    if (!geometry.has_triangle(id)) continue;
    nearest = std::min(nearest, distance(geometry.triangle(id).bounds()));
    ++all;
  }
  geometry.traverse([&](const MeshBox& node) { return distance(node) < shrunk; },
                    [&](std::uint32_t id) {
                      shrunk = std::min(shrunk, distance(geometry.triangle(id).bounds()));
                      ++visited;
                      return true;
                    });
  EXPECT_EQ(shrunk, nearest);
  EXPECT_LT(visited, all / 2) << "what cannot be nearer is not visited";
}

template <class G> void expect_visits_end_when_told(const G& geometry) {
  std::vector<std::uint32_t> all = queried(geometry, geometry.bounds());
  std::vector<std::uint32_t> some;
  const auto visit = [&](std::uint32_t id) {
    some.push_back(id);
    return some.size() < 7;
  };
  EXPECT_FALSE(geometry.query(geometry.bounds(), visit));
  EXPECT_EQ(some, std::vector<std::uint32_t>(all.begin(), all.begin() + 7));
  some.clear();
  EXPECT_FALSE(geometry.traverse([](const MeshBox&) { return true; }, visit));
  EXPECT_EQ(some.size(), 7u);
}

/// Figures for people; no verdict hangs on the clock.
template <class Build> void print_build_time(const char* what, std::uint32_t triangles, const Build& build) {
  double least = 1e9;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto begin = std::chrono::steady_clock::now();
    build();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    least = std::min(least, taken.count());
  }
  std::printf("%s: %.3f us a triangle to build\n", what, 1e6 * least / triangles);
}

template <class T> std::string fault_text(const Result<T>& result) {
  if (result.ok()) return "";
  return std::string(result.error().place.view()) + ": " + std::string(result.error().message.view());
}

}  // namespace isostep::test
