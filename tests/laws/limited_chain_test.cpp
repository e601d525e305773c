// A chain whose hinges bend to their limits cracks like a whip as it falls, with all stops in play at once.
// SPDX-License-Identifier: MIT
#include "scenes/build.hpp"
#include "scenes/measure.hpp"
#include "scenes/trials/trial.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace limited_chain_test {

template <class S> class LimitedChain : public ::testing::Test {};
TYPED_TEST_SUITE(LimitedChain, AllScalars);

/// Nothing in it gives energy back: what is gained is counted from the least that there was, as a part of the loss.
TYPED_TEST(LimitedChain, gains_nothing_and_stays_together) {
  using S = TypeParam;
  scenes::Scene scene = scenes::find_trial("limited_chain")->make();
  for (const int substeps : {4, 8, 16}) {
    scene.substeps = substeps;
    World<S> w(scenes::settings_of<S>(scene));
    scenes::build(scene, w);
    const double start = scenes::measure_energy(w).total();
    double least = start, gained = 0, apart = 0;
    for (int i = 0; i < 600; ++i) {
      ASSERT_TRUE(w.step().clean()) << substeps << " sub-steps, frame " << i;
      const double now = scenes::measure_energy(w).total();
      gained = std::max(gained, now - least);
      least = std::min(least, now);
      apart = std::max(apart, scenes::largest_joint_error(w));
    }
    EXPECT_LT(gained, 0.01 * (start - least)) << substeps << " sub-steps";
    EXPECT_LT(apart, 0.01) << substeps << " sub-steps";
  }
}

}  // namespace limited_chain_test
}  // namespace isostep::test
