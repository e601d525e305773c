// Distance joint: rod, rope or spring between two points.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_frames.hpp"

namespace isostep::detail {

/// Coinciding points have no direction: y is taken, and a rod grows along it.
template <class S> ISO_INLINE void linearise_distance(const JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
  const Direction<S> d = direction_of(f.between.x, f.between.y, f.between.z);
  const Vec3<Unit<S>> unit =
      d.length > S(0) ? Vec3<Unit<S>>{d.x, d.y, d.z} : Vec3<Unit<S>>{Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  const JointProperties<S>& p = joint.properties;
  const Vec3<S> zero = Vec3<S>::zero();
  const JointRow<S> row = {convert<S>(unit), cross(f.arm_a, unit), cross(f.arm_b, unit), zero, zero};
  JointBlock<S>& block = joint.blocks[0];
  empty_block(block);
  if (joint.drive_count == 0) {
    block.rows[0] = row;
    block.error.x = bounded_error(d.length - p.upper, h);
    return;
  }
  JointDrive<S>& drive = joint.drives[0];
  drive.row = row;
  drive.position = d.length;
  drive.lower = p.lower;
  drive.upper = p.upper;
  drive.target = p.spring_target;
}

}  // namespace isostep::detail
