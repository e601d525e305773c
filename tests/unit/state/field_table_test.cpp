// The table of a record agrees with its canonical bytes, whatever it consists of.
// SPDX-License-Identifier: MIT
#include "isostep/state/field_table.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "toy.hpp"

namespace isostep {
namespace field_table_test {

struct Nothing {
  ISO_FIELDS()
};
struct Nested {
  toy::Padded rows[2];
  std::uint32_t lane[1];
  Nothing nothing;
  toy::Mood mood;
  ISO_FIELDS(rows, lane, nothing, mood)
};
struct Longest {
  std::uint8_t a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p;
  std::uint8_t a2, b2, c2, d2, e2, f2, g2, h2, i2, j2, k2, l2, m2, n2, o2, p2;
  ISO_FIELDS(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, a2, b2, c2, d2, e2, f2, g2, h2, i2, j2, k2, l2, m2, n2, o2,
             p2)
};
static_assert(kPackedSize<Nothing> == 0 && kPackedSize<Longest> == 32 && kFieldType<Longest>.count == 32);
static_assert(kFieldType<Nested>.size == kPackedSize<Nested> && kFieldType<Nested>.rows[3].offset == 28);

struct Number {
  std::string path;
  FieldFormat format;
  std::uint32_t offset;
};
std::vector<Number> numbers_of(const FieldType& type) {
  std::vector<Number> numbers;
  const auto keep = [](void* user, const PathPart& path, FieldFormat format, std::uint32_t offset) {
    static_cast<std::vector<Number>*>(user)->push_back({path_text(path), format, offset});
  };
  each_number(PathPart{nullptr, "it", 0}, type, {keep, &numbers});
  return numbers;
}

TEST(FieldTable, NamesEveryNumberInItsPlace) {
  const std::vector<Number> numbers = numbers_of(kFieldType<Nested>);
  const char* const paths[] = {"it.rows[0].big", "it.rows[0].flag", "it.rows[0].small", "it.rows[0].middle",
                               "it.rows[1].big", "it.rows[1].flag", "it.rows[1].small", "it.rows[1].middle",
                               "it.lane",        "it.mood"};
  ASSERT_EQ(numbers.size(), std::size(paths));
  std::uint32_t offset = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(numbers[i].path, paths[i]);
    EXPECT_EQ(numbers[i].offset, offset) << paths[i];
    offset += numbers[i].format.size;
  }
  EXPECT_EQ(offset, kPackedSize<Nested>);
  EXPECT_EQ(numbers[1].format.kind, FieldKind::truth);
  EXPECT_EQ(numbers[2].format.kind, FieldKind::signed_integer);
  EXPECT_TRUE(numbers_of(kFieldType<Nothing>).empty());
}

template <class S> class FieldTableOf : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(FieldTableOf, Scalars);

/// The number at its offset in the packed bytes is the member's.
TYPED_TEST(FieldTableOf, FindsNumbersInCanonicalBytes) {
  using S = TypeParam;
  const toy::Thing<S> thing = {{S(1.5), S(-2), S(3)}, S(-4.25), 0x89abcdefu, toy::Mood::cross, {6, 255}};
  std::uint8_t bytes[kPackedSize<toy::Thing<S>>];
  pack(bytes, thing);
  const std::uint64_t expected[] = {to_bits(thing.velocity.x),
                                    to_bits(thing.velocity.y),
                                    to_bits(thing.velocity.z),
                                    to_bits(thing.charge),
                                    0x89abcdefu,
                                    1,
                                    6,
                                    255};
  const std::vector<Number> numbers = numbers_of(kFieldType<toy::Thing<S>>);
  ASSERT_EQ(numbers.size(), std::size(expected));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(load_number(bytes + numbers[i].offset, numbers[i].format.size), expected[i]) << numbers[i].path;
  EXPECT_EQ(numbers[3].format.scalar_id, ScalarTraits<S>::kId);
}

}  // namespace field_table_test
}  // namespace isostep
