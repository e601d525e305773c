// DirectSystem: pivoting by exchanges, pass after pass.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/direct_descent.inl"
#include "isostep/dynamics/solvers/direct_system.hpp"

namespace isostep {

template <class N> N DirectSystem<N>::at_bound(const DirectRow<N>& row) {
  if (row.bound != DirectBound::boxed) return N(0);
  return row.state == DirectState::at_low ? -row.limit : row.limit;
}

template <class N> N DirectSystem<N>::clamped(const DirectRow<N>& row, N x) {
  switch (row.bound) {
    case DirectBound::absent: return N(0);
    case DirectBound::equal: return D::bounded(x);
    case DirectBound::above: return D::bounded(max(x, N(0)));
    case DirectBound::below: return D::bounded(min(x, N(0)));
    case DirectBound::boxed: return x < -row.limit ? -row.limit : row.limit < x ? row.limit : x;
  }
  return x;
}

/// Returns the state that a row ought to have.
template <class N>
DirectState DirectSystem<N>::turned(const DirectRow<N>& row, N residual, N answer_slack, N right_slack) {
  const bool low = row.bound == DirectBound::above || row.bound == DirectBound::boxed;
  const bool high = row.bound == DirectBound::below || row.bound == DirectBound::boxed;
  const N limit = row.bound == DirectBound::boxed ? row.limit : N(0);
  if (row.bound == DirectBound::boxed && limit < answer_slack) return DirectState::at_low;  // nothing to choose
  switch (row.state) {
    case DirectState::free:
      if (low && row.answer + limit < -answer_slack) return DirectState::at_low;
      if (high && limit + answer_slack < row.answer) return DirectState::at_high;
      return DirectState::free;
    case DirectState::at_low: return residual < -right_slack ? DirectState::free : row.state;
    case DirectState::at_high: return right_slack < residual ? DirectState::free : row.state;
  }
  return row.state;
}

template <class N> void DirectSystem<N>::gather_motions(bool held_only) {
  for (DirectMotion<N>& motion : motions_) motion = DirectMotion<N>::zero();
  for (const DirectBlock<N>& block : blocks_) {
    for (const DirectRow<N>& row : block.rows) {
      if (row.answer == N(0) || (held_only && row.state == DirectState::free)) continue;
      for (int end = 0; end < 2; ++end) {
        if (block.body[end] != 0) add_scaled(motions_[block.body[end]], row.ends[end], row.answer);
      }
    }
  }
}

template <class N> N DirectSystem<N>::residual(const DirectBlock<N>& block, int r) const {
  const DirectRow<N>& row = block.rows[r];
  const N moved =
      D::rounded(product_sum(row.ends[0], motions_[block.body[0]]) + product_sum(row.ends[1], motions_[block.body[1]]));
  return moved + row.soft * row.answer + row.give * (row.answer - row.last) - row.right;
}

template <class N> bool DirectSystem<N>::refactor() {
  held_.resize(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    std::uint8_t bits = 0;
    for (int r = 0; r < 3; ++r) {
      const DirectRow<N>& row = blocks_[b].rows[r];
      const bool out = row.bound == DirectBound::absent || row.state != DirectState::free;
      bits = static_cast<std::uint8_t>(bits | (out ? 1u << r : 0u));
    }
    held_[b] = bits;
  }
  if (is_factored_ && held_ == factored_) return true;
  factored_ = held_;
  is_factored_ = loss_ <= SparseCholesky<N>::kMostLoss && cholesky_.factorise(held_);
  ++pivots_;
  return is_factored_;
}

template <class N> bool DirectSystem<N>::solve_free() {
  bool pushes = false;
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) {
      if (row.state == DirectState::free) continue;
      if (!holds_) row.answer = at_bound(row);
      pushes = pushes || row.answer != N(0);
    }
  }
  if (pushes) gather_motions(true);
  right_.resize(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (int r = 0; r < 3; ++r) {
      DirectRow<N>& row = blocks_[b].rows[r];
      const bool free = row.bound != DirectBound::absent && row.state == DirectState::free;
      if (free) row.answer = N(0);
      right_[b][r] = !free ? N(0) : pushes ? -residual(blocks_[b], r) : row.right + row.give * row.last;
    }
  }
  int exponent = 0;
  if (!cholesky_.solve(right_, 0, loss_, answer_, exponent)) return false;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (int r = 0; r < 3; ++r) {
      DirectRow<N>& row = blocks_[b].rows[r];
      const bool free = row.bound != DirectBound::absent && row.state == DirectState::free;
      if (free) row.answer = D::bounded(D::shifted(answer_[b][r], exponent));
    }
  }
  gather_motions(false);
  return true;
}

/// Finds what counts as zero: 2^-26 of the largest right-hand side, and the rounding error of the largest answer.
template <class N> void DirectSystem<N>::find_tolerances() {
  N right = N(0), answer = N(0);
  for (const DirectBlock<N>& block : blocks_) {
    for (const DirectRow<N>& row : block.rows) {
      const N b = row.right < N(0) ? -row.right : row.right, x = row.answer < N(0) ? -row.answer : row.answer;
      if (right < b) right = b;
      if (answer < x) answer = x;
    }
  }
  right_slack_ = right * N(0x1p-26) + answer * N(0x1p-36);
  answer_slack_ = right_slack_;
}

