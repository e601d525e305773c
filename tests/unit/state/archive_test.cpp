// Writer and Reader: what goes in comes out, and nothing that comes in is believed.
// SPDX-License-Identifier: MIT
#include "isostep/state/archive.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "toy.hpp"

namespace isostep {
namespace archive_test {

using Buffer = std::vector<std::uint8_t>;

template <class S> class Archive : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Archive, Scalars);

template <class S> toy::Thing<S> thing() {
  return {{S(1.5), S(-2.25), S(0.125)}, S(-3), 0x01020304u, toy::Mood::cross, {9, 8}};
}

TYPED_TEST(Archive, RecordsComeBackBitForBit) {
  using Thing = toy::Thing<TypeParam>;
  const std::vector<Thing> before(3, thing<TypeParam>());
  Buffer bytes;
  Writer writer(bytes);
  writer.write_array(before);
  EXPECT_EQ(bytes.size(), 4 + 3 * sizeof(Thing));

  Reader reader(bytes);
  std::vector<Thing> after;
  EXPECT_TRUE(reader.read_array(after, 3));
  EXPECT_EQ(reader.remaining(), 0u);
  ASSERT_EQ(after.size(), 3u);
  EXPECT_EQ(std::memcmp(after.data(), before.data(), 3 * sizeof(Thing)), 0);
}

TYPED_TEST(Archive, OneRecordAtATimeWritesTheSameBytesAsAnArray) {
  using Thing = toy::Thing<TypeParam>;
  const Thing things[2] = {thing<TypeParam>(), thing<TypeParam>()};
  Buffer whole, single;
  Writer(whole).write_records(things, 2);
  for (const Thing& one : things) Writer(single).write(one);
  EXPECT_EQ(whole, single);
}

TYPED_TEST(Archive, EveryCutIsAFailureThatSticks) {
  using Thing = toy::Thing<TypeParam>;
  Buffer bytes;
  Writer(bytes).write(thing<TypeParam>());
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
    const Buffer part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(cut));
    Reader reader(part);
    Thing value{};
    EXPECT_FALSE(reader.read(value));
    EXPECT_EQ(reader.remaining(), 0u);
    EXPECT_EQ(reader.read<std::uint8_t>(), 0u);
    EXPECT_EQ(reader.result("thing").error().code, ErrorCode::truncated);
  }
}

TEST(Writer, LaysOutFieldsLittleEndianByWidth) {
  const toy::Padded padded{0x0807060504030201u, true, -2, 0x1234};
  Buffer bytes;
  Writer(bytes).write(padded);
  EXPECT_EQ(bytes, (Buffer{1, 2, 3, 4, 5, 6, 7, 8, 1, 0xfe, 0x34, 0x12}));
  Buffer text;
  Writer(text).write_text("ab");
  EXPECT_EQ(text, (Buffer{2, 0, 0, 0, 'a', 'b'}));
  Buffer scalars;
  Writer(scalars).write(1.0f);
  Writer(scalars).write(Q16_16(1));
  EXPECT_EQ(scalars, (Buffer{0, 0, 0x80, 0x3f, 0, 0, 1, 0}));
}

TEST(Reader, ReadsRecordsWithPaddingAndBools) {
  std::vector<toy::Padded> before = {{1, true, -2, 3}, {4, false, 5, -6}};
  Buffer bytes;
  Writer(bytes).write_array(before);
  Reader reader(bytes);
  std::vector<toy::Padded> after;
  ASSERT_TRUE(reader.read_array(after, 2));
  ASSERT_EQ(after.size(), 2u);
  EXPECT_EQ(after[0].small, -2);
  EXPECT_TRUE(after[0].flag);
  EXPECT_FALSE(after[1].flag);
  EXPECT_EQ(after[1].middle, -6);
}

