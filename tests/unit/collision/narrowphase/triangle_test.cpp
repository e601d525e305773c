// Convexes on triangles of surfaces: against planes, against distances in double, and at edges.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/geometry/baked/box_solid.hpp"
#include "unit/geometry/oracle.hpp"

namespace isostep::test {
namespace triangle_test {

using oracle::D3;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
constexpr double kMargin = 0.02;  // [m]

/// A grid of cells of half a metre.
struct Sheet {
  static constexpr int kCells = 16;
  std::vector<D3> points;
  std::vector<MeshTriangle> triangles;
  SurfaceContent<TriangleMesh> content;

  template <class Height> explicit Sheet(Height height, double shift = 0) {
    for (int k = 0; k <= kCells; ++k) {
      for (int i = 0; i <= kCells; ++i) {
        points.push_back({0.5 * i - 4 + shift, height(i, k), 0.5 * k - 4});
        if (i == kCells || k == kCells) continue;
        const auto at = static_cast<std::uint32_t>(k * (kCells + 1) + i), below = at + kCells + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    bake();
  }
  /// The closed surface of a box about the origin.
  explicit Sheet(D3 half) {
    for (int i = 0; i < 8; ++i)
      points.push_back({i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
    constexpr std::uint32_t kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : kQuads) {
      triangles.push_back({{q[0], q[1], q[2]}});
      triangles.push_back({{q[2], q[3], q[0]}});
    }
    bake();
  }
  void bake() {
    const BlobRef blob = mesh_blob(points, triangles).value();
    content.surface = read_triangle_mesh(blob->bytes()).value();
  }
  /// The distance of a point above all of it.
  double distance(D3 p) const {
    double least = 1e9;
    for (const MeshTriangle& t : triangles) {
      const D3 a = points[t.vertices[0]], b = points[t.vertices[1]], c = points[t.vertices[2]];
      const D3 n = oracle::unit(cross(b - a, c - a));
      bool above = true;
      for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        if (dot(cross(n, to - from), p - from) >= 0) continue;
        above = false;
        const double along = std::clamp(dot(p - from, to - from) / dot(to - from, to - from), 0.0, 1.0);
        least = std::min(least, oracle::length(p - from - (to - from) * along));
      }
      if (above) least = std::min(least, std::fabs(dot(n, p - a)));
    }
    return least;
  }
};

template <class S> class Triangles : public testing::Test {
 protected:
  static constexpr double kError = std::same_as<S, Q16_16> ? 5e-4 : std::same_as<S, float> ? 1e-5 : 1e-7;  // [m]
  using Found = std::vector<Manifold<S>>;

  static Found collide_all(const Primitive<S>& convex, const Transform<S>& at, const Sheet& sheet) {
    const Primitive<S> mesh = primitive_of(Mesh<S>{1});
    const ShapeView<S> surface(mesh, &sheet.content);
    const Transform<S> there = Transform<S>::of(Pose<S>::identity());
    Found found;
    visit_triangles_near<S>(convex, at, surface, there, from_double<S>(kMargin), [&](std::uint32_t triangle) {
      Manifold<S> m;
      collide_with_triangle<S>(convex, at, surface, triangle, there, from_double<S>(kMargin), m);
      if (m.count > 0) found.push_back(m);
      return true;
    });
    return found;
  }
  static double deepest(const Found& found) {
    double least = 1e9;
    for (const Manifold<S>& m : found) {
      for (int i = 0; i < m.count; ++i) least = std::min(least, to_double(m.points[i].separation));
    }
    return least;
  }
  static Transform<S> at(oracle::Random& random, D3 place) {
    return Transform<S>::of({oracle::made<S>(place), random.orientation<S>()});
  }
};
TYPED_TEST_SUITE(Triangles, Scalars);

TYPED_TEST(Triangles, of_a_plane_push_along_its_normal_alone_and_hold_the_lowest_corners) {
  using S = TypeParam;
  oracle::Random random(71);
  const Sheet plain([](int, int) { return 0.0; });
  int corners = 0;
  for (int round = 0; round < 400; ++round) {
    const D3 half = {random.in(0.1, 0.6), random.in(0.1, 0.6), random.in(0.1, 0.6)};
    Transform<S> place = this->at(random, {random.in(-2, 2), 0, random.in(-2, 2)});
    const BoxSolid<S> box(oracle::made<S>(half));
    double lowest = 1e9;
    for (const Vec3<S> v : box.polyhedron().vertices) lowest = std::min(lowest, to_double((place.rotation * v).y));
    place.position.y = from_double<S>(-lowest - random.in(0, 0.5) * std::min({half.x, half.y, half.z}));
    const auto found = this->collide_all(primitive_of(Box<S>{oracle::made<S>(half)}), place, plain);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(this->deepest(found), to_double(place.position.y) + lowest, this->kError);
    for (const Manifold<S>& m : found) {
      EXPECT_LT(oracle::length(oracle::real(m.normal) - D3{0, -1, 0}), 4e-6) << round;
      for (int i = 0; i < m.count; ++i) {
        EXPECT_EQ(m.points[i].feature >> 28, 1u);
        ++corners;
      }
    }
  }
  EXPECT_GT(corners, 500);
}

TYPED_TEST(Triangles, of_hills_are_as_far_from_balls_as_the_nearest_of_them) {
  using S = TypeParam;
  oracle::Random random(72);
  const Sheet hills([&](int, int) { return std::floor(1024 * random.in(0, 0.3)) / 1024; });
  int touching = 0;
  for (int round = 0; round < 400; ++round) {
    const double radius = random.in(0.1, 0.5);
    const D3 centre = {random.in(-2.5, 2.5), random.in(0.31, 0.6), random.in(-2.5, 2.5)};
    const auto found = this->collide_all(primitive_of(Sphere<S>{from_double<S>(radius)}),
                                         Transform<S>::of({oracle::made<S>(centre), Quat<Unit<S>>::identity()}), hills);
    const double gap = hills.distance(centre) - radius;
    if (gap > kMargin + this->kError) {
      EXPECT_TRUE(found.empty());
    } else if (gap < kMargin - this->kError) {
      EXPECT_NEAR(this->deepest(found), gap, this->kError) << round;
      ++touching;
    }
  }
  EXPECT_GT(touching, 100);
}

TYPED_TEST(Triangles, let_pass_what_has_its_centre_behind_them) {
  using S = TypeParam;
  const Sheet plain([](int, int) { return 0.0; });
  const Transform<S> below = Transform<S>::of({oracle::made<S>({0.2, -0.1, 0.3}), Quat<Unit<S>>::identity()});
  const S size = from_double<S>(0.25);
  for (const Primitive<S>& shape :
       {primitive_of(Sphere<S>{size}), primitive_of(Capsule<S>{size, size}), primitive_of(Box<S>{{size, size, size}})})
    EXPECT_TRUE(this->collide_all(shape, below, plain).empty());
}

TYPED_TEST(Triangles, at_a_ridge_hold_what_lies_across_it_and_push_it_up) {
  using S = TypeParam;
  const Sheet roof([](int i, int) { return i <= 8 ? 0.25 * i : 0.25 * (16 - i); });  // its ridge is at x = 0, y = 2
  const Transform<S> over = Transform<S>::of({oracle::made<S>({0.05, 2.24, 0.1}), Quat<Unit<S>>::identity()});
  const Primitive<S> shapes[] = {primitive_of(Box<S>{oracle::made<S>({0.25, 0.25, 0.25})}),
                                 primitive_of(Sphere<S>{from_double<S>(0.25)})};
  for (const Primitive<S>& shape : shapes) {
    const auto found = this->collide_all(shape, over, roof);
    ASSERT_FALSE(found.empty());
    for (const Manifold<S>& m : found) EXPECT_LT(to_double(m.normal.y), -0.85);
    EXPECT_NEAR(this->deepest(found), shape.type == ShapeType::box ? -0.01 : -0.0049, 2e-3);
  }
}

TYPED_TEST(Triangles, are_the_same_far_out) {
  using S = TypeParam;
  oracle::Random random(73);
  const auto heights = [](int i, int k) { return ((i * 7 + k * 3) % 5) / 16.0; };
  const Sheet here(heights), there(heights, 64);
  for (int round = 0; round < 100; ++round) {
    const D3 place = {std::floor(random.in(-512, 512)) / 256, 0.5, std::floor(random.in(-512, 512)) / 256};
    const Primitive<S> box = primitive_of(Box<S>{oracle::made<S>({0.25, 0.375, 0.5})});
    Transform<S> pose = this->at(random, place);
    const auto near = this->collide_all(box, pose, here);
    pose.position.x += S(64);
    const auto far = this->collide_all(box, pose, there);
    ASSERT_EQ(near.size(), far.size());
    for (std::size_t i = 0; i < near.size(); ++i) {
      ASSERT_EQ(near[i].count, far[i].count);
      EXPECT_EQ(near[i].normal, far[i].normal);
      for (int p = 0; p < near[i].count; ++p) EXPECT_EQ(near[i].points[p].separation, far[i].points[p].separation);
    }
  }
}

/// Upright over the edge of a slab, its core in the plane of a side, and a hair beside it.
TYPED_TEST(Triangles, that_have_a_capsule_in_their_plane_push_it_off_the_near_edge_alone) {
  using S = TypeParam;
  const Sheet slab(D3{2, 0.5, 1});
  const Capsule<S> capsule = {from_double<S>(0.25), from_double<S>(0.25)};
  int touches = 0;
  for (const double beside : {0.0, 1e-4, -1e-4, 1.0 / 1024, -1.0 / 1024}) {
    for (const double z : {1.0, -1.0}) {
      const D3 place = {0.3, 0.5 + 0.25 + 0.2, z + beside};
      const Transform<S> at = Transform<S>::of({oracle::made<S>(place), Quat<Unit<S>>::identity()});
      for (const Manifold<S>& m : this->collide_all(primitive_of(capsule), at, slab)) {
        EXPECT_LT(to_double(m.normal.y), -0.99) << beside;  // from the capsule down
        for (int i = 0; i < m.count; ++i) EXPECT_NEAR(to_double(m.points[i].separation), 0.2 - 0.25, 5e-4) << beside;
        ++touches;
      }
    }
  }
  EXPECT_GE(touches, 10);
}

}  // namespace triangle_test
}  // namespace isostep::test
