// Bodies of direct_system.hpp: K and its limits.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/direct_pivot.inl"
#include "isostep/dynamics/solvers/direct_system.hpp"

namespace isostep {

template <class N> void DirectSystem<N>::begin() {
  blocks_.clear();
  patches_.clear();
}

template <class N> std::uint32_t DirectSystem<N>::add_block(std::uint32_t body_a, std::uint32_t body_b) {
  blocks_.push_back({{body_a, body_b}, {}});
  return block_count() - 1;
}

template <class N>
void DirectSystem<N>::tie(std::uint32_t body_count, std::uint32_t most_blocks, std::uint64_t most_work) {
  motions_.assign(body_count + 1, DirectMotion<N>::zero());
  is_factored_ = false;
  pairs_.clear();
  too_large_ = block_count() > most_blocks;
  if (too_large_) return;
  first_.assign(motions_.size() + 1, 0);
  for (const DirectBlock<N>& block : blocks_) {
    for (const std::uint32_t body : block.body) first_[body + 1] += body != 0;
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  at_body_.resize(first_.back());
  next_ = first_;
  for (std::uint32_t b = 0; b < block_count(); ++b) {
    for (const std::uint32_t body : blocks_[b].body) {
      if (body != 0) at_body_[next_[body]++] = b;
    }
  }
  for (std::uint32_t body = 1; body < motions_.size(); ++body) {
    for (std::uint32_t i = first_[body]; i < first_[body + 1]; ++i) {
      for (std::uint32_t j = i + 1; j < first_[body + 1]; ++j) {
        const DirectBlock<N>&a = blocks_[at_body_[i]], &b = blocks_[at_body_[j]];
        const std::uint32_t of_a = a.body[0] + a.body[1] - body, of_b = b.body[0] + b.body[1] - body;
        if (of_a == of_b && of_a != 0 && of_a < body) continue;  // they met at that one
        pairs_.push_back({at_body_[i], at_body_[j]});
      }
    }
  }
  too_large_ = most_work < least_work();
  if (too_large_) return;
  if (cholesky_.is_analysed() && last_count_ == block_count() && last_pairs_ == pairs_) return;
  cholesky_.analyse(block_count(), pairs_);
  last_count_ = block_count();
  last_pairs_ = pairs_;
}

/// Returns about how many products of blocks a factorisation takes: exactly, if every block meets every other.
template <class N> std::uint64_t DirectSystem<N>::elimination_work() const {
  const std::uint64_t pairs = pairs_.size();
  return pairs * pairs / (block_count() + 1) + block_count();
}

template <class N> GeneralBlock<N> DirectSystem<N>::coupling(const DirectBlock<N>& i, const DirectBlock<N>& j) const {
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

template <class N> void DirectSystem<N>::assemble() {
  if (!too_large_) cholesky_.clear();
  is_factored_ = false;
  int least = 1;
  for (std::uint32_t b = 0; b < block_count(); ++b) {
    DirectBlock<N>& block = blocks_[b];
    GeneralBlock<N> k = coupling(block, block);
    for (int r = 0; r < 3; ++r) {
      DirectRow<N>& row = block.rows[r];
      if (row.bound == DirectBound::absent) continue;
      row.give = k.rows[r][r] * (row.bound == DirectBound::equal ? kEquationGive : kContactGive);
      k.rows[r][r] += row.give + row.soft;
      row.diagonal = k.rows[r][r];
      if (D::size(row.diagonal) < least) least = D::size(row.diagonal);
    }
    if (too_large_) continue;
    cholesky_.add_diagonal(b, {k.rows[0][0], k.rows[0][1], k.rows[0][2], k.rows[1][1], k.rows[1][2], k.rows[2][2]});
  }
  loss_ = 1 - least - kLeastGive;
  if (too_large_) return;
  for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
    cholesky_.add_pair(p, coupling(blocks_[pairs_[p].first], blocks_[pairs_[p].second]));
  }
}

/// Sets a limit. Returns true if the row's answer does not fit it.
template <class N> bool DirectSystem<N>::set_limit(std::uint32_t r, N limit) {
  DirectRow<N>& of = row(r);
  const N moved = of.limit < limit ? limit - of.limit : of.limit - limit;
  of.limit = limit;
  const N size = of.answer < N(0) ? -of.answer : of.answer;
  if (of.state == DirectState::free) return limit + answer_slack_ < size;
  return limit * N(0x1p-5) + answer_slack_ < moved;
}

/// Limits friction as the contact kernels do: to an octagon inside the cone, exact along both tangents.
template <class N> bool DirectSystem<N>::limit_patch(const DirectPatch<N>& patch) {
  N load = N(0);
  for (std::uint32_t p = 0; p < patch.points; ++p) {
    const N x = row(patch.normal + p).answer;
    if (N(0) < x) load = D::sum(load, x);
  }
  const auto share = [load](N factor, int exponent)
                         ISO_INLINE_LAMBDA { return D::bounded(D::shifted(load * factor, exponent)); };
  const N limit = share(patch.friction, patch.friction_exponent);
  bool moved = set_limit(patch.first + 2, share(patch.twist_friction, patch.twist_exponent));
  moved = set_limit(patch.first, limit) || moved;
  const N x = row(patch.first).answer;
  const N rest = limit - (x < N(0) ? -x : x);
  // (sqrt 2 + 1) rest
  const N across = N(0) < rest ? rest + rest + rest * N(0.41421356237309504880) : N(0);
  moved = set_limit(patch.first + 1, across < limit ? across : limit) || moved;
  if (patch.rolling == DirectPatch<N>::kNoRolling) return moved;
  const N rolling = share(patch.lever, patch.lever_exponent);
  for (std::uint32_t r = 0; r < 2; ++r) moved = set_limit(patch.rolling + r, rolling) || moved;
  return moved;
}

template <class N> void DirectSystem<N>::guess_friction(std::uint32_t patch, bool fresh) {
  const DirectPatch<N>& of = patches_[patch];
  limit_patch(of);
  const auto guess = [&](std::uint32_t r) {
    DirectRow<N>& friction = row(r);
    if (fresh) friction.limit = D::kMost;
    const N most = friction.limit - friction.limit * N(0x1p-7);
    friction.state = friction.answer < -most  ? DirectState::at_low
                     : most < friction.answer ? DirectState::at_high
                                              : DirectState::free;
  };
  for (std::uint32_t r = 0; r < 3; ++r) guess(of.first + r);
  if (of.rolling != DirectPatch<N>::kNoRolling) {
    for (std::uint32_t r = 0; r < 2; ++r) guess(of.rolling + r);
  }
}

template <class N> void DirectSystem<N>::rescale(int by) {
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) {
      row.answer = D::bounded(D::shifted(row.answer, by));
      row.limit = D::bounded(D::shifted(row.limit, by));
    }
  }
}

template <class N> void DirectSystem<N>::settle() {
  for (DirectBlock<N>& block : blocks_) {
    for (DirectRow<N>& row : block.rows) {
      if (row.bound == DirectBound::equal || row.bound == DirectBound::absent) row.state = DirectState::free;
      if (row.state == DirectState::free) continue;
      if (row.bound == DirectBound::above) row.state = DirectState::at_low;
      if (row.bound == DirectBound::below) row.state = DirectState::at_high;
    }
  }
}

}  // namespace isostep
