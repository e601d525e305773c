// The worst-first resolver of rigid bodies against closed forms: impacts, friction, rest, projection, joints.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace worst_first_test {

template <class S> class WorstFirstBodies : public ::testing::Test {
 protected:
  static World<S> world(double gravity, std::int32_t substeps = 8) {
    Settings<S> s = settings<S>(gravity, 60, substeps);
    s.allow_sleep = false;
    s.solver = SolverName::worst_first;
    return World<S>(s);
  }
  static BodyDefinition<S> body(ShapeId shape, D3 position, D3 velocity = {0, 0, 0}, double mass = 1) {
    BodyDefinition<S> d = moving<S>(shape, position, velocity);
    d.mass = num<S>(mass);
    d.material.friction = S(0);
    return d;
  }
  /// A plane through the origin that falls along +x, at this angle.
  static void add_slope(World<S>& w, double angle, double friction) {
    using U = Unit<S>;
    BodyDefinition<S> d =
        still<S>(w.add_shape(HalfSpace<S>{{num<U>(std::sin(angle)), num<U>(std::cos(angle)), U(0)}, S(0)}));
    d.material.friction = num<S>(friction);
    w.create(d);
  }
};
TYPED_TEST_SUITE(WorstFirstBodies, AllScalars);

// ---- impacts

// O8.
TYPED_TEST(WorstFirstBodies, two_balls_part_by_the_law_of_impact) {
  using S = TypeParam;
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const double mass : {1.0, 3.0}) {
      World<S> w = this->world(0);
      const ShapeId ball = add_ball(w, 0.5);
      BodyDefinition<S> d = this->body(ball, {-1, 0, 0}, {2, 0, 0});
      d.material.restitution = num<S>(e);
      const BodyId a = w.create(d);
      d = this->body(ball, {1, 0, 0}, {-1, 0, 0}, mass);
      const BodyId b = w.create(d);
      run(w, 40);
      const double after_a = ((1 - e * mass) * 2 + (1 + e) * mass * -1) / (1 + mass);
      const double off = 64 * speed_grain<S>();
      expect_near(real(w.velocity(a)), {after_a, 0, 0}, off, "a");
      expect_near(real(w.velocity(b)), {(2 - mass - after_a) / mass, 0, 0}, off, "b");
    }
  }
}

// O11: J = -(1 + e) v_n / (1 / m_a + 1 / m_b + (r x n)^2 / I).
TYPED_TEST(WorstFirstBodies, an_impact_off_the_centre_turns_as_much_as_it_pushes) {
  using S = TypeParam;
  for (const double e : {0.0, 0.5, 1.0}) {
    World<S> w = this->world(0);
    const double mass = 4, half = 1, arm = 0.5, speed = 3;
    const double inertia = mass * (half * half + 0.25 * 0.25) / 3;
    const BodyId box = w.create(this->body(add_box(w, half, 0.25, 1), {0, 0, 0}, {0, 0, 0}, mass));
    BodyDefinition<S> d = this->body(add_ball(w, 0.25), {arm, 1, 0}, {0, -speed, 0});
    d.material.restitution = num<S>(e);
    const BodyId ball = w.create(d);
    for (int i = 0; i < 30 && real(w.velocity(box)).y == 0; ++i) w.step();
    const double impulse = (1 + e) * speed / (1 + 1 / mass + arm * arm / inertia);
    const double off = pick<S>(1e-5, 1e-13, 1e-3, 1e-8) * 10;
    expect_near(real(w.velocity(ball)), {0, impulse - speed, 0}, off, "ball");
    expect_near(real(w.velocity(box)), {0, -impulse / mass, 0}, off, "box");
    expect_near(real(w.angular_velocity(box)), {0, 0, -arm * impulse / inertia}, off, "angular velocity");
    // Angular momentum about the box's centre: the ball's before, m_ball arm (-speed).
    const double after = arm * real(w.velocity(ball)).y + inertia * real(w.angular_velocity(box)).z;
    EXPECT_NEAR(after, -arm * speed, 4 * off);
  }
}

