// An arena of oneTBB as a TaskRunner.
// SPDX-License-Identifier: MIT
#include "tbb_runner.hpp"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace isostep::threads {

struct TbbRunner::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

TbbRunner::TbbRunner(int threads)
    : arena_(std::make_unique<Arena>(threads > 0 ? std::min(threads, tbb::info::default_concurrency())
                                                 : tbb::info::default_concurrency())) {}
TbbRunner::~TbbRunner() = default;

TaskRunner TbbRunner::runner() {
  const auto run = [](void* user, std::int32_t copies, TaskRunner::Task task, void* data) {
    static_cast<Arena*>(user)->arena.execute([=] {
      tbb::parallel_for(
          0, copies, 1, [=](int) { task(data); }, tbb::simple_partitioner());
    });
  };
  return {run, arena_.get(), arena_->arena.max_concurrency()};
}

}  // namespace isostep::threads
