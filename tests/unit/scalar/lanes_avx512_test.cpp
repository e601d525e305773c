// Lanes in AVX-512 registers. Compiled for them and skipped on processors without.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/lanes_avx512.hpp"

#include "lanes_checks.hpp"

bool isostep::test::cpu_can_run() {
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
}

namespace lanes_avx512_test {

using isostep::Overflow;
using isostep::Q16_16;
using isostep::Q32_32;
using isostep::isa::Avx512;

using Avx512Lanes = testing::Types<Lanes<float, 16, Avx512>, Lanes<double, 8, Avx512>, Lanes<Q16_16, 16, Avx512>,
                                   Lanes<Fixed<std::int32_t, 30>, 16, Avx512>, Lanes<Q32_32, 8, Avx512>,
                                   Lanes<Fixed<std::int64_t, 40>, 8, Avx512>, Lanes<Fixed<std::int64_t, 62>, 8, Avx512>,
                                   Lanes<float, 8, Avx512>, Lanes<Q32_32, 1, Avx512>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Avx512, LanesTest, Avx512Lanes);

class Avx512Test : public testing::Test {
 protected:
  void SetUp() override {
    if (!isostep::test::cpu_can_run()) GTEST_SKIP() << "this processor lacks the instruction set";
  }
};

TEST_F(Avx512Test, RoundEveryShiftOfEveryFormat) {
  check_formats<std::int32_t, 16, Avx512>();
  check_formats<std::int64_t, 8, Avx512>();
}

TEST_F(Avx512Test, TakeIeeeRoots) {
  check_sqrt<Lanes<float, 16, Avx512>>();
  check_sqrt<Lanes<double, 8, Avx512>>();
}

TEST_F(Avx512Test, RegistersHoldTheWholeType) {
  EXPECT_EQ(sizeof(Lanes<float, 16, Avx512>), 64u);
  EXPECT_EQ(sizeof(Lanes<Q16_16, 16, Avx512>), 64u);
  EXPECT_EQ(sizeof(Lanes<Q32_32, 8, Avx512>), 64u);
  EXPECT_EQ(sizeof(product(Lanes<Q16_16, 16, Avx512>::zero(), Lanes<Q16_16, 16, Avx512>::zero())), 128u);
}

TEST_F(Avx512Test, TheTrappingPolicyStillTraps) {
  using T = Fixed<std::int64_t, 32, Overflow::trap>;
  using L = Lanes<T, 8, Avx512>;
  const L big = L::broadcast(T::highest());
  EXPECT_EQ(Block<L>::of(big - big).lane[7].raw(), 0);
  EXPECT_EQ(to_bits(less(big, L::zero())), 0u);
  EXPECT_EQ(to_bits(less(L::zero(), big)), 0xffu);
  EXPECT_DEATH(Block<L>::of(big + big), "");
  EXPECT_DEATH(Block<L>::of(big * big), "");
}

}  // namespace lanes_avx512_test