// O10. One contact after another, the worst first: what solves all at once shares the blow among five.
TYPED_TEST(WorstFirstBodies, of_five_balls_in_a_row_only_the_last_moves_on) {
  using S = TypeParam;
  World<S> w = this->world(0);
  const ShapeId shape = add_ball(w, 0.5);
  std::vector<BodyId> balls;
  for (int i = 0; i < 5; ++i) {
    BodyDefinition<S> d = this->body(shape, {i == 0 ? -0.5 : i, 0, 0}, {i == 0 ? 2.0 : 0.0, 0, 0});
    d.material.restitution = S(1);
    balls.push_back(w.create(d));
  }
  run(w, 60);
  for (int i = 0; i < 5; ++i) {
    expect_near(real(w.velocity(balls[static_cast<std::size_t>(i)])), {i == 4 ? 2.0 : 0.0, 0, 0},
                256 * speed_grain<S>(), "ball");
  }
}

// O9: peaks h e^2, h e^4; 2 % for the part of a sub-step by which an impact comes early.
TYPED_TEST(WorstFirstBodies, a_bouncing_ball_rises_to_the_square_of_restitution_each_time) {
  using S = TypeParam;
  for (const double e : {0.5, 0.8, 1.0}) {
    World<S> w = this->world(-10);
    add_ground(w);
    BodyDefinition<S> d = this->body(add_ball(w, 0.5), {0, 2.5, 0});
    d.material.restitution = num<S>(e);
    const BodyId id = w.create(d);
    double last = 0, expected = 2;
    int peaks = 0;
    for (int i = 0; i < 300 && peaks < 2; ++i) {
      w.step();
      const double speed = real(w.velocity(id)).y;
      if (last > 0 && speed <= 0) {
        expected *= e * e;
        ++peaks;
        EXPECT_NEAR(real(w.center_of_mass(id)).y - 0.5, expected, 0.02 * 2 + 0.01) << e << ", peak " << peaks;
      }
      last = speed;
    }
    EXPECT_EQ(peaks, 2);
  }
}

// O24.
TYPED_TEST(WorstFirstBodies, a_crowd_without_scenery_keeps_its_momentum_and_gains_no_energy) {
  using S = TypeParam;
  World<S> w = this->world(0, 4);
  const ShapeId shapes[] = {add_ball(w, 0.5), add_box(w, 0.5, 0.375, 0.25), add_box(w, 0.25, 0.25, 0.75)};
  std::vector<BodyId> ids;
  std::vector<double> masses;
  D3 before = {0, 0, 0};
  double energy = 0;
  for (int i = 0; i < 27; ++i) {
    const D3 at = {1.25 * (i % 3 - 1), 1.25 * (i / 3 % 3 - 1), 1.25 * (i / 9 - 1)};
    masses.push_back(1 + i % 3);
    BodyDefinition<S> d = this->body(shapes[i % 3], at, at * -1.5, masses.back());
    d.material.friction = num<S>(0.5);
    d.material.restitution = num<S>(0.25 * (i % 4));
    ids.push_back(w.create(d));
    before = before + real(w.velocity(ids.back())) * masses.back();
    energy += masses.back() * dot(at, at) * 1.5 * 1.5 / 2;
  }
  std::uint32_t begins = 0;
  for (int i = 0; i < 60; ++i) {
    w.step();
    begins += static_cast<std::uint32_t>(w.events().contact_begin.size());
  }
  EXPECT_GT(begins, 20u);
  D3 after = {0, 0, 0};
  double left = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const D3 v = real(w.velocity(ids[i]));
    after = after + v * masses[i];
    left += masses[i] * dot(v, v) / 2;
  }
  // Thousands of impulses, rounded to either side.
  expect_near(after, before, 3000 * speed_grain<S>(), "momentum");
  EXPECT_LT(left, energy);
}

// ---- friction

