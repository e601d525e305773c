// Instances of hulls and meshes: mirrored and scaled point by point, with mass and contacts that follow.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/instance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/hull_content.hpp"
#include "isostep/geometry/baked/hull_mass.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/content.hpp"
#include "unit/geometry/hull_recipes.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace instance_test {

const Instance kMirrors[] = {{true, false, false, 0},
                             {false, true, false, 0},
                             {false, false, true, 0},
                             {true, true, false, 0},
                             {true, true, true, 0}};

std::vector<D3> drawn(int n) {
  scenes::Draws draws(static_cast<std::uint32_t>(n) + 77);
  std::vector<D3> points;
  for (const scenes::Point& p : scenes::drawn_hull(n, draws).points) points.push_back({p.x, p.y, p.z});
  return points;
}
BlobRef hull_of(const std::vector<D3>& points) { return hull_blob(std::span<const D3>(points)).value(); }
D3 moved(D3 p, const Instance& i) {
  const double size = std::ldexp(1.0, i.doublings);
  return {(i.mirror_x ? -p.x : p.x) * size, (i.mirror_y ? -p.y : p.y) * size, (i.mirror_z ? -p.z : p.z) * size};
}
std::string place_of(const Result<BlobRef>& result) {
  return result.ok() ? "" : std::string(result.error().place.view());
}

TEST(Instances, of_hulls_are_the_hulls_of_the_points_so_changed) {
  for (int n = 0; n < 40; ++n) {
    std::vector<D3> points = drawn(n);
    const auto on_grid = [](double v) { return std::round(v * 1024) / 1024; };
    for (D3& p : points) p = {on_grid(p.x), on_grid(p.y), on_grid(p.z)};
    const BlobRef blob = hull_of(points);
    for (Instance instance : kMirrors) {
      for (const int doublings : {-3, 0, 5, 9}) {
        instance.doublings = doublings;
        std::vector<D3> changed;
        for (const D3 p : points) changed.push_back(moved(p, instance));
        const Result<BlobRef> made = instance_of(*blob, instance);
        ASSERT_TRUE(made.ok()) << made.error().message.view();
        EXPECT_EQ(made.value()->id(), hull_of(changed)->id()) << n << ' ' << doublings;
        Instance back = instance;
        back.doublings = -doublings;
        EXPECT_EQ(instance_of(*made.value(), back).value()->id(), blob->id());
      }
    }
  }
}

TEST(Instances, of_hulls_have_the_same_volume_and_their_moments_to_two_digits) {
  for (int n = 0; n < 40; ++n) {
    const BlobRef blob = hull_of(drawn(n));
    const HullMass mass = hull_mass(read_hull(blob->bytes()).value().hull);
    for (const Instance& i : kMirrors) {
      const HullMass other = hull_mass(read_hull(instance_of(*blob, i).value()->bytes()).value().hull);
      const std::int64_t sign[3] = {i.mirror_x ? -1 : 1, i.mirror_y ? -1 : 1, i.mirror_z ? -1 : 1};
      EXPECT_EQ(other.volume6, mass.volume6);
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(std::abs(other.centre[k] - sign[k] * mass.centre[k]), 4) << n;
        EXPECT_LE(std::abs(other.variance[k] - mass.variance[k]), 4) << n;
        EXPECT_LE(std::abs(other.product[k] - sign[(k + 1) % 3] * sign[(k + 2) % 3] * mass.product[k]), 4) << n;
      }
    }
    Instance larger;
    larger.doublings = 1;
    const GridHull half = read_hull(blob->bytes()).value(),
                   whole = read_hull(instance_of(*blob, larger).value()->bytes()).value();
    if (half.exponent == whole.exponent) continue;
    EXPECT_EQ(whole.hull.vertices, half.hull.vertices) << "the grid grew with it: the same integers";
  }
}

template <class S> class InstancesOf : public testing::Test {};
TYPED_TEST_SUITE(InstancesOf, AllScalars);

template <class S> const HullContent<S>& content(const BlobRef& blob) {
  return *static_cast<const HullContent<S>*>(content_of<S>(*blob));
}

TYPED_TEST(InstancesOf, faces_and_vertices_are_mirrored_bit_for_bit) {
  using S = TypeParam;
  for (int n = 0; n < 40; ++n) {
    const BlobRef blob = hull_of(drawn(n)), mirrored = instance_of(*blob, kMirrors[0]).value();
    const HullContent<S>&one = content<S>(blob), &other = content<S>(mirrored);
    const Polyhedron<S> a = one.solid.polyhedron(), b = other.solid.polyhedron();
    ASSERT_EQ(a.faces.size(), b.faces.size());
    EXPECT_EQ(one.filled, other.filled) << "its volume";
    for (std::uint32_t f = 0; f < a.faces.size(); ++f) {
      bool found = false;
      for (std::uint32_t g = 0; g < b.faces.size(); ++g) {
        const Vec3<Unit<S>> normal = a.normals[f], image = b.normals[g];
        found = found || (image == Vec3<Unit<S>>{-normal.x, normal.y, normal.z} && a.offsets[f] == b.offsets[g]);
      }
      EXPECT_TRUE(found) << n << ' ' << f;
    }
  }
}

