// stable_sort and insertion_sort against the standard library's stable sort.
// SPDX-License-Identifier: MIT
#include "isostep/core/stable_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "isostep/core/random.hpp"

namespace isostep {
namespace stable_sort_test {

struct Record {
  std::uint64_t key;
  std::uint32_t position;  // before sorting
};
bool operator==(const Record& a, const Record& b) { return a.key == b.key && a.position == b.position; }

struct KeyOf {
  ISO_INLINE constexpr std::uint64_t operator()(const Record& record) const { return record.key; }
};

std::vector<Record> records_of(const std::vector<std::uint64_t>& keys) {
  std::vector<Record> records;
  for (const std::uint64_t key : keys) records.push_back({key, static_cast<std::uint32_t>(records.size())});
  return records;
}
std::vector<Record> expected_of(std::vector<Record> records) {
  std::stable_sort(records.begin(), records.end(), [](const Record& a, const Record& b) { return a.key < b.key; });
  return records;
}
std::vector<Record> sorted(std::vector<Record> records) {
  std::vector<Record> scratch(records.size());
  stable_sort(records.data(), scratch.data(), static_cast<std::uint32_t>(records.size()), KeyOf{});
  return records;
}

TEST(StableSort, EveryLengthAndEveryMaskOfBitsIsOrderedAndKeepsTheOrderOfEqualKeys) {
  Pcg32 random = Pcg32::seeded(1);
  const std::uint64_t masks[] = {0,     1,          0xff,           0x7ff, 0xff00ff00ff00ff00u, 0x000003ff000003ffu,
                                 ~0ull, 1ull << 63, 0xfffull << 52, 7,     0x8000000000000001u};
  for (const std::uint32_t count : {0u, 1u, 2u, 3u, 31u, 32u, 33u, 100u, 1024u, 1025u, 5000u}) {
    for (const std::uint64_t mask : masks) {
      std::vector<std::uint64_t> keys;
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t high = random.next();
        keys.push_back((high << 32 | random.next()) & mask);
      }
      const std::vector<Record> records = records_of(keys);
      EXPECT_EQ(sorted(records), expected_of(records)) << count << " keys, mask " << mask;
    }
  }
}

TEST(StableSort, BitsThatAllKeysShareStayInTheKeys) {
  std::vector<std::uint64_t> keys;
  for (std::uint64_t i = 0; i < 200; ++i) keys.push_back(0xabc0000000000123u | ((i * 77u) % 200u) << 20);
  const std::vector<Record> records = records_of(keys);
  EXPECT_EQ(sorted(records), expected_of(records));
}

TEST(StableSort, SortedAndReversedInputsEndSorted) {
  std::vector<std::uint64_t> up;
  for (std::uint64_t i = 0; i < 3000; ++i) up.push_back(i * i);
  std::vector<std::uint64_t> keys(up.rbegin(), up.rend());
  std::vector<std::uint64_t> scratch(keys.size());
  stable_sort(keys.data(), scratch.data(), 3000, OwnKey{});
  EXPECT_EQ(keys, up);
  stable_sort(keys.data(), scratch.data(), 3000, OwnKey{});
  EXPECT_EQ(keys, up);
}

TEST(InsertionSort, KeepsTheOrderOfEqualKeys) {
  Pcg32 random = Pcg32::seeded(2);
  for (std::uint32_t count = 0; count < 60; ++count) {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t i = 0; i < count; ++i) keys.push_back(random_below(random, 9));
    std::vector<Record> records = records_of(keys);
    const std::vector<Record> expected = expected_of(records);
    insertion_sort(records.data(), count, KeyOf{});
    EXPECT_EQ(records, expected);
  }
}

}  // namespace stable_sort_test
}  // namespace isostep
