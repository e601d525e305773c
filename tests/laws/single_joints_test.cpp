// Laws of one body on one joint with a spring, a motor, limits: it never has more energy than it was given.
// ISOSTEP_SINGLE_JOINTS=600 tries so many of each kind for ten seconds under every setting; without it a sample is.
// SPDX-License-Identifier: MIT

#include "laws/single_joints.hpp"

#include "random/asked.hpp"

namespace isostep::test {
namespace single_joints_test {

constexpr int kTogether = 25;  // in one world

template <class S> class SingleJointLaws : public ::testing::Test {
 protected:
  static JointFindings try_kind(JointKind kind, const JointTrial& trial, std::uint64_t first, int count) {
    JointFindings findings;
    for (int done = 0; done < count; done += kTogether) {
      JointTrials<S> trials(kind, first + static_cast<std::uint64_t>(done), std::min(kTogether, count - done), trial);
      findings += trials.run();
    }
    return findings;
  }
  /// Every kind under every setting. A sample draws other joints for each, and ends sooner where steps are dear.
  static JointFindings try_all(std::initializer_list<JointKind> kinds) {
    constexpr int kSubsteps[] = {1, 4, 8, 32, 64};
    const int all_joints = static_cast<int>(asked("ISOSTEP_SINGLE_JOINTS", 0));
    JointFindings all;
    std::uint64_t first = 0;
    for (const SolverName solver : {SolverName::soft_step, SolverName::pgs}) {
      for (const int substeps : kSubsteps) {
        JointFindings here;
        for (const JointKind kind : kinds) {
          here += all_joints > 0 ? try_kind(kind, {solver, substeps, 600}, 0, all_joints)
                                 : try_kind(kind, {solver, substeps, substeps > 8 ? 120 : 360}, first, 8);
        }
        if (all_joints > 0) report(solver, substeps, here);
        all += here;
        first += 8;
      }
    }
    EXPECT_EQ(all.too_fast, 0) << "of " << all.tried << ", the fastest at " << all.fastest << " m/s" << all.words;
    return all;
  }

 private:
  static void report(SolverName solver, int substeps, const JointFindings& f) {
    std::printf("%s %s %d: of %d too fast %d (%g m/s), past their limit %d of %d (%.4f rad), motors off %d of %d\n",
                ScalarTraits<S>::kName, kSolverNames[static_cast<int>(solver)], substeps, f.tried, f.too_fast,
                f.fastest, f.past_limit, f.rested, f.furthest, f.motor_off, f.drove);
    std::fflush(stdout);
  }
};
TYPED_TEST_SUITE(SingleJointLaws, AllScalars);

TYPED_TEST(SingleJointLaws, hinges_alone_swing) { this->try_all({JointKind::free}); }

/// Held about an axis that is none of its own, a box pulls at its hinge as it turns. Seeds whose boxes do so most.
TYPED_TEST(SingleJointLaws, boxes_on_hinges_askew_to_their_axes_gain_nothing) {
  for (const std::uint64_t seed : {3u, 92u, 145u}) {
    for (const int substeps : {8, 64}) {
      const JointTrial trial = {SolverName::soft_step, substeps, 600};
      const JointFindings f = this->try_kind(JointKind::free, trial, seed, 1);
      EXPECT_EQ(f.too_fast, 0) << f.words;
    }
  }
}

TYPED_TEST(SingleJointLaws, springs_give_what_they_held) { this->try_all({JointKind::spring}); }

TYPED_TEST(SingleJointLaws, motors_reach_their_speed_and_no_more) {
  const JointFindings f = this->try_all({JointKind::motor});
  EXPECT_EQ(f.motor_off, 0) << "of " << f.drove << f.words;
  EXPECT_GT(f.drove, f.tried / 4);
}

TYPED_TEST(SingleJointLaws, limits_take_and_never_give) {
  const JointFindings f = this->try_all({JointKind::limit, JointKind::spring_limit, JointKind::motor_limit,
                                         JointKind::twist, JointKind::cone, JointKind::cone_twist});
  EXPECT_EQ(f.past_limit, 0) << "of " << f.rested << " at rest, the furthest by " << f.furthest << " rad" << f.words;
  EXPECT_GT(f.rested, f.tried / 10);
  EXPECT_LT(f.jumped, f.tried / 6);
}

}  // namespace single_joints_test
}  // namespace isostep::test
