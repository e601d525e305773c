// Projected Gauss-Seidel: rest, convergence with passes, and what one joint after another costs.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace pgs_test {

template <class S> World<S> world_of(SolverName solver, std::int32_t substeps) {
  Settings<S> s = settings<S>(-10, 60, substeps);
  s.allow_sleep = false;
  s.solver = solver;
  return World<S>(s);
}

template <class S> class Pgs : public ::testing::Test {};
TYPED_TEST_SUITE(Pgs, AllScalars);

TYPED_TEST(Pgs, a_dropped_box_comes_to_rest_on_the_floor_and_is_told_to_touch_it) {
  using S = TypeParam;
  World<S> w = world_of<S>(SolverName::pgs, 8);
  add_ground(w);
  const BodyId id = w.create(moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.5, 0}));
  std::size_t begins = 0;
  for (int i = 0; i < 180; ++i) {
    w.step();
    begins += w.events().contact_begin.size();
  }
  EXPECT_EQ(begins, 1u);
  expect_near(real(w.center_of_mass(id)), {0, 0.25, 0}, 2e-3, "centre");
  EXPECT_LT(length(real(w.velocity(id))), pick<S>(1e-4, 1e-6, 1e-3, 1e-6));
}

// From no impulses at all: after the first step nothing should move, and the exact answer is 3, 2, 1 times g h.
TYPED_TEST(Pgs, the_more_passes_the_less_is_left_of_a_stacks_fall) {
  using S = TypeParam;
  double last = 1e9;
  for (const std::int32_t passes : {1, 4, 16, 64}) {
    World<S> w = world_of<S>(SolverName::pgs, passes);
    add_ground(w);
    const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
    std::vector<BodyId> boxes;
    for (int i = 0; i < 3; ++i) boxes.push_back(w.create(moving<S>(box, {0, 0.5 + i, 0})));
    w.step();
    double fastest = 0;
    for (const BodyId id : boxes) fastest = std::max(fastest, length(real(w.velocity(id))));
    EXPECT_LT(fastest, 0.7 * last) << passes << " passes";
    last = fastest;
  }
  EXPECT_LT(last, 5e-3) << "of 0.17 m/s";
}

// The count of passes is no count of sub-steps: h stays 1 / hz, as a damped fall shows: v' = (v - g h) / (1 + c h).
TYPED_TEST(Pgs, passes_do_not_divide_the_step) {
  using S = TypeParam;
  for (const std::int32_t passes : {1, 16}) {
    World<S> w = world_of<S>(SolverName::pgs, passes);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 10, 0});
    d.linear_damping = S(2);
    const BodyId id = w.create(d);
    run(w, 30);
    double y = 10, v = 0;
    for (int i = 0; i < 30; ++i) {
      v = (v - 10.0 / 60) / (1 + 2.0 / 60);
      y += v / 60;
    }
    EXPECT_NEAR(real(w.center_of_mass(id)).y, y, pick<S>(1e-5, 1e-12, 2e-3, 1e-7));
  }
}

// Trees solve a chain at once; one joint after another carries the weight up by a link a pass.
TYPED_TEST(Pgs, a_chain_with_a_weight_comes_further_apart_than_in_trees) {
  using S = TypeParam;
  const auto worst_error = [](SolverName solver) {
    World<S> w = world_of<S>(solver, 4);
    const ShapeId link = add_box(w, 0.25, 0.0625, 0.0625), weight = add_ball(w, 0.375);
    BodyId last;
    std::vector<JointId> joints;
    for (int i = 0; i < 16; ++i) {
      BodyDefinition<S> d = moving<S>(i == 15 ? weight : link, {0.25 + 0.5 * i, 0, 0});
      d.mass = i == 15 ? S(10) : S(1);
      d.collide = false;
      const BodyId id = w.create(d);
      joints.push_back(
          w.create(w.joint_at(JointType::ball, last, id, {vec<S>(0.5 * i, 0, 0), Quat<Unit<S>>::identity()})));
      last = id;
    }
    double worst = 0;
    for (int i = 0; i < 90; ++i) {
      w.step();
      for (const JointId id : joints) worst = std::max(worst, to_double(w.joint_error(id)));
    }
    return worst;
  };
  const double pgs = worst_error(SolverName::pgs), trees = worst_error(SolverName::soft_step);
  EXPECT_GT(pgs, 5 * trees);
  EXPECT_LT(pgs, 1) << "it does hang together";
}

}  // namespace pgs_test
}  // namespace isostep::test
