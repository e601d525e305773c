// Laws of flat ground: what spins on it does not feel how it is cut into triangles.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace flat_ground_test {

enum class Ground { box, mesh, field };

/// The body that spins, and its ground.
struct Spin {
  Ground ground;
  double cell;  // [m]
  D3 half;      // [m] of a box; of a cylinder, whose z is 0, radius and half height
  double spin;  // [rad/s]
};
/// The course of its spin.
struct Course {
  double rise = 0;    // [m] at most, above where it started
  double drift = 0;   // [m] sideways, at most
  double rested = 0;  // [s] when it stopped
};

template <class S> class FlatGround : public ::testing::Test {
 protected:
  static ShapeId add_mesh(World<S>& w, int cells, double cell) {
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (int k = 0; k <= cells; ++k) {
      for (int i = 0; i <= cells; ++i) {
        points.push_back({(i - cells / 2.0) * cell, 0, (k - cells / 2.0) * cell});
        if (i == cells || k == cells) continue;
        const auto at = static_cast<std::uint32_t>(k * (cells + 1) + i),
                   below = at + static_cast<std::uint32_t>(cells) + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    return w.add_shape(mesh_blob(points, triangles).value());
  }
  static void add_ground_of(World<S>& w, const Spin& spin, double size) {
    const int cells = static_cast<int>(size / spin.cell);
    BodyDefinition<S> d = still<S>(ShapeId{});
    if (spin.ground == Ground::box) {
      d = still<S>(add_box(w, size / 2, 1, size / 2), {0, -1, 0});
    } else if (spin.ground == Ground::mesh) {
      d = still<S>(add_mesh(w, cells, spin.cell));
    } else {
      const auto places = static_cast<std::uint32_t>(cells + 1);
      const std::vector<double> heights(places * places, 0);
      d = still<S>(w.add_shape(height_field_blob({places, places, spin.cell}, heights).value()),
                   {-cells * spin.cell / 2, 0, -cells * spin.cell / 2});
    }
    d.material.friction = num<S>(0.6);
    w.create(d);
  }
  static ShapeId add_solid(World<S>& w, D3 half) {
    return half.z == 0 ? w.add_shape(Cylinder<S>{num<S>(half.x), num<S>(half.y)}) : add_box(w, half.x, half.y, half.z);
  }
  static Course follow(World<S>& w, BodyId body, int frames) {
    Course course;
    const D3 from = real(w.center_of_mass(body));
    for (int i = 0; i < frames && course.rested == 0; ++i) {
      w.step();
      const D3 now = real(w.center_of_mass(body)) - from;
      course.rise = std::max(course.rise, now.y);
      course.drift = std::max(course.drift, std::hypot(now.x, now.z));
      if (length(real(w.angular_velocity(body))) < 0.01) course.rested = i / 60.0;
    }
    return course;
  }
  /// Spins about an upright axis.
  static Course spin_flat(const Spin& spin) {
    World<S> w(settings<S>());
    add_ground_of(w, spin, 6);
    BodyDefinition<S> d = moving<S>(add_solid(w, spin.half), {0.13, spin.half.y, 0.31});
    d.angular_velocity = vec<S>(0, spin.spin, 0);
    return follow(w, w.create(d), 180);
  }
  /// A wheel about its level axis, at a place and heading of its own.
  static Course spin_upright(const Spin& spin) {
    World<S> w(settings<S>());
    add_ground_of(w, spin, 30);
    BodyDefinition<S> d = moving<S>(add_solid(w, spin.half), {-12, spin.half.x, 0.13});
    const Quat<Unit<S>> heading = turn<S>({0, 1, 0}, 0.2);
    d.orientation = heading * turn<S>({1, 0, 0}, kPi / 2);
    d.angular_velocity = vec<S>(rotated<S>(heading, {0, 0, -spin.spin}));
    d.material.friction = num<S>(0.6);
    return follow(w, w.create(d), 90);
  }
};
TYPED_TEST_SUITE(FlatGround, AllScalars);

TYPED_TEST(FlatGround, of_triangles_bears_a_spinning_wheel_as_a_box_does) {
  const bool is_small = std::is_same_v<TypeParam, Q16_16>;  // turns by at most 64 rad/s
  for (const double spin : {30.0, is_small ? 45.0 : 120.0}) {
    const D3 half = {0.25, 0.25, 0};
    const Course box = this->spin_upright({Ground::box, 1, half, spin});
    for (const Ground ground : {Ground::mesh, Ground::field}) {
      const Course course = this->spin_upright({ground, 0.5, half, spin});
      EXPECT_LT(course.rise, 0.001) << spin << " rad/s";
      EXPECT_NEAR(course.drift, box.drift, 0.01 * box.drift) << "and drives it as fast";
    }
  }
}

TYPED_TEST(FlatGround, of_triangles_stops_what_spins_on_it_when_and_where_a_box_does) {
  const D3 solids[] = {{0.5, 0.25, 0.5}, {0.5, 0.25, 0}, {0.25, 0.05, 0}, {0.7, 0.1, 0.2}};
  for (const D3 half : solids) {
    const Course box = this->spin_flat({Ground::box, 1, half, 15});
    ASSERT_GT(box.rested, 0);
    for (const Spin& spin : {Spin{Ground::mesh, 0.25, half, 15}, Spin{Ground::mesh, 0.7, half, 15},
                             Spin{Ground::mesh, 4, half, 15}, Spin{Ground::field, 1, half, 15}}) {
      const Course course = this->spin_flat(spin);
      EXPECT_NEAR(course.rested, box.rested, 0.05 * box.rested) << half.x << ' ' << spin.cell;
      EXPECT_LT(course.drift, 0.005) << half.x << ' ' << spin.cell;
    }
  }
}

}  // namespace flat_ground_test
}  // namespace isostep::test
