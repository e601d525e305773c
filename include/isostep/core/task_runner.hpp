// TaskRunner: the threads that a game lends to a step, and stages of work that they share out among themselves.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// The most pieces of a stage.
inline constexpr std::uint32_t kMaxPieces = 32;

/// A function and its data; `threads` of 1, the default, calls no other.
///
/// Contract: run(user, copies, task, data) calls task(data) up to `copies` times and returns when all of those calls
/// have. They may run side by side, one after another, or not at all: a copy waits for no other, the caller finishes
/// what nobody does, and results do not depend on any of it. It is called by whichever thread steps: worlds that step
/// at once, or inside another's task, call it at once. Neither `run` nor a task throws, but for want of memory.
struct TaskRunner {
  using Task = void (*)(void* data);
  void (*run)(void* user, std::int32_t copies, Task task, void* data) = nullptr;
  void* user = nullptr;
  std::int32_t threads = 1;  // that may run at once, the caller's among them; beyond kMaxPieces they count as that
};

/// Returns into how many pieces to divide work: one a thread, none smaller than `least`; four a thread for much work,
/// so that little waits for an interrupted thread.
ISO_INLINE std::uint32_t piece_count(std::uint32_t work, std::uint32_t least, std::uint32_t threads) {
  const std::uint32_t most = work / least;
  if (threads <= 1 || most <= 1) return 1;
  const std::uint32_t pieces = most < 16 * threads ? (most < threads ? most : threads) : 4 * threads;
  return pieces < kMaxPieces ? pieces : kMaxPieces;
}

/// One piece of a stage. Pieces of one stage write nothing in common.
using StagePiece = void (*)(void* data, std::uint32_t stage, std::uint32_t piece);

/// Runs stages one after another, `pieces[i]` (up to kMaxPieces) in the i-th, those of one stage side by side on the
/// runner's threads. What a stage wrote the next one sees.
/// How:     threads claim pieces, each the same ones of every stage before others, so that what a piece reads again is
///          still in its core's cache; who ends a stage's last piece opens the next stage. Nobody waits for a thread
///          that has claimed nothing, so one thread alone comes to the end. Nothing is allocated.
void run_stages(const TaskRunner& runner, std::span<const std::uint32_t> pieces, StagePiece piece, void* data);

}  // namespace isostep
