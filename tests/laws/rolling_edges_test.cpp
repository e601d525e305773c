// Laws of what rolls on an edge: a barrel on its rim, a coin, a cone, a drum with corners, a wheelset. Ground that
// stands still does no work, and friction of what rolls none either: no such body ever has more energy than it began
// with, whatever lies on the ground or hangs on the body.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "built.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "random/dice.hpp"
#include "random/energy_book.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace rolling_edges_test {

enum class Ground { plane, box, mesh, field, kinematic, slab };
enum class Solid { cylinder, cone, prism, wheelset };
enum class Beside { nothing, drag, handle, rope };
constexpr double kPi = 3.14159265358979323846;

/// A solid of revolution that leans on its rim and spins about the vertical.
struct Roll {
  Solid solid = Solid::cylinder;
  Ground ground = Ground::plane;
  Beside beside = Beside::nothing;
  SolverName solver = SolverName::soft_step;
  int hz = 60, substeps = 8;
  double radius = 0.3, half_height = 0.45;  // [m]
  double tilt = 25 * kPi / 180;             // [rad] of its axis against the vertical
  double spin = 10;                         // [rad/s]
  double speed = 0;                         // [m/s]
  double friction = 0.6, restitution = 0;
};

template <class S> class RollingEdges : public ::testing::Test {
 protected:
  static constexpr int kCells = 20;
  static constexpr double kPitch = 1.1;  // [m]

  static ShapeId flat(World<S>& w, Ground ground) {
    const double half = kCells * kPitch / 2;
    if (ground == Ground::plane) return w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)});
    if (ground == Ground::box || ground == Ground::kinematic) return add_box(w, half, 1, half);
    if (ground == Ground::slab) return add_box(w, 4, 0.5, 4);
    if (ground == Ground::field) {
      const std::vector<double> heights((kCells + 1) * (kCells + 1), 0.0);
      return w.add_shape(height_field_blob({kCells + 1, kCells + 1, kPitch}, heights).value());
    }
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (int k = 0; k <= kCells; ++k) {
      for (int i = 0; i <= kCells; ++i) {
        points.push_back({kPitch * i - half, 0, kPitch * k - half});
        if (i == kCells || k == kCells) continue;
        const auto at = static_cast<std::uint32_t>(k * (kCells + 1) + i), below = at + kCells + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    return w.add_shape(mesh_blob(points, triangles).value());
  }
  static ShapeId shape_of(World<S>& w, const Roll& roll) {
    const double r = roll.radius, h = roll.half_height;
    if (roll.solid == Solid::cylinder) return w.add_shape(Cylinder<S>{num<S>(r), num<S>(h)});
    if (roll.solid == Solid::cone) return w.add_shape(Cone<S>{num<S>(r), num<S>(h)});
    if (roll.solid == Solid::wheelset) {
      const Child<S> parts[] = {part_at(primitive_of(Cylinder<S>{num<S>(r), num<S>(h * 0.2)}), {0, h, 0}),
                                part_at(primitive_of(Cylinder<S>{num<S>(r * 0.7), num<S>(h * 0.2)}), {0, -h, 0}),
                                part_at(primitive_of(Cylinder<S>{num<S>(r * 0.1), num<S>(h)}), {0, 0, 0})};
      return w.add_shape(std::span<const Child<S>>(parts));
    }
    std::vector<D3> points;
    for (int i = 0; i < 16; ++i) {
      for (const double y : {-h, h}) points.push_back({r * std::cos(i * kPi / 8), y, r * std::sin(i * kPi / 8)});
    }
    return w.add_shape(hull_blob(std::span<const D3>(points)).value());
  }
  static void add_ground(World<S>& w, const Roll& roll) {
    const double corner = kCells * kPitch / 2;
    BodyDefinition<S> d = still<S>(flat(w, roll.ground));
    if (roll.ground == Ground::box || roll.ground == Ground::kinematic) d.position = vec<S>(0, -1, 0);
    if (roll.ground == Ground::field) d.position = vec<S>(-corner, 0, -corner);
    if (roll.ground == Ground::kinematic) d.type = BodyType::kinematic;
    d.material.friction = num<S>(roll.friction);
    d.material.restitution = num<S>(roll.restitution);
    if (roll.ground == Ground::slab) {
      w.create(still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(-1)})));
      d.type = BodyType::dynamic;
      d.position = vec<S>(0, -0.5, 0);
      d.mass = S(2000);
    }
    ASSERT_TRUE(w.create(d));
    for (int i = 0; roll.ground == Ground::slab && i < 30; ++i) w.step();
  }
  static void add_roll(World<S>& w, const Roll& roll) {
    const double h = roll.half_height, c = std::cos(roll.tilt), s = std::sin(roll.tilt);
    const double disc = roll.solid == Solid::wheelset ? 1.2 * h : h, up = roll.solid == Solid::wheelset ? -disc : disc;
    const double low = roll.solid == Solid::cone ? std::max(h * c + roll.radius * s, -h * c)
                                                 : std::max(disc * c + roll.radius * s, -up * c + roll.radius * s);
    BodyDefinition<S> d = moving<S>(shape_of(w, roll), {0, low, 0}, {roll.speed, 0, 0});
    d.mass = S(100);
    d.material.friction = num<S>(roll.friction);
    d.material.restitution = num<S>(roll.restitution);
    using U = Unit<S>;
    d.orientation = normalise(Quat<U>{U(0), U(0), num<U>(std::sin(roll.tilt / 2)), num<U>(std::cos(roll.tilt / 2))});
    d.angular_velocity = vec<S>(0, roll.spin, 0);
    const BodyId id = w.create(d);
    ASSERT_TRUE(id);
    hang(w, roll.beside, id);
  }
  static void hang(World<S>& w, Beside beside, BodyId id) {
    if (beside == Beside::drag) {
      BodyDrag<S> drag;
      drag.body = id;
      drag.linear = num<S>(0.001);
      ASSERT_TRUE(w.add(drag));
    } else if (beside == Beside::handle) {
      BodyDefinition<S> d = moving<S>(add_ball(w, 0.0625), real(w.pose(id).position));
      d.mass = S(1);
      d.collide = false;
      d.velocity = vec<S>(real(w.velocity(id)));
      d.angular_velocity = vec<S>(real(w.angular_velocity(id)));
      ASSERT_TRUE(w.create(w.joint_at(JointType::fixed, id, w.create(d), w.pose(id))));
    } else if (beside == Beside::rope) {
      TwoPointJoint<S> ends;
      ends.b = id;
      ends.anchor_a = vec<S>(0, 3, 0);
      ends.anchor_b = w.pose(id).position;
      ends.length = S(20);
      ASSERT_TRUE(w.create(rope<S>(ends)));
    }
  }
  /// [1] The most that it has above what it began with, of that.
  static double gain_of(const Roll& roll, double seconds) {
    Settings<S> s = settings<S>(-10, roll.hz, roll.substeps);
    s.solver = roll.solver;
    World<S> w(s);
    add_ground(w, roll);
    const double ground = EnergyBook<S>::energy_of(w);
    add_roll(w, roll);
    const double start = EnergyBook<S>::energy_of(w);
    double most = start;
    for (int i = 0; i < seconds * roll.hz; ++i) {
      w.step();
      most = std::max(most, EnergyBook<S>::energy_of(w));
    }
    return (most - start) / (start - ground);
  }
  static void expect_no_gain(const Roll& roll, double seconds) {
    EXPECT_LT(gain_of(roll, seconds), pick<S>(0.002, 0.002, 0.01, 0.002))  // [1] roundings, cut steps
        << kSolverNames[static_cast<int>(roll.solver)] << " at " << roll.hz << " Hz x " << roll.substeps << ", solid "
        << static_cast<int>(roll.solid) << " on ground " << static_cast<int>(roll.ground) << " beside "
        << static_cast<int>(roll.beside) << ", friction " << roll.friction << ", restitution " << roll.restitution
        << ", radius " << roll.radius << ", half height " << roll.half_height << ", tilt " << roll.tilt * 180 / kPi
        << ", spin " << roll.spin;
  }
};
TYPED_TEST_SUITE(RollingEdges, AllScalars);

