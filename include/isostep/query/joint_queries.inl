// Bodies of joint_queries.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "isostep/query/joint_queries.hpp"

namespace isostep::detail {

/// The frames of a joint in the world, by the present poses of its bodies.
template <class S> struct JointPoses { Pose<S> a, b; };
template <class S> ISO_INLINE JointPoses<S> poses_of(const BodyMap<S>& map, const JointProperties<S>& joint) {
  return {compose(map.centre_pose_at(joint.body_a), joint.frame_a),
          compose(map.centre_pose_at(joint.body_b), joint.frame_b)};
}

template <class S> S joint_error(const BodyMap<S>& map, JointId joint) {
  const JointProperties<S>* properties = map.joints.properties_of(joint);
  if (properties == nullptr) return S(0);
  const JointPoses<S> poses = poses_of(map, *properties);
  return visit_joint_type(properties->type, [&](auto kind) ISO_INLINE_LAMBDA {
    return decltype(kind)::template Of<S>::error(*properties, poses.a, poses.b);
  });
}

/// Returns the frames of a joint, and leaves the arms unset.
template <class S> ISO_INLINE JointFrames<S> frames_of(const BodyMap<S>& map, const JointProperties<S>& joint) {
  const JointPoses<S> poses = poses_of(map, joint);
  const Vec3<S> none = Vec3<S>::zero();
  return {none, none, poses.b.position - poses.a.position, poses.a.orientation, poses.b.orientation};
}
template <class S> S joint_position(const BodyMap<S>& map, JointId joint) {
  const JointProperties<S>* properties = map.joints.properties_of(joint);
  return properties == nullptr ? S(0) : position_of(properties->type, frames_of(map, *properties));
}
template <class S> S joint_position(const WorldState<S>& state, const BodyMap<S>& map, JointId joint, JointAxis axis) {
  const JointProperties<S>* properties = map.joints.properties_of(joint);
  if (properties == nullptr || properties->type != JointType::six_axis) return S(0);
  const auto& drives = state.records->axis_drives;
  const auto find = [&](JointAxis of) { return drives.find(drive_on(*state.records, joint, of)); };
  const bool swings = axis == JointAxis::swing_x || axis == JointAxis::swing_y;
  const int tilting =
      swings ? tilting_swing(properties->flags, find(JointAxis::swing_x), find(JointAxis::swing_y)) : -1;
  return position_of(axis, properties->flags, tilting, frames_of(map, *properties));
}

}  // namespace isostep::detail
