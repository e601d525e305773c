// The law of energy of particles among rigid bodies: whatever solvers, shapes, springs and steps come together, what
// was put in is all there is. ISOSTEP_PARTICLE_WORLDS asks for another number of worlds than the test's own.
// SPDX-License-Identifier: MIT

#include <cstdlib>

#include "laws/random_coupled_worlds.hpp"

namespace isostep::test {
namespace {

template <class S> class CoupledEnergy : public ::testing::Test {};
TYPED_TEST_SUITE(CoupledEnergy, AllScalars);

std::uint64_t worlds() {
  const char* asked = std::getenv("ISOSTEP_PARTICLE_WORLDS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 120;
}

TYPED_TEST(CoupledEnergy, is_never_above_what_was_put_in) {
  using S = TypeParam;
  std::uint64_t touched = 0;
  for (std::uint64_t seed = 0; seed < worlds(); ++seed) {
    RandomCoupledWorld<S> world(seed);
    double most = world.start();
    const int steps = world.steps(5);
    for (int i = 0; i < steps; ++i) {
      ASSERT_TRUE(world.step()) << world.telling();
      most = std::max(most, world.energy());
    }
    touched += world.touches() > 0;
    EXPECT_LE(most, world.most()) << world.telling();
  }
  EXPECT_GT(touched, worlds() / 2) << "worlds whose bodies meet no particles show nothing";
}

}  // namespace
}  // namespace isostep::test
