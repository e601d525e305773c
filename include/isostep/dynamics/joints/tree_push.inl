// Speeds along the rows of W trees, and impulses on their bodies. Part of tree_kernel.inl, with internal linkage like
// it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/tree_factor.inl"
#include "isostep/scalar/lanes_bounded.hpp"

namespace isostep {
namespace {

/// Computes speeds along rows and pushes bodies, both within half of the format: a pass with drives on wrong pieces can
/// leave any speed.
template <class S, int W, class Isa> struct TreePusher : TreeFactoriser<S, W, Isa> {
  using Base = TreeFactoriser<S, W, Isa>;
  using Base::load;
  using Base::store;
  using Base::times;
  using typename Base::Body;
  using typename Base::Joint;
  using typename Base::L;
  using typename Base::Mask;
  using typename Base::Memory;
  using typename Base::Node;
  using typename Base::Rows;
  using typename Base::U;
  using typename Base::V;

  static ISO_INLINE Vec3<V> times(L a, Vec3<V> v) { return {times(a, v.x), times(a, v.y), times(a, v.z)}; }
  static ISO_INLINE Vec3<V> times(const Mat3<L>& a, Vec3<V> v) {
    return {round_to<V>(dot_sum(a.rows[0], v)), round_to<V>(dot_sum(a.rows[1], v)), round_to<V>(dot_sum(a.rows[2], v))};
  }
  static ISO_INLINE Vec3<V> bounded(Vec3<V> v, Velocity<S> most) {
    const V high = V::broadcast(most), low = -high;
    return {clamp(v.x, low, high), clamp(v.y, low, high), clamp(v.z, low, high)};
  }

  // ---- speeds

  static ISO_INLINE Vec3<V> speed(const TreeShape& shape, const TreeNode& node, Memory m) {
    const TreeJoint& of = shape.joints[node.joint];
    const Body &a = m.bodies[of.body_a], &b = m.bodies[of.body_b];
    if (node.is_point()) return point_speed(m.joints[node.joint], a, b);
    const Rows& rows = m.rows[node.rows];
    const auto along = [&](int r) ISO_INLINE_LAMBDA { return row_speed(node, rows, r, a, b); };
    return {along(0), along(1), along(2)};
  }
  static ISO_INLINE V speed_along(const TreeShape& shape, const TreeDrive& drive, Memory m) {
    const TreeNode& node = shape.nodes[drive.node];
    const TreeJoint& of = shape.joints[drive.joint];
    return row_speed(node, m.rows[node.rows], static_cast<int>(drive.place), m.bodies[of.body_a], m.bodies[of.body_b]);
  }

  // ---- impulses

  /// Applies all impulses of a joint.
  static ISO_INLINE void push_all(const TreeRun<S>& run, std::uint32_t j, Memory m) {
    const TreeJoint& of = run.shape.joints[j];
    const Vec3<V> none = {V::zero(), V::zero(), V::zero()};
    if (!of.turns) return push(run.shape, of, m, load(m.nodes[of.node].impulse), none, 0);
    const std::uint32_t clear = run.shape.nodes[of.node - 1].may_idle ? run.clear[j] : 0;
    push(run.shape, of, m, load(m.nodes[of.node].impulse), load(m.nodes[of.node - 1].impulse), clear);
  }
  /// Adds a joint's solutions to its impulses, and applies the changes to the bodies.
  static ISO_INLINE void push_changes(const TreeRun<S>& run, std::uint32_t j, Memory m, Softness<S> soft) {
    const TreeJoint& of = run.shape.joints[j];
    const Vec3<V> none = {V::zero(), V::zero(), V::zero()};
    const Vec3<V> place = add_solution(run, of.node, m, soft);
    if (!of.turns) return push(run.shape, of, m, place, none, 0);
    const std::uint32_t idle = run.shape.nodes[of.node - 1].may_idle ? run.idle[of.node - 1] & Base::kAll : 0;
    push(run.shape, of, m, place, add_solution(run, of.node - 1, m, soft), idle);
  }
  /// Applies a change of one drive's impulse. Bodies in lanes without a change stay as they are, signs of zeros too.
  static ISO_INLINE void push_row(const TreeShape& shape, const TreeDrive& drive, Memory m, V change) {
    const Mask acts = ~equal(change, V::zero());
    if (!any(acts)) return;
    const TreeNode& node = shape.nodes[drive.node];
    const TreeJoint& of = shape.joints[drive.joint];
    const Joint& joint = m.joints[drive.joint];
    const Rows& rows = m.rows[node.rows];
    const auto add = [&](V p, const S(&by)[9][W], Velocity<S>(&field)[3][W]) ISO_INLINE_LAMBDA {
      const Vec3<L> row = row_of(by, static_cast<int>(drive.place));
      for (int k = 0; k < 3; ++k) {
        const V old = V::load(field[k]), next = with_headroom(old) + round_with_headroom<V>(product(row[k], p));
        select(acts, next, old).store(field[k]);
      }
    };
    const auto push_body = [&](V p, const S(&turn)[9][W], Body& body) ISO_INLINE_LAMBDA {
      if (!node.of_angles) add(p, rows.linear, body.linear);
      add(p, turn, body.angular);
    };
    if (of.a_moves) push_body(-times(L::load(joint.share_a), change), rows.turn_a, m.bodies[of.body_a]);
    if (of.b_moves) push_body(times(L::load(joint.share_b), change), rows.turn_b, m.bodies[of.body_b]);
  }

 private:
  /// Does speed_along() of joint_rows.hpp: v + w x r of b less that of a.
  static ISO_INLINE Vec3<V> point_speed(const Joint& joint, const Body& a, const Body& b) {
    const Vec3<L> ra = load(joint.arm_a), rb = load(joint.arm_b);
    const Vec3<V> wa = load(a.angular), wb = load(b.angular);
    const Vec3<V> turning = {
        round_with_headroom<V>(product(rb.z, wb.y) - product(rb.y, wb.z) - product(ra.z, wa.y) + product(ra.y, wa.z)),
        round_with_headroom<V>(product(rb.x, wb.z) - product(rb.z, wb.x) - product(ra.x, wa.z) + product(ra.z, wa.x)),
        round_with_headroom<V>(product(ra.x, wa.y) - product(ra.y, wa.x) - product(rb.x, wb.y) + product(rb.y, wb.x))};
    const Vec3<V> between = with_headroom(load(b.linear)) - with_headroom(load(a.linear));
    return with_headroom(with_headroom(between) + turning);
  }
  static ISO_INLINE Vec3<L> row_of(const S (&field)[9][W], int r) {
    return {L::load(field[3 * r]), L::load(field[3 * r + 1]), L::load(field[3 * r + 2])};
  }
  static ISO_INLINE V row_speed(const TreeNode& node, const Rows& rows, int r, const Body& a, const Body& b) {
    const auto turning =
        dot_sum(row_of(rows.angular_b, r), load(b.angular)) - dot_sum(row_of(rows.angular_a, r), load(a.angular));
    if (node.of_angles) return round_with_headroom<V>(turning);
    const Vec3<V> between = with_headroom(load(b.linear)) - with_headroom(load(a.linear));
    return round_with_headroom<V>(dot_sum(row_of(rows.linear, r), between) + turning);
  }

  /// Adds the solution to a node's impulses and returns the change. A drive's solution is scaled like its row.
  static ISO_INLINE Vec3<V> add_solution(const TreeRun<S>& run, std::uint32_t n, Memory m, Softness<S> soft) {
    const TreeNode& of = run.shape.nodes[n];
    Node& node = m.nodes[n];
    const V none = V::zero();
    if (Base::idles(run, n)) return {none, none, none};
    Vec3<V> solution = load(node.right);
    const Vec3<V> old = load(node.impulse);
    for (std::uint32_t d = of.first_drive; d < of.first_drive + of.drive_count; ++d) {
      V& of_drive = solution[static_cast<int>(run.shape.drives[d].place)];
      of_drive = round_to<V>(product(U::load(m.drives[d].scale), of_drive));
    }
    if (run.shape.soft) solution = softened(run, of, m, solution, old, soft);
    Vec3<V> impulse = bounded(old + solution, most_joint_impulse<S>());
    if (of.may_idle) impulse = select(Base::idle_lanes(run, n), old, impulse);
    store(impulse, node.impulse);
    return impulse - old;
  }
  /// Does next() of push_joint(). The impulse of a drive on a constant piece stays.
  static ISO_INLINE Vec3<V> softened(const TreeRun<S>& run, const TreeNode& of, Memory m, Vec3<V> solution, Vec3<V> old,
                                     Softness<S> soft) {
    const L scale = Base::number(soft.mass_scale), less_old = Base::number(soft.impulse_scale);
    Vec3<V> change = times(scale, solution) - times(less_old, old);
    for (std::uint32_t d = of.first_drive; d < of.first_drive + of.drive_count; ++d) {
      V& of_drive = change[static_cast<int>(run.shape.drives[d].place)];
      of_drive = select(equal(U::load(m.drives[d].scale), U::zero()), V::zero(), of_drive);
    }
    return change;
  }

  /// `still`: lanes in which the angles push nothing, not even a zero, since that has a sign.
  static ISO_INLINE void push(const TreeShape& shape, const TreeJoint& of, Memory m, Vec3<V> place, Vec3<V> angle,
                              std::uint32_t still) {
    const Joint& joint = m.joints[shape.nodes[of.node].joint];
    if (shape.row_blocks == 0) return push_point(of, m, joint, place);
    if (of.a_moves) {
      const L share = L::load(joint.share_a);
      push_body<true>(shape, of, m, -times(share, place), -times(share, angle), still);
    }
    if (of.b_moves) {
      const L share = L::load(joint.share_b);
      push_body<false>(shape, of, m, times(share, place), times(share, angle), still);
    }
  }
  static ISO_INLINE void push_point(const TreeJoint& of, Memory m, const Joint& joint, Vec3<V> impulse) {
    if (of.a_moves) {
      Body& body = m.bodies[of.body_a];
      const Vec3<V> p = times(L::load(joint.share_a), impulse);
      store(load(body.linear) - p, body.linear);
      store(load(body.angular) - times(load(joint.turn_a), p), body.angular);
    }
    if (of.b_moves) {
      Body& body = m.bodies[of.body_b];
      const Vec3<V> p = times(L::load(joint.share_b), impulse);
      store(load(body.linear) + p, body.linear);
      store(load(body.angular) + times(load(joint.turn_b), p), body.angular);
    }
  }
  /// Pushes a body by all rows of a joint at once. On a long arm a drive and the point turn a light body hard against
  /// each other, beyond the range of velocities, while their sum is small.
  template <bool IsA>
  static ISO_INLINE void push_body(const TreeShape& shape, const TreeJoint& of, Memory m, Vec3<V> place, Vec3<V> angle,
                                   std::uint32_t still) {
    Body& body = m.bodies[IsA ? of.body_a : of.body_b];
    const TreeNode& node = shape.nodes[of.node];
    const Joint& joint = m.joints[node.joint];
    const auto add = [](Velocity<S>(&field)[3][W], int k, auto sum) ISO_INLINE_LAMBDA {
      (with_headroom(V::load(field[k])) + round_with_headroom<V>(sum)).store(field[k]);
    };
    const auto across = [](const Mat3<L>& rows, int k, Vec3<V> p) ISO_INLINE_LAMBDA {
      return product(rows.rows[0][k], p.x) + product(rows.rows[1][k], p.y) + product(rows.rows[2][k], p.z);
    };
    Mat3<L> turn;  // rows of the places' turns
    if (node.is_point()) {
      turn = transpose(load(IsA ? joint.turn_a : joint.turn_b));
      store(with_headroom(load(body.linear)) + place, body.linear);
    } else {
      turn = load(IsA ? m.rows[node.rows].turn_a : m.rows[node.rows].turn_b);
      const Mat3<L> linear = load(m.rows[node.rows].linear);
      for (int k = 0; k < 3; ++k) add(body.linear, k, across(linear, k, place));
    }
    if (!of.turns || still == Base::kAll) {
      for (int k = 0; k < 3; ++k) add(body.angular, k, across(turn, k, place));
      return;
    }
    const Rows& rows = m.rows[shape.nodes[of.node - 1].rows];
    const Mat3<L> other = load(IsA ? rows.turn_a : rows.turn_b);
    if (still == 0) {
      for (int k = 0; k < 3; ++k) add(body.angular, k, across(turn, k, place) + across(other, k, angle));
      return;
    }
    const Mask none = Mask::from_bits(still);
    for (int k = 0; k < 3; ++k) {
      const auto of_place = across(turn, k, place), of_both = of_place + across(other, k, angle);
      const V old = with_headroom(V::load(body.angular[k]));
      const V by_place = round_with_headroom<V>(of_place), by_both = round_with_headroom<V>(of_both);
      select(none, old + by_place, old + by_both).store(body.angular[k]);
    }
  }
};

}  // namespace
}  // namespace isostep
