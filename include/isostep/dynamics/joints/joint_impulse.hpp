// JointImpulse<S>: what a joint does to its bodies, in sum.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"

namespace isostep {

/// Holds the summed impulses of all rows over a step's sub-steps, on b, as velocity changes of the pair's reduced mass.
template <class S> struct JointImpulse {
  Vec3<S> linear;   // [m/s] world
  Vec3<S> angular;  // [m^2/s] world, about b's origin of the joint

  static ISO_INLINE constexpr JointImpulse zero() { return {Vec3<S>::zero(), Vec3<S>::zero()}; }
  ISO_FIELDS(linear, angular)
};

namespace detail {

template <class S> ISO_INLINE void add_row(JointImpulse<S>& sum, const JointRow<S>& row, Vec3<S> arm, Velocity<S> by) {
  if (by == Velocity<S>(0)) return;
  const Vec3<S> turning = row.angular_b - cross(arm, row.linear);
  for (int k = 0; k < 3; ++k) {
    sum.linear[k] = saturating_add(sum.linear[k], saturate_to<S>(product(row.linear[k], by)));
    sum.angular[k] = saturating_add(sum.angular[k], saturate_to<S>(product(turning[k], by)));
  }
}

/// Adds the impulses of a sub-step. Kernels leave points without rows: their rows are the axes.
template <class S> ISO_INLINE void add_impulses(const JointConstraint<S>& joint, JointImpulse<S>& sum) {
  const bool point = holds_point(joint.properties), alone = joint.block_count == 1 && joint.drive_count == 0;
  for (int k = 0; k < 3 && point; ++k) {
    const Velocity<S> by = joint.blocks[0].impulse[k];
    const S along = alone ? convert<S>(by) : saturate_to<S>(product(S(1), by));
    sum.linear[k] = saturating_add(sum.linear[k], along);
  }
  for (std::uint32_t i = point ? 1 : 0; i < joint.block_count; ++i) {
    for (int r = 0; r < 3; ++r) add_row(sum, joint.blocks[i].rows[r], joint.arm_b, joint.blocks[i].impulse[r]);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i)
    add_row(sum, joint.drives[i].row, joint.arm_b, joint.drives[i].impulse);
}

}  // namespace detail

}  // namespace isostep