/// Two hulls that touch, and their mirror images at the mirrored places.
TYPED_TEST(InstancesOf, contacts_are_mirrored_too) {
  using S = TypeParam;
  const Primitive<S> hull = primitive_of(Hull<S>{1});
  const double digits = 16 * to_double(resolution<Unit<S>>()), depth = 16 * grain<S>();
  int touching = 0;
  for (int n = 0; n < 60; ++n) {
    const BlobRef a = hull_of(drawn(n)), b = hull_of(drawn(n + 500));
    const Vec3<S> at = vec<S>(0.28 + 0.01 * (n % 7), 0.11, -0.07 * (n % 5));
    Transform<S> here = Transform<S>::of(Pose<S>::identity()), there = here, there_mirrored = here;
    there.position = at;
    there_mirrored.position = {-at.x, at.y, at.z};
    const auto view = [&](const BlobRef& blob) { return ShapeView<S>{hull, content_of<S>(*blob)}; };
    const BlobRef mirrored_a = instance_of(*a, kMirrors[0]).value(), mirrored_b = instance_of(*b, kMirrors[0]).value();
    Manifold<S> found, mirrored;
    collide(view(a), here, view(b), there, num<S>(0.02), found);
    collide(view(mirrored_a), here, view(mirrored_b), there_mirrored, num<S>(0.02), mirrored);
    ASSERT_EQ(found.count, mirrored.count) << n;
    if (found.count == 0) continue;
    ++touching;
    const D3 normal = real(found.normal);
    expect_near(real(mirrored.normal), {-normal.x, normal.y, normal.z}, digits);
    const auto deepest = [](const Manifold<S>& m) {
      S least = m.points[0].separation;
      for (int i = 1; i < m.count; ++i) least = min(least, m.points[i].separation);
      return to_double(least);
    };
    EXPECT_NEAR(deepest(found), deepest(mirrored), depth) << n;
  }
  EXPECT_GT(touching, 30);
}

TEST(Instances, of_meshes_keep_their_outward_sides_ids_and_materials) {
  const std::vector<D3> points = {{0, 0, 0}, {0, 0.1, 1}, {1, 0.05, 0}, {1, 0.01, 1}};
  const std::vector<MeshTriangle> triangles = {{{0, 1, 2}}, {{3, 2, 1}}};
  const std::vector<std::uint8_t> numbers = {1, 0};
  const std::vector<SurfaceMaterial> table = {surface_material(0.5, 0).value(), surface_material(0, 0).value()};
  const BlobRef blob = mesh_blob(points, triangles, {numbers, table}).value();
  const TriangleMesh mesh = read_triangle_mesh(blob->bytes()).value();
  for (Instance instance : kMirrors) {
    instance.doublings = 2;
    const BlobRef made = instance_of(*blob, instance).value();
    const TriangleMesh other = read_triangle_mesh(made->bytes()).value();
    const std::int64_t x = instance.mirror_x ? -1 : 1, y = instance.mirror_y ? -1 : 1, z = instance.mirror_z ? -1 : 1;
    EXPECT_EQ(other.exponent(), mesh.exponent()) << "the points fit the grid";
    for (std::uint32_t id = 0; id < 2; ++id) {
      const GridVector n = mesh.corners(id).normal(), m = other.corners(id).normal();
      EXPECT_EQ(m, (GridVector{16 * x * n.x, 16 * y * n.y, 16 * z * n.z})) << "outward";
      const MeshPoint p = mesh.corners(id).points[0], q = other.corners(id).points[0];
      EXPECT_TRUE(q == (MeshPoint{static_cast<int>(4 * x) * p.x, static_cast<int>(4 * y) * p.y,
                                  static_cast<int>(4 * z) * p.z}));
      EXPECT_EQ(other.material(id), mesh.material(id));
    }
    EXPECT_EQ(other.table().size(), 2u);
    instance.doublings = -2;
    EXPECT_EQ(instance_of(*made, instance).value()->id(), blob->id());
  }
}

TEST(Instances, what_leaves_the_grid_is_refused) {
  const BlobRef hull = hull_of({{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, 0, 0.0000153}});
  const auto scaled = [](const BlobRef& blob, int doublings) {
    return place_of(instance_of(*blob, {false, false, false, doublings}));
  };
  EXPECT_EQ(scaled(hull, 16), "");
  EXPECT_EQ(scaled(hull, 17), "doublings");
  EXPECT_EQ(scaled(hull, 1000000000), "doublings");
  EXPECT_EQ(scaled(hull, -1), "doublings") << "a point is one step from the origin";
  const BlobRef field = height_field_blob({2, 2, 1}, std::vector<double>(4, 0)).value();
  EXPECT_EQ(scaled(field, 0), "type");
}

}  // namespace instance_test
}  // namespace isostep::test
