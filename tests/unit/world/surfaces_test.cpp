// Meshes and height fields as shapes of worlds: what slides, rests, rolls and is asked for on them.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace surfaces_test {

using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
using Heights = double (*)(int i, int k);

constexpr int kCells = 20;
constexpr double kPitch = 0.5, kHalf = 5;  // [m]

double plain(int, int) { return 0; }
double roof(int i, int) { return i <= kCells / 2 ? 0.25 * i : 0.25 * (kCells - i); }
double valley(int i, int k) { return -roof(i, k); }

template <class S> class Surfaces : public testing::TestWithParam<int> {
 protected:
  /// A ground of `heights` [m], centred on the world's origin.
  static Child<S> ground(Heights heights, bool field, std::vector<BlobRef>& blobs) {
    std::vector<double> sheet;
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (int k = 0; k <= kCells; ++k) {
      for (int i = 0; i <= kCells; ++i) {
        sheet.push_back(heights(i, k));
        points.push_back({kPitch * i - kHalf, heights(i, k), kPitch * k - kHalf});
        if (i == kCells || k == kCells) continue;
        const auto at = static_cast<std::uint32_t>(k * (kCells + 1) + i), below = at + kCells + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    if (field) blobs.push_back(height_field_blob({kCells + 1, kCells + 1, kPitch}, sheet).value());
    else blobs.push_back(mesh_blob(points, triangles).value());
    const auto name = static_cast<std::uint32_t>(blobs.size());
    if (!field) return {primitive_of(Mesh<S>{name}), Pose<S>::identity()};
    return {primitive_of(HeightField<S>{name}), {vec<S>(-kHalf, 0, -kHalf), Quat<Unit<S>>::identity()}};
  }
  static BodyId add(World<S>& world, Heights heights, bool field, double friction) {
    std::vector<BlobRef> blobs;
    const Child<S> child = ground(heights, field, blobs);
    BodyDefinition<S> d = still<S>(world.add_shape(std::span<const Child<S>>(&child, 1), blobs));
    d.material.friction = num<S>(friction);
    return world.create(d);
  }
  static ShapeId add_prism(World<S>& world) {
    std::vector<D3> points;
    for (int i = 0; i < 8; ++i) {
      const double x = 0.25 * isostep::cos(i * 0.785398), z = 0.25 * isostep::sin(i * 0.785398);
      points.push_back({x, 0.25, z});
      points.push_back({x, -0.25, z});
    }
    const std::vector<BlobRef> blobs = {hull_blob(std::span<const D3>(points)).value()};
    const Child<S> child = {primitive_of(Hull<S>{1}), Pose<S>::identity()};
    return world.add_shape(std::span<const Child<S>>(&child, 1), blobs);
  }
};
TYPED_TEST_SUITE(Surfaces, Scalars);

TYPED_TEST(Surfaces, what_slides_over_a_flat_one_feels_no_edge) {
  using S = TypeParam;
  using U = Unit<S>;
  for (const bool field : {false, true}) {
    World<S> world(settings<S>(-10));
    this->add(world, plain, field, 0);
    const ShapeId shapes[] = {add_ball(world, 0.25), world.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.2)}),
                              add_box(world, 0.25, 0.25, 0.25), this->add_prism(world)};
    std::vector<BodyId> bodies;
    for (int n = 0; n < 4; ++n) {
      BodyDefinition<S> d = moving<S>(shapes[n], {-4.5, 0.25, -1.8 + n});
      d.velocity = vec<S>(4, 0, 0.6);
      d.material.friction = S(0);
      d.allow_sleep = false;
      if (n == 1) d.orientation = normalise(Quat<U>{U(0.5), U(0), U(0), U(0.5)});
      bodies.push_back(world.create(d));
    }
    double rise = 0, spin = 0;
    for (int frame = 0; frame < 120; ++frame) {
      ASSERT_TRUE(world.step().clean());
      if (frame < 30) continue;
      for (const BodyId body : bodies) {
        rise = std::max(rise, std::fabs(to_double(world.velocity(body).y)));
        spin = std::max(spin, to_double(length(world.angular_velocity(body))));
      }
    }
    EXPECT_LT(rise, 0.002);
    EXPECT_LT(spin, 0.004);
    for (const BodyId body : bodies) EXPECT_GT(to_double(world.pose(body).position.x), 3);
  }
}

