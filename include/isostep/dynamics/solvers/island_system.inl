// Bodies of island_system.hpp: K and its limits.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/friction_ellipse.hpp"
#include "isostep/dynamics/solvers/island_system.hpp"

namespace isostep {

template <class N> void IslandSystem<N>::begin() {
  blocks_.clear();
  patches_.clear();
}

template <class N> std::uint32_t IslandSystem<N>::add_block(std::uint32_t body_a, std::uint32_t body_b) {
  blocks_.push_back({{body_a, body_b}, {}});
  return block_count() - 1;
}

/// Lists the blocks of each body.
template <class N> void IslandSystem<N>::list_blocks(std::uint32_t body_count) {
  first_.assign(body_count + 2, 0);
  for (const IslandBlock<N>& block : blocks_) {
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
}

/// Finds how much each row yields, and its entry on the diagonal of K.
template <class N> void IslandSystem<N>::weigh_rows() {
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) {
      if (row.bound == RowBound::absent) continue;
      N k = N(0);
      for (int end = 0; end < 2; ++end) {
        if (block.body[end] != 0) k += D::rounded(product_sum(row.ends[end], row.ends[end]));
      }
      row.give = k * (row.bound == RowBound::equal ? kEquationGive : kContactGive);
      row.diagonal = k + (row.give + row.soft);
    }
  }
}

/// Sets a limit. Returns true if the row's answer does not fit it.
template <class N> bool IslandSystem<N>::set_limit(std::uint32_t r, N limit) {
  IslandRow<N>& of = row(r);
  const N moved = of.limit < limit ? limit - of.limit : of.limit - limit;
  of.limit = limit;
  const N size = of.answer < N(0) ? -of.answer : of.answer;
  if (of.state == RowState::free) return limit + answer_slack_ < size;
  return limit * N(0x1p-5) + answer_slack_ < moved;
}

/// Limits twist and rolling by the load. Returns the limit of friction along the first tangent.
template <class N> N IslandSystem<N>::limit_turns(const IslandPatch<N>& patch, bool& moved) {
  N load = N(0);
  for (std::uint32_t p = 0; p < patch.points; ++p) {
    const N x = row(patch.normal + p).answer;
    if (N(0) < x) load = D::sum(load, x);
  }
  const auto share = [load](N factor, int exponent)
                         ISO_INLINE_LAMBDA { return D::bounded(D::shifted(load * factor, exponent)); };
  moved = set_limit(patch.first + 2, share(patch.twist_friction, patch.twist_exponent));
  if (patch.rolling != IslandPatch<N>::kNoRolling) {
    const N rolling = share(patch.lever, patch.lever_exponent);
    for (std::uint32_t r = 0; r < 2; ++r) moved = set_limit(patch.rolling + r, rolling) || moved;
  }
  return share(patch.friction, patch.friction_exponent);
}

/// Limits friction to an octagon inside the cone, exact along both tangents. `moves`: motions are those of the answers.
template <class N> bool IslandSystem<N>::limit_patch(const IslandPatch<N>& patch, bool moves) {
  bool moved = false;
  const N limit = limit_turns(patch, moved);
  if (patch.ratio < N(1)) return limit_grain(patch, limit, moves) || moved;
  moved = set_limit(patch.first, limit) || moved;
  const N rest = limit - abs(row(patch.first).answer);
  // (sqrt 2 + 1) rest
  const N across = N(0) < rest ? rest + rest + rest * N(0.41421356237309504880) : N(0);
  return set_limit(patch.first + 1, across < limit ? across : limit) || moved;
}

/// Limits friction on a grain to a rectangle: about the ellipse while it holds, else the one whose corner is the force
/// that the answers, and what slips, lead to.
template <class N> bool IslandSystem<N>::limit_grain(const IslandPatch<N>& patch, N limit, bool moves) {
  const IslandBlock<N>& block = blocks_[patch.first / 3];
  const N heaviest = max(block.rows[0].diagonal, block.rows[1].diagonal);
  N to[2] = {block.rows[0].answer, block.rows[1].answer};
  for (int r = 0; moves && r < 2; ++r) {
    if (block.rows[r].bound == RowBound::absent) continue;
    to[r] = D::bounded(to[r] - D::bounded_quotient(residual(block, r), heaviest));
  }
  const bool slides = hold_in_cone(to[0], to[1], limit, patch.ratio);
  const bool moved = set_limit(patch.first, slides ? abs(to[0]) : limit);
  return set_limit(patch.first + 1, slides ? abs(to[1]) : limit * patch.ratio) || moved;
}

/// Limits tangents to what the cone admits along each, alone.
template <class N> void IslandSystem<N>::limit_by_cone(const IslandPatch<N>& patch) {
  bool moved = false;
  const N limit = limit_turns(patch, moved);
  set_limit(patch.first, limit);
  set_limit(patch.first + 1, patch.ratio < N(1) ? limit * patch.ratio : limit);
}

