// Shares a pass over the contacts' blocks out among threads: stages in order, pieces side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/task_runner.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

/// The stages of a pass. Blocks of one colour, which may be solved side by side, are a group; groups keep their order.
/// Small groups follow each other in one piece, for a stage costs a meeting of all threads.
/// Unit of work: a row of a block, some 15 ns in float.
class PassPlan {
 public:
  /// Consecutive blocks of one run.
  struct Slice {
    std::uint32_t run, first, count;
  };
  static constexpr std::uint32_t kLeastPiece = 32;  // [rows]: half a microsecond, four meetings

  void begin(std::uint32_t threads);
  /// Adds the blocks of a run, of `rows` rows each. Runs of one group follow each other.
  void add(std::uint32_t group, std::uint32_t run, std::uint32_t blocks, std::uint32_t rows);
  /// Adds blocks that are solved in their order, as part of one piece.
  void add_alone(std::uint32_t run, std::uint32_t blocks);
  void end();

  /// Returns how many pieces each stage has.
  ISO_INLINE std::span<const std::uint32_t> stages() const { return pieces_of_; }
  ISO_INLINE std::span<const Slice> piece(std::uint32_t stage, std::uint32_t piece) const {
    const std::uint32_t at = first_piece_[stage] + piece;
    return {slices_.data() + first_slice_[at], first_slice_[at + 1] - first_slice_[at]};
  }

 private:
  struct Entry {
    std::uint32_t run, blocks, rows;
  };
  void close_group();
  void split_group(std::uint32_t pieces);
  void open_tail();
  void open_stage();
  void open_piece();

  std::uint32_t threads_ = 1, group_ = 0, group_work_ = 0;
  bool tail_is_open_ = false;   // the last stage is one piece of small groups
  std::vector<Entry> entries_;  // of the group under way
  std::vector<Slice> slices_;
  std::vector<std::uint32_t> first_slice_;  // of each piece, and the end
  std::vector<std::uint32_t> first_piece_;  // of each stage
  std::vector<std::uint32_t> pieces_of_;    // each stage
};

}  // namespace isostep