TYPED_TEST(RollingEdges, a_barrel_on_its_rim_gains_nothing) {
  for (const SolverName solver : built({SolverName::soft_step, SolverName::worst_first, SolverName::direct})) {
    Roll barrel;
    barrel.solver = solver;
    this->expect_no_gain(barrel, 10);
  }
}
TYPED_TEST(RollingEdges, nor_does_it_at_other_rates) {
  for (const int substeps : {4, 32}) {
    Roll barrel;
    barrel.substeps = substeps;
    this->expect_no_gain(barrel, 6);
  }
  Roll barrel;
  barrel.hz = 240;
  this->expect_no_gain(barrel, 4);
}
TYPED_TEST(RollingEdges, a_can_that_rocks_gains_nothing) {
  Roll can;
  can.radius = 0.0625;
  can.half_height = 0.1;
  can.tilt = 5 * kPi / 180;
  can.spin = 4;
  this->expect_no_gain(can, 10);
}
/// Whatever rolls, on whatever ground.
TYPED_TEST(RollingEdges, nothing_that_rolls_on_an_edge_gains) {
  constexpr double kSizes[][2] = {{0.3, 0.45}, {0.5, 0.0625}, {0.3, 0.1}, {1, 0.2}, {0.2, 0.8}};
  Dice dice(43);
  for (int i = 0; i < 16; ++i) {
    Roll roll;
    roll.solid = static_cast<Solid>(i % 3);
    roll.ground = static_cast<Ground>(i % 4);
    const auto& size = kSizes[dice.below(5)];
    roll.radius = size[0];
    roll.half_height = size[1];
    roll.tilt = dice.in(2, 88) * kPi / 180;
    roll.spin = dice.in(1, 40);
    roll.speed = i % 5 == 0 ? 3 : 0;
    this->expect_no_gain(roll, 4);
  }
}

