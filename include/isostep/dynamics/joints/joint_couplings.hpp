// The couplings of joints' rows: the turns that a row gives bodies, and the entries of K between two rows.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint.hpp"

namespace isostep::detail {

template <class S> ISO_INLINE void set_turns(JointRow<S>& row, const Mat3<S>& kappa_a, const Mat3<S>& kappa_b) {
  row.turn_a = kappa_a * row.angular_a;
  row.turn_b = kappa_b * row.angular_b;
}
/// Returns the entry of K between two rows of one joint.
template <class S> ISO_INLINE S self_coupling(const JointRow<S>& i, const JointRow<S>& j, MassShare<S> share) {
  return share.a * coupling(i.linear, i.angular_a, j.linear, j.turn_a) +
         share.b * coupling(i.linear, i.angular_b, j.linear, j.turn_b);
}
/// Returns the coupling of two purely angular rows.
template <class S> ISO_INLINE S turning_coupling(const JointRow<S>& i, const JointRow<S>& j, MassShare<S> share) {
  return share.a * round_to<S>(dot_sum(i.angular_a, j.turn_a)) + share.b * round_to<S>(dot_sum(i.angular_b, j.turn_b));
}
template <class S> ISO_INLINE void weigh_block(JointBlock<S>& block, MassShare<S> share) {
  if (block.point) {
    const auto& r = block.rows;
    const Mat3<S> a =
        point_coupling<S>({r[0].angular_a, r[1].angular_a, r[2].angular_a}, {r[0].turn_a, r[1].turn_a, r[2].turn_a});
    const Mat3<S> b =
        point_coupling<S>({r[0].angular_b, r[1].angular_b, r[2].angular_b}, {r[0].turn_b, r[1].turn_b, r[2].turn_b});
    const S one = share.a + share.b;
    const auto mix = [&](S of_a, S of_b) { return round_to<S>(product(share.a, of_a) + product(share.b, of_b)); };
    const S xy = mix(a.rows[0].y, b.rows[0].y), xz = mix(a.rows[0].z, b.rows[0].z), yz = mix(a.rows[1].z, b.rows[1].z);
    block.coupling = {{{one + mix(a.rows[0].x, b.rows[0].x), xy, xz},
                       {xy, one + mix(a.rows[1].y, b.rows[1].y), yz},
                       {xz, yz, one + mix(a.rows[2].z, b.rows[2].z)}}};
    return;
  }
  const auto k = [&](int i, int j) {
    const JointRow<S>&row = block.rows[i], &other = block.rows[j];
    return block.turns ? turning_coupling(row, other, share) : self_coupling(row, other, share);
  };
  const S xy = k(0, 1), xz = k(0, 2), yz = k(1, 2);
  const Vec3<S> give = block.give;
  block.coupling = {{{k(0, 0) + give.x, xy, xz}, {xy, k(1, 1) + give.y, yz}, {xz, yz, k(2, 2) + give.z}}};
}

/// Returns K_ij between blocks at one body, without the mass share of j.
template <class S>
ISO_INLINE Mat3<S> block_coupling(const JointBlock<S>& i, bool i_is_a, const JointBlock<S>& j, bool j_is_a) {
  if (i.point && j.point) {
    const auto angular = [&](int r) { return i_is_a ? i.rows[r].angular_a : i.rows[r].angular_b; };
    const auto turn = [&](int r) { return j_is_a ? j.rows[r].turn_a : j.rows[r].turn_b; };
    Mat3<S> p = point_coupling<S>({angular(0), angular(1), angular(2)}, {turn(0), turn(1), turn(2)});
    p = p + Mat3<S>::identity();
    return i_is_a == j_is_a ? p : Mat3<S>{{-p.rows[0], -p.rows[1], -p.rows[2]}};
  }
  Mat3<S> k;
  const bool turns = i.turns || j.turns;  // linear parts meet nothing
  for (int r = 0; r < 3; ++r) {
    const JointRow<S>& row = i.rows[r];
    const Vec3<S> angular = i_is_a ? row.angular_a : row.angular_b;
    const auto with = [&](const JointRow<S>& other) {
      const Vec3<S> turn = j_is_a ? other.turn_a : other.turn_b;
      const S c = turns ? round_to<S>(dot_sum(angular, turn)) : coupling(row.linear, angular, other.linear, turn);
      return i_is_a == j_is_a ? c : -c;
    };
    k.rows[r] = {with(j.rows[0]), with(j.rows[1]), with(j.rows[2])};
  }
  return k;
}

}  // namespace isostep::detail
