// Cylinders and cones: features that stay as they roll and stand, and a box of triangles beside the box. The laws that
// they share with all shapes are in every_pair_test.cpp.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/collision/narrowphase/convex_oracle.hpp"

namespace isostep::test {
namespace {

using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

template <class S> class Revolved : public testing::Test {
 protected:
  struct Pair {
    Primitive<S> a, b;
    Transform<S> ta, tb;
  };
  static Primitive<S> any(Random& random, ShapeType type, double scale) {
    const auto size = [&] { return scale * std::exp(random.in(std::log(0.1), 0)); };
    const double x = size(), y = size(), z = size();
    switch (type) {
      case ShapeType::sphere: return sphere_of<S>(x);
      case ShapeType::box: return box_of<S>(x, y, z);
      case ShapeType::capsule: return capsule_of<S>(x, y);
      case ShapeType::half_space: return half_space_of<S>(random.direction(), scale * random.in(-0.5, 0.5));
      case ShapeType::cylinder: return primitive_of(Cylinder<S>{from_double<S>(x), from_double<S>(y)});
      default: return primitive_of(Cone<S>{from_double<S>(x), from_double<S>(y)});
    }
  }
  /// Brought along a random way to where they are `depth` from touching, far from the origin.
  static Pair placed(Random& random, ShapeType type_a, ShapeType type_b, double scale, double depth, Point far) {
    Pair pair = {any(random, type_a, scale), any(random, type_b, scale), random_pose<S>(random, 0.01),
                 random_pose<S>(random, 0.01)};
    const Point way = random.direction(), start = point_of(pair.ta.position);
    if (type_a == ShapeType::half_space) {
      const Convex plane(pair.a, pair.ta), solid(pair.b, pair.tb);
      const double off = -depth - ConvexOracle::separation(plane, solid);
      pair.tb.position = vec_of<S>(point_of(pair.tb.position) + plane.normal() * off + far);
    } else {
      double low = 0, high = 4 * scale;
      for (int i = 0; i < 9; ++i) {
        const double middle = (low + high) / 2;
        Transform<S> tb = pair.tb;
        tb.position = vec_of<S>(start + way * middle);
        (ConvexOracle::separation({pair.a, pair.ta}, {pair.b, tb}) < -depth ? low : high) = middle;
      }
      pair.tb.position = vec_of<S>(start + way * high + far);
    }
    pair.ta.position = vec_of<S>(start + far);
    return pair;
  }
};
TYPED_TEST_SUITE(Revolved, Scalars);

constexpr ShapeType kRound[] = {ShapeType::cylinder, ShapeType::cone};

TYPED_TEST(Revolved, a_cylinder_touches_a_plane_along_one_line_however_it_rolls) {
  using S = TypeParam;
  const auto cylinder = primitive_of(Cylinder<S>{from_double<S>(0.5), from_double<S>(0.25)});
  const auto ground = half_space_of<S>({0, 1, 0}, 0), table = box_of<S>(2, 0.5, 2);
  for (int n = 0; n < 100; ++n) {
    const Transform<S> lying = at<S>({0, 0.499, 0}, {1, 0, 0}, std::acos(0.0));
    Transform<S> rolled = lying;
    const Transform<S> spin = at<S>({0, 0, 0}, {0, 1, 0}, 0.1 * n);
    rolled.rotation = lying.rotation * spin.rotation;
    for (const bool on_box : {false, true}) {
      const Manifold<S> m = touch(on_box ? table : ground, at<S>({0, on_box ? -0.5 : 0.0, 0}), cylinder, rolled);
      ASSERT_EQ(m.count, 2) << n;
      for (int i = 0; i < 2; ++i) {
        EXPECT_NEAR(to_double(m.points[i].separation), -0.001, rounding<S>(2)) << n;
        EXPECT_NEAR(std::abs(to_double(m.points[i].position.z)), 0.25, 4 * rounding<S>(2)) << n;
        EXPECT_EQ(m.points[i].feature & 0xffu, 32u + static_cast<unsigned>(i)) << n;
      }
    }
  }
}

TYPED_TEST(Revolved, what_stands_on_a_disc_keeps_the_same_four_points) {
  using S = TypeParam;
  const Primitive<S> solids[] = {primitive_of(Cylinder<S>{from_double<S>(0.5), from_double<S>(0.25)}),
                                 primitive_of(Cone<S>{from_double<S>(0.5), from_double<S>(0.25)})};
  const auto ground = half_space_of<S>({0, 1, 0}, 0), table = box_of<S>(2, 0.5, 2);
  Random random(23);
  for (const Primitive<S>& solid : solids) {
    for (const bool on_box : {false, true}) {
      std::set<std::uint32_t> names;
      for (int n = 0; n < 50; ++n) {
        const Point axis = {random.in(-1, 1), 0, random.in(-1, 1)};
        const Transform<S> t = at<S>({random.in(-0.01, 0.01), 0.249, 0}, axis, random.in(0, 2e-5));
        const Manifold<S> m = touch(on_box ? table : ground, at<S>({0, on_box ? -0.5 : 0.0, 0}), solid, t);
        ASSERT_EQ(m.count, 4);
        for (int i = 0; i < 4; ++i) names.insert(m.points[i].feature);
      }
      EXPECT_EQ(names.size(), 4u);
    }
  }
}

/// The content of a mesh of a box's twelve triangles.
template <class S> SurfaceContent<TriangleMesh> mesh_of_box(double half) {
  std::vector<Vec3<double>> points;
  for (int i = 0; i < 8; ++i)
    points.push_back({(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half});
  const std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<MeshTriangle> triangles;
  for (const auto& q : quads) {
    triangles.push_back({{q[0], q[1], q[2]}});
    triangles.push_back({{q[0], q[2], q[3]}});
  }
  SurfaceContent<TriangleMesh> content;
  content.surface = read_triangle_mesh(mesh_blob(points, triangles).value()->bytes()).value();
  return content;
}

TYPED_TEST(Revolved, a_box_of_triangles_is_touched_where_the_box_is) {
  using S = TypeParam;
  const SurfaceContent<TriangleMesh> content = mesh_of_box<S>(0.5);
  const Primitive<S> box = box_of<S>(0.5, 0.5, 0.5), mesh = primitive_of(Mesh<S>{1});
  Random random(24);
  for (const ShapeType type : kRound) {
    int touching = 0, elsewhere = 0;
    for (int n = 0; n < 60; ++n) {
      auto pair = TestFixture::placed(random, ShapeType::box, type, 0.6, 0, {0, 0, 0});
      pair.a = box;
      double low = 0, high = 4;
      const Point way = random.direction(), start = point_of(pair.ta.position);
      const double depth = random.in(-0.005, 0.015);
      for (int i = 0; i < 10; ++i) {
        const double middle = (low + high) / 2;
        pair.tb.position = vec_of<S>(start + way * middle);
        (ConvexOracle::separation({box, pair.ta}, {pair.b, pair.tb}) < -depth ? low : high) = middle;
      }
      pair.tb.position = vec_of<S>(start + way * high);
      const Manifold<S> solid = touch(box, pair.ta, pair.b, pair.tb);
      Manifold<S> found;
      collide(ShapeView<S>(mesh, &content), pair.ta, pair.b, pair.tb, from_double<S>(0.02), found);
      if (solid.count == 0) continue;
      ++touching;
      if (found.count == 0 || std::abs(deepest(found) - deepest(solid)) > 0.005) ++elsewhere;
    }
    EXPECT_GT(touching, 40);
    EXPECT_LE(elsewhere, 3);
  }
}

}  // namespace
}  // namespace isostep::test
