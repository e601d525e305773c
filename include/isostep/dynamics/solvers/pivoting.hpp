// PivotingSystem<N>: an island solved by pivoting over sparse factorisations.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/solvers/island_system.hpp"
#include "isostep/math/sparse_cholesky.hpp"

namespace isostep {

/// Source:  Judice, Pires 1994, A block principal pivoting algorithm for large-scale strictly monotone linear
///          complementarity problems, Computers and Operations Research 21(5): all wrong rows change sides. If that
///          does not make them fewer, Gauss-Seidel finds another start, and from there rows change one at a time in
///          descent: the primal active set method (Nocedal, Wright 2006, Numerical Optimization, sec. 16.5).
/// Differs: bounds on both sides. Limits of friction are computed from the load until they settle; x of rows at their
///          bounds goes to the right-hand side.
/// Limits:  friction is an octagon inside the cone, along the slip or the friction borne. Every row yields a little
///          (kContactGive, kEquationGive). A box on a table sinks at 5 um/s in sub-steps of 1/120 s, of which 0.2 um
///          stay where errors are closed. With less, exchanges on a wall of boxes no longer end. Systems of more than
///          kMostBlocks, and those with too many neighbours (a heap at one place) for kLeastPivots within their work,
///          are swept, never factorised.
/// Order:   pivots follow from the rows alone; elimination as SparseCholesky.
template <class N> class PivotingSystem final : public IslandSystem<N> {
 public:
  using Base = IslandSystem<N>;
  using typename Base::D;
  /// The most blocks of three rows of an island. With twice as many (a wall of 210 boxes has 1200) a factorisation
  /// takes 8 ms and a falling wall needs hundreds.
  static constexpr std::uint32_t kMostBlocks = 600;
  static constexpr int kMostPivots = 200;  // factorisations for one problem, as far as the caller's budget allows
  static constexpr int kLeastPivots = 4;   // of which a problem is worth beginning with
  static constexpr int kPasses = 3;        // limits come within 1/32, as a rule in two
  static constexpr int kPatience = 3;      // exchanges that may bring nothing before rows are taken one by one
  static constexpr int kSweeps = 16, kLeastSweeps = 4;
  static constexpr std::uint64_t kSweepWork = 4;  // of a block in a sweep: three rows at two ends

  void tie(std::uint32_t body_count, std::uint64_t most_work);
  void assemble();
  /// With `firm` it takes more passes. Answers that pivoting did not end with are within bounds, and joints hold. Too
  /// large systems are only swept, as often as most_work allows, kLeastSweeps times at least.
  bool solve(bool firm, std::uint64_t most_work);
  std::uint64_t least_work() const { return kLeastPivots * elimination_work(); }

  ISO_INLINE int pivots() const { return pivots_; }  // of the last solve

 private:
  using Pair = typename SparseCholesky<N>::Pair;
  using Base::answer_slack_, Base::at_body_, Base::blocks_, Base::first_, Base::motions_, Base::patches_;
  using Base::at_bound, Base::block_count, Base::clamped, Base::find_tolerances, Base::gather_motions;
  using Base::limit_patch, Base::residual, Base::settle_answers, Base::sweep;
  using Base::right_slack_, Base::too_large_, Base::work_;

  GeneralBlock<N> coupling(const IslandBlock<N>& i, const IslandBlock<N>& j) const;
  std::uint64_t elimination_work() const;
  bool exchange();
  bool descend();
  void start_from_sweeps();
  void step_within_bounds();
  void solve_equations();
  void solve_anew();
  bool is_violated() const;
  bool yielded(bool firm) const;
  static bool takes_back(const IslandRow<N>& row, bool firm);
  bool refactor();
  bool solve_free();
  std::uint32_t find_wrong();
  static RowState turned(const IslandRow<N>& row, N residual, N answer_slack, N right_slack);

  std::vector<Pair> pairs_;
  SparseCholesky<N> cholesky_;
  int loss_ = 0;
  std::vector<std::uint8_t> held_, factored_;
  bool is_factored_ = false;
  std::vector<Vec3<N>> right_, answer_, from_;
  std::vector<N> begin_;  // answers of each row
  bool holds_ = false;    // rows that are not free keep the answers that they have
  std::vector<std::uint32_t> wrong_;
  std::vector<RowState> wanted_;
  int pivots_ = 0, most_pivots_ = 0;
};

}  // namespace isostep
