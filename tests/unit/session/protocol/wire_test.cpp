// Numbers in bytes: the form is LEB128's and zigzag's own, each number has one, and damage is noticed for good.
// SPDX-License-Identifier: MIT
#include "isostep/session/protocol/wire.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace isostep {
namespace wire_test {

using Buffer = std::vector<std::uint8_t>;

Buffer number(std::uint32_t value) {
  std::uint8_t bytes[8];
  WireWriter writer(bytes, sizeof bytes);
  writer.number(value);
  return Buffer(bytes, bytes + writer.size());
}
Buffer difference(std::int32_t value) {
  std::uint8_t bytes[8];
  WireWriter writer(bytes, sizeof bytes);
  writer.difference(value);
  return Buffer(bytes, bytes + writer.size());
}

TEST(Wire, NumbersAreLeb128) {
  EXPECT_EQ(number(0), (Buffer{0x00}));
  EXPECT_EQ(number(127), (Buffer{0x7f}));
  EXPECT_EQ(number(128), (Buffer{0x80, 0x01}));
  EXPECT_EQ(number(624485), (Buffer{0xe5, 0x8e, 0x26}));  // the example of the DWARF standard, 7.6
  EXPECT_EQ(number(0xffffffffu), (Buffer{0xff, 0xff, 0xff, 0xff, 0x0f}));
}

TEST(Wire, DifferencesOfEitherSignAreShortWhenSmall) {
  EXPECT_EQ(difference(0), (Buffer{0}));
  EXPECT_EQ(difference(-1), (Buffer{1}));
  EXPECT_EQ(difference(1), (Buffer{2}));
  EXPECT_EQ(difference(-64), (Buffer{127}));
  EXPECT_EQ(difference(64), (Buffer{0x80, 0x01}));
  EXPECT_EQ(difference(INT32_MAX), (Buffer{0xfe, 0xff, 0xff, 0xff, 0x0f}));
  EXPECT_EQ(difference(INT32_MIN), (Buffer{0xff, 0xff, 0xff, 0xff, 0x0f}));
}

TEST(Wire, EveryNumberComesBack) {
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const std::uint32_t value = static_cast<std::uint32_t>(i < 100000 ? i : i * 2654435761u);
    const Buffer bytes = number(value), signed_bytes = difference(static_cast<std::int32_t>(value));
    WireReader reader(bytes), other(signed_bytes);
    ASSERT_EQ(reader.number(), value);
    ASSERT_EQ(other.difference(), static_cast<std::int32_t>(value));
    ASSERT_FALSE(reader.failed() || other.failed());
    ASSERT_EQ(reader.remaining() + other.remaining(), 0u);
  }
}

TEST(Wire, NoOtherBytesGiveTheSameNumber) {
  for (std::uint32_t word = 0; word < 1u << 24; ++word) {
    const std::uint8_t bytes[3] = {static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
                                   static_cast<std::uint8_t>(word >> 16)};
    WireReader reader(bytes);
    const std::uint32_t value = reader.number();
    if (reader.failed()) {
      ASSERT_EQ(value, 0u);
      continue;
    }
    std::uint8_t again[8];
    WireWriter writer(again, sizeof again);
    writer.number(value);
    ASSERT_EQ(writer.size(), 3 - reader.remaining());
    ASSERT_EQ(std::memcmp(again, bytes, writer.size()), 0);
  }
}

TEST(Wire, NumbersWithIdleBytesOrTooManyBitsAreRefused) {
  for (const Buffer& bytes : {Buffer{0x80, 0x00}, Buffer{0xff, 0x80, 0x00}, Buffer{0xff, 0xff, 0xff, 0xff, 0x10},
                              Buffer{0xff, 0xff, 0xff, 0xff, 0x7f}, Buffer{0xff, 0xff, 0xff, 0xff, 0xff, 0x00},
                              Buffer{0x80, 0x80, 0x80, 0x80, 0x80, 0x01}, Buffer{0x80}, Buffer{}}) {
    WireReader reader(bytes);
    EXPECT_EQ(reader.number(), 0u);
    EXPECT_TRUE(reader.failed());
  }
}

TEST(Wire, FixedNumbersAreLittleEndian) {
  std::uint8_t bytes[8];
  WireWriter writer(bytes, sizeof bytes);
  writer.fixed(std::uint16_t{0x1234});
  writer.fixed(std::uint32_t{0x89abcdefu});
  EXPECT_EQ(Buffer(bytes, bytes + writer.size()), (Buffer{0x34, 0x12, 0xef, 0xcd, 0xab, 0x89}));
  WireReader reader({bytes, 6});
  EXPECT_EQ(reader.fixed<std::uint16_t>(), 0x1234);
  EXPECT_EQ(reader.fixed<std::uint32_t>(), 0x89abcdefu);
}

TEST(Wire, AFullBufferIsNotOverrunAndSaysSo) {
  std::uint8_t bytes[4] = {9, 9, 9, 9};
  WireWriter writer(bytes, 3);
  writer.byte(1);
  EXPECT_FALSE(writer.full());
  writer.raw(Buffer{2, 3, 4, 5});
  EXPECT_TRUE(writer.full());
  EXPECT_EQ(writer.size(), 3u);
  EXPECT_EQ(bytes[3], 9);
}

TEST(Wire, TheFirstFailureSticks) {
  const Buffer bytes{1, 2, 3};
  WireReader reader(bytes);
  EXPECT_EQ(reader.raw(4).size(), 0u);
  EXPECT_TRUE(reader.failed());
  EXPECT_EQ(reader.remaining(), 0u);
  EXPECT_EQ(reader.number(), 0u);
  EXPECT_EQ(reader.raw(1).size(), 0u);
  WireReader whole(bytes);
  EXPECT_EQ(whole.raw(3).size(), 3u);
  EXPECT_FALSE(whole.failed());
  EXPECT_EQ(whole.byte(), 0);
  EXPECT_TRUE(whole.failed());
}

}  // namespace wire_test
}  // namespace isostep
