// Solids on boxes far wider than they are: the floor's distant corners cost the contact no digits.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "random/dice.hpp"
#include "random/hull.hpp"
#include "sample.hpp"
#include "scenes/measure.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace wide_floors_test {

struct Found {
  double deepest = 0, sunk = 0;  // [1] of the radius, of a round one: as it lands, and 3 s later
  double gained = 0;             // [1] of the energy that lifts the solid by its radius
};

template <class S> class WideFloors : public ::testing::Test {
 protected:
  static double widest() { return std::min(8000.0, 0.9 * to_double(Limits<S>::extent())); }  // [m] half extent

  /// [m] The height of the lowest point of a cylinder, or of a cone whose apex is up, in its frame.
  static double lowest(const Pose<S>& pose, bool is_cone, double radius, double half) {
    const D3 axis = real(rotate(pose.orientation, Vec3<S>{S(0), S(1), S(0)}));
    const double rim = radius * std::sqrt(std::max(0.0, 1 - axis.y * axis.y)), y = to_double(pose.position.y);
    if (is_cone) return std::min(y + half * axis.y, y - half * axis.y - rim);
    return y - half * std::abs(axis.y) - rim;
  }
  /// A solid of `radius` [m] dropped on a box of half extent `wide` [m].
  static Found drop(std::uint64_t seed, double wide) {
    Dice dice(seed * 7368787 + 11);
    World<S> w(settings<S>());
    BodyDefinition<S> floor = still<S>(add_box(w, wide, 1, wide), {0, -1, 0});
    floor.material.friction = num<S>(0.5);
    w.create(floor);
    const double radius = dice.in(0.06, 0.6), half = radius * dice.in(0.5, 1.5);
    const std::uint32_t kind = dice.below(4);
    const bool is_cone = kind == 1, is_round = kind < 2;
    const ShapeId shape = kind == 0   ? w.add_shape(Cylinder<S>{num<S>(radius), num<S>(half)})
                          : kind == 1 ? w.add_shape(Cone<S>{num<S>(radius), num<S>(half)})
                          : kind == 2 ? add_hull(w, draw_hull(dice, {radius, half, radius}), 0)
                                      : add_box(w, radius, half, radius);
    const D3 push = dice.point(0.5);
    const double x = dice.in(-1, 1), z = dice.in(-1, 1);
    BodyDefinition<S> d = moving<S>(shape, {x, radius + half, z}, {push.x, 0, push.z});
    d.orientation = dice.template orientation<S>();
    d.material.friction = num<S>(0.5);
    const BodyId body = w.create(d);
    const double unit = to_double(w.mass(body)) * 10 * radius;
    Found found;
    double least = 1e30;
    for (int frame = 0; frame < 360; ++frame) {
      w.step();
      const double depth = is_round ? -lowest(w.pose(body), is_cone, radius, half) / radius : 0;
      double& most = frame < 180 ? found.deepest : found.sunk;
      most = std::max(most, depth);
      const double energy = scenes::measure_energy(w).total();
      found.gained = std::max(found.gained, (energy - least) / unit);
      least = std::min(least, energy);
    }
    return found;
  }
};
TYPED_TEST_SUITE(WideFloors, AllScalars);

TYPED_TEST(WideFloors, bear_as_narrow_ones_do) {
  const std::uint64_t seeds = sampled(60u, 12u);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    for (const double wide : {20.0, 400.0, this->widest()}) {
      if (wide > this->widest()) continue;
      const Found found = this->drop(seed, wide);
      EXPECT_LT(found.deepest, 0.1) << "seed " << seed << ", " << wide << " m";
      EXPECT_LT(found.sunk, 0.02) << "seed " << seed << ", " << wide << " m";
      EXPECT_LT(found.gained, 0.04) << "seed " << seed << ", " << wide << " m";
    }
  }
}

}  // namespace wide_floors_test
}  // namespace isostep::test
