// Cylinders and cones: features that stay as they roll and stand, and a box of triangles beside the box. The laws that
// they share with all shapes are in every_pair_test.cpp.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/collision/narrowphase/support_oracle.hpp"
#include "unit/geometry/oracle.hpp"

namespace isostep::test {
namespace revolved_test {

using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

template <class S> class Revolved : public testing::Test {};
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
        const double tilt = random.in(0, 2e-5), x = random.in(-0.01, 0.01);
        const Transform<S> t = at<S>({x, 0.249, 0}, axis, tilt);
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
  const Primitive<S> mesh = primitive_of(Mesh<S>{1});
  const DrawnShape box = box_shape(0.5, 0.5, 0.5);
  Random random(24);
  for (const ShapeType type : kRound) {
    int touching = 0, elsewhere = 0;
    for (int n = 0; n < 60; ++n) {
      const DrawnShape round = ShapeDrawer::draw(random, type, 0);
      const Transform<S> ta = random_pose<S>(random, 0.01);
      Transform<S> tb = random_pose<S>(random, 0.01);
      const Point way = random.direction();
      const double depth = random.in(-0.005, 0.015);
      const PlacedShape in_a(box, oracle::real(ta), {0, 0, 0});
      PlacedShape in_b(round, oracle::real(tb), {0, 0, 0});
      double low = 0, high = 4;
      for (int i = 0; i < 12; ++i) {
        const double middle = (low + high) / 2;
        in_b.move_to(in_a.at() + way * middle);
        (SupportOracle(in_a, in_b).best().separation < -depth ? low : high) = middle;
      }
      tb.position = vec_of<S>(in_a.at() + way * high);
      const Manifold<S> solid = touch(box.primitive<S>(), ta, round.primitive<S>(), tb);
      Manifold<S> found;
      collide(ShapeView<S>(mesh, &content), ta, round.primitive<S>(), tb, from_double<S>(0.02), found);
      if (solid.count == 0) continue;
      ++touching;
      if (found.count == 0 || std::abs(deepest(found) - deepest(solid)) > 0.005) ++elsewhere;
    }
    EXPECT_GT(touching, 40);
    EXPECT_LE(elsewhere, 3);
  }
}

}  // namespace revolved_test
}  // namespace isostep::test