/// Nor where the ground could move, something hangs on the body, or it bounces.
TYPED_TEST(RollingEdges, nor_with_anything_beside_it) {
  Dice dice(44);
  const int rolls = sampled(96, 24);
  for (int i = 0; i < rolls; ++i) {
    Roll roll;
    roll.solid = i % 2 == 0 ? Solid::wheelset : static_cast<Solid>(dice.below(3));
    roll.ground = static_cast<Ground>(dice.below(6));
    roll.beside = static_cast<Beside>(i % 4);
    roll.radius = roll.half_height = 0.25;
    roll.tilt = dice.in(10, 85) * kPi / 180;
    roll.spin = dice.in(4, 12);
    roll.friction = i % 3 == 0 ? 0.6 : 0.05;
    roll.restitution = i % 5 == 0 ? 0.2 : 0;
    this->expect_no_gain(roll, 8);
  }
}
/// A log on ice, through many small bounces.
TYPED_TEST(RollingEdges, a_capsule_that_spins_and_yaws_gains_nothing) {
  using S = TypeParam;
  for (const double restitution : {0.0, 0.5, 1.0}) {
    World<S> w(settings<S>());
    BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
    d.material.friction = S(0);
    d.material.restitution = num<S>(restitution);
    w.create(d);
    const Material<S> ice = d.material;
    d = moving<S>(w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0.25, 0});
    using U = Unit<S>;
    d.orientation = normalise(Quat<U>{U(0), U(0), U(0.70710678), U(0.70710678)});
    d.material = ice;
    d.angular_velocity = vec<S>(10, 2, 0);
    w.create(d);
    const double start = EnergyBook<S>::energy_of(w);
    double most = start;
    for (int i = 0; i < 1200; ++i) {
      w.step();
      most = std::max(most, EnergyBook<S>::energy_of(w));
    }
    EXPECT_LT(most / start - 1, pick<S>(0.005, 0.002, 0.25, 0.002)) << restitution;  // roundings
  }
}

}  // namespace rolling_edges_test
}  // namespace isostep::test
