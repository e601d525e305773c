// SliceReader: tokens of inputs that are damaged, cut or promise too much.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "isostep/session/protocol/packet.hpp"

namespace isostep {
namespace slice_reader_test {

using Buffer = std::vector<std::uint8_t>;

/// The number of entries before the end or the damage.
int entries(const Buffer& tokens, Frame count, bool& failed) {
  SliceReader reader({0, 0, count, tokens});
  InputEntry entry;
  int n = 0;
  while (reader.next(entry)) ++n;
  failed = reader.failed();
  return n;
}
TEST(SliceReader, DamagedTokensAreNoticed) {
  bool failed = false;
  EXPECT_EQ(entries({0x40 | 3}, 4, failed), 4);
  EXPECT_FALSE(failed);
  EXPECT_EQ(entries({0x40 | 3}, 3, failed), 0);  // a run longer than the slice
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({0x40 | 3}, 5, failed), 4);  // and one that is shorter
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({0x40, 0x40}, 1, failed), 1);  // bytes that belong to nobody
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({}, 1, failed), 0);
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({0x80, 2, 1, 1, 0x81, 0x01, 5}, 2, failed), 2);
  EXPECT_FALSE(failed);
  EXPECT_EQ(entries({0x80, 2, 1, 1, 0x81, 0x04, 5}, 2, failed), 1);  // changes a byte that is not there
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({0x80, 2, 1, 1, 0x81, 0x01}, 2, failed), 1);
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({0x80, 2, 1, 1, 0xc1, 5}, 2, failed), 2);
  EXPECT_EQ(entries({0x80, 2, 1, 1, 0xc4, 5}, 2, failed), 1);  // changes a byte that is not there
  EXPECT_EQ(entries({0x80, 2, 1, 1, 0xc3, 5}, 2, failed), 1);
  EXPECT_EQ(entries({0x80, 7, 1, 1, 1, 1, 1, 1, 1, 0xc1, 5}, 2, failed), 1);  // too long for a mask in the token
  EXPECT_EQ(entries({0xc0}, 1, failed), 0);
  EXPECT_EQ(entries({0x81, 0x00}, 1, failed), 0);  // as long as a previous one that was never given
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({0x80, 3, 1, 1}, 1, failed), 0);
  EXPECT_TRUE(failed);
  EXPECT_EQ(entries({0x80, 0x81, 0x04}, 1, failed), 0);  // 513 bytes
  EXPECT_TRUE(failed);
  for (unsigned token = 0x82; token < 256; ++token) {
    EXPECT_EQ(entries({static_cast<std::uint8_t>(token), 0, 0, 0, 0}, 1, failed), 0);
    EXPECT_TRUE(failed) << token;
  }
}

}  // namespace slice_reader_test
}  // namespace isostep
