// The verdict: whom a majority finds wrong.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/verdict.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace verdict_test {

Statements said(std::initializer_list<std::uint64_t> chains) {
  Statements statements;
  std::size_t machine = 0;
  for (const std::uint64_t chain : chains) statements.of[machine++] = {true, chain != 0, chain};
  return statements;
}

TEST(Judge, NamesWhoDiffersFromMoreThanHalfOfAllThatWereAsked) {
  EXPECT_FALSE(judge(said({})).is_decided);
  EXPECT_FALSE(judge(said({7, 8})).is_decided) << "two";
  EXPECT_FALSE(judge(said({7, 7, 8, 8})).is_decided) << "two against two";
  EXPECT_FALSE(judge(said({7, 8, 9})).is_decided) << "three opinions";
  EXPECT_FALSE(judge(said({7, 7, 8, 0})).is_decided) << "who is silent may be of another opinion";
  EXPECT_EQ(judge(said({7, 8, 7})).minority, 2u);
  EXPECT_EQ(judge(said({8, 7, 7, 9, 7})).minority, 9u);
  EXPECT_EQ(judge(said({7, 7, 0, 8, 7})).minority, 8u) << "who is silent is not wrong";
  EXPECT_EQ(judge(said({7, 7, 7})).minority, 0u);
  EXPECT_TRUE(judge(said({7, 7, 7})).is_decided);
}

}  // namespace verdict_test
}  // namespace isostep
