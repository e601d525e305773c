// Ball joint: two points coincide; a cone bounds the swing and an interval the twist of a shoulder or a hip.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/point_joint.hpp"

namespace isostep {

namespace detail {
/// [1] least cos(swing / 2) at which twist is limited: within 14 degrees of half a turn it changes faster than a
/// sub-step follows, and at half a turn it means nothing.
template <class S> inline constexpr S kLeastTwistCosine = S(1.0 / 8);

/// Twist, about z, of a rotation that also swings: its rate is the relative angular velocity about the mean of the two
/// z axes, divided by cos(swing / 2).
template <class S>
ISO_INLINE void linearise_twist(const JointFrames<S>& f, Vec3<Unit<S>> za, Vec3<Unit<S>> zb,
                                JointConstraint<S>& joint) {
  using U = Unit<S>;
  const U half = U(0.5);
  const Vec3<U> sum = za * half + zb * half;  // as long as cos(swing / 2)
  const Direction<U> mean = direction_of(sum.x, sum.y, sum.z);
  JointDrive<S>& drive = joint.drives[0];
  const S cosine = max(convert<S>(mean.length), kLeastTwistCosine<S>);
  drive.row = angular_row<S>({mean.x, mean.y, mean.z}, drive.radius / cosine);
  const bool limit = (joint.properties.flags & joint_flag::kLimit) != 0;
  drive.bounded_below = drive.bounded_above = limit && kLeastTwistCosine<S> < cosine;
  set_angle(drive, joint.properties, twist_angle<S>(relative_rotation(f)));
}
/// Swing: the angle between the z axes, about their common normal. Aligned axes have none, and no row.
template <class S> ISO_INLINE void linearise_swing(Vec3<Unit<S>> za, Vec3<Unit<S>> zb, JointConstraint<S>& joint) {
  using U = Unit<S>;
  const Vec3<U> n = cross(za, zb);
  const Direction<U> axis = direction_of(n.x, n.y, n.z);
  JointDrive<S>& drive = joint.drives[1];
  drive.row = angular_row<S>({axis.x, axis.y, axis.z}, drive.radius);
  drive.position = atan2_to<S>(axis.length, dot(za, zb)) * drive.radius;
  drive.upper = joint.properties.cone * drive.radius;
}

}  // namespace detail

/// Origins coincide. kLimit: lower..upper of the twist about z; kCone: of the angle between the z axes.
template <class S> struct BallJoint : detail::PointJoint<S> {
  static constexpr JointType kType = JointType::ball;
  static constexpr std::uint32_t kFlags = joint_flag::kCollideConnected | joint_flag::kLimit | joint_flag::kCone;
  static constexpr const char* kFlagNames = "of a ball joint kLimit, kCone, kCollideConnected";
  static constexpr JointMeasure kMeasure = JointMeasure::angle;
  static constexpr bool kDrivesAlone = true;

  static ISO_INLINE void count_rows(JointConstraint<S>& joint) {
    const bool limit = (joint.properties.flags & joint_flag::kLimit) != 0;
    const bool cone = (joint.properties.flags & joint_flag::kCone) != 0;
    joint.block_count = cone || limit ? 2 : 1;
    joint.drive_count = cone || limit ? 2 : 0;
    joint.drives[0].bounded_below = joint.drives[0].bounded_above = limit;
    joint.drives[1].bounded_above = cone;
  }
  static ISO_INLINE void linearise(const detail::JointFrames<S>& f, Step<S> h, JointConstraint<S>& joint) {
    detail::point_block(f, h, joint.blocks[0]);
    if (joint.drive_count == 0) return;
    detail::empty_block(joint.blocks[1]);
    const Vec3<Unit<S>> za = to_matrix(f.a).column(2), zb = to_matrix(f.b).column(2);
    detail::linearise_twist(f, za, zb, joint);
    detail::linearise_swing(za, zb, joint);
  }
};

}  // namespace isostep
