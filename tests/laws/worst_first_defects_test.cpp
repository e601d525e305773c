// Defects of the book's own resolver, which the solver worst_first has not got: rows 9 to 14 of the list, with every
// projection. Row 9, creep on a slope, is a_block_rests_on_a_slope_... of tests/unit/book/worst_first_test.cpp, and
// a resting ball that bounces by gravity alone, of row 11, is there too.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace worst_first_defects_test {

template <class S> class WorstFirstDefects : public ::testing::Test {
 protected:
  static Settings<S> asked(std::uint32_t projection, double gravity, std::int32_t substeps = 4) {
    Settings<S> s = settings<S>(gravity, 60, substeps);
    s.solver = SolverName::worst_first;
    s.projection = static_cast<Projection>(projection);
    return s;
  }
  static BodyDefinition<S> body(ShapeId shape, D3 position, D3 velocity, double friction, double restitution = 0) {
    BodyDefinition<S> d = moving<S>(shape, position, velocity);
    d.material.friction = num<S>(friction);
    d.material.restitution = num<S>(restitution);
    return d;
  }
  template <class Try> static void with_each(Try&& try_one) {
    for (std::uint32_t i = 0; i < kProjections; ++i) {
      SCOPED_TRACE(kProjectionNames[i]);
      try_one(i);
    }
  }
  static double kinetic(const World<S>& w, BodyId id, D3 half) {
    const D3 v = real(w.velocity(id)), turning = real(w.angular_velocity(id));
    const double m = to_double(w.mass(id));
    // In the body's own axes.
    const Quat<Unit<S>> q = w.pose(id).orientation;
    const D3 axes[] = {rotated<S>(q, {1, 0, 0}), rotated<S>(q, {0, 1, 0}), rotated<S>(q, {0, 0, 1})};
    const double squares[] = {half.x * half.x, half.y * half.y, half.z * half.z};
    double energy = m * dot(v, v) / 2;
    for (int i = 0; i < 3; ++i) {
      const double along = dot(turning, axes[i]);
      energy += m * (squares[0] + squares[1] + squares[2] - squares[i]) / 3 * along * along / 2;
    }
    return energy;
  }
};
TYPED_TEST_SUITE(WorstFirstDefects, AllScalars);

/// Row 10. A rod that strikes while it slides, at slants where what friction does along the normal comes to nothing or
/// turns its sign (Painleve): the divisor of the book's impulse, m^-1 (1 + 3 sin a (sin a - mu cos a)) or so, is zero.
TYPED_TEST(WorstFirstDefects, a_rod_that_slides_as_it_strikes_gains_no_energy_at_any_slant_and_friction) {
  using S = TypeParam;
  const D3 half = {0.5, 0.03125, 0.03125};
  this->with_each([&](std::uint32_t projection) {
    for (const double friction : {0.5, 4.0 / 3, 2.0, 8.0}) {
      for (int tenth = 1; tenth < 16; ++tenth) {
        for (const double slip : {-3.0, 0.0, 3.0}) {
          World<S> w(WorstFirstDefects<S>::asked(projection, 0));
          add_ground(w, friction);
          const double angle = 0.1 * tenth;
          BodyDefinition<S> d = WorstFirstDefects<S>::body(
              add_box(w, half.x, half.y, half.z), {0, half.x * std::sin(angle) + half.y * std::cos(angle) + 0.01, 0},
              {slip, -2, 0}, friction);
          d.orientation = turn<S>({0, 0, 1}, angle);
          const BodyId id = w.create(d);
          double energy = WorstFirstDefects<S>::kinetic(w, id, half);
          const double first = energy;
          for (int i = 0; i < 30; ++i) {
            ASSERT_TRUE(w.step().clean()) << friction << " at " << angle;
            const double now = WorstFirstDefects<S>::kinetic(w, id, half);
            ASSERT_LE(now, energy + 0.02 * first) << friction << " at " << angle << ", slip " << slip;
            energy = std::max(now, 0.0);
          }
          ASSERT_GT(real(w.center_of_mass(id)).y, 0) << friction << " at " << angle;
          ASSERT_LT(energy, 0.99 * first) << "it was struck";
        }
      }
    }
  });
}

/// Row 10. Nothing turns and nothing moves across: the matrix of friction is singular.
TYPED_TEST(WorstFirstDefects, what_friction_cannot_move_is_left_alone) {
  using S = TypeParam;
  this->with_each([](std::uint32_t projection) {
    World<S> w(WorstFirstDefects<S>::asked(projection, -10));
    add_ground(w, 1);
    BodyDefinition<S> d = WorstFirstDefects<S>::body(add_box(w, 0.5, 0.5, 0.5), {0, 0.5625, 0}, {0, -1, 0}, 1);
    d.locks = body_flag::kAllLocks & ~(body_flag::kLockX << 1);  // falls, and that is all
    const BodyId id = w.create(d);
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(w.step().clean());
    expect_near(real(w.center_of_mass(id)), {0, 0.5, 0}, 2e-3, "rests");
  });
}

