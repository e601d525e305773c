// Bodies of joint_queries.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_coordinate.hpp"
#include "isostep/query/joint_queries.hpp"

namespace isostep::detail {

template <class S> S joint_error(const BodyMap<S>& map, JointId joint) {
  const JointProperties<S>* properties = map.joints.properties_of(joint);
  if (properties == nullptr) return S(0);
  const Pose<S> a = compose(map.centre_pose_at(properties->body_a), properties->frame_a);
  const Pose<S> b = compose(map.centre_pose_at(properties->body_b), properties->frame_b);
  return visit_joint_type(properties->type, [&](auto kind) ISO_INLINE_LAMBDA {
    return decltype(kind)::template Of<S>::error(*properties, a, b);
  });
}

/// As they lie now; arms are not looked for.
template <class S> ISO_INLINE JointFrames<S> frames_of(const BodyMap<S>& map, const JointProperties<S>& joint) {
  const Pose<S> a = compose(map.centre_pose_at(joint.body_a), joint.frame_a);
  const Pose<S> b = compose(map.centre_pose_at(joint.body_b), joint.frame_b);
  const Vec3<S> none = Vec3<S>::zero();
  return {none, none, b.position - a.position, a.orientation, b.orientation};
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
