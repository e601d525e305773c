// SlotMap: no id comes back, however often a slot is used, and what is written and read again goes on alike.
// SPDX-License-Identifier: MIT
#include "isostep/core/slot_map.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace isostep::test {
namespace slot_map_test {

using TestId = Id<struct TestTag>;

std::vector<SlotEntry> entries_of(const SlotMap& slots) {
  std::vector<SlotEntry> entries;
  for (std::uint32_t slot = 0; slot < slots.entries().size(); ++slot) entries.push_back(slots.entries()[slot]);
  return entries;
}

TEST(SlotMap, a_slot_that_had_all_its_tenants_is_used_no_more) {
  constexpr std::uint32_t kTenants = (1u << 24) - 1, kSpace = 5;
  SlotMap slots;
  const TestId first = slots.take<TestId>(kSpace);
  TestId last = first;
  for (std::uint32_t i = 1; i < kTenants; ++i) {
    slots.give_back(0);
    last = slots.take<TestId>(kSpace);
    ASSERT_EQ(last.slot, 0u);
  }
  EXPECT_EQ(SlotMap::space_of(last), kSpace);
  EXPECT_TRUE(slots.holds(last));
  EXPECT_FALSE(slots.holds(first));
  slots.give_back(0);
  EXPECT_FALSE(slots.is_taken(0));
  EXPECT_FALSE(slots.holds(last));
  EXPECT_EQ(slots.count_taken(), 0u);
  const TestId next = slots.take<TestId>(kSpace);
  EXPECT_EQ(next.slot, 1u);
  EXPECT_TRUE(slots.ids<TestId>() == std::vector<TestId>{next});

  SlotMap read;
  ASSERT_TRUE(read.restore(entries_of(slots), slots.first_free()));
  EXPECT_FALSE(read.is_taken(0));
  EXPECT_EQ(read.take<TestId>(kSpace).slot, 2u);
}

TEST(SlotMap, a_file_may_not_retire_a_slot_that_has_tenants_left_nor_list_it_as_free) {
  SlotMap slots;
  constexpr std::uint32_t kLast = (1u << 24) - 1;
  EXPECT_TRUE(slots.restore({{kLast, SlotEntry::kRetired}}, SlotEntry::kEnd));
  EXPECT_FALSE(slots.restore({{kLast - 1, SlotEntry::kRetired}}, SlotEntry::kEnd));
  EXPECT_FALSE(slots.restore({{kLast, SlotEntry::kRetired}}, 0));
  EXPECT_FALSE(slots.restore({{kLast, SlotEntry::kRetired}, {1, 0}}, 1));
}

}  // namespace slot_map_test
}  // namespace isostep::test
