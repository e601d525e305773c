// Stages of pieces: each piece once, each stage after the one before, whoever comes.
// SPDX-License-Identifier: MIT
#include "isostep/core/task_runner.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "examples/thread_pool.hpp"

namespace isostep {
namespace task_runner_test {

/// Counts the pieces done of each stage, and those that began before the stage before them had ended.
struct Log {
  std::vector<std::uint32_t> pieces;
  std::vector<std::atomic<std::uint32_t>> done;
  std::atomic<int> early = 0;
  std::uint64_t plain = 0;

  explicit Log(std::vector<std::uint32_t> of) : pieces(std::move(of)), done(pieces.size()) {}
  static void piece(void* data, std::uint32_t stage, std::uint32_t piece) {
    Log& log = *static_cast<Log*>(data);
    for (std::uint32_t before = 0; before < stage; ++before) {
      if (log.done[before].load(std::memory_order_relaxed) != log.pieces[before]) ++log.early;
    }
    if (piece == 0) log.plain = log.plain + 1;  // of stage after stage: unordered stages would race here
    ++log.done[stage];
  }
  void expect_complete() const {
    EXPECT_EQ(early, 0);
    for (std::size_t i = 0; i < pieces.size(); ++i) EXPECT_EQ(done[i], pieces[i]) << "stage " << i;
  }
};

TEST(RunStages, without_a_runner_takes_them_in_order) {
  Log log({3, 0, 1, 7});
  run_stages({}, log.pieces, &Log::piece, &log);
  log.expect_complete();
}

TEST(RunStages, does_every_piece_once_and_no_stage_before_its_turn) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    for (int round = 0; round < 50; ++round) {
      std::vector<std::uint32_t> pieces;
      for (std::uint32_t i = 0; i < 120; ++i) pieces.push_back((i * 7 + static_cast<std::uint32_t>(round)) % 5);
      Log log(pieces);
      run_stages(pool.runner(), log.pieces, &Log::piece, &log);
      log.expect_complete();
    }
  }
}

TEST(RunStages, shares_a_stage_among_threads) {
  ThreadPool pool(2);
  struct Meeting {
    std::atomic<int> here = 0;
    bool met = false;
  } meeting;
  // Each of two pieces waits for the other: one thread alone would never end, so the wait gives up in time.
  const auto wait = [](void* data, std::uint32_t, std::uint32_t piece) {
    auto& m = *static_cast<Meeting*>(data);
    ++m.here;
    for (int i = 0; i < 60000 && m.here < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (piece == 0) m.met = m.here == 2;
  };
  const std::uint32_t pieces[] = {2};
  run_stages(pool.runner(), pieces, wait, &meeting);
  EXPECT_TRUE(meeting.met);
}

TEST(RunStages, comes_to_the_end_when_the_runner_calls_nobody_or_one_after_another) {
  const auto nobody = [](void*, std::int32_t, TaskRunner::Task, void*) {};
  const auto in_turn = [](void*, std::int32_t copies, TaskRunner::Task task, void* data) {
    for (int i = 0; i < copies; ++i) task(data);
  };
  for (const TaskRunner runner : {TaskRunner{nobody, nullptr, 4}, TaskRunner{in_turn, nullptr, 4}}) {
    Log log({5, 1, 0, 0, 9, 2});
    run_stages(runner, log.pieces, &Log::piece, &log);
    log.expect_complete();
  }
}

TEST(RunStages, may_be_called_inside_a_piece_and_by_several_threads_at_once) {
  ThreadPool pool(3);
  struct Outer {
    ThreadPool& pool;
    std::atomic<int> pieces = 0;
  } outer = {pool};
  const auto nest = [](void* data, std::uint32_t, std::uint32_t) {
    auto& o = *static_cast<Outer*>(data);
    Log log({4, 1, 4});
    run_stages(o.pool.runner(), log.pieces, &Log::piece, &log);
    log.expect_complete();
    ++o.pieces;
  };
  const std::uint32_t stages[] = {6, 2};
  std::vector<std::thread> callers;
  for (int i = 0; i < 4; ++i) {
    callers.emplace_back([&] {
      for (int round = 0; round < 25; ++round) run_stages(pool.runner(), stages, nest, &outer);
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(outer.pieces, 4 * 25 * 8);
}

TEST(RunStages, of_no_stages_or_none_with_pieces_ends_at_once) {
  ThreadPool pool(2);
  run_stages(pool.runner(), {}, &Log::piece, nullptr);
  Log log({0, 0, 0});
  run_stages(pool.runner(), log.pieces, &Log::piece, &log);
  log.expect_complete();
}

}  // namespace task_runner_test
}  // namespace isostep