// O16.
TYPED_TEST(WorstFirstBodies, a_block_rests_on_a_slope_exactly_while_its_tangent_is_below_friction) {
  using S = TypeParam;
  const double angle = std::atan(0.5);
  for (const double part : {0.9, 1.1}) {
    World<S> w = this->world(-10);
    this->add_slope(w, angle, part * 0.5);
    BodyDefinition<S> d = this->body(add_box(w, 0.5, 0.25, 0.5), D3{std::sin(angle), std::cos(angle), 0} * 0.25);
    d.orientation = turn<S>({0, 0, 1}, -angle);
    d.material.friction = num<S>(part * 0.5);
    const BodyId id = w.create(d);
    run(w, 12);
    const D3 from = real(w.center_of_mass(id)), v = real(w.velocity(id));
    run(w, part > 1 ? 300 : 60);
    if (part > 1) {
      EXPECT_LT(length(real(w.center_of_mass(id)) - from), pick<S>(1e-3, 1e-3, 5e-3, 1e-3));
    } else {
      const double a = 10 * (std::sin(angle) - part * 0.5 * std::cos(angle));
      const D3 down = {std::cos(angle), -std::sin(angle), 0};
      EXPECT_NEAR(dot(real(w.velocity(id)) - v, down), a, pick<S>(0.02, 0.02, 0.06, 0.02) * a);
    }
  }
}

TYPED_TEST(WorstFirstBodies, a_belt_carries_what_lies_on_it_up_to_its_own_speed) {
  using S = TypeParam;
  World<S> w = this->world(-10);
  BodyDefinition<S> belt = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
  belt.material.friction = num<S>(0.25);
  belt.material.surface_velocity = vec<S>(1.5, 0, -2);
  w.create(belt);
  BodyDefinition<S> d = this->body(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0});
  d.material.friction = num<S>(0.25);
  const BodyId id = w.create(d);
  run(w, 30);  // 2.5 m/s at 0.25 * 10 m/s^2: half way
  expect_near(real(w.velocity(id)), {0.75, 0, -1}, 0.03, "half way");
  run(w, 60);
  expect_near(real(w.velocity(id)), {1.5, 0, -2}, pick<S>(1e-3, 1e-3, 2e-3, 1e-3), "carried");
}

// m a = F, I a / r = c N - F r: a = 5 c g / (7 r).
TYPED_TEST(WorstFirstBodies, rolling_resistance_slows_a_ball_by_its_lever_and_friction_spins_it) {
  using S = TypeParam;
  World<S> w = this->world(-10);
  add_ground(w, 0.6);
  BodyDefinition<S> d = this->body(add_ball(w, 0.5), {0, 0.5, 0}, {3, 0, 1});
  d.angular_velocity = vec<S>(2, 0, -6);
  d.material.friction = num<S>(0.6);
  d.material.rolling_resistance = num<S>(0.0625);
  const BodyId id = w.create(d);
  run(w, 60);
  const double kept = 1 - 5 * 0.0625 * 10 / (7 * 0.5) / std::sqrt(10.0);
  expect_near(real(w.velocity(id)), {3 * kept, 0, kept}, 0.03, "slowed");
  run(w, 240);
  expect_near(real(w.velocity(id)), {0, 0, 0}, pick<S>(1e-3, 1e-3, 2e-3, 1e-3), "stopped");
}

// ---- rest

TYPED_TEST(WorstFirstBodies, gravity_of_a_sub_step_does_not_make_a_resting_ball_bounce) {
  using S = TypeParam;
  for (const std::int32_t substeps : {1, 4}) {
    World<S> w = this->world(-10, substeps);
    add_ground(w);
    BodyDefinition<S> d = this->body(add_ball(w, 0.5), {0, 0.5, 0});
    d.material.restitution = num<S>(0.9);
    const BodyId id = w.create(d);
    for (int i = 0; i < 300; ++i) {
      w.step();
      ASSERT_LT(std::fabs(real(w.velocity(id)).y), 10.0 / (60 * substeps)) << i;
      ASSERT_NEAR(real(w.center_of_mass(id)).y, 0.5, 1e-3) << i;
    }
  }
}

