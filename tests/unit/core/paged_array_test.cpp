// PagedArray against vectors of the same items; what copies share, and what they let go.
// SPDX-License-Identifier: MIT
#include "isostep/core/paged_array.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "isostep/core/random.hpp"

namespace isostep {
namespace paged_array_test {

using Small = PagedArray<int, 4>;
using Pointers = PagedArray<std::shared_ptr<int>, 4>;

std::vector<int> items(const Small& array) {
  std::vector<int> list;
  for (const int item : array) list.push_back(item);
  return list;
}
Small filled(int count) {
  Small array;
  for (int i = 0; i < count; ++i) array.push_back(i);
  return array;
}
std::size_t shared_pages(const Small& a, const Small& b) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < a.pages(); ++p) count += a.shares_page(p, b) ? 1u : 0u;
  return count;
}
std::vector<std::size_t> differences(const Small& a, const Small& b) {
  std::vector<std::size_t> list;
  a.each_difference(b, [&](std::size_t i) { list.push_back(i); });
  return list;
}

TEST(PagedArray, RandomChangesAndCopiesLeaveTheItemsOfVectors) {
  Small arrays[4];
  std::vector<int> models[4];
  Pcg32 random = Pcg32::seeded(3);
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t at = random_below(random, 4), other = random_below(random, 4);
    Small& array = arrays[at];
    std::vector<int>& model = models[at];
    switch (random_below(random, 8)) {
      case 0:
        array = arrays[other];
        model = models[other];
        break;
      case 1: {
        Small copy = arrays[other];
        array = std::move(copy);
        model = models[other];
        break;
      }
      case 2:
      case 3:
      case 4:
        array.push_back(i);
        model.push_back(i);
        break;
      case 5:
        if (model.empty()) break;
        array.pop_back();
        model.pop_back();
        break;
      default:
        if (model.empty()) break;
        const std::uint32_t index = random_below(random, static_cast<std::uint32_t>(model.size()));
        array.change(index) = i;
        model[index] = i;
    }
    if (model.size() > 40) {
      array.clear();
      model.clear();
    }
    for (int k = 0; k < 4; ++k) ASSERT_EQ(items(arrays[k]), models[k]) << "after change " << i;
    std::vector<std::size_t> expected;
    for (std::size_t k = 0; k < std::max(model.size(), models[other].size()); ++k) {
      if (k >= model.size() || k >= models[other].size() || model[k] != models[other][k]) expected.push_back(k);
    }
    ASSERT_EQ(differences(array, arrays[other]), expected);
  }
}

TEST(PagedArray, ACopySharesEveryPageAndAChangePartsWithOne) {
  Small array = filled(10);
  EXPECT_EQ(array.pages(), 3u);
  const Small copy = array;
  EXPECT_EQ(shared_pages(array, copy), 3u);
  array.change(5) = 50;
  EXPECT_EQ(shared_pages(array, copy), 2u);
  EXPECT_EQ(copy[5], 5);
  EXPECT_EQ(array[5], 50);
  EXPECT_EQ(differences(array, copy), std::vector<std::size_t>{5});
}

TEST(PagedArray, AnArrayThatGoesBackToACopySharesItsPagesAgain) {
  Small array = filled(10);
  const Small copy = array;
  array.change(0) = 7;
  for (int i = 0; i < 8; ++i) array.push_back(i);
  array = copy;
  EXPECT_EQ(shared_pages(array, copy), 3u);
  EXPECT_EQ(items(array), items(copy));
}

TEST(PagedArray, AChangeWithNoCopyLeftMovesNothing) {
  Small array = filled(10);
  { const Small copy = array; }
  const int* const page = array.page(1);
  array.change(5) = 50;
  EXPECT_EQ(array.page(1), page);
}

TEST(PagedArray, PagesHoldTheirSizeAndTheLastTheRest) {
  const Small array = filled(10);
  EXPECT_EQ(array.page_size(0), 4u);
  EXPECT_EQ(array.page_size(1), 4u);
  EXPECT_EQ(array.page_size(2), 2u);
  EXPECT_EQ(array.page(2)[1], 9);
}

TEST(PagedArray, AnItemTakenOffIsLetGo) {
  Pointers array;
  const auto item = std::make_shared<int>(1);
  for (int i = 0; i < 5; ++i) array.push_back(item);
  EXPECT_EQ(item.use_count(), 6);
  array.pop_back();
  array.pop_back();
  EXPECT_EQ(item.use_count(), 4);
  {
    Pointers copy = array;
    EXPECT_EQ(item.use_count(), 4) << "the page is shared, not its items";
    copy.change(0) = nullptr;
    EXPECT_EQ(item.use_count(), 6);
  }
  EXPECT_EQ(item.use_count(), 4);
  array.clear();
  EXPECT_EQ(item.use_count(), 1);
}

TEST(PagedArray, WhatIsRememberedOfAPageIsForgottenByAChangeOfThatPageAlone) {
  Small array = filled(8);
  int computed = 0;
  const auto value = [&](std::size_t p) {
    return array.remembered(p).get([&] { return static_cast<std::uint64_t>(++computed); });
  };
  EXPECT_EQ(value(0), 1u);
  EXPECT_EQ(value(1), 2u);
  EXPECT_EQ(value(0), 1u);
  const Small copy = array;
  array.change(2) = 0;
  EXPECT_EQ(value(0), 3u);
  EXPECT_EQ(value(1), 2u);
  EXPECT_EQ(copy.remembered(0).get([] { return std::uint64_t{9}; }), 1u);
}

}  // namespace paged_array_test
}  // namespace isostep
