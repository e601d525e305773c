// Fixed joint: two frames coincide, as if welded.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_frames.hpp"

namespace isostep::detail {

/// Symbols: 2 (x, y, z) of the relative rotation is the error angle to first order, in a's axes.
template <class S> ISO_INLINE void linearise_fixed(const JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
  point_block(f, h, joint.blocks[0]);
  const Mat3<Unit<S>> a = to_matrix(f.a);
  const Quat<Unit<S>> q = relative_rotation(f);
  const S twice = S(2) * joint.radius;
  JointBlock<S>& block = joint.blocks[1];
  block.point = false;
  for (int i = 0; i < 3; ++i) block.rows[i] = angular_row<S>(a.column(i), joint.radius);
  block.error = {bounded_error(twice * q.x, h), bounded_error(twice * q.y, h), bounded_error(twice * q.z, h)};
}

}  // namespace isostep::detail
