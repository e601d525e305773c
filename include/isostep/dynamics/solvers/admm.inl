// Bodies of admm.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/dynamics/solvers/admm.hpp"

namespace isostep {
namespace detail {

/// Computes x q y^T.
template <class N> ISO_INLINE GeneralBlock<N> weighed_product(const Vec3<N>& x, const Vec3<N>& y, N q) {
  GeneralBlock<N> k;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) k.rows[i][j] = x[i] * q * y[j];
  }
  return k;
}
template <class N> ISO_INLINE SymmetricBlock<N> weighed_square(const Vec3<N>& x, N q) {
  const GeneralBlock<N> k = weighed_product(x, x, q);
  return {k.rows[0][0], k.rows[0][1], k.rows[0][2], k.rows[1][1], k.rows[1][2], k.rows[2][2]};
}

}  // namespace detail

template <class N> void AdmmSystem<N>::tie(std::uint32_t body_count, std::uint64_t most_work) {
  motions_.assign(body_count + 1, IslandMotion<N>::zero());
  v_.resize(3 * std::size_t{block_count()});
  is_factored_ = false;
  pairs_.clear();
  too_large_ = body_count > kMostBodies;
  if (too_large_) return;
  for (std::uint32_t body = 0; body < body_count; ++body) pairs_.push_back({2 * body, 2 * body + 1});
  for (std::uint32_t k = 0; k < block_count(); ++k) {
    if (!is_tied_by(k) || continues(k)) continue;
    const std::uint32_t a = 2 * (blocks_[k].body[0] - 1), b = 2 * (blocks_[k].body[1] - 1);
    for (std::uint32_t i = 0; i < 4; ++i) pairs_.push_back({a + i / 2, b + i % 2});
  }
  too_large_ = most_work < elimination_work();
  if (too_large_) return;
  cholesky_.analyse(2 * body_count, pairs_);
}

/// The tangents of a patch share a weight, so that the nearest force of their cone is nearest in that measure.
template <class N> void AdmmSystem<N>::assemble() {
  this->weigh_rows();
  p_.assign(3 * std::size_t{block_count()}, N(0));
  for (std::uint32_t r = 0; r < p_.size(); ++r) {
    const RowBound bound = this->row(r).bound;
    const int weight = bound == RowBound::equal   ? kEquationWeight
                       : bound == RowBound::boxed ? kFrictionWeight
                                                  : kWeight;
    if (bound != RowBound::absent) p_[r] = D::times_power(this->row(r).diagonal, weight);
  }
  for (const IslandPatch<N>& patch : patches_)
    p_[patch.first] = p_[patch.first + 1] = max(p_[patch.first], p_[patch.first + 1]);
  is_factored_ = false;
}

template <class N> bool AdmmSystem<N>::factorise() {
  if (is_factored_) return true;
  const auto bodies = static_cast<std::uint32_t>(motions_.size()) - 1;
  // Fixed point: no entry exceeds one, however many rows a body has.
  scale_ = 0;
  if (D::kRoom != 0) scale_ = 3 - kEquationWeight + static_cast<int>(std::bit_width(3 * block_count()));
  cholesky_.clear();
  const N one = D::times_power(N(1), -scale_), none = N(0);
  for (std::uint32_t i = 0; i < 2 * bodies; ++i) cholesky_.add_diagonal(i, {one, none, none, one, none, one});
  std::uint32_t pair = bodies, next = bodies;
  for (std::uint32_t b = 0; b < block_count(); ++b) {
    const IslandBlock<N>& block = blocks_[b];
    const bool both = is_tied_by(b);
    if (both && !continues(b)) {
      pair = next;
      next += 4;
    }
    for (std::uint32_t r = 0; r < 3; ++r) {
      const IslandRow<N>& row = block.rows[r];
      if (row.bound == RowBound::absent) continue;
      const N q = D::quotient(one, p_[3 * b + r] + row.soft);
      for (int end = 0; end < 2; ++end) {
        if (block.body[end] == 0) continue;
        const IslandMotion<N>& w = row.ends[end];
        const std::uint32_t at = 2 * (block.body[end] - 1);
        cholesky_.add_diagonal(at, detail::weighed_square(w.linear, q));
        cholesky_.add_diagonal(at + 1, detail::weighed_square(w.angular, q));
        cholesky_.add_pair(block.body[end] - 1, detail::weighed_product(w.linear, w.angular, q));
      }
      if (!both) continue;
      const Vec3<N> a[2] = {row.ends[0].linear, row.ends[0].angular}, c[2] = {row.ends[1].linear, row.ends[1].angular};
      for (std::uint32_t i = 0; i < 4; ++i)
        cholesky_.add_pair(pair + i, detail::weighed_product(a[i / 2], c[i % 2], q));
    }
  }
  is_factored_ = cholesky_.factorise();
  return is_factored_;
}

