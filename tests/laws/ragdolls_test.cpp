// Laws of ragdolls whose joints have limits: what falls gains nothing, holds together and bends no further than it may.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/trials/trial_run.hpp"

namespace isostep::scenes {
namespace ragdolls_test {

template <class S> class RagdollLaws : public ::testing::Test {
 protected:
  static void survives(const char* name) {
    const Trial& trial = *find_trial(name);
    const Scene scene = *find_scene(name);
    World<S> world(settings_of<S>(scene));
    build(scene, world);
    TrialRun run(trial, scene);
    run.see(world);
    while (!run.over()) run.see(world, world.step());
    EXPECT_TRUE(run.verdict().survived) << trial.measure << ": " << run.verdict().figure << " " << trial.unit
                                        << " where " << trial.bar << " are allowed";
  }
};
/// Not Q16.16: ragdolls are beyond its ratios.
using WideScalars = ::testing::Types<float, double, Q32_32>;
TYPED_TEST_SUITE(RagdollLaws, WideScalars);

TYPED_TEST(RagdollLaws, fifty_fall_into_a_pit_within_their_limits) { this->survives("ragdolls_with_limits"); }

TYPED_TEST(RagdollLaws, none_gains_energy_from_whatever_side_it_falls) { this->survives("ragdoll_from_every_tilt"); }

}  // namespace ragdolls_test
}  // namespace isostep::scenes
