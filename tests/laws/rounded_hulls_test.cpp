// Hulls with a radius: they stand, slide over the edges of a floor without a bump, and lie in piles that come to rest.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "random/dice.hpp"
#include "random/hull.hpp"

namespace isostep::test {
namespace rounded_hulls_test {

constexpr int kCells = 16;
constexpr double kPitch = 0.5;

template <class S> class RoundedHulls : public ::testing::Test {
 protected:
  using U = Unit<S>;

  /// A mesh: flat, or a bowl that rises by `bowl` times the square of the distance from its middle.
  static void add_floor(World<S>& world, double bowl, double friction) {
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    const double half = kCells * kPitch / 2;
    for (int k = 0; k <= kCells; ++k) {
      for (int i = 0; i <= kCells; ++i) {
        const double x = kPitch * i - half, z = kPitch * k - half;
        points.push_back({x, bowl * (x * x + z * z), z});
        if (i == kCells || k == kCells) continue;
        const auto at = static_cast<std::uint32_t>(k * (kCells + 1) + i), below = at + kCells + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    const BlobRef blob = mesh_blob(points, triangles).value();
    BodyDefinition<S> d = still<S>(world.add_shape(blob));
    d.material.friction = num<S>(friction);
    world.create(d);
  }
  static BlobRef slab(double x, double y, double z) {
    std::vector<D3> points;
    for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
    return hull_blob(std::span<const D3>(points)).value();
  }
  static BodyDefinition<S> awake(ShapeId shape, D3 at, double friction) {
    BodyDefinition<S> d = moving<S>(shape, at);
    d.material.friction = num<S>(friction);
    d.mass = S(1);
    d.allow_sleep = false;
    return d;
  }
  static double energy_of(const World<S>& w, const std::vector<BodyId>& bodies) {
    double energy = 0;
    for (const BodyId body : bodies) {
      const D3 v = real(w.velocity(body));
      energy += 0.5 * dot(v, v) + 10 * to_double(w.pose(body).position.y);
    }
    return energy;
  }
};
TYPED_TEST_SUITE(RoundedHulls, AllScalars);

TYPED_TEST(RoundedHulls, a_tower_stands_on_a_mesh) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  this->add_floor(world, 0, 0.6);
  const ShapeId shape = add_hull(world, this->slab(0.2, 0.15, 0.2), 0.05);  // 0.4 high
  std::vector<BodyId> bodies;
  for (int n = 0; n < 8; ++n) {
    BodyDefinition<S> d = this->awake(shape, {0.1, 0.2 + 0.4 * n, 0.05}, 0.6);
    d.orientation = turn<S>({0, 1, 0}, 0.2 * n);
    bodies.push_back(world.create(d));
  }
  run(world, 600);
  for (int n = 0; n < 8; ++n) {
    const D3 at = real(world.pose(bodies[static_cast<std::size_t>(n)]).position);
    EXPECT_LT(std::hypot(at.x - 0.1, at.z - 0.05), pick<S>(2e-3, 1e-3, 0.02, 1e-3)) << n;
    EXPECT_NEAR(at.y, 0.2 + 0.4 * n, 0.003 * (n + 1)) << n;
    EXPECT_LT(length(real(world.velocity(bodies[static_cast<std::size_t>(n)]))), pick<S>(1e-3, 1e-3, 0.01, 1e-3));
  }
}

TYPED_TEST(RoundedHulls, one_slides_over_inner_edges_without_a_bump) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  this->add_floor(world, 0, 0);
  BodyDefinition<S> d = this->awake(add_hull(world, this->slab(0.2, 0.1, 0.15), 0.05), {-2.5, 0.15, -0.3}, 0);
  d.orientation = turn<S>({0, 1, 0}, 0.4);
  d.velocity = vec<S>(2, 0, 0.3);
  const BodyId body = world.create(d);
  double rise = 0, spin = 0;
  for (int frame = 0; frame < 120; ++frame) {
    ASSERT_TRUE(world.step().clean());
    if (frame < 30) continue;
    rise = std::max(rise, std::fabs(to_double(world.velocity(body).y)));
    spin = std::max(spin, length(real(world.angular_velocity(body))));
  }
  EXPECT_LT(rise, 0.002);
  EXPECT_LT(spin, pick<S>(2e-3, 1e-3, 0.02, 1e-3));
  EXPECT_NEAR(to_double(world.velocity(body).x), 2, pick<S>(1e-3, 1e-3, 0.01, 1e-3));
}

TYPED_TEST(RoundedHulls, piles_of_them_on_a_mesh_gain_no_energy_and_come_to_rest) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  this->add_floor(world, 0.1, 0.6);
  Dice dice(5);
  std::vector<ShapeId> shapes;
  for (int n = 0; n < 12; ++n) {
    const D3 half = {dice.in(0.1, 0.25), dice.in(0.1, 0.25), dice.in(0.1, 0.25)};
    shapes.push_back(add_hull(world, draw_hull(dice, half), n % 4 == 3 ? 0.0 : 0.02 + 0.03 * (n % 4)));
  }
  shapes.push_back(add_box(world, 0.15, 0.2, 0.15));
  shapes.push_back(world.add_shape(Cylinder<S>{num<S>(0.15), num<S>(0.2)}));
  shapes.push_back(world.add_shape(Capsule<S>{num<S>(0.12), num<S>(0.15)}));
  std::vector<BodyId> bodies;
  for (int n = 0; n < 45; ++n) {
    const D3 at = {0.75 * (n % 3 - 1), 0.7 + 0.75 * (n / 9), 0.75 * (n / 3 % 3 - 1)};
    BodyDefinition<S> d = this->awake(shapes[static_cast<std::size_t>(n) % shapes.size()], at, 0.6);
    d.orientation = turn<S>({0.6, 0, 0.8}, 0.7 * n);
    d.material.rolling_resistance = num<S>(0.02);
    bodies.push_back(world.create(d));
  }
  const double bound = this->energy_of(world, bodies);
  double most = -1e9, fastest = 0;
  for (int frame = 0; frame < 1080; ++frame) {
    world.step();
    most = std::max(most, this->energy_of(world, bodies));
    if (frame < 1020) continue;
    for (const BodyId body : bodies) fastest = std::max(fastest, length(real(world.velocity(body))));
  }
  EXPECT_LT(most, bound + 0.5);
  EXPECT_LT(fastest, pick<S>(0.1, 0.1, 0.3, 0.1));
  for (const BodyId body : bodies) {
    const D3 at = real(world.pose(body).position);
    EXPECT_GT(at.y - 0.1 * (at.x * at.x + at.z * at.z), 0.03);
  }
}

TYPED_TEST(RoundedHulls, a_fast_one_does_not_pass_a_thin_wall) {
  using S = TypeParam;
  for (int n = 0; n < 12; ++n) {
    World<S> world(settings<S>(0));
    world.create(still<S>(add_box(world, 0.02, 4, 4)));
    BodyDefinition<S> d = this->awake(add_hull(world, this->slab(0.05, 0.02, 0.1), 0.03), {-2 - 0.13 * n, 0, 0}, 0.5);
    d.orientation = turn<S>({0.6, 0, 0.8}, 0.5 * n);
    d.velocity = vec<S>(50, 0, 0);
    d.angular_velocity = vec<S>(0, 3.0 * n, 0);
    const BodyId body = world.create(d);
    for (int frame = 0; frame < 20; ++frame) world.step();  // Q16.16 may tell of a spin beyond its range
    EXPECT_LT(to_double(world.pose(body).position.x), 0) << n;
  }
}

/// Its corners are over triangles whose edges its own edges cross, nearer than the corners.
TYPED_TEST(RoundedHulls, lie_on_a_mesh_and_not_in_it) {
  using S = TypeParam;
  for (const double radius : {0.01, 0.02, 0.05}) {
    World<S> world(settings<S>(-10));
    this->add_floor(world, 0, 0.6);
    const double a = 0.2;
    const std::vector<D3> corners = {{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}};
    const ShapeId shape = add_hull(world, hull_blob(std::span<const D3>(corners)).value(), radius);
    BodyDefinition<S> d = this->awake(shape, {0.13, 0.5, 0.31}, 0.5);
    d.orientation = turn<S>({0.7956, 0.2387, 0.5569}, 0.8);
    const BodyId body = world.create(d);
    run(world, 120);
    double lowest = 1;
    for (int i = 0; i < 120; ++i) {
      world.step();
      for (const D3 corner : corners) {
        const double height = rotated<S>(world.pose(body).orientation, corner).y - radius;
        lowest = std::min(lowest, to_double(world.center_of_mass(body).y) + height);
      }
    }
    EXPECT_GT(lowest, -0.005) << "radius " << radius;
  }
}

}  // namespace rounded_hulls_test
}  // namespace isostep::test
