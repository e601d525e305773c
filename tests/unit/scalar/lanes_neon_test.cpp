// Lanes in NEON registers: runs on 64-bit Arm, or under an emulator of it.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/lanes_neon.hpp"

#include "lanes_checks.hpp"

bool isostep::test::cpu_can_run() { return true; }  // what the compiler may use everywhere is there

namespace lanes_neon_test {

using isostep::Overflow;
using isostep::Q16_16;
using isostep::Q32_32;
using isostep::isa::Neon;

using NeonLanes = testing::Types<Lanes<float, 4, Neon>, Lanes<double, 2, Neon>, Lanes<Q16_16, 4, Neon>,
                                 Lanes<Fixed<std::int32_t, 30>, 4, Neon>, Lanes<Q32_32, 2, Neon>,
                                 Lanes<Fixed<std::int64_t, 40>, 2, Neon>, Lanes<Fixed<std::int64_t, 62>, 2, Neon>,
                                 Lanes<float, 8, Neon>, Lanes<Q32_32, 1, Neon>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Neon, LanesTest, NeonLanes);

TEST(NeonLanes, RoundEveryShiftOfEveryFormat) {
  check_formats<std::int32_t, 4, Neon>();
  check_formats<std::int64_t, 2, Neon>();
}

TEST(NeonLanes, TakeIeeeRoots) {
  check_sqrt<Lanes<float, 4, Neon>>();
  check_sqrt<Lanes<double, 2, Neon>>();
}

TEST(NeonLanes, RegistersHoldTheWholeType) {
  EXPECT_EQ(sizeof(Lanes<float, 4, Neon>), 16u);
  EXPECT_EQ(sizeof(Lanes<Q16_16, 4, Neon>), 16u);
  EXPECT_EQ(sizeof(Lanes<Q32_32, 2, Neon>), 16u);
  EXPECT_EQ(sizeof(product(Lanes<Q16_16, 4, Neon>::zero(), Lanes<Q16_16, 4, Neon>::zero())), 32u);
}

}  // namespace lanes_neon_test