template <class N> std::uint32_t DirectSystem<N>::find_wrong() {
  find_tolerances();
  wrong_.clear();
  wanted_.clear();
  for (std::uint32_t b = 0; b < block_count(); ++b) {
    for (int r = 0; r < 3; ++r) {
      const DirectRow<N>& row = blocks_[b].rows[r];
      if (row.bound == DirectBound::absent || row.bound == DirectBound::equal) continue;
      const N rest = row.state == DirectState::free ? N(0) : residual(blocks_[b], r);
      const DirectState wanted = turned(row, rest, answer_slack_, right_slack_);
      if (wanted == row.state) continue;
      wrong_.push_back(3 * b + static_cast<std::uint32_t>(r));
      wanted_.push_back(wanted);
    }
  }
  return static_cast<std::uint32_t>(wrong_.size());
}

/// Lets all wrong rows change sides, as long as that makes them fewer.
template <class N> bool DirectSystem<N>::exchange() {
  std::uint32_t least = ~0u;
  for (int patience = kPatience; patience > 0 && pivots_ < most_pivots_;) {
    if (!refactor() || !solve_free()) return false;
    const std::uint32_t count = find_wrong();
    if (count == 0) return true;
    patience = count < least ? kPatience : patience - 1;
    least = count < least ? count : least;
    for (std::size_t i = 0; i < count; ++i) row(wrong_[i]).state = wanted_[i];
  }
  return false;
}

/// Returns true if a pass takes back a row's compliance. Friction keeps its own: else its limits would never settle.
template <class N> bool DirectSystem<N>::takes_back(const DirectRow<N>& row, bool firm) {
  if (row.bound == DirectBound::absent || row.bound == DirectBound::boxed) return false;
  return firm || row.bound == DirectBound::equal;
}

/// Returns true if the speeds to which rows yielded are worth another pass.
template <class N> bool DirectSystem<N>::yielded(bool firm) const {
  for (const DirectBlock<N>& block : blocks_) {
    for (const DirectRow<N>& row : block.rows) {
      const N speed = row.give * (row.answer - row.last) * N(0x1p-12);
      if (takes_back(row, firm) && (right_slack_ < speed || speed < -right_slack_)) return true;
    }
  }
  return false;
}

/// Solves in passes. Each finds the limits again and takes back the compliance of the last: rows stop yielding to it.
template <class N> bool DirectSystem<N>::solve(bool firm, std::uint64_t most_work) {
  pivots_ = 0;
  const std::uint64_t most = most_work / elimination_work();
  most_pivots_ = most < kMostPivots ? static_cast<int>(most) : kMostPivots;
  bool solved = !too_large_;
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) row.last = N(0);
  }
  for (int pass = 0; solved && pass < kPasses; ++pass) {
    begin_.resize(3 * block_count());
    for (std::uint32_t r = 0; r < 3 * block_count(); ++r) begin_[r] = row(r).answer;
    solved = exchange();
    if (!solved) {
      start_from_sweeps();
      solved = exchange();
    }
    if (!solved) {
      start_from_sweeps();
      solved = descend();
    }
    bool again = yielded(firm);
    for (const DirectPatch<N>& patch : patches_) again = limit_patch(patch) || again;
    if (!again) break;
    for (DirectBlock<N>& block : blocks_) {
      for (DirectRow<N>& row : block.rows) row.last = takes_back(row, firm) ? clamped(row, row.answer) : N(0);
    }
  }
  if (!solved && !too_large_) solve_equations();
  work_ = static_cast<std::uint64_t>(pivots_) * elimination_work();
  if (too_large_) {
    const std::uint64_t one = kSweepWork * block_count(), most_sweeps = most_work / one;
    const int sweeps = most_sweeps < kLeastSweeps ? kLeastSweeps
                       : most_sweeps < kSweeps    ? static_cast<int>(most_sweeps)
                                                  : kSweeps;
    sweep(sweeps);
    work_ = static_cast<std::uint64_t>(sweeps) * one;
  }
  settle_answers();
  if (!solved || !is_violated()) return solved;
  solve_anew();
  settle_answers();
  return false;
}

/// Holds answers within their bounds and computes the motions that they give.
template <class N> void DirectSystem<N>::settle_answers() {
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) row.answer = clamped(row, row.answer);
  }
  gather_motions(false);
}

/// Returns true if rows that hold are violated by more than twice the most that is asked of any. A joint that presses a
/// body against an immovable one makes loads, and friction, of thousands of times what is asked. Their limits never
/// settle: cut to the last limit, friction no longer balances them. The way that is left to a contact asks for nothing.
template <class N> bool DirectSystem<N>::is_violated() const {
  N asked = N(0), worst = N(0);
  for (const DirectBlock<N>& block : blocks_) {
    for (int r = 0; r < 3; ++r) {
      const DirectRow<N>& row = block.rows[r];
      if (row.bound == DirectBound::absent || row.bound == DirectBound::boxed) continue;
      const N off = residual(block, r);
      if (row.bound != DirectBound::above) asked = max(asked, -row.right), worst = max(worst, off);
      if (row.bound != DirectBound::below) asked = max(asked, row.right), worst = max(worst, -off);
    }
  }
  return asked < worst * N(0.5);
}

}  // namespace isostep