// Without the removal 10 / 60 m/s would bounce back as 0.15 m/s in every sub-step.
TYPED_TEST(WorstFirstBodies, nor_a_stack_of_them_though_it_comes_through_others) {
  using S = TypeParam;
  World<S> w = this->world(-10, 1);
  add_ground(w);
  const ShapeId shape = add_box(w, 0.5, 0.5, 0.5);
  std::vector<BodyId> boxes;
  for (int i = 0; i < 4; ++i) {
    BodyDefinition<S> d = this->body(shape, {0, 0.5 + i, 0});
    d.material.friction = num<S>(0.5);
    d.material.restitution = num<S>(0.9);
    boxes.push_back(w.create(d));
  }
  for (int i = 0; i < 240; ++i) {
    w.step();
    for (int k = 0; k < 4; ++k) {
      const BodyId id = boxes[static_cast<std::size_t>(k)];
      ASSERT_NEAR(real(w.center_of_mass(id)).y, 0.5 + k, 0.02) << i;
    }
  }
  for (const BodyId id : boxes) EXPECT_LT(length(real(w.velocity(id))), 0.02);
}

// O19, and BOOK's own collapse after 0.3 s.
TYPED_TEST(WorstFirstBodies, ten_boxes_stand_for_ten_seconds) {
  using S = TypeParam;
  World<S> w = this->world(-10, 4);
  add_ground(w, 0.5);
  const ShapeId shape = add_box(w, 0.5, 0.5, 0.5);
  std::vector<BodyId> boxes;
  for (int i = 0; i < 10; ++i) {
    BodyDefinition<S> d = this->body(shape, {0, 0.5 + i, 0});
    d.material.friction = num<S>(0.5);
    boxes.push_back(w.create(d));
  }
  run(w, 600);
  expect_near(real(w.center_of_mass(boxes[9])), {0, 9.5, 0}, 0.02, "top");
}

// ---- projection

// Moved n lambda / m and turned I^-1 (r x n) lambda: by how much is left open, in what ratio is not.
TYPED_TEST(WorstFirstBodies, overlap_off_the_centre_is_shared_by_moving_and_turning_and_makes_no_speed) {
  using S = TypeParam;
  World<S> w = this->world(0, 1);
  w.create(still<S>(add_ball(w, 0.5), {0.75, -0.75 + 0.03125, 0}));
  const BodyId id = w.create(this->body(add_box(w, 1, 0.25, 1), {0, 0, 0}));
  const double kappa = 3 / (1 + 0.25 * 0.25), arm = 0.75;
  const auto moved = [&] {
    const double risen = real(w.center_of_mass(id)).y, turned = 2 * to_double(w.pose(id).orientation.z);
    EXPECT_NEAR(turned, kappa * arm * risen, 0.02 * turned + 4 * grain<S>());
    return risen + arm * turned;
  };
  w.step();
  const double first = moved();
  EXPECT_GT(first, 0.002);
  EXPECT_LT(first, 0.016) << "relaxed: not all at once";
  expect_near(real(w.velocity(id)), {0, 0, 0}, 0, "speed");
  expect_near(real(w.angular_velocity(id)), {0, 0, 0}, 0, "angular velocity");
  run(w, 60);
  // To what a resting contact keeps, half a millimetre.
  EXPECT_NEAR(moved(), 0.03125 - 0.0005, 5e-4);
}

// A rod's end is light: three quarters of the way would be turning, 0.35 rad of it.
TYPED_TEST(WorstFirstBodies, no_projection_turns_a_body_by_more_than_a_fifth_and_moves_it_the_rest) {
  using S = TypeParam;
  World<S> w = this->world(0, 1);
  w.create(still<S>(add_ball(w, 0.5), {0.09375, -0.3125, 0}));
  BodyDefinition<S> d = this->body(add_box(w, 0.109375, 0.03125, 0.03125), {0, 0, 0});
  const BodyId id = w.create(d);
  w.step();
  const double turned = 2 * std::asin(to_double(w.pose(id).orientation.z)), risen = real(w.center_of_mass(id)).y;
  EXPECT_NEAR(turned, 0.2, 1e-3);
  EXPECT_NEAR(risen + 0.09375 * turned, 0.05, 1e-3) << "3 m/s for a sixtieth of a second";
}

