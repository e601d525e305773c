// A scene's tree of hinges in joint coordinates: the same motion as by joints, and its reasons to refuse.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "tool/lab/articulated_run.hpp"
#include "tool/lab/run_point.hpp"
#include "tool/lab/sweep.hpp"

namespace isostep::tool::lab {
namespace articulated_test {

LabResult result_of(const std::string& scene, const std::string& scalar, const std::string& model, int hz) {
  const Subject subject = subject_of(scene);
  LabPoint point = default_point(scene, scalar);
  point.model = model;
  point.hz = hz;
  return run_point(subject, point, {}, frames_at(subject.scene, -1, hz), [] { return false; });
}

TEST(ArticulatedRun, KeepsTheEnergyOfAFlyingRobot) {
  for (const char* scalar : {"double", "q32.32"}) {
    const LabResult result = result_of("simbenchmark_anymal_energy", scalar, kArticulation, 100);
    ASSERT_EQ(result.state, kDone) << result.reason;
    EXPECT_LT(result.figure, 1e-8) << scalar;  // [J^2] by joints 5.8, RaiSim in 2018 1.4
    EXPECT_EQ(result.faults, 0);
  }
}

TEST(ArticulatedRun, MovesAsJointsDoInShortSteps) {
  for (const char* scene : {"erez_chain", "erez_humanoid"}) {
    const LabResult tree = result_of(scene, "double", kArticulation, 1000);
    const LabResult joints = result_of(scene, "double", "rigid", 1000);
    ASSERT_FALSE(tree.outcome.empty()) << tree.reason;
    EXPECT_LT(scenes::distance_of(tree.outcome, joints.outcome), 1e-3) << scene;  // [m]
  }
}

TEST(ArticulatedRun, RefusesWhatItCannotBe) {
  EXPECT_EQ(result_of("simbenchmark_anymal_pd", "double", kArticulation, 200).reason,
            "an articulation has no contacts");
  EXPECT_EQ(result_of("S6v", "double", kArticulation, 60).reason, "the scene is not one tree");
  EXPECT_EQ(result_of("erez_chain", "q16.16", kArticulation, 100).reason, "an articulation has too few bits in q16.16");
  EXPECT_EQ(result_of("erez_chain", "double", kArticulation, kMostHz + 1).state, kRefused);
}

}  // namespace articulated_test
}  // namespace isostep::tool::lab
