// A plan of a pass holds every block once, groups in order, pieces of like size.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/pass_plan.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace pass_plan_test {

struct Part {
  std::uint32_t group, blocks, rows;
};
constexpr std::uint32_t kAlone = 99;

PassPlan plan_of(std::span<const Part> runs, std::uint32_t threads) {
  PassPlan plan;
  plan.begin(threads);
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    if (runs[i].group == kAlone) plan.add_alone(i, runs[i].blocks);
    else plan.add(runs[i].group, i, runs[i].blocks, runs[i].rows);
  }
  plan.end();
  return plan;
}

/// Every block of every run once, in the order of the runs; answers the work of each piece of each stage [rows].
std::vector<std::vector<std::uint32_t>> check(const PassPlan& plan, std::span<const Part> runs) {
  std::vector<std::vector<std::uint32_t>> work;
  std::uint32_t run = 0, block = 0;
  for (std::uint32_t s = 0; s < plan.stages().size(); ++s) {
    work.emplace_back();
    EXPECT_GT(plan.stages()[s], 0u);
    for (std::uint32_t p = 0; p < plan.stages()[s]; ++p) {
      std::uint32_t rows = 0;
      for (const PassPlan::Slice& slice : plan.piece(s, p)) {
        EXPECT_EQ(slice.run, run);
        EXPECT_EQ(slice.first, block);
        EXPECT_GT(slice.count, 0u);
        rows += slice.count * runs[run].rows;
        block += slice.count;
        if (block == runs[run].blocks) ++run, block = 0;
      }
      work.back().push_back(rows);
    }
  }
  EXPECT_EQ(run, runs.size());
  return work;
}

TEST(PassPlan, of_one_thread_is_one_piece) {
  const Part runs[] = {{0, 500, 7}, {1, 300, 4}, {1, 1, 5}, {kAlone, 40, 7}};
  const auto work = check(plan_of(runs, 1), runs);
  ASSERT_EQ(work.size(), 1u);
  EXPECT_EQ(work[0].size(), 1u);
}

TEST(PassPlan, splits_a_large_group_evenly_also_across_its_runs) {
  const Part runs[] = {{0, 90, 7}, {0, 70, 4}, {0, 3, 9}};
  for (const std::uint32_t threads : {2u, 3u, 4u}) {
    const auto work = check(plan_of(runs, threads), runs);
    ASSERT_EQ(work.size(), 1u);
    EXPECT_EQ(work[0].size() % threads, 0u);
    for (const std::uint32_t rows : work[0]) {
      EXPECT_NEAR(static_cast<double>(rows), 937.0 / static_cast<double>(work[0].size()), 9.0);
      EXPECT_GE(rows + 9, PassPlan::kLeastPiece);
    }
  }
}

TEST(PassPlan, keeps_small_groups_together_in_one_piece_and_large_ones_apart) {
  const Part runs[] = {{0, 100, 7}, {1, 100, 7}, {2, 2, 7}, {3, 1, 4}, {kAlone, 80, 7}, {4, 100, 7}, {5, 1, 1}};
  const auto work = check(plan_of(runs, 2), runs);
  ASSERT_EQ(work.size(), 5u);
  EXPECT_GT(work[0].size(), 1u);
  EXPECT_GT(work[1].size(), 1u);
  EXPECT_EQ(work[2], (std::vector<std::uint32_t>{14 + 4 + 560}));
  EXPECT_GT(work[3].size(), 1u);
  EXPECT_EQ(work[4], (std::vector<std::uint32_t>{1}));
}

TEST(PassPlan, of_nothing_has_no_stage_and_serves_again) {
  PassPlan plan = plan_of({}, 4);
  EXPECT_TRUE(plan.stages().empty());
  const Part runs[] = {{3, 1, 7}};
  plan.begin(4);
  plan.add(3, 0, 1, 7);
  plan.end();
  EXPECT_EQ(check(plan, runs).size(), 1u);
}

TEST(PieceCount, is_one_a_thread_or_four_and_makes_no_piece_too_small) {
  EXPECT_EQ(piece_count(1000, 64, 1), 1u);
  EXPECT_EQ(piece_count(127, 64, 2), 1u);
  EXPECT_EQ(piece_count(128, 64, 2), 2u);
  EXPECT_EQ(piece_count(64 * 5, 64, 2), 2u);
  EXPECT_EQ(piece_count(64 * 32, 64, 2), 8u);
  EXPECT_EQ(piece_count(64 * 5, 64, 8), 5u);
  EXPECT_EQ(piece_count(64 * 1000, 64, 4), 16u);
  EXPECT_EQ(piece_count(64 * 100000, 64, 64), kMaxPieces);
  EXPECT_EQ(piece_count(0, 64, 4), 1u);
}

}  // namespace pass_plan_test
}  // namespace isostep
