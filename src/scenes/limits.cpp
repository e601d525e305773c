// Limits of joints, by swing and twist.
// SPDX-License-Identifier: MIT
#include "limits.hpp"

#include <cmath>

#include "trials/judges.hpp"
#include "trials/scene_numbers.hpp"

namespace isostep::scenes {

JointLimits::JointLimits(const Scene& scene) {
  for (const SceneJoint& joint : scene.joints) {
    const bool twists = (joint.flags & joint_flag::kLimit) != 0, swings = (joint.flags & joint_flag::kCone) != 0;
    if (measure_of(joint.type) != JointMeasure::angle || (!twists && !swings)) continue;
    const Rotation& q = joint.orientation;
    joints_.push_back({joint.a, joint.b, normalise(Quat<double>{value(q[0]), value(q[1]), value(q[2]), value(q[3])}),
                       twists, swings, value(joint.lower), value(joint.upper), value(joint.cone)});
  }
}

/// Frames are one at the start: q is b's, seen from a's, now.
double JointLimits::passed(const std::vector<BodySight>& start, const std::vector<BodySight>& now) const {
  double most = 0;
  for (const Limited& joint : joints_) {
    const auto frame = [&](int body) {
      if (body < 0) return joint.frame;
      const std::size_t i = static_cast<std::size_t>(body);
      return normalise(now[i].orientation) * conjugate(normalise(start[i].orientation)) * joint.frame;
    };
    Quat<double> q = conjugate(frame(joint.a)) * frame(joint.b);
    if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
    const double twist = 2 * std::atan2(q.z, q.w);
    const double swing = 2 * std::atan2(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
    if (joint.twists) most = worse(worse(most, twist - joint.upper), joint.lower - twist);
    if (joint.swings) most = worse(most, swing - joint.cone);
  }
  return most;
}

}  // namespace isostep::scenes
