// Differences are named by path, shown in decimal and bits, and measured in steps of the format.
// SPDX-License-Identifier: MIT
#include "isostep/state/diff.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "toy.hpp"

namespace isostep {
namespace diff_test {

template <class S> std::vector<toy::Thing<S>> things() {
  return std::vector<toy::Thing<S>>(20, {{S(1.5), S(2), S(3)}, S(4), 5, toy::Mood::calm, {6, 7}});
}
template <class S>
void compare(const std::vector<toy::Thing<S>>& a, const std::vector<toy::Thing<S>>& b, DiffReport& report) {
  diff_records("bodies", a.data(), a.size(), b.data(), b.size(), report);
}

template <class S> class Diff : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Diff, Scalars);

TYPED_TEST(Diff, EqualRecordsHaveNone) {
  DiffReport report;
  compare(things<TypeParam>(), things<TypeParam>(), report);
  EXPECT_FALSE(report.any());
  EXPECT_EQ(report.count(), 0u);
}

TYPED_TEST(Diff, OneStepOfOneFieldIsNamedAndMeasured) {
  const auto a = things<TypeParam>();
  auto b = a;
  b[17].velocity.x = from_bits<TypeParam>(to_bits(a[17].velocity.x) + 1);
  DiffReport report;
  compare(a, b, report);
  ASSERT_EQ(report.count(), 1u);
  const Difference& difference = report.kept()[0];
  EXPECT_EQ(difference.path.view(), "bodies[17].velocity.x");
  EXPECT_EQ(difference.a.view(), "1.5");
  EXPECT_NE(difference.b.view(), "1.5");
  EXPECT_EQ(difference.steps, 1u);
  EXPECT_STREQ(difference.unit, kIsFixed<TypeParam> ? "lsb" : "ulp");
}

TEST(Diff, DescribesBothValues) {
  const auto a = things<float>();
  auto b = a;
  b[3].velocity.x = 1.25f;
  DiffReport report;
  compare(a, b, report);
  ASSERT_TRUE(report.any());
  EXPECT_EQ(describe(report.kept()[0]),
            "bodies[3].velocity.x: 1.5 | 1.25 (0x3fc00000 | 0x3fa00000), 2097152 ulp apart");
}

TEST(Diff, CountsAllAndKeepsTheFirst) {
  const auto a = things<Q32_32>();
  auto b = a;
  b[2].mood = toy::Mood::cross;
  b[4].visits = 9;
  b[4].marks[1] = 8;
  DiffReport report(2);
  compare(a, b, report);
  EXPECT_EQ(report.count(), 3u);
  ASSERT_EQ(report.kept().size(), 2u);
  EXPECT_EQ(describe(report.kept()[0]), "bodies[2].mood: 0 | 1 (0x0000 | 0x0001), 1 apart");
  EXPECT_EQ(describe(report.kept()[1]), "bodies[4].visits: 5 | 9 (0x00000005 | 0x00000009), 4 apart");
  DiffReport all(10);
  compare(a, b, all);
  EXPECT_EQ(all.kept()[2].path.view(), "bodies[4].marks[1]");
}

TEST(Diff, LengthsComeFirst) {
  const auto a = things<float>();
  auto b = a;
  b.pop_back();
  b[0].charge = 8;
  DiffReport report(2);
  compare(a, b, report);
  ASSERT_EQ(report.count(), 2u);
  EXPECT_EQ(report.kept()[0].path.view(), "bodies.count");
  EXPECT_EQ(report.kept()[0].a.view(), "20");
  EXPECT_EQ(report.kept()[0].b.view(), "19");
  EXPECT_EQ(report.kept()[1].path.view(), "bodies[0].charge");
}

TEST(Diff, PaddingIsNoDifference) {
  toy::Padded a{}, b{};
  std::memset(static_cast<void*>(&a), 0, sizeof a);
  std::memset(static_cast<void*>(&b), 0xff, sizeof b);
  for (toy::Padded* p : {&a, &b}) {
    p->big = 1;
    p->flag = false;
    p->small = 2;
    p->middle = 3;
  }
  DiffReport report;
  diff_value("padded", a, b, report);
  EXPECT_FALSE(report.any());
  b.flag = true;
  b.small = -2;
  DiffReport two(2);
  diff_value("padded", a, b, two);
  EXPECT_EQ(describe(two.kept()[0]), "padded.flag: false | true (0x00 | 0x01), 1 apart");
  EXPECT_EQ(describe(two.kept()[1]), "padded.small: 2 | -2 (0x02 | 0xfe), 4 apart");
}

TEST(StepsBetween, CountsFloatsAcrossZero) {
  constexpr FieldFormat format = kFieldFormat<float>;
  const float tiny = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(steps_between(format, to_bits(0.0f), to_bits(-0.0f)), 1u);
  EXPECT_EQ(steps_between(format, to_bits(tiny), to_bits(-tiny)), 3u);
  EXPECT_EQ(steps_between(format, to_bits(1.0f), to_bits(2.0f)), 1u << 23);
  EXPECT_EQ(steps_between(format, to_bits(2.0f), to_bits(1.0f)), 1u << 23);
}

TEST(StepsBetween, SpansTheWholeRangeOfAFormat) {
  EXPECT_EQ(steps_between(kFieldFormat<Q16_16>, to_bits(Q16_16::lowest()), to_bits(Q16_16::highest())), 0xffffffffu);
  EXPECT_EQ(steps_between(kFieldFormat<Q32_32>, to_bits(Q32_32::highest()), to_bits(Q32_32::lowest())),
            ~std::uint64_t{0});
  EXPECT_EQ(steps_between(kFieldFormat<std::int8_t>, 0x80, 0x7f), 255u);
  EXPECT_EQ(steps_between(kFieldFormat<std::uint8_t>, 0x80, 0x7f), 1u);
}

TEST(ValueText, WritesEveryKindOfField) {
  EXPECT_EQ(value_text(std::int8_t{-5}), "-5");
  EXPECT_EQ(value_text(~std::uint64_t{0}), "18446744073709551615");
  EXPECT_EQ(value_text(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(value_text(true), "true");
  EXPECT_EQ(value_text(toy::Mood::cross), "1");
  EXPECT_EQ(value_text(-0.5f), "-0.5");
  EXPECT_EQ(value_text(-0.5), "-0.5");
  EXPECT_EQ(value_text(Q16_16(-0.5)), "-0.5");
  EXPECT_EQ(value_text(Q32_32(-0.5)), "-0.5");
  EXPECT_EQ(value_text(Unit<Q32_32>(-0.5)), "-0.5");
  EXPECT_EQ(value_text(Fixed<std::int64_t, 40>(-0.5)), "-0.5");
}

}  // namespace diff_test
}  // namespace isostep
