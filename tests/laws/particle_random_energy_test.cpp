// The law of energy in random worlds: whatever springs, links, contacts, methods and steps come together, what was put
// in is all there is. ISOSTEP_PARTICLE_WORLDS asks for another number of worlds than the test's own.
// SPDX-License-Identifier: MIT

#include <cstdlib>

#include "laws/random_particle_worlds.hpp"

namespace isostep::test {
namespace {

template <class S> class RandomParticleEnergy : public ::testing::Test {};
TYPED_TEST_SUITE(RandomParticleEnergy, AllScalars);

std::uint64_t worlds() {
  const char* asked = std::getenv("ISOSTEP_PARTICLE_WORLDS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 160;
}

TYPED_TEST(RandomParticleEnergy, is_never_above_what_was_put_in) {
  using S = TypeParam;
  std::uint64_t moved = 0;
  for (std::uint64_t seed = 0; seed < worlds(); ++seed) {
    RandomParticleWorld<S> world(seed);
    double most = world.start();
    const int steps = world.steps(5);
    bool changed = false;
    for (int i = 0; i < steps; ++i) {
      const ParticleReport report = world.step();
      ASSERT_EQ(report.stopped + report.clamped_speed + report.clamped_position, 0u) << world.telling();
      const double now = world.energy();
      changed = changed || now != most;
      most = std::max(most, now);
    }
    moved += changed;
    EXPECT_LE(most, world.most()) << world.telling();
  }
  EXPECT_GT(moved, worlds() / 2) << "worlds that only rest show nothing";
}

}  // namespace
}  // namespace isostep::test
