// Hinge: points and z axes coincide; the angle about z may be limited, driven and sprung.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_frames.hpp"

namespace isostep::detail {

/// Symbols: z_a x z_b is the rotation, to first order, by which b's axis has left a's; it has no part along z_a.
template <class S> ISO_INLINE void linearise_hinge(const JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
  point_block(f, h, joint.blocks[0]);
  const Mat3<Unit<S>> a = to_matrix(f.a);
  const Vec3<Unit<S>> tilt = transposed_times(a, to_matrix(f.b).column(2));  // b's axis in a's frame
  JointBlock<S>& block = joint.blocks[1];
  block.point = false;
  block.rows[0] = angular_row<S>(a.column(0), joint.radius);
  block.rows[1] = angular_row<S>(a.column(1), joint.radius);
  block.rows[2] = JointRow<S>::zero();
  block.error = {bounded_error(-(joint.radius * tilt.y), h), bounded_error(joint.radius * tilt.x, h), Velocity<S>(0)};
  if (joint.drive_count == 0) return;
  joint.drives[0].row = angular_row<S>(a.column(2), joint.drives[0].radius);
  set_angle(joint.drives[0], joint.properties, twist_angle<S>(relative_rotation(f)));
}

}  // namespace isostep::detail
