// Solids on boxes far wider than they are: the floor's distant corners cost the contact no digits.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include "random/dice.hpp"
#include "random/hull.hpp"
#include "sample.hpp"
#include "scenes/measure.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace wide_floors_test {

/// Measures of one second along a floor.
struct Course {
  double way = 0;  // [1] of what its speed makes of it
  double hop = 0;  // [m] above the floor, most
};

struct Found {
  double deepest = 0, sunk = 0;  // [1] of the radius, of a round one: as it lands, and 3 s later
  double gained = 0;             // [1] of the energy that lifts the solid by its radius
};

template <class S> class WideFloors : public ::testing::Test {
 protected:
  static double widest() { return std::min(8000.0, 0.9 * to_double(Limits<S>::extent())); }  // [m] half extent

  /// Calls visit(seed, half extent [m]) for floors from `narrow` to the widest.
  template <class Visit> static void visit_floors(std::uint64_t seeds, double narrow, const Visit& visit) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      for (const double wide : {narrow, 400.0, widest()}) {
        if (wide > widest()) continue;
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(wide) + " m");
        visit(seed, wide);
      }
    }
  }
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

  /// A round solid that rolls, or one with edges that slides without friction, on a tilted box of half extent `wide`
  /// [m] whose middle is up to .7 of that away. Gravity is across the box.
  static Course run_along(std::uint64_t seed, double wide) {
    Dice dice(seed * 9176417 + 3);
    Settings<S> ways = settings<S>();
    const Quat<Unit<S>> tilt = dice.template orientation<S>();
    const auto turned = [&](D3 v) { return rotated<S>(tilt, v); };
    const D3 up = turned({0, 1, 0}), along = turned({1, 0, 0});
    ways.gravity = vec<S>(up * -10.0);
    World<S> w(ways);
    const D3 middle = turned({dice.in(-0.7, 0.7), 0, dice.in(-0.7, 0.7)}) * wide - up;
    const std::uint32_t kind = dice.below(5);
    const bool rolls = kind < 3;
    BodyDefinition<S> floor = still<S>(add_box(w, wide, 1, wide), middle);
    floor.orientation = tilt;
    floor.material.friction = num<S>(rolls ? 0.5 : 0.0);
    w.create(floor);
    const double radius = dice.in(0.1, 0.6), half = radius * dice.in(0.8, 1.5),
                 speed = dice.in(5, rolls ? 60 * radius : 50);
    const ShapeId shape = kind == 0   ? w.add_shape(Cylinder<S>{num<S>(radius), num<S>(half)})
                          : kind == 1 ? w.add_shape(Capsule<S>{num<S>(radius), num<S>(half)})
                          : kind == 2 ? w.add_shape(Sphere<S>{num<S>(radius)})
                          : kind == 3 ? add_box(w, half, radius, half)
                                      : w.add_shape(Cylinder<S>{num<S>(half), num<S>(radius)});
    const D3 velocity = along * speed, start = up * radius;
    BodyDefinition<S> d = moving<S>(shape, start, velocity);
    d.orientation = tilt;
    if (rolls) {
      const Unit<S> root = num<Unit<S>>(std::sqrt(0.5));
      d.orientation = normalise(tilt * Quat<Unit<S>>{root, Unit<S>(0), Unit<S>(0), root});
      d.angular_velocity = vec<S>(turned({0, 0, -speed / radius}));
    }
    d.material.friction = floor.material.friction;
    const BodyId body = w.create(d);
    Course found;
    for (int frame = 0; frame < 60; ++frame) {
      w.step();
      found.hop = std::max(found.hop, dot(real(w.pose(body).position), up) - radius);
    }
    found.way = dot(real(w.pose(body).position), along) / speed;
    return found;
  }
};
TYPED_TEST_SUITE(WideFloors, AllScalars);

TYPED_TEST(WideFloors, bear_as_narrow_ones_do) {
  this->visit_floors(sampled(60u, 12u), 20, [&](std::uint64_t seed, double wide) {
    const Found found = this->drop(seed, wide);
    EXPECT_LT(found.deepest, 0.1);
    EXPECT_LT(found.sunk, 0.02);
    EXPECT_LT(found.gained, 0.04);
  });
}

TYPED_TEST(WideFloors, stop_nothing_that_rolls_or_slides) {
  this->visit_floors(sampled(100u, 20u), 100, [&](std::uint64_t seed, double wide) {
    const Course found = this->run_along(seed, wide);
    EXPECT_NEAR(found.way, 1, 0.02);
    EXPECT_LT(found.hop, 0.01);
  });
}

TYPED_TEST(WideFloors, are_met_where_they_are_by_casts) {
  using S = TypeParam;
  const std::uint64_t seeds = sampled(400u, 80u);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Dice dice(seed * 4410697 + 7);
    const double wide = dice.below(2) == 0 ? 400.0 : this->widest();
    if (wide > this->widest()) continue;
    World<S> w(settings<S>());
    w.create(still<S>(add_box(w, wide, 1, wide), {dice.in(-0.7, 0.7) * wide, -1, dice.in(-0.7, 0.7) * wide}));
    const double radius = dice.in(0.05, 0.6), half = dice.in(0.1, 1);
    const std::uint32_t kind = dice.below(4);
    const ShapeId shape = kind == 0   ? w.add_shape(Cylinder<S>{num<S>(radius), num<S>(half)})
                          : kind == 1 ? w.add_shape(Capsule<S>{num<S>(radius), num<S>(half)})
                          : kind == 2 ? w.add_shape(Sphere<S>{num<S>(radius)})
                                      : add_box(w, radius, half, radius);
    const double low = kind == 1 ? radius + half : kind == 2 ? radius : half, height = dice.in(0.5, 4);
    Pose<S> pose = Pose<S>::identity();
    pose.position = {S(0), num<S>(low + height), S(0)};
    const auto hit = w.cast_shape(shape, pose, {num<S>(dice.in(-2, 2)), num<S>(-2 * height), S(0)});
    ASSERT_TRUE(hit) << "seed " << seed;
    EXPECT_NEAR(to_double(hit->fraction) * 2 * height, height, 0.001) << "seed " << seed << ", " << wide << " m";
  }
}

}  // namespace wide_floors_test
}  // namespace isostep::test
