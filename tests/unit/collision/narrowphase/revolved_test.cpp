// Cylinders and cones against every convex shape: separations beside an oracle that knows no features, points on both
// surfaces, mirrored order, features that stay.
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
  static double smallest(const Primitive<S>& p) {
    if (p.type == ShapeType::half_space) return 1e9;
    if (p.type == ShapeType::sphere || p.type == ShapeType::capsule) return to_double(p.radius);
    if (p.type == ShapeType::box) return to_double(min(p.half.x, min(p.half.y, p.half.z)));
    return to_double(min(p.radius, p.half.y));
  }
};
TYPED_TEST_SUITE(Revolved, Scalars);

constexpr ShapeType kOthers[] = {ShapeType::sphere,     ShapeType::box,      ShapeType::capsule,
                                 ShapeType::half_space, ShapeType::cylinder, ShapeType::cone};
constexpr ShapeType kRound[] = {ShapeType::cylinder, ShapeType::cone};

/// What prefers faces may lose 1/128 of the smaller inner radius twice, rims of two 1/1000, and the points of a disc on
/// a face 0.0006 radii; a face that the lowest point is beside shows what is over it.
TYPED_TEST(Revolved, the_deepest_point_is_as_deep_as_the_shapes_overlap) {
  using S = TypeParam;
  Random random(20);
  for (const ShapeType a : kOthers) {
    for (const ShapeType b : kRound) {
      int touching = 0, far_off = 0;
      for (int n = 0; n < 40; ++n) {
        const double depth = random.in(-0.015, 0.03);
        const Point far = n % 4 == 3 ? Point{20, -15, 30} : Point{0, 0, 0};
        const auto pair = TestFixture::placed(random, a, b, 1, depth, far);
        const Convex solid_a(pair.a, pair.ta), solid_b(pair.b, pair.tb);
        const double truth = ConvexOracle::separation(solid_a, solid_b);
        const Manifold<S> m = touch(pair.a, pair.ta, pair.b, pair.tb, 0.02);
        const double noise = 40 * rounding<S>(length3(far) + 4) + 1e-6;
        if (m.count == 0) {
          EXPECT_GT(truth, -noise) << static_cast<int>(a) << " " << static_cast<int>(b) << " " << n;
          continue;
        }
        ++touching;
        const double small = std::min(TestFixture::smallest(pair.a), TestFixture::smallest(pair.b));
        const double along =
            a == ShapeType::half_space ? truth : ConvexOracle::along(solid_a, solid_b, point_of(m.normal));
        EXPECT_LT(along, truth + 0.002 + noise) << static_cast<int>(a) << " " << static_cast<int>(b) << " " << n;
        EXPECT_GT(along, truth - small / 60 - noise) << static_cast<int>(a) << " " << static_cast<int>(b) << " " << n;
        if (std::abs(deepest(m) - along) > 0.002 + small / 60 + noise) ++far_off;
      }
      EXPECT_GT(touching, 25) << static_cast<int>(a) << " " << static_cast<int>(b);
      EXPECT_LE(far_off, 2) << static_cast<int>(a) << " " << static_cast<int>(b);
    }
  }
}

TYPED_TEST(Revolved, points_lie_midway_between_the_surfaces_and_have_names_of_their_own) {
  using S = TypeParam;
  Random random(21);
  for (const ShapeType a : kOthers) {
    for (const ShapeType b : kRound) {
      for (int n = 0; n < 25; ++n) {
        const auto pair = TestFixture::placed(random, a, b, 1, random.in(-0.01, 0.01), {0, 0, 0});
        const Convex solid_a(pair.a, pair.ta), solid_b(pair.b, pair.tb);
        const Manifold<S> m = touch(pair.a, pair.ta, pair.b, pair.tb, 0.02);
        std::set<std::uint32_t> names;
        const Point normal = point_of(m.normal);
        for (int i = 0; i < m.count; ++i) {
          const Point p = point_of(m.points[i].position);
          const double half = to_double(m.points[i].separation) / 2;
          EXPECT_LT(solid_a.distance(p - normal * half), 0.03)
              << static_cast<int>(a) << static_cast<int>(b) << " " << n;
          EXPECT_LT(solid_b.distance(p + normal * half), 0.03)
              << static_cast<int>(a) << static_cast<int>(b) << " " << n;
          names.insert(m.points[i].feature);
        }
        EXPECT_EQ(names.size(), static_cast<std::size_t>(m.count));
        EXPECT_NEAR(length3(normal), m.count > 0 ? 1 : 0, 1e-4);
      }
    }
  }
}

TYPED_TEST(Revolved, the_other_order_gives_the_same_mirrored) {
  using S = TypeParam;
  Random random(22);
  for (const ShapeType a : kOthers) {
    for (const ShapeType b : kRound) {
      for (int n = 0; n < 15; ++n) {
        const auto pair = TestFixture::placed(random, a, b, 1, random.in(-0.01, 0.01), {0, 0, 0});
        const Manifold<S> m = touch(pair.a, pair.ta, pair.b, pair.tb), w = touch(pair.b, pair.tb, pair.a, pair.ta);
        ASSERT_EQ(m.count, w.count) << static_cast<int>(a) << static_cast<int>(b) << " " << n;
        EXPECT_LE(length3(point_of(m.normal) + point_of(w.normal)), a == b ? 0.02 : 0.0);
      }
    }
  }
}

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
