// Lanes in AVX2 registers. Compiled with -mavx2 and skipped on processors without it.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/lanes_avx2.hpp"

#include "lanes_checks.hpp"

bool isostep::test::cpu_can_run() { return __builtin_cpu_supports("avx2") != 0; }

namespace lanes_avx2_test {

using isostep::Overflow;
using isostep::Q16_16;
using isostep::Q32_32;
using isostep::isa::Avx2;

using Avx2Lanes = testing::Types<Lanes<float, 8, Avx2>, Lanes<double, 4, Avx2>, Lanes<Q16_16, 8, Avx2>,
                                 Lanes<Fixed<std::int32_t, 30>, 8, Avx2>, Lanes<Q32_32, 4, Avx2>,
                                 Lanes<Fixed<std::int64_t, 40>, 4, Avx2>, Lanes<Fixed<std::int64_t, 62>, 4, Avx2>,
                                 Lanes<float, 4, Avx2>, Lanes<Q32_32, 1, Avx2>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Avx2, LanesTest, Avx2Lanes);

class Avx2Test : public testing::Test {
 protected:
  void SetUp() override {
    if (!isostep::test::cpu_can_run()) GTEST_SKIP() << "this processor lacks the instruction set";
  }
};

TEST_F(Avx2Test, RoundEveryShiftOfEveryFormat) {
  check_formats<std::int32_t, 8, Avx2>();
  check_formats<std::int64_t, 4, Avx2>();
}

TEST_F(Avx2Test, TakeIeeeRoots) {
  check_sqrt<Lanes<float, 8, Avx2>>();
  check_sqrt<Lanes<double, 4, Avx2>>();
}

TEST_F(Avx2Test, RegistersHoldTheWholeType) {
  EXPECT_EQ(sizeof(Lanes<float, 8, Avx2>), 32u);
  EXPECT_EQ(sizeof(Lanes<Q16_16, 8, Avx2>), 32u);
  EXPECT_EQ(sizeof(Lanes<Q32_32, 4, Avx2>), 32u);
  EXPECT_EQ(sizeof(product(Lanes<Q16_16, 8, Avx2>::zero(), Lanes<Q16_16, 8, Avx2>::zero())), 64u);
}

TEST_F(Avx2Test, TheTrappingPolicyStillTraps) {
  using T = Fixed<std::int64_t, 32, Overflow::trap>;
  using L = Lanes<T, 4, Avx2>;
  const L big = L::broadcast(T::highest());
  EXPECT_EQ(Block<L>::of(big - big).lane[3].raw(), 0);
  EXPECT_EQ(to_bits(less(big, L::zero())), 0u);
  EXPECT_EQ(to_bits(less(L::zero(), big)), 0xfu);
  EXPECT_DEATH(Block<L>::of(big + big), "");
  EXPECT_DEATH(Block<L>::of(big * big), "");
}

}  // namespace lanes_avx2_test
