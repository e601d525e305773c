// The numbers of large systems: quantities of any size, and their shares of a power of two.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/linear_system.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace isostep {
namespace linear_system_test {

template <class S> class LinearSystemOf : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(LinearSystemOf, Scalars);

TYPED_TEST(LinearSystemOf, QuantitiesOfAnySizeKeepTheirRatios) {
  using System = LinearSystem<TypeParam>;
  const double most = std::sqrt(to_double(highest<TypeParam>())) / 2;
  for (const double a : {most, -3.25, 1.0, -0.0625}) {
    for (const double b : {0.03125, -1.0, most}) {
      const auto x = System::value(from_double<TypeParam>(a)), y = System::value(from_double<TypeParam>(b));
      auto ratio = System::quotient(x, y);
      for (int i = 0; i < 3; ++i) ratio = System::quotient(ratio, System::value(16384));  // far below the format
      for (int i = 0; i < 3; ++i)
        ratio = System::quotient(ratio, System::quotient(System::value(1), System::value(16384)));
      const double expected = to_double(from_double<TypeParam>(a)) / to_double(from_double<TypeParam>(b));
      const int e = System::exponent(ratio);
      const double scale = kIsFixed<TypeParam> ? std::ldexp(1, e) : 1;
      EXPECT_NEAR(to_double(System::number(ratio, e)) * scale / expected, 1, 1e-15);
    }
  }
}

TYPED_TEST(LinearSystemOf, SumsOfUnequalSizesAreSums) {
  using System = LinearSystem<TypeParam>;
  const auto big = System::value(12288), small = System::quotient(System::value(3), System::value(1 << 30));
  const auto none = System::value(0);
  for (const auto& sum :
       {System::sum(big, small), System::sum(small, big), System::sum(none, System::sum(small, big))}) {
    const double scale = kIsFixed<TypeParam> ? std::ldexp(1, 14) : 1;
    EXPECT_EQ(to_double(System::number(sum, 14)) * scale, 12288 + std::ldexp(3, -30));
  }
}

TYPED_TEST(LinearSystemOf, ExponentsBoundFixedPointAndAreNoneOtherwise) {
  using System = LinearSystem<TypeParam>;
  if constexpr (kIsFixed<TypeParam>) {
    EXPECT_EQ(System::exponent(System::value(1)), 1);
    EXPECT_EQ(System::exponent(System::value(TypeParam(-1.5))), 1);
    EXPECT_EQ(System::exponent(System::value(TypeParam(0.25))), -1);
    EXPECT_LT(System::exponent(System::value(0)), -100);
    EXPECT_EQ(System::number(System::value(TypeParam(-1.5)), 1).raw(), -(std::int64_t{3} << 60));
  } else {
    EXPECT_EQ(System::exponent(System::value(1 << 20)), 0);
    EXPECT_EQ(System::number(System::value(1 << 20), 7).value(), 1 << 20);
  }
}

TYPED_TEST(LinearSystemOf, AddingRoundsOnceAndStopsAtTheFormatsEnd) {
  using S = TypeParam;
  using System = LinearSystem<S>;
  using Number = typename System::Number;
  const S unit = resolution<S>();
  const auto half = System::quotient(System::value(unit), System::value(2));
  const auto most = System::quotient(System::value(unit), System::value(3));
  EXPECT_EQ(System::add(S(1), most), S(1));
  EXPECT_EQ(System::add(S(1), System::sum(half, most)), S(1) + unit);
  EXPECT_EQ(System::add(S(-1), System::quotient(System::sum(half, most), System::value(-1))), S(-1) - unit);
  EXPECT_EQ(System::add(S(2), System::value(Number(-1), 0)), S(1));
  if constexpr (kIsFixed<S>) {
    EXPECT_EQ(System::add(S(-2), System::value(Number(-1), 200)), S::lowest());
    EXPECT_EQ(System::add(S(2), System::value(Number(1), 200)), S::highest());
    EXPECT_EQ(System::add(S::highest(), System::value(S::highest())), S::highest());
    EXPECT_EQ(System::add(S::lowest(), System::value(S::highest())), S::from_raw(-1));
  }
}

}  // namespace linear_system_test
}  // namespace isostep
