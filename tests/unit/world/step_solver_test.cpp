// StepSolver alone: what a step's solver is given.
// SPDX-License-Identifier: MIT

#include "isostep/world/step_solver.hpp"

#include <set>

#include "built.hpp"
#include "isostep/world/solvers.inl"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace step_solver_test {

template <class S> class StepSolvers : public ::testing::Test {
 protected:
  StepSolvers() : systems(made()) { tools.use_simd(Simd::scalar); }
  World<S>& made() {
    const ShapeId ball = add_ball(world, 0.5);
    fixed = world.create(still<S>(ball, {0, 4, 0}));
    awake = world.create(moving<S>(ball, {0, 2, 0}));
    world.create(world.joint_at(JointType::ball, fixed, awake, {vec<S>(0, 4, 0), Quat<Unit<S>>::identity()}));
    return world;
  }

  World<S> world{settings<S>(0)};
  BodyId fixed, awake;
  Systems<S> systems;
  StepTools<S> tools = {};
  StepSolver<S> solver{systems.state, systems.map, systems.proxies};
};
TYPED_TEST_SUITE(StepSolvers, SystemScalars);

TYPED_TEST(StepSolvers, forces_become_accelerations_and_leave_the_state) {
  using S = TypeParam;
  this->systems.state.forces = {{this->awake.slot, 1, vec<S>(3, 0, 0), vec<S>(0, 0, 5)}};
  StepReport report;
  this->solver.take_forces();
  this->solver.report_forces(report);
  EXPECT_TRUE(this->systems.state.forces.empty());
  EXPECT_EQ(report.clamped_force, 1u);
  const StepContext<S> context = this->solver.context({}, {}, {}, {}, this->tools, false);
  ASSERT_EQ(context.accelerations.size(), 1u);
  EXPECT_EQ(context.accelerations[0].linear, vec<S>(3, 0, 0));
  this->solver.take_forces();
  this->solver.report_forces(report);
  EXPECT_TRUE(this->solver.context({}, {}, {}, {}, this->tools, false).accelerations.empty());
}

TYPED_TEST(StepSolvers, joints_know_the_rows_and_the_poses_of_their_ends) {
  using S = TypeParam;
  const StepContext<S> context = this->solver.context({}, {}, {}, {}, this->tools, true);
  EXPECT_TRUE(context.watched);
  ASSERT_EQ(context.joint_ends.size(), 1u);
  EXPECT_EQ(context.joint_ends[0].a.row, 0u);
  EXPECT_EQ(context.joint_ends[0].b.row, 1u);
  EXPECT_EQ(context.joint_ends[0].b.pose.position, vec<S>(0, 2, 0));
}

/// The awake ball flies up; then it has come to the fixed one, which stops it.
TYPED_TEST(StepSolvers, the_solver_of_the_settings_moves_the_bodies_and_tells_the_impulses_of_contacts) {
  using S = TypeParam;
  using V = Velocity<S>;
  WorldState<S>& state = this->systems.state;
  state.joints = {};
  const BodyState<S> start = this->systems.awake(this->awake);
  const BodyState<S>& ball = this->systems.awake(this->awake);
  std::vector<ContactGeometry<S>> geometry;
  const auto solve_from = [&](double y) {
    state.awake.states[0] = start;
    state.awake.states[0].centre = vec<S>(0, y, 0);
    state.awake.states[0].velocity = vec<V>(0, 6, 0);
    const StepContext<S> context = this->solver.context(geometry, {}, {}, {}, this->tools, false);
    const void* used = nullptr;
    this->solver.with_solver([&](auto& chosen) {
      used = &chosen;
      chosen.colour_constraints(context);
      chosen.prepare(context);
      chosen.solve_substeps(context);
      chosen.store_impulses(context);
    });
    return used;
  };
  std::set<const void*> all_used;
  for (std::uint32_t name = 0; name < kSolvers; ++name) {
    if (left_out(SolverName{name}) != nullptr) continue;
    SCOPED_TRACE(kSolverNames[name]);
    state.settings.solver = static_cast<SolverName>(name);
    state.contacts.clear();
    geometry.clear();
    all_used.insert(solve_from(2));
    EXPECT_NEAR(to_double(ball.centre.y), 2.1, 1e-5);
    EXPECT_TRUE(this->solver.impulses().empty());

    Contact<S> contact = {};
    contact.key = {this->fixed.slot, this->awake.slot, 0, 0};
    contact.count = 1;
    state.contacts.push_back(contact);
    ContactGeometry<S> touch = {};
    touch.row_b = 1;
    touch.normal.y = Unit<S>(-1);
    touch.points[0].arm_a = vec<S>(0, -0.5, 0);
    touch.points[0].arm_b = vec<S>(0, 0.5, 0);
    geometry.push_back(touch);
    all_used.insert(solve_from(3));
    const double near = state.settings.solver == SolverName::avbd ? 0.1 : 0.05;  // it has four passes for 6 m/s
    EXPECT_NEAR(to_double(ball.velocity.y), 0, near);
    ASSERT_EQ(this->solver.impulses().size(), 1u);
    EXPECT_NEAR(to_double(this->solver.impulses()[0]), 6, near);
    EXPECT_EQ(state.contacts[0].flags, contact_flag::kTouching);
  }
  EXPECT_EQ(all_used.size(), std::size(kBuiltSolvers)) << "each name has a solver of its own";
}

}  // namespace step_solver_test
}  // namespace isostep::test
