// Groups of blocks become stages of pieces.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/pass_plan.hpp"

namespace isostep {

void PassPlan::begin(std::uint32_t threads) {
  threads_ = threads;
  group_ = group_work_ = 0;
  tail_is_open_ = false;
  entries_.clear();
  slices_.clear();
  first_slice_.clear();
  first_piece_.clear();
  pieces_of_.clear();
}

void PassPlan::add(std::uint32_t group, std::uint32_t run, std::uint32_t blocks, std::uint32_t rows) {
  if (group != group_) close_group();
  group_ = group;
  entries_.push_back({run, blocks, rows});
  group_work_ += blocks * rows;
}

void PassPlan::add_alone(std::uint32_t run, std::uint32_t blocks) {
  close_group();
  open_tail();
  slices_.push_back({run, 0, blocks});
}

void PassPlan::end() {
  close_group();
  first_slice_.push_back(static_cast<std::uint32_t>(slices_.size()));
}

void PassPlan::close_group() {
  if (entries_.empty()) return;
  const std::uint32_t pieces = piece_count(group_work_, kLeastPiece, threads_);
  if (pieces > 1) {
    split_group(pieces);
  } else {
    open_tail();
    for (const Entry& entry : entries_) slices_.push_back({entry.run, 0, entry.blocks});
  }
  group_work_ = 0;
  entries_.clear();
}

/// Piece k ends where k + 1 shares of the work are done.
void PassPlan::split_group(std::uint32_t pieces) {
  open_stage();
  open_piece();
  tail_is_open_ = false;
  std::uint32_t done = 0, piece = 0;
  const auto end_of = [&](std::uint32_t k) {
    return static_cast<std::uint32_t>(std::uint64_t{group_work_} * (k + 1) / pieces);
  };
  for (const Entry& entry : entries_) {
    for (std::uint32_t first = 0; first < entry.blocks;) {
      if (done >= end_of(piece)) {
        ++piece;
        open_piece();
      }
      const std::uint32_t room = (end_of(piece) - done + entry.rows - 1) / entry.rows;
      const std::uint32_t left = entry.blocks - first, count = left < room ? left : room;
      slices_.push_back({entry.run, first, count});
      first += count;
      done += count * entry.rows;
    }
  }
}

void PassPlan::open_tail() {
  if (tail_is_open_) return;
  open_stage();
  open_piece();
  tail_is_open_ = true;
}

void PassPlan::open_stage() {
  first_piece_.push_back(static_cast<std::uint32_t>(first_slice_.size()));
  pieces_of_.push_back(0);
}

void PassPlan::open_piece() {
  first_slice_.push_back(static_cast<std::uint32_t>(slices_.size()));
  ++pieces_of_.back();
}

}  // namespace isostep
