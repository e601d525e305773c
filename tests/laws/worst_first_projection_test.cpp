// Projections of the solver worst_first: what each leaves of an overlap, and what it moves.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "isostep/store/state_validator.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace worst_first_projection_test {

constexpr double kRest = 0x1p-11;         // [m] overlap that stays
constexpr double kTolerance = 0x1p-14;    // [m] errors that are left alone
constexpr double kLeft = 5 * kTolerance;  // [m] overlap whose quarter is one, and one

template <class S> class Projections : public ::testing::Test {
 protected:
  static World<S> world(Projection projection, double gravity = 0, std::int32_t substeps = 8) {
    Settings<S> s = settings<S>(gravity, 60, substeps);
    s.allow_sleep = false;
    s.solver = SolverName::worst_first;
    s.projection = projection;
    return World<S>(s);
  }
  static BodyDefinition<S> body(ShapeId shape, D3 position, D3 velocity = {0, 0, 0}, double friction = 0) {
    BodyDefinition<S> d = moving<S>(shape, position, velocity);
    d.material.friction = num<S>(friction);
    return d;
  }
  template <class Try> static void with_each(Try&& try_one) {
    for (std::uint32_t i = 0; i < kProjections; ++i) {
      SCOPED_TRACE(kProjectionNames[i]);
      try_one(static_cast<Projection>(i));
    }
  }
  /// A wall that fills the half space beyond x = at, towards `sign`.
  static void add_wall(World<S>& w, double at, int sign) {
    using U = Unit<S>;
    w.create(still<S>(w.add_shape(HalfSpace<S>{{U(-sign), U(0), U(0)}, num<S>(-sign * at)})));
  }
  static bool is_upright(const World<S>& w, BodyId id) { return w.pose(id).orientation == Quat<Unit<S>>::identity(); }
};
TYPED_TEST_SUITE(Projections, AllScalars);

TYPED_TEST(Projections, each_takes_a_box_out_of_a_floor_and_gives_it_no_speed) {
  using S = TypeParam;
  this->with_each([](Projection p) {
    World<S> w = Projections<S>::world(p);
    add_ground(w);
    const BodyId id = w.create(Projections<S>::body(add_box(w, 0.5, 0.5, 0.5), {0, 0.40625, 0}));
    run(w, 60);
    EXPECT_NEAR(real(w.center_of_mass(id)).y, 0.5 - kRest, kLeft + 4 * grain<S>());
    expect_near(real(w.velocity(id)), {0, 0, 0}, 4 * speed_grain<S>(), "speed");
  });
}

TYPED_TEST(Projections, each_parts_two_boxes_by_their_masses) {
  using S = TypeParam;
  this->with_each([](Projection p) {
    World<S> w = Projections<S>::world(p);
    const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
    const BodyId a = w.create(Projections<S>::body(box, {0, 0, 0}));
    BodyDefinition<S> d = Projections<S>::body(box, {0.90625, 0, 0});
    d.mass = w.mass(a) * S(3);
    const BodyId b = w.create(d);
    run(w, 60);
    const D3 at_a = real(w.center_of_mass(a)), at_b = real(w.center_of_mass(b));
    EXPECT_NEAR(at_b.x - at_a.x, 1 - kRest, kLeft + 4 * grain<S>());
    EXPECT_NEAR(0.25 * at_a.x + 0.75 * at_b.x, 0.75 * 0.90625, 256 * grain<S>()) << "centre of mass";
  });
}

TYPED_TEST(Projections, linear_turns_nobody_where_nonlinear_does) {
  using S = TypeParam;
  this->with_each([](Projection p) {
    World<S> w = Projections<S>::world(p);
    w.create(still<S>(add_ball(w, 0.5), {0.75, -0.75 + 0.03125, 0}));
    const BodyId id = w.create(Projections<S>::body(add_box(w, 1, 0.25, 1), {0, 0, 0}));
    run(w, 30);
    // With no motion to take back, velocity_based moves as linear has it.
    const bool turns = p == Projection::nonlinear || p == Projection::relaxed;
    EXPECT_EQ(Projections<S>::is_upright(w, id), !turns);
    const double risen = real(w.center_of_mass(id)).y;
    if (turns) EXPECT_LT(risen, 0.02);
    else EXPECT_NEAR(risen, 0.03125 - kRest, kLeft + 16 * grain<S>());
  });
}

/// A quarter of an overlap a sub-step, whichever way.
TYPED_TEST(Projections, each_aims_at_three_quarters_of_an_overlap_a_sub_step) {
  using S = TypeParam;
  this->with_each([](Projection p) {
    World<S> w = Projections<S>::world(p, 0, 1);
    add_ground(w);
    const double start = 0.0625;
    const BodyId id = w.create(Projections<S>::body(add_ball(w, 0.5), {0, 0.5 - kRest - start, 0}));
    double left = start;
    for (int i = 0; i < 8; ++i) {
      w.step();
      left *= 0.75;
      const double is = 0.5 - kRest - real(w.center_of_mass(id)).y;
      ASSERT_NEAR(is, left, (i + 1) * (kTolerance + 8 * grain<S>())) << i;
    }
  });
}

