// A game's own threads as a TaskRunner: the least that serves.
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "isostep/core/task_runner.hpp"

/// Threads that sleep until a step asks for them. One step at a time.
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
    called_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }

  isostep::TaskRunner runner() {
    const auto run = [](void* pool, std::int32_t copies, isostep::TaskRunner::Task task, void* data) {
      static_cast<ThreadPool*>(pool)->run(copies, task, data);
    };
    return {run, this, static_cast<std::int32_t>(helpers_.size()) + 1};
  }

 private:
  void run(int copies, isostep::TaskRunner::Task task, void* data) {
    {
      const std::lock_guard lock(mutex_);
      task_ = task;
      data_ = data;
      wanted_ = copies - 1;
    }
    called_.notify_all();
    task(data);  // comes back when all is done or claimed: who has not come by now need not
    std::unique_lock lock(mutex_);
    wanted_ = 0;
    left_.wait(lock, [this] { return running_ == 0; });
  }

  void help() {
    std::unique_lock lock(mutex_);
    for (;;) {
      called_.wait(lock, [this] { return wanted_ > 0 || closed_; });
      if (closed_) return;
      --wanted_;
      ++running_;
      const auto task = task_;
      void* const data = data_;
      lock.unlock();
      task(data);
      lock.lock();
      if (--running_ == 0) left_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable called_, left_;
  isostep::TaskRunner::Task task_ = nullptr;
  void* data_ = nullptr;
  int wanted_ = 0, running_ = 0;
  bool closed_ = false;
  std::vector<std::thread> helpers_;
};
