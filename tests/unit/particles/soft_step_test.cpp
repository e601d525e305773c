// The default solver on rows made by hand: collisions, restitution, overlap, links.
// SPDX-License-Identifier: MIT
#include "isostep/particles/solvers/soft_step.hpp"

#include "unit/particles/solver_scene.hpp"

namespace isostep {
namespace soft_step_test {

template <class S> class SoftStepTest : public testing::Test {
 protected:
  SolverScene<S, ParticleSoftStep> scene_;
};
TYPED_TEST_SUITE(SoftStepTest, Scalars);

TYPED_TEST(SoftStepTest, BallsThatMeetShareTheirMotionAndRestitutionPartsThem) {
  auto& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere, {2, 0, 0}), b = scene.add(kRight, {-2, 0, 0});
  scene.rows.end_links();
  scene.add_contact(a, b, 1, 0.5, 0.5);
  scene.rows.end_contacts();
  scene.solve_step();
  const double slack = 256 * grain<TypeParam>(4);
  EXPECT_NEAR(scene.v(a).x, 0, slack);
  EXPECT_NEAR(scene.v(b).x, 0, slack);
  EXPECT_NEAR(to_double(scene.rows.all()[0].approach), -4, slack);
  scene.solver.apply_restitution();
  EXPECT_NEAR(scene.v(a).x, -1, slack);
  EXPECT_NEAR(scene.v(b).x, 1, slack);
  EXPECT_EQ(to_double(scene.rows.all()[0].impulse), 0) << "a blow is not a load";
}

TYPED_TEST(SoftStepTest, AnOverlapIsPushedApartAndLeavesNoVelocity) {
  auto& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere), b = scene.add(kRight);
  scene.rows.end_links();
  scene.add_contact(a, b, 1.5, 0, 0.5);
  scene.rows.end_contacts();
  scene.solve_step();
  EXPECT_LT(scene.d(a).x, -0.005);
  EXPECT_GT(scene.d(b).x, 0.005);
  EXPECT_LE(scene.d(b).x - scene.d(a).x, 4.0 / 60 + 1e-3) << "at most 4 m/s";
  EXPECT_EQ(scene.v(a).x, 0);
  EXPECT_EQ(scene.v(b).x, 0);
}

TYPED_TEST(SoftStepTest, ACableAtItsEndHoldsAndASlackOneDoesNot) {
  for (const double length : {1.0, 2.0}) {
    SolverScene<TypeParam, ParticleSoftStep> scene;
    const ParticleId a = scene.add(kRight, {1, 0, 0});
    const LinkId link = scene.add_link(LinkType::cable, a, {}, length);
    ParticleConstraint<TypeParam> row = {};
    row.kind = ConstraintKind::cable;
    row.a = a.slot;
    row.b = kNoParticle;
    row.other = link.slot;
    row.share_a = Unit<TypeParam>(1);
    scene.rows.add(row);
    scene.rows.end_links();
    scene.rows.end_contacts();
    scene.solve_step();
    EXPECT_NEAR(scene.v(a).x, length == 1 ? 0 : 1, 256 * grain<TypeParam>(1));
  }
}

}  // namespace soft_step_test
}  // namespace isostep
