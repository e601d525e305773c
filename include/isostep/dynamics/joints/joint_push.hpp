// JointPush<S>: all changes of impulse of a joint, applied to its bodies at once.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint.hpp"

namespace isostep::detail {

/// Collects the impulse changes of a joint's rows, so that bodies are pushed once by all. On a long arm a drive and the
/// point turn a light body hard against each other, beyond the range of velocities, while their sum is small.
template <class S> class JointPush {
 public:
  using V = Velocity<S>;

  ISO_INLINE void add(const JointRow<S>& row, V change) {
    if (change == V(0)) return;
    rows_[count_] = &row;
    changes_[count_++] = change;
  }
  ISO_INLINE void add(const JointBlock<S>& block, Vec3<V> change) {
    for (int r = 0; r < 3; ++r) add(block.rows[r], change[r]);
  }
  ISO_INLINE void apply(const JointConstraint<S>& joint, SolverBodies<S>& bodies) const {
    if (bodies.moves(joint.row_a)) {
      const MotionRow<V> change = total(joint.share.a, [](const JointRow<S>& row) { return row.turn_a; });
      push(bodies.velocity[joint.row_a], -change.linear, -change.angular);
    }
    if (bodies.moves(joint.row_b)) {
      const MotionRow<V> change = total(joint.share.b, [](const JointRow<S>& row) { return row.turn_b; });
      push(bodies.velocity[joint.row_b], change.linear, change.angular);
    }
  }

 private:
  static ISO_INLINE void push(MotionRow<V>& velocity, Vec3<V> linear, Vec3<V> angular) {
    velocity.linear = saturating_add(velocity.linear, linear);
    velocity.angular = saturating_add(velocity.angular, angular);
  }
  template <class Turn> ISO_INLINE MotionRow<V> total(S share, const Turn& turn) const {
    const auto zero = product(S(0), V(0));
    decltype(product(S(0), V(0))) linear[3] = {zero, zero, zero}, angular[3] = {zero, zero, zero};
    for (std::uint32_t i = 0; i < count_; ++i) {
      const V change = scaled(share, changes_[i]);
      const Vec3<S> along = rows_[i]->linear, about = turn(*rows_[i]);
      for (int k = 0; k < 3; ++k) {
        linear[k] = linear[k] + product(along[k], change);
        angular[k] = angular[k] + product(about[k], change);
      }
    }
    // A sum of all rows beyond half of the format is held there: a larger one does not fit with a velocity.
    const auto held = [](auto sum) {
      const auto most = widen<decltype(sum)>(DriveBounds<S>::limitless());
      return round_to<V>(clamp(sum, -most, most));
    };
    const auto rounded = [&](const auto(&sum)[3]) { return Vec3<V>{held(sum[0]), held(sum[1]), held(sum[2])}; };
    return {rounded(linear), V(0), rounded(angular), V(0)};
  }

  static constexpr std::uint32_t kMost = 2 * kJointRows;  // of blocks and of drives
  const JointRow<S>* rows_[kMost];
  V changes_[kMost];
  std::uint32_t count_ = 0;
};

}  // namespace isostep::detail