/// Finds x and u for the current z and v.
template <class N> bool AdmmSystem<N>::solve_all() {
  constexpr int kDown = D::kRoom != 0 ? 8 : 0;  // room for what stiff rows ask of u
  right_.assign(2 * (motions_.size() - 1), Vec3<N>{N(0), N(0), N(0)});
  for (std::uint32_t r = 0; r < p_.size(); ++r) {
    const IslandBlock<N>& block = blocks_[r / 3];
    const IslandRow<N>& of = this->row(r);
    if (of.bound == RowBound::absent) continue;
    x_[r] = of.right + p_[r] * (of.answer - v_[r]);
    const N push = D::bounded_quotient(D::times_power(x_[r], -kDown), p_[r] + of.soft);
    for (int end = 0; end < 2; ++end) {
      if (block.body[end] == 0) continue;
      const std::uint32_t at = 2 * (block.body[end] - 1);
      right_[at] = right_[at] + of.ends[end].linear * push;
      right_[at + 1] = right_[at + 1] + of.ends[end].angular * push;
    }
  }
  int exponent = 0;
  if (!cholesky_.solve(right_, 0, scale_ + 1, motion_, exponent)) return false;
  const auto moved = [&](const Vec3<N>& u) -> Vec3<N> {
    const auto one = [&](N x) { return D::bounded(D::shifted(x, exponent + kDown - scale_)); };
    return {one(u.x), one(u.y), one(u.z)};
  };
  for (std::uint32_t i = 1; i < motions_.size(); ++i)
    motions_[i] = {moved(motion_[2 * i - 2]), moved(motion_[2 * i - 1])};
  for (std::uint32_t r = 0; r < p_.size(); ++r) {
    const IslandRow<N>& of = this->row(r);
    if (of.bound == RowBound::absent) continue;
    x_[r] = D::bounded_quotient(x_[r] - this->speed(blocks_[r / 3], static_cast<int>(r % 3)), p_[r] + of.soft);
  }
  return true;
}

/// Begins with the multipliers that answer the current answers: what rows at their bounds lack.
template <class N> void AdmmSystem<N>::begin_multipliers() {
  for (const IslandPatch<N>& patch : patches_) this->limit_by_cone(patch);
  x_.assign(v_.size(), N(0));  // a patch may lack its second row, which its cone reads too
  for (std::uint32_t r = 0; r < v_.size(); ++r) {
    const IslandRow<N>& of = this->row(r);
    v_[r] = N(0);
    if (of.bound == RowBound::absent || of.bound == RowBound::equal) continue;
    const N lacks = of.right - of.soft * of.answer - this->speed(blocks_[r / 3], static_cast<int>(r % 3));
    const N most = of.bound == RowBound::boxed ? of.limit - of.limit * N(0x1p-7) : N(0);
    const bool low = of.bound != RowBound::below && !(-most < of.answer) && lacks < N(0);
    const bool high = of.bound != RowBound::above && !(of.answer < most) && N(0) < lacks;
    if (low || high) v_[r] = D::bounded_quotient(lacks, p_[r]);
  }
}

/// Makes z from x + v, in x_, and v what is left.
template <class N> void AdmmSystem<N>::project() {
  constexpr N kOver = N(0.6);  // over-relaxation by 1.6 (Boyd et al., 3.4.3)
  change_ = gap_ = N(0);
  const auto take = [&](std::uint32_t r, N next) {
    N& answer = this->row(r).answer;
    change_ = max(change_, abs(p_[r] * (next - answer)));
    answer = next;
  };
  for (std::uint32_t r = 0; r < x_.size(); ++r) {
    const IslandRow<N>& of = this->row(r);
    if (of.bound == RowBound::absent) continue;
    if (of.bound == RowBound::equal) {
      take(r, x_[r]);
      continue;
    }
    gap_ = max(gap_, abs((x_[r] - of.answer) * of.diagonal));
    v_[r] = x_[r] = D::bounded(x_[r] + (x_[r] - of.answer) * kOver + v_[r]);
    if (of.bound == RowBound::boxed) continue;  // its limit follows from the answers of the others
    take(r, clamped(of, x_[r]));
    v_[r] -= of.answer;
  }
  for (const IslandPatch<N>& patch : patches_) {
    this->limit_by_cone(patch);
    Base::hold_in_cone(x_[patch.first], x_[patch.first + 1], this->row(patch.first).limit, patch.ratio);
  }
  for (std::uint32_t r = 0; r < x_.size(); ++r) {
    const IslandRow<N>& of = this->row(r);
    if (of.bound != RowBound::boxed) continue;
    take(r, clamped(of, x_[r]));
    v_[r] -= of.answer;
  }
}

template <class N> bool AdmmSystem<N>::is_solved() {
  N asked = N(0);
  for (const IslandBlock<N>& block : blocks_) {
    for (const IslandRow<N>& row : block.rows) {
      if (row.bound != RowBound::absent) asked = max(asked, abs(row.right));
    }
  }
  return !(asked * kTolerance < max(gap_, change_));
}

template <class N> bool AdmmSystem<N>::solve(bool, std::uint64_t) {
  this->settle_answers();
  int iterations = 0;
  bool solved = false;
  if (!too_large_ && factorise()) {
    begin_multipliers();
    while (!solved && iterations < kIterations && solve_all()) {
      project();
      solved = is_solved();
      ++iterations;
    }
  } else {
    this->sweep(kSweeps);
  }
  this->work_ = static_cast<std::uint64_t>(iterations) * iteration_work();
  this->settle_answers();
  return solved;
}

}  // namespace isostep
