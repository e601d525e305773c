// TournamentTree: the first by linear search, whoever changed and in whatever order.
// SPDX-License-Identifier: MIT
#include "isostep/core/tournament_tree.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace isostep {
namespace tournament_tree_test {

/// Low numbers, so that many are equal; the lowest index among equals.
struct Field {
  std::vector<int> rank;
  auto before() const {
    return [this](std::uint32_t i, std::uint32_t j) { return rank[i] != rank[j] ? rank[i] < rank[j] : i < j; };
  }
  std::uint32_t best() const {
    std::uint32_t at = 0;
    for (std::uint32_t i = 1; i < rank.size(); ++i) {
      if (rank[i] < rank[at]) at = i;
    }
    return at;
  }
};

TEST(TournamentTree, the_first_is_what_linear_search_finds_after_every_change) {
  std::mt19937 random(3);
  TournamentTree tree;
  for (const std::uint32_t count : {1u, 2u, 3u, 7u, 64u, 100u, 33u}) {  // one tree: it shrinks too
    Field field;
    for (std::uint32_t i = 0; i < count; ++i) field.rank.push_back(static_cast<int>(random() % 10));
    tree.plant(count, field.before());
    ASSERT_EQ(tree.first(), field.best()) << count;
    for (int change = 0; change < 500; ++change) {
      const std::uint32_t who = random() % count;
      field.rank[who] = static_cast<int>(random() % 10);
      tree.replay(who, field.before());
      ASSERT_EQ(tree.first(), field.best()) << count << " players, change " << change;
    }
  }
}

TEST(TournamentTree, the_answer_does_not_depend_on_the_order_of_changes) {
  Field field;
  field.rank = {5, 5, 5, 5, 5, 5};
  TournamentTree forward, backward;
  forward.plant(6, field.before());
  backward.plant(6, field.before());
  field.rank = {4, 3, 3, 9, 3, 4};
  for (std::uint32_t i = 0; i < 6; ++i) forward.replay(i, field.before());
  for (std::uint32_t i = 6; i-- > 0;) backward.replay(i, field.before());
  EXPECT_EQ(forward.first(), 1u);
  EXPECT_EQ(backward.first(), 1u);
}

}  // namespace tournament_tree_test
}  // namespace isostep
