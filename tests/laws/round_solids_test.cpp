// Cylinders and cones: they roll without bumps, stand without wandering, and do not sink.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace round_solids_test {

enum class Floor { plane, mesh, field };
constexpr Floor kFloors[] = {Floor::plane, Floor::mesh, Floor::field};
constexpr int kCells = 25;  // so that no edge is in the middle
constexpr double kPitch = 1;

template <class S> class RoundSolids : public ::testing::Test {
 protected:
  using U = Unit<S>;

  static void add_floor(World<S>& world, Floor kind) {
    if (kind == Floor::plane) {
      add_ground(world);
      return;
    }
    std::vector<double> heights((kCells + 1) * (kCells + 1), 0.0);
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    const double half = kCells * kPitch / 2;
    for (int k = 0; k <= kCells; ++k) {
      for (int i = 0; i <= kCells; ++i) {
        points.push_back({kPitch * i - half, 0, kPitch * k - half});
        if (i == kCells || k == kCells) continue;
        const auto at = static_cast<std::uint32_t>(k * (kCells + 1) + i), below = at + kCells + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    std::vector<BlobRef> blobs;
    Child<S> child = {{}, Pose<S>::identity()};
    if (kind == Floor::mesh) {
      blobs.push_back(mesh_blob(points, triangles).value());
      child.primitive = primitive_of(Mesh<S>{1});
    } else {
      blobs.push_back(height_field_blob({kCells + 1, kCells + 1, kPitch}, heights).value());
      child = {primitive_of(HeightField<S>{1}), {vec<S>(-half, 0, -half), Quat<U>::identity()}};
    }
    BodyDefinition<S> d = still<S>(world.add_shape(std::span<const Child<S>>(&child, 1), blobs));
    d.material.friction = num<S>(0.6);
    world.create(d);
  }
  static BodyDefinition<S> awake(ShapeId shape, D3 at) {
    BodyDefinition<S> d = moving<S>(shape, at);
    d.material.friction = num<S>(0.6);
    d.allow_sleep = false;
    return d;
  }
  static ShapeId cylinder(World<S>& w, double radius, double half_height) {
    return w.add_shape(Cylinder<S>{num<S>(radius), num<S>(half_height)});
  }
  static ShapeId cone(World<S>& w, double radius, double half_height) {
    return w.add_shape(Cone<S>{num<S>(radius), num<S>(half_height)});
  }
  static double y_of(const World<S>& w, BodyId body) { return to_double(w.pose(body).position.y); }
  /// The body's own axis.
  static D3 axis_of(const World<S>& w, BodyId body) { return rotated<S>(w.pose(body).orientation, {0, 1, 0}); }
  static double energy_of(const World<S>& w, const std::vector<BodyId>& bodies, double gravity) {
    double energy = 0;
    for (const BodyId body : bodies) {
      const D3 v = real(w.velocity(body));
      energy += 0.5 * dot(v, v) + gravity * y_of(w, body);
    }
    return energy;
  }
};
TYPED_TEST_SUITE(RoundSolids, AllScalars);

TYPED_TEST(RoundSolids, a_cylinder_rolls_for_ten_seconds_without_a_bump) {
  using S = TypeParam;
  for (const Floor floor : kFloors) {
    World<S> world(settings<S>(-10));
    this->add_floor(world, floor);
    BodyDefinition<S> d = this->awake(this->cylinder(world, 0.5, 0.3), {-5, 0.5, 0.1});
    const double heading = 0.2;  // across the edges of a surface
    d.orientation = turn<S>({0, 1, 0}, heading) * turn<S>({1, 0, 0}, kPi / 2);
    d.velocity = vec<S>(std::cos(heading), 0, -std::sin(heading));
    d.angular_velocity = vec<S>(-2 * std::sin(heading), 0, -2 * std::cos(heading));
    const BodyId body = world.create(d);
    double rise = 0;
    for (int frame = 0; frame < 600; ++frame) {
      ASSERT_TRUE(world.step().clean());
      if (frame >= 60) rise = std::max(rise, std::fabs(to_double(world.velocity(body).y)));
    }
    const double speed = length(real(world.velocity(body)));
    EXPECT_LT(rise, 0.002) << static_cast<int>(floor);
    EXPECT_NEAR(speed, 1, pick<S>(1e-3, 1e-3, 0.02, 1e-3)) << static_cast<int>(floor);
    EXPECT_NEAR(this->y_of(world, body), 0.5, 0.006);
  }
}

TYPED_TEST(RoundSolids, what_stands_on_a_disc_does_not_wander) {
  using S = TypeParam;
  for (const Floor floor : kFloors) {
    World<S> world(settings<S>(-10));
    this->add_floor(world, floor);
    std::vector<BodyId> bodies;
    const double heights[] = {0.5, 0.4, 0.05};
    const ShapeId shapes[] = {this->cylinder(world, 0.3, 0.5), this->cone(world, 0.4, 0.4),
                              this->cylinder(world, 0.6, 0.05)};
    for (int n = 0; n < 3; ++n) {
      BodyDefinition<S> d = this->awake(shapes[n], {0.3 + 2 * n, heights[n], 0.1});
      d.orientation = turn<S>({0, 1, 0}, 0.3 + n);
      bodies.push_back(world.create(d));
    }
    run(world, 600);
    for (int n = 0; n < 3; ++n) {
      const D3 at = real(world.pose(bodies[static_cast<std::size_t>(n)]).position);
      const double wandered = std::hypot(at.x - 0.3 - 2 * n, at.z - 0.1);
      EXPECT_LT(wandered, pick<S>(1e-3, 1e-4, 0.01, 1e-4)) << n;
      EXPECT_GT(at.y, heights[n] - 0.006);
      EXPECT_GT(this->axis_of(world, bodies[static_cast<std::size_t>(n)]).y, 0.9999);
    }
  }
}

/// About its apex, which stays: omega along the line that touches, of size Omega / tan(half the angle at the apex).
TYPED_TEST(RoundSolids, a_cone_rolls_in_a_circle) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  add_ground(world);
  const double r = 0.4, h = 0.5, half_angle = std::atan2(r, 2 * h), slow = 0.5;  // [rad/s] around the apex
  const D3 axis = {-std::cos(half_angle), -std::sin(half_angle), 0};             // to the apex, which is at the origin
  BodyDefinition<S> d = this->awake(this->cone(world, r, h), axis * -h);
  d.orientation = turn<S>({0, 0, 1}, kPi / 2 + half_angle);
  const D3 spin = {-slow / std::tan(half_angle), 0, 0};
  d.angular_velocity = vec<S>(spin);
  d.velocity = vec<S>(cross(spin, axis * (-1.5 * h)));  // of the centre of mass
  const BodyId body = world.create(d);
  const double at_first = length(real(world.velocity(body)));
  double away = 0, rise = 0;
  for (int frame = 0; frame < 600; ++frame) {
    world.step();
    const D3 apex = real(world.pose(body).position) + this->axis_of(world, body) * h;
    away = std::max(away, std::hypot(apex.x, apex.z));
    if (frame > 60) rise = std::max(rise, std::fabs(to_double(world.velocity(body).y)));
  }
  const D3 apex = real(world.pose(body).position) + this->axis_of(world, body) * h;
  EXPECT_LT(std::fabs(apex.y), 0.006);
  EXPECT_LT(away, 0.05);
  EXPECT_LT(rise, 0.004);
  EXPECT_GT(length(real(world.velocity(body))), 0.9 * at_first);
}

TYPED_TEST(RoundSolids, thin_discs_do_not_sink) {
  using S = TypeParam;
  for (const Floor floor : kFloors) {
    World<S> world(settings<S>(-10));
    this->add_floor(world, floor);
    const ShapeId disc = this->cylinder(world, 0.5, 0.02);
    std::vector<BodyId> bodies;
    for (int n = 0; n < 6; ++n) {
      BodyDefinition<S> d = this->awake(disc, {0.02 * n, 0.05 + 0.06 * n, 0.2});
      d.orientation = turn<S>({0.8, 0, 0.6}, n % 2 == 0 ? 0.05 : 0.0);
      bodies.push_back(world.create(d));
    }
    for (int i = 0; i < 600; ++i) world.step();
    for (int n = 0; n < 6; ++n) {
      const double y = this->y_of(world, bodies[static_cast<std::size_t>(n)]);
      EXPECT_GT(y, 0.02 + 0.04 * n - 0.008 * (n + 1)) << n;
      EXPECT_LT(y, 0.02 + 0.04 * n + 0.01) << n;
    }
  }
}

TYPED_TEST(RoundSolids, piles_of_them_gain_no_energy_and_come_to_rest) {
  using S = TypeParam;
  World<S> world(settings<S>(-10));
  add_ground(world);
  const ShapeId shapes[] = {this->cylinder(world, 0.2, 0.3), this->cone(world, 0.3, 0.25),
                            add_box(world, 0.2, 0.2, 0.2), world.add_shape(Capsule<S>{num<S>(0.15), num<S>(0.2)}),
                            add_ball(world, 0.2)};
  for (const double side : {-1.0, 1.0}) {
    world.create(still<S>(add_box(world, 0.2, 1, 1.5), {1.2 * side, 1, 0}));
    world.create(still<S>(add_box(world, 1.5, 1, 0.2), {0, 1, 1.2 * side}));
  }
  std::vector<BodyId> bodies;
  for (int n = 0; n < 28; ++n) {  // four in a layer, none in another
    const int kind = n % 3 == 0 ? 0 : n % 3 == 1 ? 1 : 2 + n / 3 % 3;
    const D3 at = {n % 2 == 0 ? 0.43 : -0.43, 0.5 + 0.85 * (n / 4), n / 2 % 2 == 0 ? 0.43 : -0.43};
    BodyDefinition<S> d = this->awake(shapes[kind], at);
    d.mass = S(1);
    d.orientation = turn<S>({0.6, 0, 0.8}, 0.7 * n);
    d.material.rolling_resistance = num<S>(0.02);
    bodies.push_back(world.create(d));
  }
  const double bound = this->energy_of(world, bodies, 10);
  double most = -1e9, fastest = 0;
  for (int frame = 0; frame < 900; ++frame) {
    world.step();
    most = std::max(most, this->energy_of(world, bodies, 10));
    if (frame < 840) continue;
    for (const BodyId body : bodies) fastest = std::max(fastest, length(real(world.velocity(body))));
  }
  EXPECT_LT(most, bound + 0.5);
  EXPECT_LT(fastest, pick<S>(0.06, 0.05, 0.2, 0.06));
  for (const BodyId body : bodies) EXPECT_GT(this->y_of(world, body), 0.1);
}

/// An edge along a cone's axis is nearest level with its base.
TYPED_TEST(RoundSolids, a_cone_beside_the_corner_of_a_pillar_is_left_alone) {
  using S = TypeParam;
  const double gap = 0.05, way = 1 + (0.5 + gap) / std::sqrt(2.0);
  World<S> w(settings<S>());
  add_ground(w, 0);
  BodyDefinition<S> of_pillar = still<S>(add_box(w, 1, 1, 1), {0, 0.3, 0});
  of_pillar.filter.category = 2;
  const BodyId pillar = w.create(of_pillar);
  const ShapeId cone = w.add_shape(Cone<S>{num<S>(0.5), num<S>(0.5)});
  BodyDefinition<S> d = moving<S>(cone, {way, 0.5, way});
  d.material.friction = S(0);
  d.allow_sleep = false;
  const BodyId body = w.create(d);
  const auto meets = [&](double at) {
    const auto hit =
        w.overlap_first(cone, {vec<S>(at, 0.5, at), Quat<Unit<S>>::identity()}, QueryFilter{.mask = 2, .ignore = body});
    return hit && hit->body == pillar;
  };
  run(w, 60);
  EXPECT_LT(length(real(w.center_of_mass(body)) - real(d.position) + D3{0, 0.25, 0}), 0.01);
  EXPECT_FALSE(meets(way - 0.04 / std::sqrt(2.0)));
  EXPECT_TRUE(meets(way - 0.07 / std::sqrt(2.0)));
}

}  // namespace round_solids_test
}  // namespace isostep::test
