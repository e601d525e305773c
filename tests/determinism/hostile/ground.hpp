// Hostile ground, all of it at once: what a game, its libraries and its threads may do to a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <bit>
#include <cstring>
#include <optional>
#include <vector>

#include "determinism/hostile/shuffled_heap.hpp"
#include "determinism/hostile_environment.hpp"
#include "examples/thread_pool.hpp"
#include "isostep/core/simd.hpp"

namespace isostep::test {

/// The surroundings of a run.
struct Ground {
  int workers = 1;
  Simd simd = Simd::best;
  std::uint32_t control = kMasks;  // of every thread, whenever it is in the engine
  std::uint64_t heap = 0;          // seed of a shuffled heap; 0: the ordinary one
  unsigned char rubbish = 0;       // in new memory, and on the stack before every step
};

/// Litters the stack that locals of the next calls will find where nobody wrote.
[[gnu::noinline]] inline void litter_stack(unsigned char rubbish) {
  unsigned char room[1 << 16];
  std::memset(room, rubbish, sizeof room);
  __asm__ volatile("" : : "r"(room) : "memory");
}

/// Float arithmetic of the test's own, as bits: a quotient that rounds, one below zero, a denormal result and a
/// denormal operand.
[[gnu::noinline]] inline std::vector<std::uint32_t> own_arithmetic() {
  volatile float one = 1, three = 3, small = 0x1p-126f, quarter = 0.25f, tiny = 0x1p-149f, large = 0x1p100f;
  volatile float results[] = {one / three, -one / three, small * quarter, tiny * large};
  std::vector<std::uint32_t> bits;
  for (const float result : results) bits.push_back(std::bit_cast<std::uint32_t>(result));
  return bits;
}

/// Holds the ground for a run: heap, threads, and a way to call the engine on it.
class Holding {
 public:
  explicit Holding(const Ground& ground) : ground_(ground), pool_(ground.workers) {
    if (ground.heap != 0) heap_.emplace(ground.heap, ground.rubbish);
  }

  /// Calls the engine as a caller would whose thread is like that; false when it came back otherwise.
  template <class Call> bool operator()(const Call& call) const {
    litter_stack(ground_.rubbish);
    const Hostile environment(ground_.control);
    call();
    return Hostile::control() == ground_.control;
  }
  /// Every worker is in the same state as the caller, and leaves the engine in it.
  TaskRunner runner() {
    const auto run = [](void* user, std::int32_t copies, TaskRunner::Task task, void* data) {
      Holding& self = *static_cast<Holding*>(user);
      self.task_ = task;
      self.data_ = data;
      ++self.calls_;
      const TaskRunner inner = self.pool_.runner();
      inner.run(inner.user, copies, &Holding::work, user);
    };
    return {run, this, ground_.workers};
  }
  int calls() const { return calls_; }
  bool workers_kept_their_state() const { return kept_; }

 private:
  static void work(void* user) {
    Holding& self = *static_cast<Holding*>(user);
    if (!self([&] { self.task_(self.data_); })) self.kept_ = false;
  }

  Ground ground_;
  ThreadPool pool_;
  std::optional<ShuffledHeap> heap_;
  TaskRunner::Task task_ = nullptr;
  void* data_ = nullptr;
  int calls_ = 0;
  std::atomic<bool> kept_ = true;
};

}  // namespace isostep::test
