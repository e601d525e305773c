// Rows of joints that hold angles: all three, the tilt of the z axes, the twist about them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_frames.hpp"

namespace isostep::detail {

/// Computes the rows that keep orientations equal. Symbols: 2 (x, y, z) of the relative rotation is the error angle to
/// first order, in a's axes.
template <class S>
ISO_INLINE void weld_block(const JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h, JointConstraint<S>& joint) {
  const Quat<Unit<S>> q = relative_rotation(f);
  const S twice = S(2) * joint.radius;
  JointBlock<S>& block = joint.blocks[1];
  block.point = false;
  for (int i = 0; i < 3; ++i) block.rows[i] = angular_row<S>(a.column(i), joint.radius);
  block.error = {bounded_error(twice * q.x, h), bounded_error(twice * q.y, h), bounded_error(twice * q.z, h)};
}

/// [1] Returns the error `across` of two axes that should coincide. `along`, that of the other axis, keeps it from
/// being zero where they point in opposite directions: there their cross product is zero, as where they coincide.
template <class U> ISO_INLINE U part_across(U across, U along) {
  if (!(along < U(0))) return across;
  return across < U(0) ? across + along : across - along;
}

/// Computes the rows that keep z axes together. Symbols: z_a x z_b is the rotation, to first order, of b's axis from
/// a's; it has no part along z_a.
template <class S>
ISO_INLINE void axle_block(const JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h, JointConstraint<S>& joint) {
  const Vec3<Unit<S>> tilt = transposed_times(a, to_matrix(f.b).column(2));  // b's axis in a's frame
  JointBlock<S>& block = joint.blocks[1];
  block.point = false;
  block.rows[0] = angular_row<S>(a.column(0), joint.radius);
  block.rows[1] = angular_row<S>(a.column(1), joint.radius);
  block.rows[2] = JointRow<S>::zero();
  block.error = {bounded_error(-(joint.radius * tilt.y), h),
                 bounded_error(joint.radius * part_across(tilt.x, tilt.z), h), Velocity<S>(0)};
}

/// Sets the drive of the angle about z while the z axes coincide.
template <class S>
ISO_INLINE void linearise_turn(const JointFrames<S>& f, const Mat3<Unit<S>>& a, JointConstraint<S>& joint) {
  if (joint.drive_count == 0) return;
  joint.drives[0].row = angular_row<S>(a.column(2), joint.drives[0].radius);
  set_angle(joint.drives[0], joint.properties, twist_angle<S>(relative_rotation(f)));
}

/// [1] The least cos(swing / 2) at which twist is limited: within 14 degrees of half a turn it changes faster than a
/// sub-step follows, and at half a turn it has no meaning.
template <class S> inline constexpr S kLeastTwistCosine = S(1.0 / 8);

/// [rad] The swing at which a joint with a limited, locked or sprung twist stops: 149 degrees. There a twist changes
/// four times as fast as bodies turn. Beyond half a turn b comes back with another twist, and forces on that would turn
/// b with energy that it never took.
template <class S> inline constexpr S kTwistEnds = S(2.6);
/// [rad] Returns the swing at which a joint with a cone or a held twist stops.
template <class S> ISO_INLINE S most_swing(const JointProperties<S>& p, bool holds_twist) {
  const bool cone = (p.flags & joint_flag::kCone) != 0;
  return !cone ? kTwistEnds<S> : holds_twist ? min(p.cone, kTwistEnds<S>) : p.cone;
}

/// The twist, about z, of a rotation that also swings. Its rate is the relative angular velocity about the mean of the
/// two z axes, divided by cos(swing / 2).
template <class S> struct Twist {
  Vec3<Unit<S>> axis;
  S cosine;  // [1] of half the swing, kLeastTwistCosine or more
};
template <class S> ISO_INLINE Twist<S> twist_of(Vec3<Unit<S>> za, Vec3<Unit<S>> zb) {
  using U = Unit<S>;
  const U half = U(0.5);
  const Vec3<U> sum = za * half + zb * half;  // as long as cos(swing / 2)
  const Direction<U> mean = direction_of(sum.x, sum.y, sum.z);
  return {{mean.x, mean.y, mean.z}, max(convert<S>(mean.length), kLeastTwistCosine<S>)};
}

/// Sets the drive of the twist. Where the twist has no meaning no limit acts.
template <class S, class Asked>
ISO_INLINE void set_twist(const JointFrames<S>& f, Vec3<Unit<S>> za, Vec3<Unit<S>> zb, bool limit, const Asked& asked,
                          JointDrive<S>& drive) {
  const Twist<S> twist = twist_of<S>(za, zb);
  drive.row = angular_row<S>(twist.axis, drive.radius / twist.cosine);
  drive.bounded_below = drive.bounded_above = limit && kLeastTwistCosine<S> < twist.cosine;
  set_angle(drive, asked, twist_angle<S>(relative_rotation(f)));
}
/// Locks the twist about z.
template <class S>
ISO_INLINE void lock_twist(const JointFrames<S>& f, Vec3<Unit<S>> za, Vec3<Unit<S>> zb, Step<S> h,
                           JointConstraint<S>& joint) {
  const Twist<S> twist = twist_of<S>(za, zb);
  JointBlock<S>& block = joint.blocks[1];
  block.rows[2] = angular_row<S>(twist.axis, joint.radius / twist.cosine);
  block.error.z = bounded_error(joint.radius * twist_angle<S>(relative_rotation(f)), h);
}

/// Sets the drive of the swing: the angle between the z axes, about their common normal. Aligned axes have no row.
template <class S> ISO_INLINE void linearise_swing(Vec3<Unit<S>> za, Vec3<Unit<S>> zb, S most, JointDrive<S>& drive) {
  using U = Unit<S>;
  const Vec3<U> n = cross(za, zb);
  const Direction<U> axis = direction_of(n.x, n.y, n.z);
  drive.row = angular_row<S>({axis.x, axis.y, axis.z}, drive.radius);
  drive.position = atan2_to<S>(axis.length, dot(za, zb)) * drive.radius;
  drive.upper = most * drive.radius;
}

}  // namespace isostep::detail