TEST(Reader, RefusesABoolThatIsNeither) {
  const Buffer bytes = {1, 2, 3, 4, 5, 6, 7, 8, 2, 0, 0, 0};
  Reader reader(bytes);
  toy::Padded padded{};
  EXPECT_FALSE(reader.read(padded));
  EXPECT_FALSE(padded.flag);
  const Error error = reader.result("padded").error();
  EXPECT_EQ(error.code, ErrorCode::invalid);
  EXPECT_EQ(error.place.view(), "padded byte 8, at or after field flag");
}

TEST(Reader, ACountIsCheckedAgainstCapAndBytesBeforeAnyMemoryIsTaken) {
  const Buffer huge = {0xff, 0xff, 0xff, 0xff, 1, 2, 3, 4};
  std::vector<std::uint64_t> records;
  Reader by_bytes(huge);
  EXPECT_FALSE(by_bytes.read_array(records, 0xffffffffu));
  EXPECT_EQ(by_bytes.result("x").error().code, ErrorCode::truncated);
  EXPECT_LT(records.capacity(), 64u);
  Reader by_cap(huge);
  EXPECT_FALSE(by_cap.read_array(records, 100));
  EXPECT_EQ(by_cap.result("x").error().code, ErrorCode::limit);
  EXPECT_LT(records.capacity(), 64u);
}

TEST(Reader, AnArrayOfNothingIsEmpty) {
  const Buffer bytes = {0, 0, 0, 0};
  Reader reader(bytes);
  std::vector<std::uint64_t> records(3);
  EXPECT_TRUE(reader.read_array(records, 0));
  EXPECT_TRUE(records.empty());
}

TEST(Reader, BytesAreViewsAndMayNotRunPastTheEnd) {
  Buffer bytes;
  Writer(bytes).write_text("hello");
  Reader reader(bytes);
  EXPECT_EQ(reader.read_text(5), "hello");
  Reader capped(bytes);
  EXPECT_EQ(capped.read_text(4), "");
  EXPECT_FALSE(capped.ok());
  bytes.pop_back();
  Reader cut(bytes);
  EXPECT_TRUE(cut.read_bytes(100).empty());
  EXPECT_FALSE(cut.ok());
}

TEST(Reader, LeftOverBytesAreAnErrorWhenAskedFor) {
  const Buffer bytes = {1, 2};
  Reader reader(bytes);
  reader.read<std::uint8_t>();
  EXPECT_TRUE(reader.ok());
  reader.expect_end();
  EXPECT_EQ(reader.result("x").error().code, ErrorCode::corrupt);
}

TEST(Reader, TheFirstFailureIsTheOneThatIsReported) {
  Reader reader({});
  reader.fail(ErrorCode::invalid, "first");
  reader.fail(ErrorCode::limit, "second");
  EXPECT_EQ(reader.result("x").error().message.view(), "first");
}

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = 5;
  ASSERT_TRUE(good);
  EXPECT_EQ(good.value(), 5);
  const Result<int> bad = Error{ErrorCode::limit, "too many", "bodies"};
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message.view(), "too many");
  EXPECT_TRUE(Result<void>().ok());
}

TEST(Result, AskingForTheOtherSideStopsTheProgram) {
  const Result<int> good = 5;
  const Result<int> bad = Error{ErrorCode::limit, "too many", "bodies"};
  EXPECT_DEATH((void)good.error(), "");
  EXPECT_DEATH((void)bad.value(), "");
}

TEST(ShortText, CutsWhatDoesNotFit) {
  EXPECT_EQ(ShortText<4>("abcdef").view(), "abcd");
  EXPECT_EQ(ShortText<4>("ab").append_number(12345).view(), "ab12");
  EXPECT_EQ(ShortText<40>().append_number(0).append(" ").append_number(18446744073709551615u).view(),
            "0 18446744073709551615");
  EXPECT_EQ(ShortText<16>().append_hex(0xab).view(), "00000000000000ab");
}

}  // namespace archive_test
}  // namespace isostep
