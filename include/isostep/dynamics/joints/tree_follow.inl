// Joints of W trees whose angles are measured once a step, and followed in its other sub-steps. Part of
// tree_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/tree_laws.inl"

namespace isostep {
namespace {

/// Joints at a point with motors, springs or servos of angles. They are measured at the start of a step, and again once
/// their bodies turned by kMostTurn against each other. Between, rows stand still in frame a, and errors and angles
/// follow what the bodies turn along them.
/// Error:   none of a hinge. Of a swing, whose row turns too, half the square of what b turned against a: 1/512 rad.
/// Why:     measured in every sub-step they take a quarter of a step of human_rain. Measured once a step, what turns
///          fast passes its limits by .14 rad.
template <class S, int W, class Isa> struct TreeFollower : TreeLaws<S, W, Isa> {
  using Base = TreeLaws<S, W, Isa>;
  using Base::load;
  using Base::number;
  using Base::store;
  using Base::times;
  using typename Base::Drive;
  using typename Base::L;
  using typename Base::Law;
  using typename Base::Mask;
  using typename Base::Memory;
  using typename Base::Rows;
  using typename Base::V;

  /// Keeps the rows that were measured in this sub-step as they stand in frame a.
  static ISO_INLINE void keep_rows(const TreeRun<S>& run, Memory m) {
    for (std::size_t j = 0; j < run.shape.joints.size(); ++j) {
      const TreeJoint& of = run.shape.joints[j];
      if (!of.follows || run.stale[j] == 0) continue;
      const Mask which = Mask::from_bits(run.stale[j]);
      Rows& rows = m.rows[run.shape.nodes[of.node - 1].rows];
      const auto a = load(m.bodies[of.body_a].rotation);
      const Mat3<L> now = load(rows.angular_a), old = load(rows.linear);
      Mat3<L> kept;
      ISO_UNROLL for (int r = 0; r < 3; ++r) kept.rows[r] =
          select(which, transposed_times(a, now.rows[r]), old.rows[r]);
      store(kept, rows.linear);
      select(which, V::zero(), V::load(m.joints[j].turned)).store(m.joints[j].turned);
      run.stale[j] = 0;
    }
  }
  /// Turns the rows with a, and moves errors, angles and laws by what bodies turned since the last sub-step. Joints
  /// that turned too far since they were measured are stale.
  static ISO_INLINE void follow(const TreeRun<S>& run, Memory m, Step<S> h) {
    for (std::size_t j = 0; j < run.shape.joints.size(); ++j) {
      const TreeJoint& of = run.shape.joints[j];
      if (!of.follows || run.stale[j] != 0) continue;
      const Vec3<V> turn = load(m.bodies[of.body_b].turned) - load(m.bodies[of.body_a].turned);
      const V turned = V::load(m.joints[j].turned) + max_abs(turn);
      turned.store(m.joints[j].turned);
      run.stale[j] = to_bits(less(V::broadcast(kMostTurn), turned));
      if (run.stale[j] != Base::kAll) follow(run, of, turn, m, h);
    }
  }

 private:
  /// [rad] Bodies of a joint may turn against each other by that much before it is measured again.
  static constexpr Velocity<S> kMostTurn = Velocity<S>(1.0 / 16);

  static ISO_INLINE void follow(const TreeRun<S>& run, const TreeJoint& of, const Vec3<V>& turn, Memory m, Step<S> h) {
    const TreeNode& node = run.shape.nodes[of.node - 1];
    Rows& rows = m.rows[node.rows];
    const auto a = load(m.bodies[of.body_a].rotation);
    const Mat3<L> kept = load(rows.linear);
    Mat3<L> now;
    ISO_UNROLL for (int r = 0; r < 3; ++r) now.rows[r] = a * kept.rows[r];
    store(now, rows.angular_a);
    store(now, rows.angular_b);
    const auto moved = [&](int r) ISO_INLINE_LAMBDA { return round_with_headroom<V>(dot_sum(now.rows[r], turn)); };
    const V most = V::broadcast(convert<Velocity<S>>(S(32) * h));
    Vec3<V> error = load(m.nodes[of.node - 1].error);
    ISO_UNROLL for (int r = 0; r < 3; ++r) error[r] = clamp(error[r] + moved(r), -most, most);
    store(error, m.nodes[of.node - 1].error);
    for (std::uint32_t d = node.first_drive; d < node.first_drive + node.drive_count; ++d) {
      const TreeDrive& drive = run.shape.drives[d];
      move(m.drives[d], m.laws[drive.law], moved(static_cast<int>(drive.place)), Base::speed_along(run.shape, drive, m),
           h);
    }
  }
  static ISO_INLINE void move(Drive& drive, Law& law, V by, V speed, Step<S> h) {
    const L way = convert<L>(by), none = number(highest<S>());
    const L above = L::load(drive.above_lower), below = L::load(drive.below_upper);
    (above + select(less(above, none), way, L::zero())).store(drive.above_lower);
    (below - select(less(below, none), way, L::zero())).store(drive.below_upper);
    const V next = V::load(law.way) + by;
    next.store(law.way);
    const auto held = [](auto sum)
                          ISO_INLINE_LAMBDA { return round_within<V>(sum, convert<Velocity<S>>(Limits<S>::speed())); };
    const auto step = Lanes<Step<S>, W, Isa>::broadcast(h);
    const V error = next - times(L::load(law.lag), round_to<V>(product(step, speed)));
    const L w = L::load(law.spring), rate = L::load(law.rate);
    const V strong = held(product(w, held(product(rate, error))));
    const L weak_rate = select(less(w, number(S(1))), w, L::zero()) * rate;
    select(less(w, number(S(1))), held(product(weak_rate, error)), strong).store(law.spring_push);
  }
};

}  // namespace
}  // namespace isostep
