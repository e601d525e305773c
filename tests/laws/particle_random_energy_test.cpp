// The law of energy in random worlds: whatever springs, links, contacts, methods and steps come together, what was put
// in is all there is. ISOSTEP_PARTICLE_WORLDS asks for another number of worlds than the test's own.
// SPDX-License-Identifier: MIT

#include "laws/random_particle_worlds.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace particle_random_energy_test {

template <class S> class RandomParticleEnergy : public ::testing::Test {};
TYPED_TEST_SUITE(RandomParticleEnergy, AllScalars);

TYPED_TEST(RandomParticleEnergy, is_never_above_what_was_put_in) {
  expect_no_gain<RandomParticleWorld<TypeParam>>(asked("ISOSTEP_PARTICLE_WORLDS", sampled(320u, 40u)),
                                                 [](const auto&, bool changed) { return changed; });
}

}  // namespace particle_random_energy_test
}  // namespace isostep::test
