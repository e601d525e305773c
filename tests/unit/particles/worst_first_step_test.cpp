// Worst-first resolution within a sub-step, and time division, on rows made by hand.
// SPDX-License-Identifier: MIT
#include "isostep/particles/solvers/worst_first_step.hpp"

#include "unit/particles/solver_scene.hpp"

namespace isostep {
namespace worst_first_step_test {

template <class S> class WorstFirstStepTest : public testing::Test {
 protected:
  SolverScene<S, WorstFirstStep> scene_;
};
TYPED_TEST_SUITE(WorstFirstStepTest, Scalars);

TYPED_TEST(WorstFirstStepTest, OfARowOfBallsOnlyTheLastMoves) {
  auto& scene = this->scene_;
  ParticleId balls[4];
  for (int i = 0; i < 4; ++i) balls[i] = scene.add({static_cast<double>(i), 0, 0}, i == 0 ? D3{2, 0, 0} : kNowhere);
  scene.rows.end_links();
  for (int i = 0; i < 3; ++i) scene.add_contact(balls[i], balls[i + 1], 1, 1, 0.5);
  scene.rows.end_contacts();
  scene.solve_step();
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(scene.v(balls[i]).x, i == 3 ? 2 : 0, 64 * grain<TypeParam>(2));
  EXPECT_TRUE(scene.step.report.clean());
}

TYPED_TEST(WorstFirstStepTest, WithoutTimeDivisionABulletPassesAndWithItItBouncesWhereItMet) {
  for (const Stepping stepping : {Stepping::fixed, Stepping::time_division}) {
    SolverScene<TypeParam, WorstFirstStep> scene;
    scene.state.settings.substeps = 1;
    scene.state.settings.stepping = stepping;
    scene.state.colliders.add(Collider<TypeParam>{});  // the plane y = 0
    const ParticleId bullet = scene.add({0, 0.5, 0}, {0, -60, 0});
    scene.rows.end_links();
    scene.add_contact(bullet, {}, 0, 1, 1);
    scene.rows.end_contacts();
    scene.solve_step();
    const double y = 0.5 + scene.d(bullet).y;
    const bool divides = stepping == Stepping::time_division;
    EXPECT_NEAR(y, divides ? 0.5 : -0.5, 256 * grain<TypeParam>(1));
    EXPECT_NEAR(scene.v(bullet).y, divides ? 60 : -60, 256 * grain<TypeParam>(60));
  }
}

TYPED_TEST(WorstFirstStepTest, LooksThatAreOverAreReported) {
  auto& scene = this->scene_;
  scene.state.settings.looks = 1;
  const ParticleId a = scene.add(kNowhere, {2, 0, 0}), b = scene.add(kRight, {-2, 0, 0});
  scene.rows.end_links();
  scene.add_contact(a, b, 1, 0, 0.5);
  scene.rows.end_contacts();
  scene.solve_step();
  EXPECT_GT(scene.step.report.spent, 0u);
  EXPECT_NEAR(scene.v(a).x, 0, 64 * grain<TypeParam>(2)) << "every constraint is resolved once more";
}

}  // namespace worst_first_step_test
}  // namespace isostep
