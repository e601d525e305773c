// DirectSystem<N>: one island's constraints as a complementarity problem with bounds, solved by pivoting.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/solvers/direct_number.hpp"
#include "isostep/math/sparse_cholesky.hpp"

namespace isostep {

/// The answers that a row admits.
enum class DirectBound : std::uint8_t {
  absent,  // none: padding of its block
  equal,   // any
  above,   // x >= 0
  below,   // x <= 0
  boxed    // |x| <= limit
};
/// The state of a row in pivoting.
enum class DirectState : std::uint8_t { free, at_low, at_high };

/// A row of W = J M^-1/2, scaled so that |w|^2 is about one, with its right-hand side.
template <class N> struct DirectRow {
  DirectMotion<N> ends[2];  // at the two bodies
  int exponent = 0;         // w, times 2^exponent, is the row unscaled
  DirectBound bound = DirectBound::absent;
  DirectState state = DirectState::free;
  N soft = N(0);      // [1] compliance, of a spring
  N give = N(0);      // [1] compliance to answers other than `last`
  N diagonal = N(0);  // [1] of K
  N right = N(0);
  N limit = N(0);
  N answer = N(0);
  N last = N(0);  // answer of the pass before
};

/// Three rows between two bodies. Body 0 does not move.
template <class N> struct DirectBlock {
  std::uint32_t body[2];
  DirectRow<N> rows[3];
};

/// The rows of a contact whose limits follow from its load. Row r is row r % 3 of block r / 3.
template <class N> struct DirectPatch {
  std::uint32_t first;   // tangent, tangent, twist
  std::uint32_t normal;  // the first of the normal rows
  std::uint32_t points;
  std::uint32_t rolling;              // the first of two rows, or kNoRolling
  N friction, twist_friction, lever;  // [1] limits over the load, times 2^exponent
  int friction_exponent, twist_exponent, lever_exponent;
  static constexpr std::uint32_t kNoRolling = ~0u;
};

/// Finds x such that for K x + soft x - right: it is 0 where x is within its bounds, >= 0 where x is at the lower one
/// and <= 0 where x is at the upper one. K = W W^T has entries only for blocks that share a body.
/// Source:  Judice, Pires 1994, A block principal pivoting algorithm for large-scale strictly monotone linear
///          complementarity problems, Computers and Operations Research 21(5): all wrong rows change sides. If that
///          does not make them fewer, Gauss-Seidel finds another start, and from there rows change one at a time in
///          descent: the primal active set method (Nocedal, Wright 2006, Numerical Optimization, sec. 16.5).
/// Differs: bounds on both sides. Limits of friction are computed from the load until they settle; x of rows at their
///          bounds goes to the right-hand side.
/// Symbols: u = W^T x, the change of M^1/2 v. All of right, limit, answer and u share an exponent, which the caller
///          knows.
/// Limits:  K has as many zero eigenvalues as rows are redundant, so every row yields a little: under an impulse by
///          kContactGive of the speed that the impulse would give its two bodies alone, an equation by kEquationGive. A
///          box on a table sinks at 5 um/s in sub-steps of 1/120 s, of which 0.2 um stay where errors are closed. With
///          less, exchanges on a wall of boxes no longer end.
/// Order:   pivots follow from the rows alone; elimination as SparseCholesky.
template <class N> class DirectSystem {
 public:
  using D = DirectNumber<N>;
  static constexpr N kContactGive = N(0x1p-12), kEquationGive = N(0x1p-20);
  static constexpr int kLeastGive = -20;   // their least exponent
  static constexpr int kMostPivots = 200;  // factorisations for one problem, as far as the caller's budget allows
  static constexpr int kLeastPivots = 4;   // of which a problem is worth beginning with
  static constexpr int kPasses = 3;        // limits come within 1/32, as a rule in two
  static constexpr int kPatience = 3;      // exchanges that may bring nothing before rows are taken one by one
  static constexpr int kSweeps = 16, kLeastSweeps = 4;
  static constexpr std::uint64_t kSweepWork = 4;  // of a block in a sweep: three rows at two ends

  /// Begins without blocks.
  void begin();
  std::uint32_t add_block(std::uint32_t body_a, std::uint32_t body_b);
  ISO_INLINE std::uint32_t block_count() const { return static_cast<std::uint32_t>(blocks_.size()); }
  ISO_INLINE DirectRow<N>& row(std::uint32_t r) { return blocks_[r / 3].rows[r % 3]; }
  ISO_INLINE const DirectRow<N>& row(std::uint32_t r) const { return blocks_[r / 3].rows[r % 3]; }
  ISO_INLINE std::vector<DirectPatch<N>>& patches() { return patches_; }
  /// Returns u of a body.
  ISO_INLINE const DirectMotion<N>& motion(std::uint32_t body) const { return motions_[body]; }

  /// Ties the blocks, once all between bodies 0..body_count are added. Systems of more than most_blocks, and those with
  /// too many neighbours (a heap at one place) for kLeastPivots within most_work, are swept, never factorised.
  void tie(std::uint32_t body_count, std::uint32_t most_blocks, std::uint64_t most_work);
  /// Assembles K from the current rows.
  void assemble();
  /// Multiplies answers and limits by 2^by, for a change of the exponent that they share.
  void rescale(int by);
  /// Guesses the state of a patch's friction from answers and load: at its limit or not. With `fresh` it holds.
  void guess_friction(std::uint32_t patch, bool fresh);
  /// Holds rows whose bound changed sides at their new bound.
  void settle();
  /// Solves. Returns false if pivoting did not end within most_work or its result is violated: then answers are within
  /// bounds, and joints hold. Too large systems are only swept, as often as most_work allows, kLeastSweeps times at
  /// least. With `firm` contacts do not yield either, at the price of more passes. Equations never do.
  bool solve(bool firm, std::uint64_t most_work);
  /// Sweeps by projected Gauss-Seidel from the current answers.
  void sweep(int sweeps);

  ISO_INLINE int pivots() const { return pivots_; }  // of the last solve
  /// Returns the work of the smallest solve that is worth beginning.
  ISO_INLINE std::uint64_t least_work() const { return kLeastPivots * elimination_work(); }
  /// Returns about how many products of blocks the last solve took: some 50 ns each in double.
  ISO_INLINE std::uint64_t work() const { return work_; }
  ISO_INLINE bool is_swept() const { return too_large_; }

 private:
  using Pair = typename SparseCholesky<N>::Pair;

  GeneralBlock<N> coupling(const DirectBlock<N>& i, const DirectBlock<N>& j) const;
  std::uint64_t elimination_work() const;
  bool limit_patch(const DirectPatch<N>& patch);
  bool set_limit(std::uint32_t r, N limit);
  bool exchange();
  bool descend();
  void start_from_sweeps();
  void step_within_bounds();
  void solve_equations();
  void solve_anew();
  void settle_answers();
  bool is_violated() const;
  bool yielded(bool firm) const;
  static bool takes_back(const DirectRow<N>& row, bool firm);
  bool refactor();
  bool solve_free();
  void gather_motions(bool held_only);
  N residual(const DirectBlock<N>& block, int r) const;
  void find_tolerances();
  std::uint32_t find_wrong();
  static DirectState turned(const DirectRow<N>& row, N residual, N answer_slack, N right_slack);
  static N at_bound(const DirectRow<N>& row);
  static N clamped(const DirectRow<N>& row, N x);

  std::vector<DirectBlock<N>> blocks_;
  std::vector<DirectPatch<N>> patches_;
  std::vector<DirectMotion<N>> motions_;  // of each body
  std::vector<Pair> pairs_, last_pairs_;
  std::uint32_t last_count_ = 0;                       // blocks that are analysed
  std::vector<std::uint32_t> first_, next_, at_body_;  // blocks of each body
  SparseCholesky<N> cholesky_;
  int loss_ = 0;
  std::vector<std::uint8_t> held_, factored_;
  bool too_large_ = false, is_factored_ = false;
  std::vector<Vec3<N>> right_, answer_, from_;
  std::vector<N> begin_;  // answers of each row
  bool holds_ = false;    // rows that are not free keep the answers that they have
  std::vector<std::uint32_t> wrong_;
  std::vector<DirectState> wanted_;
  N answer_slack_ = N(0), right_slack_ = N(0);
  int pivots_ = 0, most_pivots_ = 0;
  std::uint64_t work_ = 0;
};

extern template class DirectSystem<Exact<double>>;
extern template class DirectSystem<Fixed<std::int64_t, 62>>;

}  // namespace isostep
