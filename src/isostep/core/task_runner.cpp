// Stages of work, claimed piece by piece from one board.
// SPDX-License-Identifier: MIT
#include "isostep/core/task_runner.hpp"

#include <atomic>
#include <bit>

#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace {

/// Tells the processor that a loop waits.
inline void relax_processor() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ volatile("yield");
#endif
}

/// Looks at the board, some 0.5 ms in all, before a thread that finds nothing to do leaves. It takes no part in the
/// stages that follow; the others come to the end without it. So threads beyond the cores do not keep others waiting.
constexpr std::uint32_t kPatience = 1u << 15;

class StagedWork {
 public:
  StagedWork(std::span<const std::uint32_t> pieces, std::uint32_t threads, StagePiece piece, void* data)
      : pieces_(pieces), threads_(threads), piece_(piece), data_(data), board_(opened(0)) {}

  void work() {
    pin_floats([&] {  // threads that are lent may have any environment
      const std::uint32_t thread = arrived_.fetch_add(1, std::memory_order_relaxed) % threads_;
      for (std::uint32_t waited = 0; waited < kPatience;) {
        std::uint64_t board = board_.load(std::memory_order_acquire);
        if (stage_of(board) == pieces_.size()) return;
        if (unclaimed_of(board) == 0) {
          relax_processor();
          ++waited;
          continue;
        }
        const std::uint32_t piece = choose(unclaimed_of(board), thread);
        if (!board_.compare_exchange_weak(board, board & ~(std::uint64_t{1} << piece), std::memory_order_acquire))
          continue;
        waited = 0;
        piece_(data_, stage_of(board), piece);
        finish_piece(stage_of(board));
      }
    });
  }

 private:
  // The board: the stage in the upper half, a bit for each piece of it that nobody has claimed in the lower.
  static std::uint32_t stage_of(std::uint64_t board) { return static_cast<std::uint32_t>(board >> 32); }
  static std::uint32_t unclaimed_of(std::uint64_t board) { return static_cast<std::uint32_t>(board); }

  /// The board of the first stage from this one on that has pieces, or of the end.
  std::uint64_t opened(std::uint32_t stage) const {
    while (stage < pieces_.size() && pieces_[stage] == 0) ++stage;
    const std::uint64_t all = stage < pieces_.size() ? 0xffffffffu >> (kMaxPieces - pieces_[stage]) : 0u;
    return std::uint64_t{stage} << 32 | all;
  }
  /// Every so-manieth piece is a thread's own.
  std::uint32_t choose(std::uint32_t unclaimed, std::uint32_t thread) const {
    for (std::uint32_t piece = thread; piece < kMaxPieces; piece += threads_) {
      if ((unclaimed >> piece & 1u) != 0) return piece;
    }
    return static_cast<std::uint32_t>(std::countr_zero(unclaimed));
  }
  void finish_piece(std::uint32_t stage) {
    if (finished_.fetch_add(1, std::memory_order_acq_rel) + 1 != pieces_[stage]) return;
    finished_.store(0, std::memory_order_relaxed);
    board_.store(opened(stage + 1), std::memory_order_release);
  }

  std::span<const std::uint32_t> pieces_;
  std::uint32_t threads_;
  StagePiece piece_;
  void* data_;
  std::atomic<std::uint32_t> arrived_ = 0;
  alignas(64) std::atomic<std::uint64_t> board_;  // cache lines of their own: each is written by all
  alignas(64) std::atomic<std::uint32_t> finished_ = 0;
};

}  // namespace

void run_stages(const TaskRunner& runner, std::span<const std::uint32_t> pieces, StagePiece piece, void* data) {
  if (runner.run == nullptr || runner.threads <= 1) {
    for (std::uint32_t stage = 0; stage < pieces.size(); ++stage) {
      for (std::uint32_t i = 0; i < pieces[stage]; ++i) piece(data, stage, i);
    }
    return;
  }
  StagedWork work(pieces, static_cast<std::uint32_t>(runner.threads), piece, data);
  runner.run(
      runner.user, runner.threads, [](void* staged) { static_cast<StagedWork*>(staged)->work(); }, &work);
  work.work();  // what the runner left
}

}  // namespace isostep
