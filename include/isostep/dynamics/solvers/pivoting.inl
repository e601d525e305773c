// PivotingSystem: K, exchanges, pass after pass.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/pivoting.hpp"
#include "isostep/dynamics/solvers/pivoting_descent.inl"

namespace isostep {

template <class N> void PivotingSystem<N>::tie(std::uint32_t body_count, std::uint64_t most_work) {
  motions_.assign(body_count + 1, IslandMotion<N>::zero());
  is_factored_ = false;
  pairs_.clear();
  too_large_ = block_count() > kMostBlocks;
  if (too_large_) return;
  this->list_blocks(body_count);
  for (std::uint32_t body = 1; body < motions_.size(); ++body) {
    for (std::uint32_t i = first_[body]; i < first_[body + 1]; ++i) {
      for (std::uint32_t j = i + 1; j < first_[body + 1]; ++j) {
        const IslandBlock<N>&a = blocks_[at_body_[i]], &b = blocks_[at_body_[j]];
        const std::uint32_t of_a = a.body[0] + a.body[1] - body, of_b = b.body[0] + b.body[1] - body;
        if (of_a == of_b && of_a != 0 && of_a < body) continue;  // they met at that one
        pairs_.push_back({at_body_[i], at_body_[j]});
      }
    }
  }
  too_large_ = most_work < least_work();
  if (too_large_) return;
  cholesky_.analyse(block_count(), pairs_);
}

/// Returns about how many products of blocks a factorisation takes: exactly, if every block meets every other.
template <class N> std::uint64_t PivotingSystem<N>::elimination_work() const {
  const std::uint64_t pairs = pairs_.size();
  return pairs * pairs / (block_count() + 1) + block_count();
}

template <class N> GeneralBlock<N> PivotingSystem<N>::coupling(const IslandBlock<N>& i, const IslandBlock<N>& j) const {
  GeneralBlock<N> k;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      N entry = N(0);
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
          if (i.body[a] == 0 || i.body[a] != j.body[b]) continue;
          entry += D::rounded(product_sum(i.rows[r].ends[a], j.rows[c].ends[b]));
        }
      }
      k.rows[r][c] = entry;
    }
  }
  return k;
}

template <class N> void PivotingSystem<N>::assemble() {
  if (!too_large_) cholesky_.clear();
  is_factored_ = false;
  this->weigh_rows();
  int least = 1;
  for (std::uint32_t b = 0; b < block_count(); ++b) {
    const IslandBlock<N>& block = blocks_[b];
    GeneralBlock<N> k = coupling(block, block);
    for (int r = 0; r < 3; ++r) {
      const IslandRow<N>& row = block.rows[r];
      if (row.bound == RowBound::absent) continue;
      k.rows[r][r] = row.diagonal;
      if (D::size(row.diagonal) < least) least = D::size(row.diagonal);
    }
    if (too_large_) continue;
    cholesky_.add_diagonal(b, {k.rows[0][0], k.rows[0][1], k.rows[0][2], k.rows[1][1], k.rows[1][2], k.rows[2][2]});
  }
  loss_ = 1 - least - Base::kLeastGive;
  if (too_large_) return;
  for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
    cholesky_.add_pair(p, coupling(blocks_[pairs_[p].first], blocks_[pairs_[p].second]));
  }
}

/// Returns the state that a row ought to have.
template <class N>
RowState PivotingSystem<N>::turned(const IslandRow<N>& row, N residual, N answer_slack, N right_slack) {
  const bool low = row.bound == RowBound::above || row.bound == RowBound::boxed;
  const bool high = row.bound == RowBound::below || row.bound == RowBound::boxed;
  const N limit = row.bound == RowBound::boxed ? row.limit : N(0);
  if (row.bound == RowBound::boxed && limit < answer_slack) return RowState::at_low;  // nothing to choose
  switch (row.state) {
    case RowState::free:
      if (low && row.answer + limit < -answer_slack) return RowState::at_low;
      if (high && limit + answer_slack < row.answer) return RowState::at_high;
      return RowState::free;
    case RowState::at_low: return residual < -right_slack ? RowState::free : row.state;
    case RowState::at_high: return right_slack < residual ? RowState::free : row.state;
  }
  return row.state;
}

