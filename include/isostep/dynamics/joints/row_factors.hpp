// The factors of a block of rows that may ask for what no body can do.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_rows.hpp"
#include "isostep/dynamics/joints/symmetric_factors.hpp"
#include "isostep/math/lanes_select.hpp"
#include "isostep/scalar/lanes_reciprocal.hpp"

namespace isostep {

/// factor_symmetric() of W blocks' couplings. In coarse formats it leaves out a row that asks for what others of it
/// hold, or for what no body can do: a weld of a body that a lock keeps from turning about an axis.
/// Why:    its inverse is 1 / softness along such a direction, and multiplies the rounding of float and Q16.16 in the
///         neighbours' couplings by as much: their rest is noise, and a tree of them explodes. What moves by less than
///         three times the softness is softer than anything that a tree of these formats may hold.
/// Differs: a point moves along every axis; a row without entries asks for nothing, and finer formats have the digits.
template <class S, int W, class Isa>
ISO_INLINE SymmetricFactors<Lanes<S, W, Isa>> factor_rows(const Mat3<Lanes<S, W, Isa>>& m, S softness) {
  using L = Lanes<S, W, Isa>;
  const L soft = L::broadcast(softness), zero = L::zero();
  SymmetricFactors<L> factors = factor_symmetric(m, soft);
  if (!(S(4) * softness < detail::kTreeCompliance<S>)) return factors;
  const L most = L::broadcast(S(0.25) / softness);
  Mat3<L> rest = m;
  for (int left = 0; left < 3; ++left) {
    const Mat3<L> inverse = factors.inverse();
    const auto asked = [&](int i)
                           ISO_INLINE_LAMBDA { return select(equal(rest.rows[i][i], zero), zero, inverse.rows[i][i]); };
    const L x = asked(0), y = asked(1), z = asked(2), largest = max(x, max(y, z));
    const auto drops = less_equal(most, largest);
    if (!any(drops)) break;
    const auto of_x = equal(x, largest), of_y = ~of_x & equal(y, largest), of_z = ~of_x & ~of_y;
    const auto leave_out = [&](int k, auto which) ISO_INLINE_LAMBDA {
      const auto gone = drops & which;
      for (int i = 0; i < 3; ++i) {
        rest.rows[i][k] = select(gone, zero, rest.rows[i][k]);
        rest.rows[k][i] = select(gone, zero, rest.rows[k][i]);
      }
    };
    leave_out(0, of_x);
    leave_out(1, of_y);
    leave_out(2, of_z);
    SymmetricFactors<L> next = factor_symmetric(rest, soft);
    next.i0 = select(equal(rest.rows[0].x, zero), zero, next.i0);
    next.i1 = select(equal(rest.rows[1].y, zero), zero, next.i1);
    next.i2 = select(equal(rest.rows[2].z, zero), zero, next.i2);
    factors = select(drops, next, factors);
  }
  return factors;
}

/// Returns the factors of one block's coupling.
template <class S> ISO_INLINE SymmetricFactors<S> factor_block(const JointBlock<S>& block, S softness) {
  if (block.point) return factor_symmetric(block.coupling, softness);
  using L = Lanes<S, 1, isa::Portable>;
  Mat3<L> m;
  for (int i = 0; i < 3; ++i) {
    const Vec3<S> row = block.coupling.rows[i];
    m.rows[i] = {L::broadcast(row.x), L::broadcast(row.y), L::broadcast(row.z)};
  }
  const SymmetricFactors<L> f = factor_rows(m, softness);
  return {f.l10.v[0], f.l20.v[0], f.l21.v[0], f.i0.v[0], f.i1.v[0], f.i2.v[0]};
}

}  // namespace isostep
