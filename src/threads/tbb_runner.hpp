// TbbRunner: a TaskRunner over the worker threads of oneTBB.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "isostep/core/task_runner.hpp"

namespace isostep::threads {

/// Threads that worlds may share, one step at a time or several: each step takes those that are free.
///     TbbRunner threads(4);
///     world.use_threads(threads.runner());    // outlives the world
class TbbRunner {
 public:
  /// `threads` at once, the caller's among them, at most one a core, which is what oneTBB has; 0 or less: as many.
  explicit TbbRunner(int threads = 0);
  ~TbbRunner();

  TaskRunner runner();

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace isostep::threads
