// The couplings of the rows of W trees: the turns that they give bodies, and the entries of K between them. Part of
// tree_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/tree_stops.inl"

namespace isostep {
namespace {

/// The functions of joint_couplings.hpp, over lanes.
/// Symbols: r = arm from a body's centre to the joint, kappa = mass times inverse inertia. An impulse p at r turns the
///          body by C p, row i of C = kappa_i x r; that moves the end of another arm q of the body by (C p) x q.
template <class S, int W, class Isa> struct TreeCoupler : TreeStopper<S, W, Isa> {
  using Base = TreeStopper<S, W, Isa>;
  using Base::load;
  using Base::number;
  using Base::store;
  using typename Base::Joint;
  using typename Base::L;
  using typename Base::Memory;
  using typename Base::Rows;
  using typename Base::U;

  // ---- what rows turn

  static ISO_INLINE void set_turns(const TreeShape& shape, const TreeNode& node, Memory m) {
    const TreeJoint& of = shape.joints[node.joint];
    const Mat3<L> kappa_a = load(m.bodies[of.body_a].felt), kappa_b = load(m.bodies[of.body_b].felt);
    if (node.is_point()) {
      Joint& joint = m.joints[node.joint];
      store(turns(kappa_a, load(joint.arm_a)), joint.turn_a);
      store(turns(kappa_b, load(joint.arm_b)), joint.turn_b);
      return;
    }
    Rows& rows = m.rows[node.rows];
    const Mat3<L> a = load(rows.angular_a), b = load(rows.angular_b);
    store(Mat3<L>{{kappa_a * a.rows[0], kappa_a * a.rows[1], kappa_a * a.rows[2]}}, rows.turn_a);
    store(Mat3<L>{{kappa_b * b.rows[0], kappa_b * b.rows[1], kappa_b * b.rows[2]}}, rows.turn_b);
  }

  // ---- of one node

  /// Returns K between the node's own rows, the upper triangle. Drives are not scaled yet.
  static ISO_INLINE Mat3<L> self_coupling(const TreeNode& node, Memory m) {
    const Joint& joint = m.joints[node.joint];
    const L share_a = L::load(joint.share_a), share_b = L::load(joint.share_b);
    if (node.is_point()) return point_coupling(joint, share_a, share_b);
    const Rows& rows = m.rows[node.rows];
    const Mat3<L> a = load(rows.angular_a), b = load(rows.angular_b);
    const Mat3<L> turn_a = load(rows.turn_a), turn_b = load(rows.turn_b);
    Mat3<L> linear;
    if (!node.of_angles) linear = load(rows.linear);
    const auto k = [&](int i, int j) ISO_INLINE_LAMBDA {
      const auto half = [&](L share, const Mat3<L>& angular, const Mat3<L>& turn) ISO_INLINE_LAMBDA {
        if (node.of_angles) return share * round_to<L>(dot_sum(angular.rows[i], turn.rows[j]));
        return share * round_to<L>(dot_sum(linear.rows[i], linear.rows[j]) + dot_sum(angular.rows[i], turn.rows[j]));
      };
      return half(share_a, a, turn_a) + half(share_b, b, turn_b);
    };
    const L xy = k(0, 1), xz = k(0, 2), yz = k(1, 2);
    return {{{k(0, 0), xy, xz}, {xy, k(1, 1), yz}, {xz, yz, k(2, 2)}}};
  }
  /// Scales the rows of a node's drives: that of a weak spring yields, a constant impulse has none.
  static ISO_INLINE void scale_self(const TreeShape& shape, const TreeNode& node, Memory m, Mat3<L>& k) {
    for (std::uint32_t d = node.first_drive; d < node.first_drive + node.drive_count; ++d) {
      const int at = static_cast<int>(shape.drives[d].place);
      const U scale = U::load(m.drives[d].scale);
      k.rows[at] = k.rows[at] * scale;
      scale_column(k, at, scale);
      k.rows[at][at] = k.rows[at][at] + L::load(m.drives[d].give);
    }
  }

  // ---- between two nodes

  /// Computes K_ij and K_ji for node i and the node at the end of a link.
  static ISO_INLINE void couple(const TreeShape& shape, const TreeNode& i, const TreeLink& link, Memory m, Mat3<L>& up,
                                Mat3<L>& down) {
    const TreeNode& j = shape.nodes[link.to];
    const Joint &from = m.joints[i.joint], &to = m.joints[j.joint];
    if (link.of_one_joint) {
      const L share_a = L::load(from.share_a), share_b = L::load(from.share_b);
      up = scaled_by(at_body(i, true, j, true, m), share_a) + scaled_by(at_body(i, false, j, false, m), share_b);
      scale_drives(shape, i, j, m, up);
      down = transpose(up);
      return;
    }
    Mat3<L> k = at_body(i, link.from_is_a, j, link.to_is_a, m);
    if (link.from_is_a != link.to_is_a) k = {{-k.rows[0], -k.rows[1], -k.rows[2]}};
    scale_drives(shape, i, j, m, k);
    up = scaled_by(k, L::load(link.to_is_a ? to.share_a : to.share_b));
    down = scaled_by(transpose(k), L::load(link.from_is_a ? from.share_a : from.share_b));
  }

 private:
  static ISO_INLINE Mat3<L> turns(const Mat3<L>& kappa, Vec3<L> arm) {
    return {{cross(kappa.rows[0], arm), cross(kappa.rows[1], arm), cross(kappa.rows[2], arm)}};
  }
  static ISO_INLINE void scale_column(Mat3<L>& k, int at, U scale) {
    for (int r = 0; r < 3; ++r) k.rows[r][at] = k.rows[r][at] * scale;
  }
  static ISO_INLINE void scale_drives(const TreeShape& shape, const TreeNode& i, const TreeNode& j, Memory m,
                                      Mat3<L>& k) {
    for (std::uint32_t d = i.first_drive; d < i.first_drive + i.drive_count; ++d) {
      const int at = static_cast<int>(shape.drives[d].place);
      k.rows[at] = k.rows[at] * U::load(m.drives[d].scale);
    }
    for (std::uint32_t d = j.first_drive; d < j.first_drive + j.drive_count; ++d)
      scale_column(k, static_cast<int>(shape.drives[d].place), U::load(m.drives[d].scale));
  }

  /// Returns the motion of `arm`. Column j: by a unit impulse along j at another joint of the body, with turns `turn`.
  static ISO_INLINE Mat3<L> moved(const Mat3<L>& turn, Vec3<L> arm) {
    return transpose(Mat3<L>{{cross(turn.column(0), arm), cross(turn.column(1), arm), cross(turn.column(2), arm)}});
  }
  static ISO_INLINE Mat3<L> point_coupling(const Joint& joint, L share_a, L share_b) {
    const Mat3<L> a = moved(load(joint.turn_a), load(joint.arm_a)), b = moved(load(joint.turn_b), load(joint.arm_b));
    const L one = share_a + share_b;
    const auto mix = [&](L of_a, L of_b)
                         ISO_INLINE_LAMBDA { return round_to<L>(product(share_a, of_a) + product(share_b, of_b)); };
    const L xy = mix(a.rows[0].y, b.rows[0].y), xz = mix(a.rows[0].z, b.rows[0].z), yz = mix(a.rows[1].z, b.rows[1].z);
    return {{{one + mix(a.rows[0].x, b.rows[0].x), xy, xz},
             {xy, one + mix(a.rows[1].y, b.rows[1].y), yz},
             {xz, yz, one + mix(a.rows[2].z, b.rows[2].z)}}};
  }
  /// Returns the turns that a node's rows give its body, as columns.
  static ISO_INLINE Mat3<L> turn_columns(const TreeNode& node, bool is_a, Memory m) {
    if (node.is_point()) return load(is_a ? m.joints[node.joint].turn_a : m.joints[node.joint].turn_b);
    return transpose(load(is_a ? m.rows[node.rows].turn_a : m.rows[node.rows].turn_b));
  }
  /// Returns the coupling of both nodes' halves at one body, without the share of mass and the signs of the halves.
  static ISO_INLINE Mat3<L> at_body(const TreeNode& i, bool i_is_a, const TreeNode& j, bool j_is_a, Memory m) {
    const Mat3<L> turn = turn_columns(j, j_is_a, m);
    const bool meet = !i.of_angles && !j.of_angles;  // their linear parts
    Mat3<L> k;
    if (i.is_point()) {
      const Joint& joint = m.joints[i.joint];
      k = moved(turn, load(i_is_a ? joint.arm_a : joint.arm_b));
      if (!meet) return k;
      if (!j.is_point()) return k + transpose(load(m.rows[j.rows].linear));
      const L one = number(S(1));
      k.rows[0].x += one;
      k.rows[1].y += one;
      k.rows[2].z += one;
      return k;
    }
    const Rows& rows = m.rows[i.rows];
    const Mat3<L> angular = load(i_is_a ? rows.angular_a : rows.angular_b);
    if (!meet) return angular * turn;
    const Mat3<L> linear = load(rows.linear);
    if (j.is_point()) return angular * turn + linear;
    const Mat3<L> other = load(m.rows[j.rows].linear);
    for (int r = 0; r < 3; ++r) {
      const auto with = [&](int c) ISO_INLINE_LAMBDA {
        return round_to<L>(dot_sum(linear.rows[r], other.rows[c]) + dot_sum(angular.rows[r], turn.column(c)));
      };
      k.rows[r] = {with(0), with(1), with(2)};
    }
    return k;
  }
};

}  // namespace
}  // namespace isostep
