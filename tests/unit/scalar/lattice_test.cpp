// Numbers on a lattice: floors, magnitudes, and back.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace isostep {
namespace lattice_test {

template <class S> class Lattice : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Lattice, Scalars);

TYPED_TEST(Lattice, CountsFloorsOfEverySign) {
  using S = TypeParam;
  EXPECT_EQ(floor_scaled(S(2.75), 0), 2);
  EXPECT_EQ(floor_scaled(S(-2.75), 0), -3);
  EXPECT_EQ(floor_scaled(S(-3), 0), -3);
  EXPECT_EQ(floor_scaled(S(-3), -1), -2);
  EXPECT_EQ(floor_scaled(S(-2.75), 2), -11);
  EXPECT_EQ(floor_scaled(S(0.75), 20), 786432);
  EXPECT_EQ(floor_scaled(S(-500), -12), -1);
  EXPECT_EQ(exponent_above(S(1)), 1);
  EXPECT_EQ(exponent_above(S(0.75)), 0);
  EXPECT_EQ(exponent_above(S(-500)), 9);
  EXPECT_LE(exponent_above(S(0)), exponent_above(resolution<S>()));
}

TYPED_TEST(Lattice, PointsOfTheLatticeComeBack) {
  using S = TypeParam;
  for (const std::int64_t whole : {0, 1, -1, 3, -7, 1 << 14, -(1 << 14) + 1}) {
    for (const int exponent : {0, 1, 7, 16}) {
      EXPECT_EQ(floor_scaled(from_lattice<S>(whole, exponent), exponent), whole);
      EXPECT_EQ(to_double(from_lattice<S>(whole, exponent)), std::ldexp(static_cast<double>(whole), -exponent));
    }
  }
}

/// Of directions with 62 fraction bits, which no other format has.
TYPED_TEST(Lattice, WhatHasNoPlaceGoesToTheNearest) {
  using U = Unit<TypeParam>;
  for (const std::int64_t whole :
       {0x3fffffffffffffff, 0x2545f4914f6cdd1d, -0x2545f4914f6cdd1d, 0x123456789, std::int64_t{-3}}) {
    const double exact = std::ldexp(static_cast<double>(whole), -62);
    EXPECT_NEAR(to_double(from_lattice<U>(whole, 62)), exact, 0.5001 * to_double(resolution<U>()) + 0x1p-54);
  }
}

}  // namespace lattice_test
}  // namespace isostep