TYPED_TEST(WorstFirstBodies, a_stretched_rod_closes_without_making_speed_and_keeps_the_centre_of_mass) {
  using S = TypeParam;
  World<S> w = this->world(0, 4);
  const ShapeId ball = add_ball(w, 0.125);
  const BodyId a = w.create(this->body(ball, {0, 0, 0})), b = w.create(this->body(ball, {1.25, 0, 0}, {0, 0, 0}, 3));
  JointProperties<S> rod = w.joint_at(JointType::distance, a, b, Pose<S>::identity());
  rod.frame_a.position = rod.frame_b.position = Vec3<S>::zero();
  rod.lower = rod.upper = S(1);
  const JointId id = w.create(rod);
  ASSERT_TRUE(id) << describe(w.fault());
  run(w, 30);
  EXPECT_LT(to_double(w.joint_error(id)), 1e-4);
  expect_near(real(w.velocity(a)), {0, 0, 0}, 0, "speed");
  const D3 centre = real(w.center_of_mass(a)) * 0.25 + real(w.center_of_mass(b)) * 0.75;
  expect_near(centre, {0.9375, 0, 0}, 64 * grain<S>(), "centre of mass");
}

// ---- joints

// Joints of every kind bear a weight of ten times the link's; the whole moves as its limits let it.
TYPED_TEST(WorstFirstBodies, a_chain_of_joints_holds_a_weight) {
  using S = TypeParam;
  for (std::uint32_t kind = 0; kind < kJointTypes; ++kind) {
    const auto type = static_cast<JointType>(kind);
    if (type == JointType::planar || type == JointType::angular) continue;  // they let it fall
    World<S> w = this->world(-10, 8);
    const ShapeId link = add_box(w, 0.0625, 0.25, 0.0625), weight = add_ball(w, 0.25);
    BodyId last;
    std::vector<JointId> joints;
    for (int i = 0; i < 6; ++i) {
      const bool end = i == 5;
      const double y = -0.25 - 0.5 * i;
      const BodyId id = w.create(this->body(end ? weight : link, {0, y, 0}, {end ? 1.0 : 0, 0, 0}, end ? 10 : 1));
      JointProperties<S> j = w.joint_at(type, last, id, {vec<S>(0, y + 0.25, 0), Quat<Unit<S>>::identity()});
      if (type == JointType::distance) j.upper = num<S>(0.125);
      if (type == JointType::six_axis) j.flags = joint_flag::kLockPoint;
      joints.push_back(w.create(j));
      ASSERT_TRUE(joints.back()) << describe(w.fault());
      last = id;
    }
    double worst = 0;
    for (int i = 0; i < 180; ++i) {
      w.step();
      for (const JointId id : joints) worst = std::max(worst, to_double(w.joint_error(id)));
    }
    EXPECT_LT(worst, 0.01) << static_cast<int>(type);
    EXPECT_GT(real(w.center_of_mass(last)).y, -3.75);
    EXPECT_LT(real(w.center_of_mass(last)).y, -2) << "it hangs";
  }
}

TYPED_TEST(WorstFirstBodies, a_motor_turns_as_told_until_its_limit_stops_it) {
  using S = TypeParam;
  World<S> w = this->world(0, 4);
  const BodyId id = w.create(this->body(add_box(w, 0.5, 0.25, 0.25), {0, 0, 0}));
  JointProperties<S> j = w.joint_at(JointType::hinge, {}, id, Pose<S>::identity());
  j.flags = joint_flag::kMotor | joint_flag::kLimit;
  j.motor_speed = S(2);
  j.max_force = S(10);
  j.lower = num<S>(-0.5);
  j.upper = S(1);
  ASSERT_TRUE(w.create(j)) << describe(w.fault());
  run(w, 20);
  expect_near(real(w.angular_velocity(id)), {0, 0, 2}, 2e-3, "turns");
  run(w, 60);
  expect_near(real(w.angular_velocity(id)), {0, 0, 0}, 2e-3, "stopped");
  EXPECT_NEAR(2 * std::asin(to_double(w.pose(id).orientation.z)), 1, 2e-3);
}

}  // namespace worst_first_test
}  // namespace isostep::test
