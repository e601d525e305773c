// IslandSystem<N>: one island's constraints as a complementarity problem with bounds, for all that solve it at once.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/solvers/island_number.hpp"

namespace isostep {

/// The answers that a row admits.
enum class RowBound : std::uint8_t {
  absent,  // none: padding of its block
  equal,   // any
  above,   // x >= 0
  below,   // x <= 0
  boxed    // |x| <= limit
};
/// The state of a row in pivoting.
enum class RowState : std::uint8_t { free, at_low, at_high };

/// A row of W = J M^-1/2, scaled so that |w|^2 is about one, with its right-hand side.
template <class N> struct IslandRow {
  IslandMotion<N> ends[2];  // at the two bodies
  int exponent = 0;         // w, times 2^exponent, is the row unscaled
  RowBound bound = RowBound::absent;
  RowState state = RowState::free;
  N soft = N(0);      // [1] compliance, of a spring
  N give = N(0);      // [1] compliance to answers other than `last`
  N diagonal = N(0);  // [1] of K
  N right = N(0);
  N limit = N(0);
  N answer = N(0);
  N last = N(0);  // an answer that the method keeps: of the pass before, in pivoting
};

/// Three rows between two bodies. Body 0 does not move.
template <class N> struct IslandBlock {
  std::uint32_t body[2];
  IslandRow<N> rows[3];
};

/// The rows of a contact whose limits follow from its load. Row r is row r % 3 of block r / 3.
template <class N> struct IslandPatch {
  std::uint32_t first;   // tangent, tangent, twist
  std::uint32_t normal;  // the first of the normal rows
  std::uint32_t points;
  std::uint32_t rolling;              // the first of two rows, or kNoRolling
  N friction, twist_friction, lever;  // [1] limits over the load, times 2^exponent
  N ratio;                            // [1] of the limits of the two tangents: below one of a grain
  int friction_exponent, twist_exponent, lever_exponent;
  static constexpr std::uint32_t kNoRolling = ~0u;
};

/// The rows of an island and their bounds; the methods that solve them derive from it. A method has four calls:
///   tie         once all blocks between bodies 0..body_count are added; solves take about most_work each
///   assemble    takes over the current rows
///   solve       returns false if it found no solution within most_work: then answers are within bounds. With `firm`
///               contacts do not yield either; equations never do
///   least_work  of the smallest solve that is worth beginning
/// Each finds x such that for
/// K x + soft x - right: it is 0 where x is within its bounds, >= 0 where x is at the lower one and <= 0 where x is at
/// the upper one. K = W W^T. Limits of friction follow from the load.
/// Symbols: u = W^T x, the change of M^1/2 v. All of right, limit, answer and u share an exponent, which the caller
///          knows.
/// Limits:  K has as many zero eigenvalues as rows are redundant, so every row may yield a little: under an impulse by
///          kContactGive of the speed that the impulse would give its two bodies alone, an equation by kEquationGive.
/// Order:   that of the rows.
template <class N> class IslandSystem {
 public:
  using D = IslandNumber<N>;
  static constexpr N kContactGive = N(0x1p-12), kEquationGive = N(0x1p-20);
  static constexpr int kLeastGive = -20;  // their least exponent

  /// Begins without blocks.
  void begin();
  std::uint32_t add_block(std::uint32_t body_a, std::uint32_t body_b);
  ISO_INLINE std::uint32_t block_count() const { return static_cast<std::uint32_t>(blocks_.size()); }
  ISO_INLINE IslandRow<N>& row(std::uint32_t r) { return blocks_[r / 3].rows[r % 3]; }
  ISO_INLINE const IslandRow<N>& row(std::uint32_t r) const { return blocks_[r / 3].rows[r % 3]; }
  ISO_INLINE std::vector<IslandPatch<N>>& patches() { return patches_; }
  /// Returns u of a body.
  ISO_INLINE const IslandMotion<N>& motion(std::uint32_t body) const { return motions_[body]; }

  /// Returns about how many products of blocks the last solve took: some 50 ns each in double.
  ISO_INLINE std::uint64_t work() const { return work_; }
  ISO_INLINE bool is_swept() const { return too_large_; }

  /// Multiplies answers and limits by 2^by, for a change of the exponent that they share.
  void rescale(int by);
  /// Guesses the state of a patch's friction from answers and load: at its limit or not. With `fresh` it holds.
  void guess_friction(std::uint32_t patch, bool fresh);
  /// Holds rows whose bound changed sides at their new bound.
  void settle();
  /// Sweeps by projected Gauss-Seidel from the current answers.
  void sweep(int sweeps);

 protected:
  void list_blocks(std::uint32_t body_count);
  void weigh_rows();
  N limit_turns(const IslandPatch<N>& patch, bool& moved);
  bool limit_patch(const IslandPatch<N>& patch, bool moves);
  bool limit_grain(const IslandPatch<N>& patch, N limit, bool moves);
  bool set_limit(std::uint32_t r, N limit);
  void limit_by_cone(const IslandPatch<N>& patch);
  static bool hold_in_cone(N& x, N& y, N limit, N ratio);
  void settle_answers();
  void gather_motions(bool held_only);
  N speed(const IslandBlock<N>& block, int r) const;
  N residual(const IslandBlock<N>& block, int r) const;
  void find_tolerances();
  static N at_bound(const IslandRow<N>& row);
  static N clamped(const IslandRow<N>& row, N x);

  std::vector<IslandBlock<N>> blocks_;
  std::vector<IslandPatch<N>> patches_;
  std::vector<IslandMotion<N>> motions_;        // of each body
  std::vector<std::uint32_t> first_, at_body_;  // blocks of each body
  std::vector<std::uint32_t> next_;
  N answer_slack_ = N(0), right_slack_ = N(0);
  std::uint64_t work_ = 0;
  bool too_large_ = false;  // only swept
};

}  // namespace isostep
