// The parts of trials of mechanisms: bodies and joints with one property more, the worst of one error.
// SPDX-License-Identifier: MIT
#pragma once

#include "judges.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {

/// [rad] The angle of a body about z, in (-pi, pi].
inline double angle_of(const BodySight& body) {
  const double angle = 2 * std::atan2(body.orientation.z, body.orientation.w);
  return angle - kTurn * std::round(angle / kTurn);
}
inline SceneBody weighing(SceneBody body, double mass) {
  body.mass = mass;
  return body;
}
inline SceneBody apart(SceneBody body) {
  body.collide = false;
  return body;
}
inline SceneJoint driven(SceneJoint joint, double speed, double torque) {
  joint.flags |= joint_flag::kMotor;
  joint.motor_speed = speed;
  joint.max_force = torque;
  return joint;
}
inline SceneJoint stopped(SceneJoint joint, double lower, double upper) {
  joint.flags |= joint_flag::kLimit;
  joint.lower = lower;
  joint.upper = upper;
  return joint;
}

/// A judge of one error from the second `from` on: the worst.
class Off : public FromStart {
 public:
  explicit Off(double from) : from_(from) {}
  double figure() const override { return worst_; }

 protected:
  virtual double error(const Sight& start, const Sight& now) const = 0;

 private:
  void compare(const Sight& start, const Sight& now) override {
    for (const BodySight& body : now.bodies) finite_ = worse(finite_, 0 * length_of(body.centre));
    if (from_ <= now.time) worst_ = worse(worst_, std::abs(error(start, now)) + finite_);
  }
  double from_;  // [s]
  double worst_ = 0, finite_ = 0;
};

}  // namespace isostep::scenes
