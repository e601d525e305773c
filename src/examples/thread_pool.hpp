// A game's own threads as a TaskRunner: the least that serves.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "isostep/core/task_runner.hpp"

/// Threads that sleep until a step asks for them. Steps of several worlds, and of worlds inside others' tasks, may ask
/// at once.
class ThreadPool {
 public:
  explicit ThreadPool(int threads) {
    for (int i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
  }
  ~ThreadPool() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }

  isostep::TaskRunner runner() {
    const auto run = [](void* pool, std::int32_t copies, isostep::TaskRunner::Task task, void* data) {
      static_cast<ThreadPool*>(pool)->run({task, data, copies - 1, 0});
    };
    return {run, this, static_cast<std::int32_t>(helpers_.size()) + 1};
  }

 private:
  struct Call {
    isostep::TaskRunner::Task task;
    void* data;
    int wanted, running;
  };

  void run(Call call) {
    {
      const std::lock_guard lock(mutex_);
      calls_.push_back(&call);
    }
    changed_.notify_all();
    call.task(call.data);  // comes back when all is done or claimed: who has not come by now need not
    std::unique_lock lock(mutex_);
    std::erase(calls_, &call);
    changed_.wait(lock, [&call] { return call.running == 0; });
  }

  void help() {
    std::unique_lock lock(mutex_);
    while (!closed_) {
      const auto found = std::find_if(calls_.begin(), calls_.end(), [](const Call* call) { return call->wanted > 0; });
      if (found == calls_.end()) {
        changed_.wait(lock);
        continue;
      }
      Call& call = **found;
      --call.wanted;
      ++call.running;
      lock.unlock();
      call.task(call.data);
      lock.lock();
      if (--call.running == 0) changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Call*> calls_;
  bool closed_ = false;
  std::vector<std::thread> helpers_;
};
