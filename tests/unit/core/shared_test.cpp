// Shared: copies are one value until one of them changes.
// SPDX-License-Identifier: MIT
#include "isostep/core/shared.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace isostep {
namespace shared_test {

using Numbers = Shared<std::vector<int>>;

TEST(Shared, ACopyIsTheSameUntilEitherChanges) {
  Numbers a;
  a.change() = {1, 2, 3};
  Numbers b = a;
  EXPECT_TRUE(a.is_same(b));
  EXPECT_EQ(a->data(), b->data());
  b.change()[0] = 9;
  EXPECT_FALSE(a.is_same(b));
  EXPECT_EQ(*a, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(*b, (std::vector<int>{9, 2, 3}));
  a = b;
  EXPECT_TRUE(a.is_same(b));
  EXPECT_EQ(a->front(), 9);
}

TEST(Shared, WhatNobodySharesIsChangedInPlace) {
  Numbers a;
  a.change() = {1, 2, 3};
  const int* const data = a->data();
  { const Numbers copy = a; }
  a.change()[1] = 5;
  EXPECT_EQ(a->data(), data);
}

TEST(Shared, AChangeForgetsWhatWasRememberedOfTheValueAndNotOfTheCopy) {
  Numbers a;
  a.change() = {1};
  const auto first = [](const Numbers& of, int which) {
    return of.remembered(which).get([&] { return static_cast<std::uint64_t>(of->front() + which); });
  };
  EXPECT_EQ(first(a, 0), 1u);
  EXPECT_EQ(first(a, 1), 2u);
  const Numbers copy = a;
  a.change()[0] = 7;
  EXPECT_EQ(first(a, 0), 7u);
  EXPECT_EQ(first(a, 1), 8u);
  EXPECT_EQ(first(copy, 0), 1u);
}

}  // namespace shared_test
}  // namespace isostep
