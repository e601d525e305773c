// Exact<T> is not fused by a compiler that was told to fuse. The code under test is exact_fma_kernels.cpp.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "exact_fma_kernels.hpp"

namespace isostep {
namespace exact_fma_test {

bool processor_fuses() {
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_cpu_supports("fma") != 0;
#else
  return true;  // where it can at all, the instruction is part of the base architecture
#endif
}

// (1 + e)^2 = 1 + 2 e + e^2 with e^2 just below half a unit in the last place: rounded, the square minus 1 + 2 e is 0;
// fused, it is e^2. Volatile, so that the compiler cannot compute the answer.
constexpr float kFloat = 0x1p-12f;
constexpr double kDouble = 0x1p-30;

TEST(ExactFma, ProductsAreRoundedBeforeTheyAreAdded) {
  if (!processor_fuses()) GTEST_SKIP() << "no fused multiply-add here";
  volatile float f = 1 + kFloat, g = -(1 + 2 * kFloat);
  volatile double d = 1 + kDouble, h = -(1 + 2 * kDouble);
  const test::FloatSums floats = test::exact_float(f, f, g);
  const test::DoubleSums doubles = test::exact_double(d, d, h);
  EXPECT_EQ(floats.plus, 0);
  EXPECT_EQ(doubles.plus, 0);
  EXPECT_EQ(floats.minus, 2 * (1 + 2 * kFloat));
  EXPECT_EQ(doubles.minus, 2 * (1 + 2 * kDouble));
  EXPECT_EQ(floats.from, -2 * (1 + 2 * kFloat));
  EXPECT_EQ(doubles.from, -2 * (1 + 2 * kDouble));
  EXPECT_EQ(floats.twice, 1 + 2 * kFloat);
  EXPECT_EQ(doubles.twice, 1 + 2 * kDouble);
}

TEST(ExactFma, BareNumbersAreFusedByTheSameFlags) {
#if !defined(__x86_64__)
  GTEST_SKIP() << "the kernels are built with -mfma on x86-64 only";
#endif
  if (!processor_fuses()) GTEST_SKIP() << "no fused multiply-add here";
  volatile float f = 1 + kFloat, g = -(1 + 2 * kFloat);
  volatile double d = 1 + kDouble, h = -(1 + 2 * kDouble);
  EXPECT_EQ(test::bare_float(f, f, g), kFloat * kFloat) << "the flags do nothing, so the other tests prove nothing";
  EXPECT_EQ(test::bare_double(d, d, h), kDouble * kDouble);
}

TEST(ExactFma, LoopsAreNotFusedEither) {
  if (!processor_fuses()) GTEST_SKIP() << "no fused multiply-add here";
  double x[16], y[16], out[32];
  for (int i = 0; i < 16; ++i) x[i] = y[i] = 1 + kDouble;
  test::rotate_exact(x, y, 1 + kDouble, 1 + kDouble, out, 16);
  for (int i = 0; i < 16; ++i) {
    EXPECT_EQ(out[2 * i], 0);
    EXPECT_EQ(out[2 * i + 1], 2 + 4 * kDouble);
  }
}

}  // namespace exact_fma_test
}  // namespace isostep