/// Row 11. A blow slower than what gravity made in the sub-step: the book's bounce pulls.
TYPED_TEST(WorstFirstDefects, no_bounce_pulls_and_none_gives_more_than_it_took) {
  using S = TypeParam;
  this->with_each([](std::uint32_t projection) {
    for (const double speed : {0.5, 0.25, 0.0, -0.25, -0.5, -1.0, -2.0}) {
      World<S> w(WorstFirstDefects<S>::asked(projection, -100, 1));
      add_ground(w);
      const BodyId id =
          w.create(WorstFirstDefects<S>::body(add_ball(w, 0.5), {0, 0.5 - 0x1p-11, 0}, {0, speed, 0}, 0, 1));
      w.step();
      const double after = real(w.velocity(id)).y;
      // It may be on its way down from one bounce, or to the next, and never faster than it came.
      EXPECT_GE(after, -std::fabs(speed) - 64 * speed_grain<S>()) << speed;
      EXPECT_LE(after, std::fabs(speed) + 64 * speed_grain<S>()) << speed;
    }
  });
}

/// Row 12. What sleeps has no acceleration of its last frame: a blow finds it as it finds one that is awake.
TYPED_TEST(WorstFirstDefects, a_sleeping_body_is_struck_as_one_that_is_awake) {
  using S = TypeParam;
  this->with_each([](std::uint32_t projection) {
    D3 speeds[2][2];
    for (const bool sleeps : {false, true}) {
      Settings<S> s = WorstFirstDefects<S>::asked(projection, -10);
      s.allow_sleep = sleeps;
      World<S> w(s);
      add_ground(w, 0);
      const BodyId box = w.create(WorstFirstDefects<S>::body(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}, {0, 0, 0}, 0));
      run(w, 180);
      EXPECT_EQ(w.is_awake(box), !sleeps);
      const BodyId ball = w.create(WorstFirstDefects<S>::body(add_ball(w, 0.25), {-1, 0.5, 0}, {5, 0.75, 0}, 0, 0.5));
      run(w, 12);
      EXPECT_TRUE(w.is_awake(box));
      speeds[sleeps][0] = real(w.velocity(box));
      speeds[sleeps][1] = real(w.velocity(ball));
    }
    EXPECT_GT(speeds[0][0].x, 0.1);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(speeds[1][i].x, speeds[0][i].x, 0.01);
      EXPECT_NEAR(speeds[1][i].y, speeds[0][i].y, 0.05);
    }
  });
}

/// Row 13. What projection turned and moved is what the next step takes: a world of the same state has the same future.
TYPED_TEST(WorstFirstDefects, nothing_of_a_projection_is_left_behind_where_the_state_does_not_have_it) {
  using S = TypeParam;
  this->with_each([](std::uint32_t projection) {
    World<S> w(WorstFirstDefects<S>::asked(projection, -10));
    add_ground(w);
    const ShapeId shape = add_box(w, 0.75, 0.25, 0.25);
    for (int i = 0; i < 6; ++i)
      w.create(WorstFirstDefects<S>::body(shape, {0.25 * (i % 3), 0.25 + 0.4375 * i, 0.125 * i}, {1, -3, 0}, 0.5));
    for (int i = 0; i < 40; ++i) {
      w.step();
      World<S> twin(WorstFirstDefects<S>::asked(projection, -10));
      const std::vector<std::uint8_t> bytes = bytes_of(w);
      Reader reader(bytes);
      ASSERT_TRUE(twin.read_portable(reader));
      World<S> next(WorstFirstDefects<S>::asked(projection, -10));
      Reader again(bytes);
      ASSERT_TRUE(next.read_portable(again));
      twin.step();
      next.step();
      ASSERT_EQ(twin.hash(), next.hash());
      typename World<S>::Snapshot saved;
      w.save(saved);
      w.step();
      ASSERT_EQ(w.hash(), twin.hash()) << i;
      ASSERT_TRUE(w.load(saved));
    }
  });
}

/// Row 14. Each pass has iterations of its own: a step resolves an impact, and the overlap beside it.
TYPED_TEST(WorstFirstDefects, speeds_and_overlaps_are_resolved_by_one_step) {
  using S = TypeParam;
  this->with_each([](std::uint32_t projection) {
    World<S> w(WorstFirstDefects<S>::asked(projection, 0, 1));
    add_ground(w, 0);
    const BodyId id = w.create(WorstFirstDefects<S>::body(add_ball(w, 0.5), {0, 0.4375, 0}, {0, -1, 0}, 0));
    EXPECT_EQ(w.step().unsolved, 0u);
    EXPECT_NEAR(real(w.velocity(id)).y, 0, 64 * speed_grain<S>());
    EXPECT_GT(real(w.center_of_mass(id)).y, 0.45);
  });
}

}  // namespace worst_first_defects_test
}  // namespace isostep::test
