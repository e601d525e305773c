// InputStream: a ring of one player's newest inputs, held against a list that forgets nothing.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/input_stream.hpp"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "isostep/core/random.hpp"

namespace isostep {
namespace input_stream_test {

using Buffer = std::vector<std::uint8_t>;

TEST(InputStream, KnowsWhatWasAppendedAndWhatIsMissing) {
  InputStream stream(8, 2);
  EXPECT_EQ(stream.begin(), 0);
  EXPECT_EQ(stream.end(), 0);
  EXPECT_FALSE(stream.contains(0));
  EXPECT_TRUE(stream.last().absent);
  EXPECT_TRUE(stream.append({false, Buffer{1, 2}}));
  EXPECT_TRUE(stream.append({true, {}}));
  EXPECT_TRUE(stream.append({false, {}}));
  EXPECT_EQ(stream.end(), 3);
  EXPECT_TRUE(same_input(stream.at(0), {false, Buffer{1, 2}}));
  EXPECT_TRUE(stream.at(1).absent);
  EXPECT_FALSE(stream.at(2).absent) << "an empty input is no absence";
  EXPECT_TRUE(same_input(stream.last(), {false, {}}));
  EXPECT_FALSE(same_input(stream.at(1), stream.at(2)));
}

TEST(InputStream, WhatIsTooLongIsNotTaken) {
  InputStream stream(8, 2);
  EXPECT_FALSE(stream.append({false, Buffer{1, 2, 3}}));
  EXPECT_EQ(stream.end(), 0);
}

TEST(InputStream, ReplacesOneFrameAndNoOther) {
  InputStream stream(4, 2);
  for (std::uint8_t i = 0; i < 6; ++i) stream.append({false, Buffer{i}});
  EXPECT_TRUE(stream.replace(3, {false, Buffer{8, 9}}));
  EXPECT_TRUE(stream.replace(4, {true, {}}));
  EXPECT_FALSE(stream.replace(5, {false, Buffer{1, 2, 3}}));
  EXPECT_EQ(stream.begin(), 2);
  EXPECT_EQ(stream.end(), 6);
  EXPECT_TRUE(same_input(stream.at(2), {false, Buffer{2}}));
  EXPECT_TRUE(same_input(stream.at(3), {false, Buffer{8, 9}}));
  EXPECT_TRUE(stream.at(4).absent);
  EXPECT_TRUE(same_input(stream.at(5), {false, Buffer{5}}));
}

TEST(InputStream, KnowsWhatRepeatsTheFrameBefore) {
  InputStream stream(8, 2);
  for (const std::uint8_t byte : {1, 1, 1, 2, 2}) stream.append({false, Buffer{byte}});
  const auto repeats = [&] {
    std::string text;
    for (Frame frame = stream.begin(); frame < stream.end(); ++frame) text += stream.repeats(frame) ? '=' : '.';
    return text;
  };
  EXPECT_EQ(repeats(), ".==.=");
  stream.replace(1, {false, Buffer{2}});
  EXPECT_EQ(repeats(), "....=");
  stream.replace(2, {false, Buffer{2}});
  EXPECT_EQ(repeats(), "..===");
}

TEST(InputStream, TheOldestFallsOut) {
  InputStream stream(4, 1);
  for (std::uint8_t i = 0; i < 10; ++i) stream.append({false, Buffer{i}});
  EXPECT_EQ(stream.begin(), 6);
  EXPECT_EQ(stream.end(), 10);
  EXPECT_FALSE(stream.contains(5));
  for (Frame f = 6; f < 10; ++f) EXPECT_EQ(stream.at(f).bytes[0], f);
}

TEST(InputStream, AnAbsenceOfAnyLengthLeavesTheNewest) {
  InputStream stream(4, 1);
  stream.append({false, Buffer{1}});
  stream.append_absent_until(1);
  EXPECT_EQ(stream.end(), 1);
  stream.append_absent_until(1000);
  EXPECT_EQ(stream.begin(), 996);
  EXPECT_EQ(stream.end(), 1000);
  EXPECT_TRUE(stream.at(996).absent);
}

TEST(InputStream, DoesWhatAListDoes) {
  Pcg32 random = Pcg32::seeded(1);
  InputStream stream(16, 4);
  std::map<Frame, std::optional<Buffer>> model;
  Frame begin = 0, end = 0;
  for (int step = 0; step < 20000; ++step) {
    const std::uint32_t draw = random.next() % 100;
    if (draw < 70) {
      Buffer bytes(random.next() % 5);
      const std::uint32_t values = random.next() % 2 == 0 ? 2 : 256;  // few: then inputs repeat each other
      for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.next() % values);
      const bool absent = random.next() % 4 == 0;
      ASSERT_TRUE(stream.append({absent, absent ? Bytes{} : Bytes(bytes)}));
      model[end++] = absent ? std::nullopt : std::optional(bytes);
      if (end - begin > 16) begin = end - 16;
    } else if (draw < 90) {
      const Frame cut = end - static_cast<Frame>(random.next() % 20) + 2;
      stream.truncate(cut);
      if (cut < end) end = cut < begin ? begin : cut;
    } else if (draw < 99) {
      const Frame to = end + static_cast<Frame>(random.next() % 30);
      stream.append_absent_until(to);
      while (end < to) model[end++] = std::nullopt;
      if (end - begin > 16) begin = end - 16;
    } else {
      begin = end = static_cast<Frame>(random.next() % 100000);
      stream.reset(begin);
    }
    ASSERT_EQ(stream.begin(), begin);
    ASSERT_EQ(stream.end(), end);
    for (Frame f = begin; f < end; ++f) {
      const std::optional<Buffer>& said = model[f];
      ASSERT_TRUE(same_input(stream.at(f), {!said, said ? Bytes(*said) : Bytes{}})) << f;
      ASSERT_EQ(stream.repeats(f), f > begin && model[f] == model[f - 1]) << f;
    }
  }
}

}  // namespace input_stream_test
}  // namespace isostep
