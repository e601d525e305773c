// Lanes without an instruction set at every width, and in SSE2 registers where there are any.
// SPDX-License-Identifier: MIT
#include "lanes_checks.hpp"

#if defined(__SSE2__)
#include "isostep/scalar/lanes_sse2.hpp"
#endif

bool isostep::test::cpu_can_run() { return true; }  // what the compiler may use everywhere is there

namespace lanes_test {

using isostep::Overflow;
using isostep::Q16_16;
using isostep::Q32_32;
using isostep::isa::Portable;
using Q23_40 = Fixed<std::int64_t, 40>;

using PortableLanes = testing::Types<Lanes<float, 1, Portable>, Lanes<double, 1, Portable>, Lanes<Q16_16, 1, Portable>,
                                     Lanes<Q32_32, 1, Portable>, Lanes<float, 2, Portable>, Lanes<Q16_16, 2, Portable>,
                                     Lanes<Q32_32, 2, Portable>, Lanes<double, 3, Portable>, Lanes<Q23_40, 3, Portable>,
                                     Lanes<float, 4, Portable>, Lanes<double, 4, Portable>, Lanes<Q32_32, 4, Portable>,
                                     Lanes<float, 8, Portable>, Lanes<Q16_16, 8, Portable>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Portable, LanesTest, PortableLanes);

TEST(PortableLanes, RoundEveryShiftOfEveryFormat) {
  check_formats<std::int32_t, 3, Portable>();
  check_formats<std::int64_t, 2, Portable>();
}

TEST(PortableLanes, TakeIeeeRoots) {
  check_sqrt<Lanes<float, 4, Portable>>();
  check_sqrt<Lanes<double, 1, Portable>>();
}

TEST(PortableLanes, KeepTheFirstOfTwoEqualOrUnorderedNumbers) {
  using L = Lanes<float, 1, Portable>;
  const L minus = L::broadcast(-0.0f);
  const L plus = L::broadcast(0.0f);
  const L nan = L::broadcast(std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(same_bits(min(minus, plus).v[0], -0.0f));
  EXPECT_TRUE(same_bits(min(plus, minus).v[0], 0.0f));
  EXPECT_TRUE(same_bits(max(minus, plus).v[0], -0.0f));
  EXPECT_TRUE(same_bits(abs(minus).v[0], -0.0f));
  EXPECT_TRUE(is_nan(min(nan, plus).v[0]));
  EXPECT_TRUE(same_bits(min(plus, nan).v[0], 0.0f));
}

TEST(PortableLanes, SumTwoNearlyCancellingProductsExactly) {
  using L = Lanes<Q32_32, 2, Portable>;
  const L large = L::broadcast(Q32_32(1 << 20));
  const L larger = large + L::broadcast(Q32_32::from_raw(1));
  const auto difference = product(larger, L::broadcast(Q32_32(3))) - product(large, L::broadcast(Q32_32(3)));
  EXPECT_EQ(isostep::round_to<L>(difference).v[1].raw(), 3);
}

template <class Isa> void check_that_lanes_trap() {
  using T = Fixed<std::int32_t, 16, Overflow::trap>;
  using L = Lanes<T, 8, Isa>;
  const L big = L::broadcast(T::highest());
  EXPECT_EQ(Block<L>::of(big - big).lane[7].raw(), 0);
  EXPECT_EQ(Block<L>::of(big * L::broadcast(T(1))).lane[7].raw(), T::highest().raw());
  EXPECT_DEATH(Block<L>::of(big + big), "");
  EXPECT_DEATH(Block<L>::of(big * big), "");
  EXPECT_DEATH(Block<L>::of(-L::broadcast(T::lowest())), "");
}
TEST(PortableLanesDeathTest, TheTrappingPolicyTrapsInLanes) { check_that_lanes_trap<Portable>(); }

#if defined(__SSE2__)
using isostep::isa::Sse2;
using Sse2Lanes = testing::Types<Lanes<float, 4, Sse2>, Lanes<double, 2, Sse2>, Lanes<Q16_16, 4, Sse2>,
                                 Lanes<Q32_32, 2, Sse2>, Lanes<float, 8, Sse2>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Sse2, LanesTest, Sse2Lanes);

TEST(Sse2Lanes, TakeIeeeRoots) {
  check_sqrt<Lanes<float, 4, Sse2>>();
  check_sqrt<Lanes<double, 2, Sse2>>();
}
TEST(Sse2Lanes, RegistersHoldTheWholeType) {
  EXPECT_EQ(sizeof(Lanes<float, 4, Sse2>), 16u);
  EXPECT_EQ(alignof(Lanes<float, 4, Sse2>), 16u);
  EXPECT_EQ(sizeof(Lanes<double, 2, Sse2>), 16u);
}
#endif

}  // namespace lanes_test
