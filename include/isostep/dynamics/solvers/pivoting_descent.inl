// PivotingSystem: sweeps, and the descent from where they lead, when exchanges come to no end.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/pivoting.hpp"

namespace isostep {

/// Starts again from the answers that the pass began with, swept to lie within their bounds, and from the states that
/// they imply: exchanges that do not end leave answers of any size.
template <class N> void PivotingSystem<N>::start_from_sweeps() {
  for (std::uint32_t r = 0; r < 3 * block_count(); ++r) this->row(r).answer = begin_[r];
  sweep(kSweeps);
  find_tolerances();
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) {
      if (row.bound == RowBound::absent || row.bound == RowBound::equal) continue;
      const N limit = row.bound == RowBound::boxed ? row.limit : N(0);
      const bool low = row.bound != RowBound::below && !(answer_slack_ < row.answer + limit);
      const bool high = row.bound != RowBound::above && !(answer_slack_ < limit - row.answer);
      row.state = low ? RowState::at_low : high ? RowState::at_high : RowState::free;
      row.answer = row.state == RowState::free ? row.answer : at_bound(row);
    }
  }
}

/// Steps from `from_` towards the answers as far as the bounds allow. The row that stops the step is held at its bound.
template <class N> void PivotingSystem<N>::step_within_bounds() {
  N most = N(1);
  std::uint32_t stop = 0;
  RowState side = RowState::free;
  for (std::uint32_t r = 0; r < 3 * block_count(); ++r) {
    IslandRow<N>& of = this->row(r);
    if (of.bound == RowBound::absent || of.state != RowState::free) continue;
    const RowState wanted = turned(of, N(0), answer_slack_, right_slack_);
    if (wanted == RowState::free) continue;
    const N from = from_[r / 3][static_cast<int>(r % 3)];
    const N limit = of.bound != RowBound::boxed ? N(0) : wanted == RowState::at_low ? -of.limit : of.limit;
    const bool begins_beyond = wanted == RowState::at_low ? from < limit : limit < from;  // by less than the slack
    const N share = begins_beyond ? N(0) : D::quotient(limit - from, of.answer - from);
    if (share < most || side == RowState::free) {
      most = max(share, N(0));
      stop = r;
      side = wanted;
    }
  }
  for (std::uint32_t r = 0; r < 3 * block_count(); ++r) {
    IslandRow<N>& of = this->row(r);
    const N from = from_[r / 3][static_cast<int>(r % 3)];
    if (of.state == RowState::free) of.answer = from + (of.answer - from) * most;
  }
  this->row(stop).state = side;
  this->row(stop).answer = at_bound(this->row(stop));
}

/// Changes one row at a time, so that x^T (K x / 2 - right) never rises: the primal active set method, which ends.
template <class N> bool PivotingSystem<N>::descend() {
  from_.resize(blocks_.size());
  while (pivots_ < most_pivots_) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      for (int r = 0; r < 3; ++r) from_[b][r] = blocks_[b].rows[r].answer;
    }
    if (!refactor() || !solve_free()) return false;
    if (find_wrong() == 0) return true;
    bool leaves = false;
    N worst = N(0);
    std::uint32_t release = 0;
    for (const std::uint32_t r : wrong_) {
      leaves = leaves || this->row(r).state == RowState::free;
      const N rest = residual(blocks_[r / 3], static_cast<int>(r % 3)), size = rest < N(0) ? -rest : rest;
      if (this->row(r).state == RowState::free || !(worst < size)) continue;
      worst = size;
      release = r;
    }
    if (leaves) step_within_bounds();
    else if (!(N(0) < worst)) return true;  // what is wrong asks for nothing: to release none would go on for ever
    else this->row(release).state = RowState::free;
  }
  return false;
}

/// Solves the equations alone: bounded rows keep their answers, and joints take the rest.
template <class N> void PivotingSystem<N>::solve_equations() {
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) {
      row.answer = clamped(row, row.answer);
      if (row.bound != RowBound::equal && row.bound != RowBound::absent) row.state = RowState::at_low;
    }
  }
  holds_ = true;
  if (refactor()) solve_free();
  holds_ = false;
}

/// Solves again without the answers found so far, which are of any size. Sweeps from zero stay near what is asked.
template <class N> void PivotingSystem<N>::solve_anew() {
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) row.answer = row.last = N(0);
  }
  sweep(kSweeps);
  solve_equations();
}

}  // namespace isostep
