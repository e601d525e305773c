// SortedOrder and LinearSearch: as TournamentTree has it, after every change.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "isostep/book/linear_search.hpp"
#include "isostep/book/sorted_order.hpp"
#include "isostep/core/tournament_tree.hpp"

namespace isostep {
namespace first_of_many_test {

template <class Queue> class FirstOfMany : public ::testing::Test {};
using Queues = ::testing::Types<SortedOrder, LinearSearch>;
TYPED_TEST_SUITE(FirstOfMany, Queues);

/// Low numbers, so that many are equal; the lowest index among equals. Nobody comes before others among those of rank
/// `idle`, as rows of a solver with nothing to do.
struct Field {
  std::vector<int> rank;
  int idle;
  auto before() const {
    return [this](std::uint32_t i, std::uint32_t j) {
      return rank[i] != rank[j] ? rank[i] < rank[j] : i < j && rank[i] != idle;
    };
  }
};

TYPED_TEST(FirstOfMany, is_the_first_of_the_tree_after_every_change_unless_nobody_has_anything_to_do) {
  std::mt19937 random(7);
  TypeParam queue;
  TournamentTree tree;
  for (const std::uint32_t count : {1u, 2u, 3u, 7u, 64u, 100u, 33u}) {  // one queue: it shrinks too
    for (const int idle : {10, 4}) {
      Field field = {{}, idle};
      const auto draw = [&] { return static_cast<int>(random() % static_cast<unsigned>(idle + 1)); };
      for (std::uint32_t i = 0; i < count; ++i) field.rank.push_back(draw());
      queue.plant(count, field.before());
      tree.plant(count, field.before());
      for (int change = 0; change < 1000; ++change) {
        ASSERT_EQ(field.rank[queue.first()], field.rank[tree.first()]) << count << " players, change " << change;
        if (field.rank[tree.first()] != idle) {
          ASSERT_EQ(queue.first(), tree.first()) << change;
        }
        // The first gives way most often, as it does in a solver.
        const std::uint32_t who = random() % 2 == 0 ? queue.first() : random() % count;
        field.rank[who] = random() % 4 == 0 ? draw() : idle;
        queue.replay(who, field.before());
        tree.replay(who, field.before());
      }
    }
  }
}

}  // namespace first_of_many_test
}  // namespace isostep