/// A ball between two walls that are too close: to take it from one is to press it into the other. Halves, one after
/// the other, end where one wall lacks a third of what both lack, and the other two; without relaxation one has all.
TYPED_TEST(Projections, relaxed_shares_an_overlap_that_nobody_can_take_away) {
  using S = TypeParam;
  const auto left_of = [](Projection p) {
    World<S> w = Projections<S>::world(p, 0, 1);
    Projections<S>::add_wall(w, 0.4375, 1);
    Projections<S>::add_wall(w, -0.4375, -1);
    const BodyId id = w.create(Projections<S>::body(add_ball(w, 0.5), {0.0625, 0, 0}));
    run(w, 40);
    return std::fabs(real(w.center_of_mass(id)).x);
  };
  EXPECT_NEAR(left_of(Projection::relaxed), 0.0625 / 3, 1e-3);
  EXPECT_NEAR(left_of(Projection::nonlinear), 0.0625, 1e-3);
}

/// Touches half way through its first step, 0.0238 m along the wall, and is found within the wall by the second.
TYPED_TEST(Projections, velocity_based_takes_a_ball_back_along_its_way_to_the_touch) {
  using S = TypeParam;
  const auto thrown = [](Projection p, int steps) {
    World<S> w = Projections<S>::world(p, 0, 1);
    add_ground(w, 0);
    const BodyId id = w.create(Projections<S>::body(add_ball(w, 0.5), {0, 0.5625, 0}, {3, -4, 0}));
    run(w, steps);
    return std::pair(real(w.center_of_mass(id)), real(w.velocity(id)));
  };
  const D3 touch = {3 * (0.0625 + kRest) / 4, 0.5 - kRest, 0};
  const auto [at, speed] = thrown(Projection::velocity_based, 2);
  expect_near(at, touch + D3{0.05, 0, 0}, kTolerance + 32 * grain<S>(), "from the touch along the wall");
  expect_near(speed, {3, 0, 0}, 4 * speed_grain<S>(), "impact");
  const double deep = 4.0 / 60 - 0.0625 - kRest;  // [m] less than continuous collision puts back
  for (const Projection p : {Projection::nonlinear, Projection::linear, Projection::relaxed}) {
    const auto [shoved, stopped] = thrown(p, 2);
    expect_near(shoved, {0.1, 0.5 - kRest - 0.75 * deep, 0}, kTolerance + 32 * grain<S>(), "along the normal alone");
    expect_near(stopped, {3, 0, 0}, 4 * speed_grain<S>(), "as fast");
  }
}

/// Both go back by the same share of their motion.
TYPED_TEST(Projections, velocity_based_takes_both_bodies_back_to_where_they_met) {
  using S = TypeParam;
  World<S> w = this->world(Projection::velocity_based, 0, 1);
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId a = w.create(this->body(ball, {0, 0, 0}, {3, 0, 0}));
  BodyDefinition<S> d = this->body(ball, {1.03125, 0, 0}, {-1, 0, 0});
  d.mass = w.mass(a) * S(8);
  const BodyId b = w.create(d);
  run(w, 2);
  const double time = (0.03125 + kRest) / 4, together = (3.0 - 8) / 9 / 60;  // [s] to the touch, [m] of the step after
  expect_near(real(w.center_of_mass(a)), {3 * time + together, 0, 0}, kTolerance + 32 * grain<S>(), "a");
  expect_near(real(w.center_of_mass(b)), {1.03125 - time + together, 0, 0}, kTolerance + 32 * grain<S>(), "b");
}

/// Ten boxes for ten seconds.
TYPED_TEST(Projections, each_holds_a_stack) {
  using S = TypeParam;
  this->with_each([](Projection p) {
    World<S> w = Projections<S>::world(p, -10, 4);
    add_ground(w, 0.5);
    const ShapeId shape = add_box(w, 0.5, 0.5, 0.5);
    std::vector<BodyId> boxes;
    for (int i = 0; i < 10; ++i) boxes.push_back(w.create(Projections<S>::body(shape, {0, 0.5 + i, 0}, {}, 0.5)));
    run(w, 600);
    double fastest = 0;
    for (const BodyId id : boxes) fastest = std::max(fastest, length(real(w.velocity(id))));
    const D3 top = real(w.center_of_mass(boxes[9]));
    if (std::getenv("ISOSTEP_SHOW") != nullptr) std::printf("%g %g %g, %g m/s\n", top.x, top.y - 9.5, top.z, fastest);
    expect_near(top, {0, 9.5, 0}, 0.02, "top");
    EXPECT_LT(fastest, pick<S>(0.02, 0.02, 0.04, 0.02)) << "Q16.16 sways by 1 cm";
  });
}

TYPED_TEST(Projections, that_are_not_in_the_list_are_a_fault_and_nonlinear) {
  using S = TypeParam;
  const World<S> w = this->world(static_cast<Projection>(kProjections));
  EXPECT_NE(w.fault(), Fault::none);
  EXPECT_EQ(std::string_view(w.fault().field), "projection");
  EXPECT_EQ(w.settings().projection, Projection::nonlinear);
  WorldState<S> state = w.state();
  state.settings.projection = static_cast<Projection>(kProjections);
  EXPECT_STREQ(broken_rule(state), "settings out of range");
}

}  // namespace worst_first_projection_test
}  // namespace isostep::test
