// _init for callers of every age: it writes as much as the caller's struct has, and all of that.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "random_facts.hpp"

namespace isostep::test {
namespace init_test {

constexpr std::uint8_t kCanary = 0xa5;
constexpr std::size_t kRoom = 64;  // [bytes] behind a struct

/// The bytes that _init makes of a struct for a caller that knows so many of it, and what lies behind.
template <class T, class Init> std::vector<std::uint8_t> made(const Init& init, std::size_t size) {
  std::vector<std::uint64_t> words((sizeof(T) + kRoom) / 8);
  std::memset(words.data(), kCanary, words.size() * 8);
  EXPECT_EQ(init(reinterpret_cast<T*>(words.data()), size), ISO_OK) << iso_last_error();
  const auto* const first = reinterpret_cast<const std::uint8_t*>(words.data());
  return {first, first + words.size() * 8};
}
std::uint32_t size_of(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof size);
  return size;
}
bool untouched(const std::vector<std::uint8_t>& bytes, std::size_t from) {
  return std::all_of(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(),
                     [](std::uint8_t byte) { return byte == kCanary; });
}

/// Releases end a struct behind any of its members.
template <class T, class Init> void check(const Fact& fact, const Init& init) {
  SCOPED_TRACE(fact.name);
  const std::vector<std::uint8_t> whole = made<T>(init, sizeof(T));
  EXPECT_TRUE(std::equal(fact.image.begin(), fact.image.end(), whole.begin()));
  for (const Member& member : fact.members) {
    const std::size_t size = (member.offset + member.size + 7) / 8 * 8;
    const std::vector<std::uint8_t> early = made<T>(init, size);
    EXPECT_EQ(size_of(early), size);
    EXPECT_TRUE(untouched(early, size)) << "a caller's " << size << " bytes are written past";
    // Of what is cut by the end nothing is written.
    const std::size_t end = member.offset + member.size;
    EXPECT_TRUE(std::equal(early.begin() + 4, early.begin() + static_cast<std::ptrdiff_t>(end), whole.begin() + 4))
        << "another default before " << size;
  }
  const std::vector<std::uint8_t> late = made<T>(init, sizeof(T) + kRoom / 2);
  EXPECT_EQ(size_of(late), sizeof(T) + kRoom / 2);
  EXPECT_TRUE(std::equal(late.begin() + 4, late.begin() + sizeof(T), whole.begin() + 4));
  EXPECT_TRUE(
      std::all_of(late.begin() + sizeof(T), late.end() - kRoom / 2, [](std::uint8_t byte) { return byte == 0; }));
  EXPECT_TRUE(untouched(late, sizeof(T) + kRoom / 2));
  T none;
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, ~std::size_t{0}, (std::size_t{1} << 32) + sizeof(T)}) {
    EXPECT_EQ(init(&none, size), ISO_WRONG_SIZE) << size;
  }
  EXPECT_EQ(init(nullptr, sizeof(T)), ISO_NULL);
}

TEST(CInit, WritesWhatTheCallersStructHasAndNoMore) {
  const Facts facts;
  int structs = 0;
#define ISO_INIT(name)                                 \
  check<name>(*facts.named(#name), name##_init_sized); \
  ++structs;
#include "calls.inl"
#undef ISO_INIT
  EXPECT_GT(structs, 250);
}

TEST(CInit, APresetWritesWhatTheCallersStructHasAndNoMore) {
  constexpr std::size_t kEarly = offsetof(iso_session_config, credential);
  iso_session_config whole, early;
  std::memset(&early, kCanary, sizeof early);
  ASSERT_EQ(iso_session_config_init(&whole), ISO_OK);
  ASSERT_EQ(iso_session_config_init_sized(&early, kEarly), ISO_OK);
  ASSERT_EQ(iso_session_config_preset(&whole, ISO_FIGHTING, 2), ISO_OK);
  ASSERT_EQ(iso_session_config_preset(&early, ISO_FIGHTING, 2), ISO_OK);
  EXPECT_EQ(early.size, kEarly);
  EXPECT_EQ(std::memcmp(&early.mode, &whole.mode, kEarly - offsetof(iso_session_config, mode)), 0);
  for (const std::uint8_t byte : early.credential) EXPECT_EQ(byte, kCanary);
  iso_session_config wild{};
  EXPECT_EQ(iso_session_config_preset(&wild, ISO_FIGHTING, 2), ISO_WRONG_SIZE);
}

}  // namespace init_test
}  // namespace isostep::test
