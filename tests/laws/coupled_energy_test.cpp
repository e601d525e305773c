// The law of energy of particles among rigid bodies: whatever solvers, shapes, springs and steps come together, what
// was put in is all there is. ISOSTEP_PARTICLE_WORLDS asks for another number of worlds than the test's own.
// SPDX-License-Identifier: MIT

#include "laws/random_coupled_worlds.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace coupled_energy_test {

template <class S> class CoupledEnergy : public ::testing::Test {};
TYPED_TEST_SUITE(CoupledEnergy, AllScalars);

TYPED_TEST(CoupledEnergy, is_never_above_what_was_put_in) {
  expect_no_gain<RandomCoupledWorld<TypeParam>>(asked("ISOSTEP_PARTICLE_WORLDS", sampled(120u, 30u)),
                                                [](const auto& world, bool) { return world.touches() > 0; });
}

}  // namespace coupled_energy_test
}  // namespace isostep::test
