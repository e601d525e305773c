// DirectSystem: sweeps, and the descent from where they lead, when exchanges come to no end.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/direct_system.hpp"

namespace isostep {

/// Starts again from the answers that the pass began with, swept to lie within their bounds, and from the states that
/// they imply: exchanges that do not end leave answers of any size.
template <class N> void DirectSystem<N>::start_from_sweeps() {
  for (std::uint32_t r = 0; r < 3 * block_count(); ++r) row(r).answer = begin_[r];
  sweep(kSweeps);
  find_tolerances();
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) {
      if (row.bound == DirectBound::absent || row.bound == DirectBound::equal) continue;
      const N limit = row.bound == DirectBound::boxed ? row.limit : N(0);
      const bool low = row.bound != DirectBound::below && !(answer_slack_ < row.answer + limit);
      const bool high = row.bound != DirectBound::above && !(answer_slack_ < limit - row.answer);
      row.state = low ? DirectState::at_low : high ? DirectState::at_high : DirectState::free;
      row.answer = row.state == DirectState::free ? row.answer : at_bound(row);
    }
  }
}

/// Steps from `from_` towards the answers as far as the bounds allow. The row that stops the step is held at its bound.
template <class N> void DirectSystem<N>::step_within_bounds() {
  N most = N(1);
  std::uint32_t stop = 0;
  DirectState side = DirectState::free;
  for (std::uint32_t r = 0; r < 3 * block_count(); ++r) {
    DirectRow<N>& of = row(r);
    if (of.bound == DirectBound::absent || of.state != DirectState::free) continue;
    const DirectState wanted = turned(of, N(0), answer_slack_, right_slack_);
    if (wanted == DirectState::free) continue;
    const N from = from_[r / 3][static_cast<int>(r % 3)];
    const N limit = of.bound != DirectBound::boxed ? N(0) : wanted == DirectState::at_low ? -of.limit : of.limit;
    const bool begins_beyond = wanted == DirectState::at_low ? from < limit : limit < from;  // by less than the slack
    const N share = begins_beyond ? N(0) : D::quotient(limit - from, of.answer - from);
    if (share < most || side == DirectState::free) {
      most = max(share, N(0));
      stop = r;
      side = wanted;
    }
  }
  for (std::uint32_t r = 0; r < 3 * block_count(); ++r) {
    DirectRow<N>& of = row(r);
    const N from = from_[r / 3][static_cast<int>(r % 3)];
    if (of.state == DirectState::free) of.answer = from + (of.answer - from) * most;
  }
  row(stop).state = side;
  row(stop).answer = at_bound(row(stop));
}

/// Changes one row at a time, so that x^T (K x / 2 - right) never rises: the primal active set method, which ends.
template <class N> bool DirectSystem<N>::descend() {
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
      leaves = leaves || row(r).state == DirectState::free;
      const N rest = residual(blocks_[r / 3], static_cast<int>(r % 3)), size = rest < N(0) ? -rest : rest;
      if (row(r).state == DirectState::free || !(worst < size)) continue;
      worst = size;
      release = r;
    }
    if (leaves) step_within_bounds();
    else if (!(N(0) < worst)) return true;  // what is wrong asks for nothing: to release none would go on for ever
    else row(release).state = DirectState::free;
  }
  return false;
}

/// Solves the equations alone: bounded rows keep their answers, and joints take the rest.
template <class N> void DirectSystem<N>::solve_equations() {
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) {
      row.answer = clamped(row, row.answer);
      if (row.bound != DirectBound::equal && row.bound != DirectBound::absent) row.state = DirectState::at_low;
    }
  }
  holds_ = true;
  if (refactor()) solve_free();
  holds_ = false;
}

/// Solves again without the answers found so far, which are of any size. Sweeps from zero stay near what is asked.
template <class N> void DirectSystem<N>::solve_anew() {
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) row.answer = row.last = N(0);
  }
  sweep(kSweeps);
  solve_equations();
}

template <class N> void DirectSystem<N>::sweep(int sweeps) {
  settle_answers();
  for (int i = 0; i < sweeps; ++i) {
    for (const DirectPatch<N>& patch : patches_) limit_patch(patch);
    for (DirectBlock<N>& block : blocks_) {
      for (int r = 0; r < 3; ++r) {
        DirectRow<N>& row = block.rows[r];
        if (row.bound == DirectBound::absent || !(N(0) < row.diagonal)) continue;
        const N wanted = clamped(row, row.answer - D::bounded(D::quotient(residual(block, r), row.diagonal)));
        const N change = wanted - row.answer;
        row.answer = wanted;
        for (int end = 0; end < 2; ++end) {
          if (block.body[end] != 0) add_scaled(motions_[block.body[end]], row.ends[end], change);
        }
      }
    }
  }
}

}  // namespace isostep