/// Brings a pair of tangents back into the cone: along the radius of its disc, or to the nearest point of its ellipse.
/// Returns true if it was outside.
template <class N> bool IslandSystem<N>::hold_in_cone(N& x, N& y, N limit, N ratio) {
  if (ratio < N(1)) return hold_in_ellipse<D>(ratio, limit, x, y);
  const N most = max(abs(x), abs(y));
  if (!(N(0) < most)) return false;
  const N fraction = D::quotient(min(abs(x), abs(y)), most) * N(0.5);
  const N half = most * D::root(N(0.25) + fraction * fraction);  // of the length: the root stays below one
  if (!(limit * N(0.5) < half)) return false;
  const N share = D::quotient(limit * N(0.5), half);
  x = x * share;
  y = y * share;
  return true;
}

template <class N> void IslandSystem<N>::guess_friction(std::uint32_t patch, bool fresh) {
  const IslandPatch<N>& of = patches_[patch];
  limit_patch(of, false);
  const auto guess = [&](std::uint32_t r) {
    IslandRow<N>& friction = row(r);
    if (fresh) friction.limit = D::kMost;
    const N most = friction.limit - friction.limit * N(0x1p-7);
    friction.state = friction.answer < -most  ? RowState::at_low
                     : most < friction.answer ? RowState::at_high
                                              : RowState::free;
  };
  for (std::uint32_t r = 0; r < 3; ++r) guess(of.first + r);
  if (of.rolling != IslandPatch<N>::kNoRolling) {
    for (std::uint32_t r = 0; r < 2; ++r) guess(of.rolling + r);
  }
}

template <class N> void IslandSystem<N>::rescale(int by) {
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) {
      row.answer = D::bounded(D::shifted(row.answer, by));
      row.last = D::bounded(D::shifted(row.last, by));
      row.limit = D::bounded(D::shifted(row.limit, by));
    }
  }
}

template <class N> void IslandSystem<N>::settle() {
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) {
      if (row.bound == RowBound::equal || row.bound == RowBound::absent) row.state = RowState::free;
      if (row.state == RowState::free) continue;
      if (row.bound == RowBound::above) row.state = RowState::at_low;
      if (row.bound == RowBound::below) row.state = RowState::at_high;
    }
  }
}

template <class N> N IslandSystem<N>::at_bound(const IslandRow<N>& row) {
  if (row.bound != RowBound::boxed) return N(0);
  return row.state == RowState::at_low ? -row.limit : row.limit;
}

template <class N> N IslandSystem<N>::clamped(const IslandRow<N>& row, N x) {
  switch (row.bound) {
    case RowBound::absent: return N(0);
    case RowBound::equal: return D::bounded(x);
    case RowBound::above: return D::bounded(max(x, N(0)));
    case RowBound::below: return D::bounded(min(x, N(0)));
    case RowBound::boxed: return x < -row.limit ? -row.limit : row.limit < x ? row.limit : x;
  }
  return x;
}

template <class N> void IslandSystem<N>::gather_motions(bool held_only) {
  for (IslandMotion<N>& motion : motions_) motion = IslandMotion<N>::zero();
  for (const IslandBlock<N>& block : blocks_) {
    for (const IslandRow<N>& row : block.rows) {
      if (row.answer == N(0) || (held_only && row.state == RowState::free)) continue;
      for (int end = 0; end < 2; ++end) {
        if (block.body[end] != 0) add_scaled(motions_[block.body[end]], row.ends[end], row.answer);
      }
    }
  }
}

/// Returns w . u of a row.
template <class N> N IslandSystem<N>::speed(const IslandBlock<N>& block, int r) const {
  const IslandRow<N>& row = block.rows[r];
  return D::rounded(product_sum(row.ends[0], motions_[block.body[0]]) +
                    product_sum(row.ends[1], motions_[block.body[1]]));
}

template <class N> N IslandSystem<N>::residual(const IslandBlock<N>& block, int r) const {
  const IslandRow<N>& row = block.rows[r];
  return speed(block, r) + row.soft * row.answer + row.give * (row.answer - row.last) - row.right;
}

/// Finds what counts as zero: 2^-26 of the largest right-hand side, and the rounding error of the largest answer.
template <class N> void IslandSystem<N>::find_tolerances() {
  N right = N(0), answer = N(0);
  for (const IslandBlock<N>& block : blocks_) {
    for (const IslandRow<N>& row : block.rows) {
      const N b = row.right < N(0) ? -row.right : row.right, x = row.answer < N(0) ? -row.answer : row.answer;
      if (right < b) right = b;
      if (answer < x) answer = x;
    }
  }
  right_slack_ = right * N(0x1p-26) + answer * N(0x1p-36);
  answer_slack_ = right_slack_;
}

/// Holds answers within their bounds and computes the motions that they give.
template <class N> void IslandSystem<N>::settle_answers() {
  for (IslandBlock<N>& block : blocks_) {
    for (IslandRow<N>& row : block.rows) row.answer = clamped(row, row.answer);
  }
  gather_motions(false);
}

template <class N> void IslandSystem<N>::sweep(int sweeps) {
  settle_answers();
  for (int i = 0; i < sweeps; ++i) {
    for (const IslandPatch<N>& patch : patches_) limit_patch(patch, true);
    for (IslandBlock<N>& block : blocks_) {
      for (int r = 0; r < 3; ++r) {
        IslandRow<N>& row = block.rows[r];
        if (row.bound == RowBound::absent || !(N(0) < row.diagonal)) continue;
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
