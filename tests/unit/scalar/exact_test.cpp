// Exact<T>: the operations of T, one rounding each, and what a number type needs to stand in for it.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/exact.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace isostep {
namespace exact_test {

template <class T> class ExactNumber : public testing::Test {};
using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(ExactNumber, Floats);

TYPED_TEST(ExactNumber, ComputesAsItsNumber) {
  using T = TypeParam;
  using E = Exact<T>;
  std::uint64_t state = 1;
  const auto draw = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<T>(static_cast<std::int64_t>(state) >> 20) / T(1 << 20);
  };
  for (int i = 0; i < 10000; ++i) {
    volatile T a = draw(), b = draw();
    const T x = a, y = b;
    volatile T sum = x + y, difference = x - y, product = x * y, quotient = x / y;
    ASSERT_EQ(to_bits((E(x) + E(y)).value()), to_bits(T(sum)));
    ASSERT_EQ(to_bits((E(x) - E(y)).value()), to_bits(T(difference)));
    ASSERT_EQ(to_bits((E(x) * E(y)).value()), to_bits(T(product)));
    ASSERT_EQ(to_bits((E(x) / E(y)).value()), to_bits(T(quotient)));
    ASSERT_EQ(to_bits((-E(x)).value()), to_bits(T(-x)));
    ASSERT_EQ(E(x) < E(y), x < y);
    ASSERT_EQ(E(x) >= E(y), x >= y);
    E c = E(x);
    c += E(y);
    c *= E(y);
    c -= E(x);
    c /= E(2);
    volatile T step = sum * y;
    step = step - x;
    step = step / 2;
    ASSERT_EQ(to_bits(c.value()), to_bits(T(step)));
  }
}

TYPED_TEST(ExactNumber, SquareRootsAreToNearest) {
  using T = TypeParam;
  using E = Exact<T>;
  for (int i = 1; i < 3000; ++i) {
    ASSERT_EQ(sqrt(E(T(i) * T(i))), E(i));
    // r is nearest to sqrt(x) when (r - ulp / 2)^2 < x < (r + ulp / 2)^2; long double holds both for float
    if constexpr (std::is_same_v<T, float>) {
      const float r = sqrt(E(i)).value();
      const double ulp = static_cast<double>(std::bit_cast<float>(to_bits(r) + 1u)) - static_cast<double>(r);
      const double low = static_cast<double>(r) - ulp / 2, high = static_cast<double>(r) + ulp / 2;
      ASSERT_LE(low * low, i);
      ASSERT_GE(high * high, i);
    }
  }
  EXPECT_EQ(sqrt(E(0.25)), E(0.5));
  EXPECT_FALSE(is_finite(sqrt(E(-1))));
}

TYPED_TEST(ExactNumber, WorksAtCompileTime) {
  using E = Exact<TypeParam>;
  constexpr E x = E(0.5) * E(3) + 1;
  static_assert(x == E(2.5) && abs(-x) == x && min(x, E(1)) == E(1) && max(x, E(1)) == x && -x < x);
  EXPECT_EQ(x, E(2.5));
}

TYPED_TEST(ExactNumber, AbsMinAndMaxHaveOneAnswer) {
  using T = TypeParam;
  using E = Exact<T>;
  EXPECT_EQ(to_bits(abs(E(T(-0.0))).value()), to_bits(T(0)));
  EXPECT_EQ(abs(E(-3)), E(3));
  EXPECT_EQ(min(E(1), E(2)), E(1));
  EXPECT_EQ(max(E(1), E(2)), E(2));
  EXPECT_EQ(to_bits(min(E(T(0)), E(T(-0.0))).value()), to_bits(T(0))) << "equal numbers: the first";
  EXPECT_EQ(to_bits(max(E(T(-0.0)), E(T(0))).value()), to_bits(T(-0.0))) << "also where one is a constant";
}

TYPED_TEST(ExactNumber, ConvertsAsItsNumberDoes) {
  using T = TypeParam;
  using E = Exact<T>;
  EXPECT_EQ(E(0.1).value(), static_cast<T>(0.1));
  EXPECT_EQ((2 * E(3)).value(), T(6));
  EXPECT_EQ((E(3) * 0.5).value(), T(1.5));
  EXPECT_EQ(static_cast<int>(E(-2.75)), -2);
  EXPECT_EQ(static_cast<double>(E(0.5)), 0.5);
  EXPECT_FALSE((std::is_convertible_v<E, double>)) << "nothing leaves the wrapper unasked";
  EXPECT_EQ(to_double(E(0.5)), 0.5);
}

TYPED_TEST(ExactNumber, LiesInMemoryAsItsNumber) {
  using T = TypeParam;
  static_assert(sizeof(Exact<T>) == sizeof(T) && alignof(Exact<T>) == alignof(T));
  static_assert(std::is_trivially_copyable_v<Exact<T>> && std::is_standard_layout_v<Exact<T>>);
  T numbers[3] = {1, 2, 3};
  auto* exact = reinterpret_cast<Exact<T>*>(numbers);
  exact[1] = exact[1] * exact[2];
  EXPECT_EQ(numbers[1], T(6));
}

TYPED_TEST(ExactNumber, HasTheLimitsOfItsNumber) {
  using T = TypeParam;
  using L = std::numeric_limits<Exact<T>>;
  EXPECT_TRUE(L::is_specialized);
  EXPECT_EQ(L::max().value(), std::numeric_limits<T>::max());
  EXPECT_EQ(L::epsilon().value(), std::numeric_limits<T>::epsilon());
  EXPECT_EQ(L::digits, std::numeric_limits<T>::digits);
  EXPECT_FALSE(is_finite(L::infinity()));
  EXPECT_FALSE(L::quiet_NaN() == L::quiet_NaN());
}

TYPED_TEST(ExactNumber, CircularFunctionsAreThoseOfTheLibrary) {
  using T = TypeParam;
  using E = Exact<T>;
  EXPECT_EQ(to_bits(sin(E(0.7)).value()), to_bits(isostep::sin(T(0.7))));
  EXPECT_EQ(to_bits(cos(E(0.7)).value()), to_bits(isostep::cos(T(0.7))));
  EXPECT_EQ(to_bits(asin(E(0.7)).value()), to_bits(isostep::asin(T(0.7))));
  EXPECT_EQ(to_bits(acos(E(0.7)).value()), to_bits(isostep::acos(T(0.7))));
  EXPECT_EQ(to_bits(exp(E(0.7)).value()), to_bits(isostep::exp(T(0.7))));
  EXPECT_EQ(to_bits(log(E(0.7)).value()), to_bits(isostep::log(T(0.7))));
  EXPECT_EQ(to_bits(atan2(E(0.7), E(-2)).value()), to_bits(isostep::atan2(T(0.7), T(-2))));
}

}  // namespace exact_test
}  // namespace isostep
