// Mechanisms alone: which rows a step's solver is given, and what they do to velocities.
// SPDX-License-Identifier: MIT

#include "isostep/systems/mechanisms/mechanisms.hpp"

#include <optional>
#include <vector>

#include "isostep/dynamics/solvers/body_rows.hpp"
#include "isostep/world/step_solver.hpp"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace mechanisms_test {

constexpr std::int32_t kRate = 480;

/// Two cubes of 6 kg and 1 kg m^2 on hinges along z, geared 1 to 2; the first turns at 10 rad/s. Nothing falls.
template <class S> class MechanismRowsAlone : public ::testing::Test {
 protected:
  using V = Velocity<S>;

  MechanismRowsAlone() {
    for (int i = 0; i < 2; ++i) {
      BodyDefinition<S> d = moving<S>(add_box(world, 0.5, 0.5, 0.5), {4.0 * i, 0, 0});
      d.mass = S(6);
      d.angular_velocity = vec<S>(0, 0, i == 0 ? 10 : 0);
      bodies[i] = world.create(d);
      joints[i] = world.create(
          world.joint_at(JointType::hinge, {}, bodies[i], {vec<S>(4.0 * i, 0, 0), Quat<Unit<S>>::identity()}));
    }
  }
  void load() {
    systems.emplace(world);
    solver.emplace(systems->state, systems->map, systems->proxies);
    solver->take_forces();
  }
  StepContext<S> context() { return solver->context({}, {}, {}, {}, tools, false); }

  World<S> world{settings<S>(0)};
  BodyId bodies[2];
  JointId joints[2];
  StepTools<S> tools = {};
  std::optional<Systems<S>> systems;
  std::optional<StepSolver<S>> solver;
};
TYPED_TEST_SUITE(MechanismRowsAlone, SystemScalars);

TYPED_TEST(MechanismRowsAlone, are_none_without_wheels_and_couplings) {
  this->load();
  EXPECT_FALSE(this->context().mechanisms.any());
}

/// w_a + 2 w_b = 0 takes 2 kg m^2/s of the first and twice that of the second.
TYPED_TEST(MechanismRowsAlone, gear_what_turns_and_tell_what_they_bore) {
  using S = TypeParam;
  const CouplingId gear = this->world.add(gears<S>(this->joints[0], 1, this->joints[1], 2));
  ASSERT_TRUE(gear) << describe(this->world.fault());
  this->load();
  const StepContext<S> context = this->context();
  const MechanismRows<S>& mechanisms = context.mechanisms;
  ASSERT_TRUE(mechanisms.any());
  EXPECT_TRUE(mechanisms.couples);
  EXPECT_EQ(std::vector<std::uint32_t>(mechanisms.bodies.begin(), mechanisms.bodies.end()),
            (std::vector<std::uint32_t>{1, 2}));
  BodyRows<S> rows;
  rows.gather(context, kRate, true);
  const auto spin = [&](std::size_t row) { return to_double(rows.rows().velocity[row].angular.z); };
  mechanisms.place(rows.rows(), kRate);
  EXPECT_NEAR(spin(1), 10, 1e-6);
  mechanisms.solve(rows.rows(), 1);
  EXPECT_NEAR(spin(1), 8, 1e-3);
  EXPECT_NEAR(spin(2), -4, 1e-3);
  mechanisms.close(rows.rows());
  mechanisms.relax(rows.rows());
  mechanisms.end();
  EXPECT_NEAR(spin(1), 8, 1e-3);
  EXPECT_NEAR(spin(2), -4, 1e-3);
  StepReport report = {};
  this->solver->report_forces(report);
  EXPECT_NEAR(to_double(this->systems->state.parts.coupling_states[gear.slot].load), -2.0 * kRate, 1);
}

TYPED_TEST(MechanismRowsAlone, begin_with_three_quarters_of_what_they_bore) {
  using S = TypeParam;
  const CouplingId gear = this->world.add(gears<S>(this->joints[0], 1, this->joints[1], 2));
  this->load();
  this->systems->state.parts.coupling_states[gear.slot].load = S(kRate);
  this->solver->take_forces();
  const StepContext<S> context = this->context();
  BodyRows<S> rows;
  rows.gather(context, kRate, true);
  context.mechanisms.place(rows.rows(), kRate);
  EXPECT_NEAR(to_double(rows.rows().velocity[1].angular.z), 10.75, 1e-3);
  EXPECT_NEAR(to_double(rows.rows().velocity[2].angular.z), 1.5, 1e-3);
}

TYPED_TEST(MechanismRowsAlone, are_none_of_joints_that_hold_nothing) {
  using S = TypeParam;
  const CouplingId gear = this->world.add(gears<S>(this->joints[0], 1, this->joints[1], 2));
  run(this->world, 1);
  ASSERT_FALSE(this->world.state(gear)->load == S(0));
  ASSERT_TRUE(this->world.set_enabled(this->bodies[1], false));
  this->load();
  EXPECT_FALSE(this->context().mechanisms.any());
  EXPECT_TRUE(this->systems->state.parts.coupling_states[gear.slot].load == S(0));
}

TYPED_TEST(MechanismRowsAlone, of_wheels_push_their_body_and_what_they_stand_on) {
  using S = TypeParam;
  BodyDefinition<S> raft = moving<S>(add_box(this->world, 2, 0.25, 2), {0, -3, 0});
  raft.mass = S(600);
  this->world.create(raft);
  BodyDefinition<S> d = moving<S>(add_box(this->world, 0.5, 0.25, 0.5), {0, -2.25, 0});
  d.mass = S(60);
  const BodyId cart = this->world.create(d);
  WheelSettings<S> wheel;
  wheel.body = cart;
  wheel.stiffness = S(20000);
  ASSERT_TRUE(this->world.add(wheel)) << describe(this->world.fault());
  this->load();
  this->systems->find_pairs();
  this->solver->take_forces();
  const StepContext<S> context = this->context();
  ASSERT_TRUE(context.mechanisms.any());
  EXPECT_FALSE(context.mechanisms.couples);
  EXPECT_EQ(std::vector<std::uint32_t>(context.mechanisms.bodies.begin(), context.mechanisms.bodies.end()),
            (std::vector<std::uint32_t>{3, 4}));
  BodyRows<S> rows;
  rows.gather(context, kRate, true);
  context.mechanisms.place(rows.rows(), kRate);
  context.mechanisms.solve(rows.rows(), kMechanismSweeps);
  const double cart_up = to_double(rows.rows().velocity[4].linear.y),
               raft_up = to_double(rows.rows().velocity[3].linear.y);
  EXPECT_GT(cart_up, 0.01);
  EXPECT_NEAR(60 * cart_up + 600 * raft_up, 0, 0.01);
}

}  // namespace mechanisms_test
}  // namespace isostep::test