template <class N> bool PivotingSystem<N>::refactor() {
  held_.resize(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    std::uint8_t bits = 0;
    for (int r = 0; r < 3; ++r) {
      const IslandRow<N>& row = blocks_[b].rows[r];
      const bool out = row.bound == RowBound::absent || row.state != RowState::free;
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

template <class N> bool PivotingSystem<N>::solve_free() {
  bool pushes = false;
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) {
      if (row.state == RowState::free) continue;
      if (!holds_) row.answer = at_bound(row);
      pushes = pushes || row.answer != N(0);
    }
  }
  if (pushes) gather_motions(true);
  right_.resize(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (int r = 0; r < 3; ++r) {
      IslandRow<N>& row = blocks_[b].rows[r];
      const bool free = row.bound != RowBound::absent && row.state == RowState::free;
      if (free) row.answer = N(0);
      right_[b][r] = !free ? N(0) : pushes ? -residual(blocks_[b], r) : row.right + row.give * row.last;
    }
  }
  int exponent = 0;
  if (!cholesky_.solve(right_, 0, loss_, answer_, exponent)) return false;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (int r = 0; r < 3; ++r) {
      IslandRow<N>& row = blocks_[b].rows[r];
      const bool free = row.bound != RowBound::absent && row.state == RowState::free;
      if (free) row.answer = D::bounded(D::shifted(answer_[b][r], exponent));
    }
  }
  gather_motions(false);
  return true;
}

template <class N> std::uint32_t PivotingSystem<N>::find_wrong() {
  find_tolerances();
  wrong_.clear();
  wanted_.clear();
  for (std::uint32_t b = 0; b < block_count(); ++b) {
    for (int r = 0; r < 3; ++r) {
      const IslandRow<N>& row = blocks_[b].rows[r];
      if (row.bound == RowBound::absent || row.bound == RowBound::equal) continue;
      const N rest = row.state == RowState::free ? N(0) : residual(blocks_[b], r);
      const RowState wanted = turned(row, rest, answer_slack_, right_slack_);
      if (wanted == row.state) continue;
      wrong_.push_back(3 * b + static_cast<std::uint32_t>(r));
      wanted_.push_back(wanted);
    }
  }
  return static_cast<std::uint32_t>(wrong_.size());
}

/// Lets all wrong rows change sides, as long as that makes them fewer.
template <class N> bool PivotingSystem<N>::exchange() {
  std::uint32_t least = ~0u;
  for (int patience = kPatience; patience > 0 && pivots_ < most_pivots_;) {
    if (!refactor() || !solve_free()) return false;
    const std::uint32_t count = find_wrong();
    if (count == 0) return true;
    patience = count < least ? kPatience : patience - 1;
    least = count < least ? count : least;
    for (std::size_t i = 0; i < count; ++i) this->row(wrong_[i]).state = wanted_[i];
  }
  return false;
}

/// Returns true if a pass takes back a row's compliance. Friction keeps its own: else its limits would never settle.
template <class N> bool PivotingSystem<N>::takes_back(const IslandRow<N>& row, bool firm) {
  if (row.bound == RowBound::absent || row.bound == RowBound::boxed) return false;
  return firm || row.bound == RowBound::equal;
}

/// Returns true if the speeds to which rows yielded are worth another pass.
template <class N> bool PivotingSystem<N>::yielded(bool firm) const {
  for (const IslandBlock<N>& block : blocks_) {
    for (const IslandRow<N>& row : block.rows) {
      const N speed = row.give * (row.answer - row.last) * N(0x1p-12);
      if (takes_back(row, firm) && (right_slack_ < speed || speed < -right_slack_)) return true;
    }
  }
  return false;
}

/// Solves in passes. Each finds the limits again and takes back the compliance of the last: rows stop yielding to it.
template <class N> bool PivotingSystem<N>::solve(bool firm, std::uint64_t most_work) {
  pivots_ = 0;
  const std::uint64_t most = most_work / elimination_work();
  most_pivots_ = most < kMostPivots ? static_cast<int>(most) : kMostPivots;
  bool solved = !too_large_;
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) row.last = N(0);
  }
  for (int pass = 0; solved && pass < kPasses; ++pass) {
    begin_.resize(3 * block_count());
    for (std::uint32_t r = 0; r < 3 * block_count(); ++r) begin_[r] = this->row(r).answer;
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
    for (const IslandPatch<N>& patch : patches_) again = limit_patch(patch, true) || again;
    if (!again) break;
    for (IslandBlock<N>& block : blocks_) {
      for (IslandRow<N>& row : block.rows) row.last = takes_back(row, firm) ? clamped(row, row.answer) : N(0);
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

/// Returns true if rows that hold are violated by more than twice the most that is asked of any. A joint that presses a
/// body against an immovable one makes loads, and friction, of thousands of times what is asked. Their limits never
/// settle: cut to the last limit, friction no longer balances them. The way that is left to a contact asks for nothing.
template <class N> bool PivotingSystem<N>::is_violated() const {
  N asked = N(0), worst = N(0);
  for (const IslandBlock<N>& block : blocks_) {
    for (int r = 0; r < 3; ++r) {
      const IslandRow<N>& row = block.rows[r];
      if (row.bound == RowBound::absent || row.bound == RowBound::boxed) continue;
      const N off = residual(block, r);
      if (row.bound != RowBound::above) asked = max(asked, -row.right), worst = max(worst, off);
      if (row.bound != RowBound::below) asked = max(asked, row.right), worst = max(worst, -off);
    }
  }
  return asked < worst * N(0.5);
}

}  // namespace isostep
