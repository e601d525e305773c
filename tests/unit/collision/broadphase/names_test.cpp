// The coarse structures by name.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/broadphase/broad_phase_name.hpp"

namespace isostep::test {
namespace names_test {

TEST(BroadPhaseNames, AreFoundAndOthersAreNot) {
  for (std::uint32_t i = 0; i < kBroadPhases; ++i)
    EXPECT_EQ(broad_phase_named(kBroadPhaseNames[i]), static_cast<BroadPhaseName>(i));
  EXPECT_EQ(broad_phase_named("box_tree"), BroadPhaseName::box_tree);
  EXPECT_EQ(broad_phase_named("sweep_and_prune"), BroadPhaseName::sweep_and_prune);
  EXPECT_EQ(broad_phase_named("heap"), std::nullopt);
  EXPECT_EQ(broad_phase_named(""), std::nullopt);
}

}  // namespace names_test
}  // namespace isostep::test
