// The generators against published sequences, the draws against their definitions.
// SPDX-License-Identifier: MIT
#include "isostep/core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "isostep/core/fields.hpp"

namespace isostep {
namespace random_test {

static_assert(kHasNoPadding<Lcg> && kHasNoPadding<Pcg32>);

template <class S> class Random : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Random, Scalars);

TEST(Lcg, FollowsTheSequencePrintedInNumericalRecipes) {
  Lcg random{0};
  for (const std::uint32_t expected : {0x3c6ef35fu, 0x47502932u, 0xd1ccf6e9u, 0xaaf95334u, 0x6252e503u, 0x9f2ec686u,
                                       0x57fe6c2du, 0xa3d95fa8u, 0x81fdbee7u, 0x94f0af1au, 0xcbf633b1u}) {
    EXPECT_EQ(random.next(), expected);
  }
  Lcg again{0};
  EXPECT_EQ(again.next_u24(), 0x3c6ef3u);
}

TEST(Pcg32, FollowsTheSequenceOfTheAuthorsDemonstration) {
  Pcg32 random = Pcg32::seeded(42, 54);
  for (const std::uint32_t expected : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu}) {
    EXPECT_EQ(random.next(), expected);
  }
}

/// Says what it is told to say.
struct Scripted {
  const std::uint32_t* words;
  std::uint32_t next() { return *words++; }
  std::uint32_t next_u24() { return next() >> 8; }
};

TEST(RandomBelow, DrawsAgainWhereTheLeftoverOfTheRangeWouldFavourALowNumber) {
  // 2^32 = 1 (mod 3): one word, the one whose product has low half 0, must go.
  const std::uint32_t words[] = {0u, 0x80000000u, 1u, 0xffffffffu};
  Scripted random{words};
  EXPECT_EQ(random_below(random, 3), 1u);  // 0 is refused, 2^31 * 3 / 2^32 = 1.5
  EXPECT_EQ(random_below(random, 3), 0u);
  EXPECT_EQ(random_below(random, 3), 2u);
}

TEST(RandomBelow, GivesEveryNumberOfABoundThatDividesTheRangeItsExactShare) {
  std::array<int, 8> seen{};
  for (std::uint32_t top = 0; top < 64; ++top) {
    const std::uint32_t word = top << 26 | 12345u;
    Scripted random{&word};
    ++seen[random_below(random, 8)];
  }
  for (const int count : seen) EXPECT_EQ(count, 8);
}

TEST(RandomBetween, CoversTheWholeRangeOfIntegersAndSingleNumbers) {
  const std::uint32_t words[] = {0u, 0xffffffffu, 77u};
  Scripted random{words};
  EXPECT_EQ(random_between(random, INT32_MIN, INT32_MAX), INT32_MIN);
  EXPECT_EQ(random_between(random, INT32_MIN, INT32_MAX), INT32_MAX);
  EXPECT_EQ(random_between(random, -5, -5), -5);
}

TEST(RandomBetween, ADieShowsSixFacesEquallyOften) {
  Pcg32 random = Pcg32::seeded(5);
  std::array<int, 7> seen{};
  for (int i = 0; i < 60000; ++i) ++seen[static_cast<std::size_t>(random_between(random, 1, 6))];
  EXPECT_EQ(seen[0], 0);
  for (std::size_t face = 1; face <= 6; ++face) EXPECT_NEAR(seen[face], 10000, 456);  // five standard deviations
}

TYPED_TEST(Random, UnitIntervalIsTheIntegerOverTwoToThe24Exactly) {
  for (const std::uint32_t u24 : {0u, 1u, 2u, 4095u, 4096u, 4097u, 0x800000u, 0xabcdefu, 0xffffffu}) {
    EXPECT_EQ(to_double(unit_interval<TypeParam>(u24)), u24 / 16777216.0);
  }
}

TYPED_TEST(Random, UniformIsTheScenesFormulaWithinARoundingAndStaysInItsRange) {
  using S = TypeParam;
  Lcg random{12345};
  Lcg twin{12345};
  for (int i = 0; i < 2000; ++i) {
    const S value = uniform(random, S(-3), S(5));
    EXPECT_GE(value, S(-3));
    EXPECT_LE(value, S(5));
    EXPECT_NEAR(to_double(value), -3 + 8 * (twin.next_u24() / 16777216.0), 8 * to_double(resolution<S>()));
  }
  EXPECT_EQ(random, twin);
}

}  // namespace random_test
}  // namespace isostep
