// Bodies of avbd.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/dynamics/solvers/avbd.hpp"

namespace isostep {
namespace detail {

/// Solves A x = b, of six numbers, A = L L^T positive definite: only its lower half is read, and overwritten by L.
template <class N> ISO_INLINE void solve_six(N (&a)[6][6], N (&b)[6]) {
  using D = IslandNumber<N>;
  for (int j = 0; j < 6; ++j) {
    N pivot = a[j][j];
    for (int k = 0; k < j; ++k) pivot -= a[j][k] * a[j][k];
    a[j][j] = D::root(pivot);
    for (int i = j + 1; i < 6; ++i) {
      N entry = a[i][j];
      for (int k = 0; k < j; ++k) entry -= a[i][k] * a[j][k];
      a[i][j] = D::quotient(entry, a[j][j]);
    }
    for (int k = 0; k < j; ++k) b[j] -= a[j][k] * b[k];
    b[j] = D::quotient(b[j], a[j][j]);
  }
  for (int j = 5; j >= 0; --j) {
    for (int i = j + 1; i < 6; ++i) b[j] -= a[i][j] * b[i];
    b[j] = D::bounded_quotient(b[j], a[j][j]);
  }
}

}  // namespace detail

template <class N> void AvbdSystem<N>::tie(std::uint32_t body_count, std::uint64_t) {
  motions_.assign(body_count + 1, IslandMotion<N>::zero());
  this->list_blocks(body_count);
  are_aside_ = false;
}

/// The tangents of a grain share a penalty, so that the nearest force of their ellipse takes most power.
template <class N> void AvbdSystem<N>::assemble() {
  this->weigh_rows();
  ratios_.assign(block_count(), N(0));
  for (const IslandPatch<N>& patch : patches_) {
    ratios_[patch.first / 3] = patch.ratio;
    N &x = this->row(patch.first).diagonal, &y = this->row(patch.first + 1).diagonal;
    if (patch.ratio < N(1)) x = y = max(x, y);
  }
}

/// Returns what a row pushes with: its multiplier and its penalty, of a compliant row less than its spring.
template <class N> N AvbdSystem<N>::answer_of(const IslandBlock<N>& block, int r) const {
  const IslandRow<N>& row = block.rows[r];
  const N lacks = D::bounded(row.right - this->speed(block, r));
  if (row.soft == N(0)) {
    const N push = D::bounded(D::times_power(D::bounded_quotient(lacks, row.diagonal), kPenalty));
    return D::sum(row.answer, push);
  }
  const N give = D::times_power(row.diagonal, -kPenalty);
  return D::bounded_quotient(row.answer * give + lacks, give + row.soft);
}

/// Finds what the rows of a block push with, and which of them yield, because they are at a bound.
template <class N> typename AvbdSystem<N>::Pushes AvbdSystem<N>::pushes_of(std::uint32_t b) const {
  const IslandBlock<N>& block = blocks_[b];
  const bool slides = N(0) < ratios_[b];
  Pushes pushes = {};
  for (int r = 0; r < 3; ++r) {
    const IslandRow<N>& row = block.rows[r];
    pushes.yields[r] = row.bound == RowBound::absent;
    if (pushes.yields[r]) continue;
    const N wanted = answer_of(block, r);
    pushes.size[r] = slides && r < 2 ? wanted : clamped(row, wanted);
    pushes.yields[r] = pushes.size[r] != wanted;
  }
  if (!slides) return pushes;
  const N x = pushes.size[0], y = pushes.size[1];
  if (!Base::hold_in_cone(pushes.size[0], pushes.size[1], block.rows[0].limit, ratios_[b])) return pushes;
  pushes.yields[0] = pushes.yields[1] = true;
  lean(pushes, x, y, ratios_[b]);
  return pushes;
}

/// Finds the stiffness of friction that was (x, y) before it was held at the rim of its cone. It has none across the
/// rim, and a part of its own along it.
/// Symbols: (x, y) = (1 + g A) size, A = diag(1, 1 / ratio^2). n = A size is normal to the rim, s is along it. The
///          projection's derivative is s s^T / (s^T (1 + g A) s). a, b = the entries of (1 + g A)^-1.
template <class N> void AvbdSystem<N>::lean(Pushes& pushes, N x, N y, N ratio) {
  const N square = ratio * ratio, along = square * pushes.size[0], across = pushes.size[1];
  const N most = max(abs(along), abs(across)), half = N(0.5);
  if (!(N(0) < most)) return;
  const N n[2] = {D::quotient(along, most) * half, D::quotient(across, most) * half};
  const N length = D::root(n[0] * n[0] + n[1] * n[1]);
  pushes.rim[0] = -D::quotient(n[1], length);
  pushes.rim[1] = D::quotient(n[0], length);
  N a, b;
  if (abs(y) < abs(x)) {
    a = D::quotient(pushes.size[0], x);
    b = D::quotient(square * a, square * a + (N(1) - a));
  } else {
    b = D::quotient(pushes.size[1], y);
    a = D::quotient(b, b + square * (N(1) - b));
  }
  const N sum = pushes.rim[0] * pushes.rim[0] * b + pushes.rim[1] * pushes.rim[1] * a;
  if (N(0) < sum) pushes.resists = D::quotient(a * b, sum);
}

/// Moves a body to where its rows and its inertia balance.
template <class N> void AvbdSystem<N>::descend(std::uint32_t body) {
  const std::uint32_t rows = 3 * (first_[body + 1] - first_[body]);
  // Scaled so that no sum of parts, each at most 2^(kPenalty + 2), exceeds one.
  const int scale = kPenalty + 3 + static_cast<int>(std::bit_width(rows));
  N a[6][6] = {};
  for (int i = 0; i < 6; ++i) a[i][i] = D::times_power(N(1), -scale);
  const IslandMotion<N>& u = motions_[body];
  N b[6] = {-u.linear.x, -u.linear.y, -u.linear.z, -u.angular.x, -u.angular.y, -u.angular.z};
  const auto stiffen = [&](const N(&w)[6], N diagonal, N soft, N part) {
    const N stiffness = D::quotient(D::times_power(part, -scale), D::times_power(diagonal, -kPenalty) + soft);
    for (int i = 0; i < 6; ++i) {
      const N of = w[i] * stiffness;
      for (int j = 0; j <= i; ++j) a[i][j] += of * w[j];
    }
  };
  for (std::uint32_t k = first_[body]; k < first_[body + 1]; ++k) {
    const IslandBlock<N>& block = blocks_[at_body_[k]];
    const Pushes pushes = pushes_of(at_body_[k]);
    N rim[6] = {};
    for (int r = 0; r < 3; ++r) {
      const IslandRow<N>& row = block.rows[r];
      const IslandMotion<N>& end = row.ends[block.body[0] == body ? 0 : 1];
      const N w[6] = {end.linear.x, end.linear.y, end.linear.z, end.angular.x, end.angular.y, end.angular.z};
      for (int i = 0; i < 6; ++i) b[i] = D::sum(b[i], w[i] * pushes.size[r]);
      for (int i = 0; r < 2 && i < 6; ++i) rim[i] += w[i] * pushes.rim[r];
      if (!pushes.yields[r]) stiffen(w, row.diagonal, row.soft, N(1));
    }
    if (N(0) < pushes.resists) stiffen(rim, max(block.rows[0].diagonal, block.rows[1].diagonal), N(0), pushes.resists);
  }
  for (N& x : b) x = D::times_power(x, -scale);
  detail::solve_six(a, b);
  IslandMotion<N>& to = motions_[body];
  to.linear = {D::sum(to.linear.x, b[0]), D::sum(to.linear.y, b[1]), D::sum(to.linear.z, b[2])};
  to.angular = {D::sum(to.angular.x, b[3]), D::sum(to.angular.y, b[4]), D::sum(to.angular.z, b[5])};
}

template <class N> bool AvbdSystem<N>::solve(bool firm, std::uint64_t) {
  keep_multipliers(firm);
  this->settle_answers();
  const auto bodies = static_cast<std::uint32_t>(motions_.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const IslandPatch<N>& patch : patches_) this->limit_by_cone(patch);
    for (std::uint32_t i = 1; i < bodies; ++i) descend(pass % 2 == 0 ? i : bodies - i);
    for (std::uint32_t k = 0; k < block_count(); ++k) {
      const Pushes pushes = pushes_of(k);
      for (int r = 0; r < 3; ++r) blocks_[k].rows[r].answer = pushes.size[r];
    }
  }
  this->work_ = static_cast<std::uint64_t>(kPasses) * block_count();
  return true;
}

/// Sets multipliers aside while errors are closed, and takes them up again after.
template <class N> void AvbdSystem<N>::keep_multipliers(bool firm) {
  for (std::uint32_t r = 0; r < 3 * block_count(); ++r) {
    IslandRow<N>& row = this->row(r);
    if (!firm && !are_aside_) row.last = row.answer;
    if (firm && are_aside_) row.answer = row.last;
  }
  are_aside_ = !firm;
}

}  // namespace isostep