TYPED_TEST(Surfaces, bodies_come_to_rest_in_a_valley_and_sleep) {
  using S = TypeParam;
  for (const bool field : {false, true}) {
    World<S> world(settings<S>(-10));
    this->add(world, valley, field, 0.8);
    std::vector<BodyId> bodies;
    const ShapeId shapes[] = {world.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.2)}), add_box(world, 0.25, 0.25, 0.25),
                              this->add_prism(world)};
    for (int n = 0; n < 3; ++n) {
      BodyDefinition<S> d = moving<S>(shapes[n], {0.3, -1.5, -2.0 + 2 * n});
      d.material.rolling_resistance = num<S>(0.05);
      d.material.friction = num<S>(0.8);
      bodies.push_back(world.create(d));
    }
    EXPECT_TRUE(settle(world, 1200));
    for (const BodyId body : bodies) {
      const Vec3<S> at = world.pose(body).position;
      EXPECT_GT(to_double(at.y), -2.5);
      EXPECT_LT(std::fabs(to_double(at.x)), 2);
    }
  }
}

TYPED_TEST(Surfaces, rays_hit_them_from_outside_and_never_pass_between_triangles) {
  using S = TypeParam;
  constexpr double kError = std::same_as<S, Q16_16> ? 1e-3 : 1e-5;  // [m]
  for (const bool field : {false, true}) {
    World<S> world(settings<S>(0));
    this->add(world, roof, field, 0);
    for (int i = 0; i <= 4 * kCells; ++i) {
      const double x = -kHalf + i * kPitch / 4, ridge = 2.5 - 0.5 * std::fabs(x);
      for (const double z : {-1.25, 0.0, 0.1, 3.5}) {  // along edges, through points, beside them
        if (std::fabs(x) == kHalf) continue;
        const auto hit = world.cast_ray(vec<S>(x, 6, z), vec<S>(0, -12, 0));
        ASSERT_TRUE(hit) << x << ' ' << z;
        EXPECT_NEAR(to_double(hit->point.y), ridge, kError);
        EXPECT_GT(to_double(hit->normal.y), 0.8);
        EXPECT_FALSE(world.cast_ray(vec<S>(x, -6, z), vec<S>(0, 12, 0)));
      }
    }
  }
}

TYPED_TEST(Surfaces, answer_nearest_points_and_overlaps) {
  using S = TypeParam;
  for (const bool field : {false, true}) {
    World<S> world(settings<S>(0));
    const BodyId body = this->add(world, roof, field, 0);
    const auto nearest = world.closest_point(vec<S>(0, 4, 0.3), S(8));
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->body, body);
    EXPECT_NEAR(to_double(nearest->distance), 1.5, 1e-3);
    std::vector<BodyId> found;
    const Primitive<S> ball = primitive_of(Sphere<S>{num<S>(0.5)});
    world.overlap_shape(ball, {vec<S>(0, 2.9, 0), Quat<Unit<S>>::identity()}, found, {});
    EXPECT_EQ(found.size(), 1u);
    world.overlap_shape(ball, {vec<S>(0, 3.1, 0), Quat<Unit<S>>::identity()}, found, {});
    EXPECT_EQ(found.size(), 1u);
  }
}

TYPED_TEST(Surfaces, are_for_static_bodies) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  std::vector<BlobRef> blobs;
  const Child<S> child = this->ground(plain, false, blobs);
  const ShapeId shape = world.add_shape(std::span<const Child<S>>(&child, 1), blobs);
  ASSERT_TRUE(shape);
  EXPECT_FALSE(world.create(moving<S>(shape, {0, 1, 0})));
}

TYPED_TEST(Surfaces, several_in_one_body_beside_a_convex_part_all_hold) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  std::vector<BlobRef> blobs;
  std::vector<Child<S>> children = {this->ground(plain, false, blobs), this->ground(plain, true, blobs),
                                    part_at(primitive_of(Box<S>{vec<S>(1, 1, 1)}), {12, 0, 0})};
  children[1].pose.position.x += S(24);
  world.create(still<S>(world.add_shape(std::span<const Child<S>>(children), blobs)));
  const ShapeId box = add_box(world, 0.25, 0.25, 0.25);
  const BodyId on[] = {world.create(moving<S>(box, {0.1, 0.5, 0.2})), world.create(moving<S>(box, {24.1, 0.5, 0.2})),
                       world.create(moving<S>(box, {12, 1.5, 0}))};
  EXPECT_TRUE(settle(world));
  EXPECT_NEAR(to_double(world.pose(on[0]).position.y), 0.25, 0.005);
  EXPECT_NEAR(to_double(world.pose(on[1]).position.y), 0.25, 0.005);
  EXPECT_NEAR(to_double(world.pose(on[2]).position.y), 1.25, 0.005);
}

}  // namespace surfaces_test
}  // namespace isostep::test
