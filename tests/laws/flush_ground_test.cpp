// Laws of flush ground: what slides from one tile, belt or part to the next one feels no edge between them.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <vector>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace flush_ground_test {

/// The way in which the ground is made of boxes that lie flush.
enum class Tiling { belts, bodies, parts };

struct Slide {
  Tiling tiling;
  double tile;   // [m] along the way
  double speed;  // [m/s]
  double yaw;    // [rad] of what slides
};

template <class S> class FlushGround : public ::testing::Test {
 protected:
  static constexpr double kFrom = -3.3, kTime = 1;  // [m], [s]

  static void add_tiles(World<S>& w, const Slide& slide) {
    const ShapeId tile = add_box(w, slide.tile / 2, 0.5, 3);
    std::vector<Child<S>> parts;
    for (double x = -4; x < 12; x += slide.tile) {
      const D3 at = {x + slide.tile / 2, -0.5, 0};
      parts.push_back(part_at(primitive_of(Box<S>{vec<S>(slide.tile / 2, 0.5, 3)}), at));
      BodyDefinition<S> d = still<S>(tile, at);
      d.material.friction = num<S>(slide.tiling == Tiling::belts ? 0.5 : 0);
      if (slide.tiling == Tiling::belts) d.material.surface_velocity = vec<S>(slide.speed, 0, 0);
      if (slide.tiling != Tiling::parts) w.create(d);
    }
    BodyDefinition<S> d = still<S>(w.add_shape(std::span<const Child<S>>(parts)));
    d.material.friction = S(0);
    if (slide.tiling == Tiling::parts) w.create(d);
  }
  /// It goes as far as it should, and is not lifted.
  static void expect_no_edge(const Slide& slide, const char* name, ShapeId (*shape)(World<S>&), double height) {
    World<S> w(settings<S>());
    add_tiles(w, slide);
    BodyDefinition<S> d = moving<S>(shape(w), {kFrom, height, 0.03}, {slide.speed, 0, 0});
    d.mass = S(5);
    d.orientation = turn<S>({0, 1, 0}, slide.yaw);
    d.material.friction = num<S>(slide.tiling == Tiling::belts ? 0.5 : 0);
    const BodyId body = w.create(d);
    double lift = 0, slowest = slide.speed;
    for (int i = 0; i < 60; ++i) {
      w.step();
      lift = std::max(lift, to_double(w.center_of_mass(body).y) - height);
      slowest = std::min(slowest, to_double(w.velocity(body).x));
    }
    const double way = slide.speed * kTime;
    EXPECT_NEAR(to_double(w.center_of_mass(body).x) - kFrom, way, 0.02 * way) << name << ' ' << slide.speed;
    EXPECT_GT(slowest, 0.95 * slide.speed) << name << ", tiles of " << slide.tile << " m at " << slide.speed << " m/s";
    EXPECT_LT(lift, 0.005) << name << ", tiles of " << slide.tile << " m at " << slide.speed << " m/s";
  }
  static ShapeId cube(World<S>& w) { return add_box(w, 0.25, 0.25, 0.25); }
  static ShapeId plate(World<S>& w) { return add_box(w, 0.5, 0.05, 0.5); }
  static ShapeId disc(World<S>& w) { return w.add_shape(Cylinder<S>{num<S>(0.25), num<S>(0.1)}); }
  static ShapeId ball(World<S>& w) { return add_ball(w, 0.25); }
};
TYPED_TEST_SUITE(FlushGround, AllScalars);

TYPED_TEST(FlushGround, lets_pass_what_slides_over_it) {
  for (const Tiling tiling : {Tiling::belts, Tiling::bodies, Tiling::parts}) {
    for (const double tile : {0.375, 1.0}) {
      for (const double speed : {2.0, 5.0}) {
        const Slide straight = {tiling, tile, speed, 0}, askew = {tiling, tile, speed, 0.4};
        this->expect_no_edge(straight, "cube", &TestFixture::cube, 0.25);
        this->expect_no_edge(askew, "plate", &TestFixture::plate, 0.05);
        this->expect_no_edge(askew, "disc", &TestFixture::disc, 0.1);
        if (tiling != Tiling::belts) this->expect_no_edge(straight, "ball", &TestFixture::ball, 0.25);
      }
    }
  }
}

/// An edge that stands out is there as ever; at 1 m/s a cube has not the energy to tip over it.
TYPED_TEST(FlushGround, stops_what_meets_a_tile_that_stands_out) {
  using S = TypeParam;
  for (const double step : {0.02, 0.05, 0.2}) {
    World<S> w(settings<S>());
    w.create(still<S>(add_box(w, 2, 0.5, 2), {-2, -0.5, 0}));
    w.create(still<S>(add_box(w, 2, 0.5, 2), {2, step - 0.5, 0}));
    BodyDefinition<S> d = moving<S>(this->cube(w), {-1, 0.25, 0}, {1, 0, 0});
    d.material.friction = S(0);
    const BodyId body = w.create(d);
    run(w, 120);
    EXPECT_LT(to_double(w.center_of_mass(body).x), -0.2) << "a step of " << step << " m";
  }
}

/// Two slopes down from one ridge are no flush ground: each bears what lies on it.
TYPED_TEST(FlushGround, is_no_ridge) {
  using S = TypeParam;
  World<S> w(settings<S>());
  for (const double side : {-1.0, 1.0}) {
    BodyDefinition<S> d = still<S>(add_box(w, 2, 0.5, 2));
    d.orientation = turn<S>({0, 0, 1}, -side * 0.3);
    d.position = vec<S>(rotated<S>(d.orientation, {side * 2, -0.5, 0}));
    d.material.friction = S(1);
    w.create(d);
  }
  BodyDefinition<S> d = moving<S>(this->ball(w), {0.4, 0.5, 0});
  d.material.friction = S(1);
  const BodyId right = w.create(d);
  d.position = vec<S>(-0.4, 0.5, 0);
  const BodyId left = w.create(d);
  run(w, 60);
  const auto height_over_slope = [&](BodyId body) {
    const D3 at = real(w.center_of_mass(body));
    return at.y * isostep::cos(0.3) + std::fabs(at.x) * isostep::sin(0.3);
  };
  EXPECT_NEAR(height_over_slope(right), 0.25, 0.01);
  EXPECT_NEAR(height_over_slope(left), 0.25, 0.01);
  EXPECT_GT(to_double(w.center_of_mass(right).x), 0.5);
  EXPECT_LT(to_double(w.center_of_mass(left).x), -0.5);
}

}  // namespace flush_ground_test
}  // namespace isostep::test
