// The default solver on rows made by hand: collisions, restitution, overlap, links.
// SPDX-License-Identifier: MIT
#include "isostep/particles/solvers/soft_step.hpp"

#include "unit/particles/solver_room.hpp"

namespace isostep {
namespace {

template <class S> class SoftStepTest : public testing::Test {
 protected:
  SolverRoom<S, ParticleSoftStep> room_;
};
TYPED_TEST_SUITE(SoftStepTest, Scalars);

TYPED_TEST(SoftStepTest, BallsThatMeetShareTheirMotionAndRestitutionPartsThem) {
  auto& room = this->room_;
  const ParticleId a = room.add(kNowhere, {2, 0, 0}), b = room.add(kRight, {-2, 0, 0});
  room.rows.end_links();
  room.add_contact(a, b, 1, 0.5, 0.5);
  room.rows.end_contacts();
  room.solve_step();
  const double slack = 256 * grain<TypeParam>(4);
  EXPECT_NEAR(room.v(a).x, 0, slack);
  EXPECT_NEAR(room.v(b).x, 0, slack);
  EXPECT_NEAR(to_double(room.rows.all()[0].approach), -4, slack);
  room.solver.apply_restitution();
  EXPECT_NEAR(room.v(a).x, -1, slack);
  EXPECT_NEAR(room.v(b).x, 1, slack);
  EXPECT_EQ(to_double(room.rows.all()[0].impulse), 0) << "a blow is not a load";
}

TYPED_TEST(SoftStepTest, AnOverlapIsPushedApartAndLeavesNoVelocity) {
  auto& room = this->room_;
  const ParticleId a = room.add(kNowhere), b = room.add(kRight);
  room.rows.end_links();
  room.add_contact(a, b, 1.5, 0, 0.5);
  room.rows.end_contacts();
  room.solve_step();
  EXPECT_LT(room.d(a).x, -0.005);
  EXPECT_GT(room.d(b).x, 0.005);
  EXPECT_LE(room.d(b).x - room.d(a).x, 4.0 / 60 + 1e-3) << "at most 4 m/s";
  EXPECT_EQ(room.v(a).x, 0);
  EXPECT_EQ(room.v(b).x, 0);
}

TYPED_TEST(SoftStepTest, ACableAtItsEndHoldsAndASlackOneDoesNot) {
  for (const double length : {1.0, 2.0}) {
    SolverRoom<TypeParam, ParticleSoftStep> room;
    const ParticleId a = room.add(kRight, {1, 0, 0});
    const LinkId link = room.add_link(LinkType::cable, a, {}, length);
    ParticleConstraint<TypeParam> row = {};
    row.kind = ConstraintKind::cable;
    row.a = a.slot;
    row.b = kNoParticle;
    row.other = link.slot;
    row.share_a = Unit<TypeParam>(1);
    room.rows.add(row);
    room.rows.end_links();
    room.rows.end_contacts();
    room.solve_step();
    EXPECT_NEAR(room.v(a).x, length == 1 ? 0 : 1, 256 * grain<TypeParam>(1));
  }
}

}  // namespace
}  // namespace isostep
