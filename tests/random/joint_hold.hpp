// The errors of a joint against what it holds, and past its limits, by its frames in double.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "random/joint_angles.hpp"

namespace isostep::test {

/// [m] A body that slides farther out than this may be off by as many times more: a tilt shows the more, and Q16.16
/// turns its base by less than such a lever asks for (JointConstraint::reach).
inline constexpr double kFarOut = 2;
/// [rad] The swings beyond which a twist is not held (kLeastTwistCosine, kWidestSwing less what a step may pass it by).
inline constexpr double kTwistEnds = 2.8, kSwingEnds = 2.0;

struct JointHold {
  double place;  // [m] off the lengths that it locks
  double angle;  // [rad] off the angles that it locks
  double swing;  // [rad] between the z axes
};

namespace joint_hold_detail {

inline double tilt(const Mat3<double>& a, const Mat3<double>& b, int axis) {
  return std::atan2(length(cross(a.column(axis), b.column(axis))), dot(a.column(axis), b.column(axis)));
}
/// The error of a six-axis joint, by the rows that stand for its locks.
inline double off_locks(std::uint32_t flags, const Mat3<double>& a, const Mat3<double>& b, double twist) {
  using namespace joint_flag;
  const bool x = (flags & kLockSwingX) != 0, y = (flags & kLockSwingY) != 0, z = (flags & kLockTwist) != 0;
  if (x && y) return tilt(a, b, 2) + (z ? std::fabs(twist) : 0.0);
  if (z && (x || y)) return tilt(a, b, x ? 1 : 0);
  if (z) return std::fabs(twist);
  if (!x && !y) return 0;
  return std::fabs(std::asin(std::clamp(dot(a.column(x ? 1 : 0), b.column(2)), -1.0, 1.0)));
}

}  // namespace joint_hold_detail

template <class S> JointHold hold_of(const World<S>& w, JointId id) {
  using namespace joint_angles_detail;
  const JointProperties<S>& p = *w.joint(id);
  const JointAngles now = angles_of(w, p);
  const Mat3<double> a = to_matrix(end_of(w, p.body_a, p.generation_a, p.frame_a).frame),
                     b = to_matrix(end_of(w, p.body_b, p.generation_b, p.frame_b).frame);
  const bool slides = !holds_point(p) && !joins_two_points(p.type);
  JointHold hold = {to_double(w.joint_error(id)), 0, now.swing};
  if (slides) hold.place /= std::max(1.0, now.apart / kFarOut);
  switch (p.type) {
    case JointType::ball:
    case JointType::distance: break;
    case JointType::fixed:
    case JointType::slider:
    case JointType::angular: hold.angle = now.swing + std::fabs(now.twist); break;
    case JointType::hinge:
    case JointType::cylindrical:
    case JointType::planar: hold.angle = now.swing; break;
    case JointType::universal: hold.angle = std::fabs(dot(a.column(0), b.column(1))); break;
    case JointType::constant_velocity: hold.angle = std::fabs(now.twist); break;
    case JointType::six_axis: hold.angle = joint_hold_detail::off_locks(p.flags, a, b, now.twist); break;
  }
  return hold;
}

/// The joint locks a twist between two swings, which is lost as they fold.
template <class S> bool locks_twist_alone(const JointProperties<S>& p) {
  if (p.type == JointType::constant_velocity) return true;
  return p.type == JointType::six_axis && (p.flags & joint_flag::kLockTurns) == joint_flag::kLockTwist;
}

}  // namespace isostep::test
