// Worst-first resolution within a sub-step, and time division, on rows made by hand.
// SPDX-License-Identifier: MIT
#include "isostep/particles/solvers/worst_first_step.hpp"

#include "unit/particles/solver_room.hpp"

namespace isostep {
namespace {

template <class S> class WorstFirstStepTest : public testing::Test {
 protected:
  SolverRoom<S, WorstFirstStep> room_;
};
TYPED_TEST_SUITE(WorstFirstStepTest, Scalars);

TYPED_TEST(WorstFirstStepTest, OfARowOfBallsOnlyTheLastMoves) {
  auto& room = this->room_;
  ParticleId balls[4];
  for (int i = 0; i < 4; ++i) balls[i] = room.add({static_cast<double>(i), 0, 0}, i == 0 ? D3{2, 0, 0} : kNowhere);
  room.rows.end_links();
  for (int i = 0; i < 3; ++i) room.add_contact(balls[i], balls[i + 1], 1, 1, 0.5);
  room.rows.end_contacts();
  room.solve_step();
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(room.v(balls[i]).x, i == 3 ? 2 : 0, 64 * grain<TypeParam>(2));
  EXPECT_TRUE(room.step.report.clean());
}

TYPED_TEST(WorstFirstStepTest, WithoutTimeDivisionABulletPassesAndWithItItBouncesWhereItMet) {
  for (const Stepping stepping : {Stepping::fixed, Stepping::time_division}) {
    SolverRoom<TypeParam, WorstFirstStep> room;
    room.state.settings.substeps = 1;
    room.state.settings.stepping = stepping;
    room.state.colliders.add(Collider<TypeParam>{});  // the plane y = 0
    const ParticleId bullet = room.add({0, 0.5, 0}, {0, -60, 0});
    room.rows.end_links();
    room.add_contact(bullet, {}, 0, 1, 1);
    room.rows.end_contacts();
    room.solve_step();
    const double y = 0.5 + room.d(bullet).y;
    const bool divides = stepping == Stepping::time_division;
    EXPECT_NEAR(y, divides ? 0.5 : -0.5, 256 * grain<TypeParam>(1));
    EXPECT_NEAR(room.v(bullet).y, divides ? 60 : -60, 256 * grain<TypeParam>(60));
  }
}

TYPED_TEST(WorstFirstStepTest, LooksThatAreOverAreReported) {
  auto& room = this->room_;
  room.state.settings.looks = 1;
  const ParticleId a = room.add(kNowhere, {2, 0, 0}), b = room.add(kRight, {-2, 0, 0});
  room.rows.end_links();
  room.add_contact(a, b, 1, 0, 0.5);
  room.rows.end_contacts();
  room.solve_step();
  EXPECT_GT(room.step.report.spent, 0u);
  EXPECT_NEAR(room.v(a).x, 0, 64 * grain<TypeParam>(2)) << "every constraint is resolved once more";
}

}  // namespace
}  // namespace isostep
