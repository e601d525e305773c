// Bullet's constraints.
// SPDX-License-Identifier: MIT
#include "bullet_joints.hpp"

#include "scenes/scene.hpp"

namespace isostep::bench {
namespace {

btTransform frame(const PeerEnd& end) { return btTransform(bt(end.orientation), bt(end.position)); }
/// The joint's frame about x: Bullet slides and twists along and about that axis.
btTransform frame_of_x(const PeerEnd& end) {
  return frame(end) * btTransform(btQuaternion(btVector3(0, 1, 0), -SIMD_HALF_PI));
}

/// Bullet's angles are those of a against b: ours the other way round. Its motor has an impulse a step.
std::unique_ptr<btTypedConstraint> hinge(const PeerJoint& joint, btRigidBody& a, btRigidBody& b, double hz) {
  auto made = std::make_unique<btHingeConstraint>(a, b, frame(joint.on_a), frame(joint.on_b));
  if (joint.is_limited) made->setLimit(bt(-joint.upper), bt(-joint.lower));
  else made->setLimit(1, -1);  // none
  if (joint.has_motor) made->enableAngularMotor(true, bt(-joint.motor_speed), bt(joint.motor_force / hz));
  return made;
}
std::unique_ptr<btTypedConstraint> slider(const PeerJoint& joint, btRigidBody& a, btRigidBody& b) {
  auto made = std::make_unique<btSliderConstraint>(a, b, frame_of_x(joint.on_a), frame_of_x(joint.on_b), true);
  made->setLowerLinLimit(joint.is_limited ? bt(joint.lower) : 1);  // above the other: none
  made->setUpperLinLimit(joint.is_limited ? bt(joint.upper) : -1);
  made->setLowerAngLimit(0);
  made->setUpperAngLimit(0);
  if (!joint.has_motor) return made;
  made->setPoweredLinMotor(true);
  made->setTargetLinMotorVelocity(bt(joint.motor_speed));
  made->setMaxLinMotorForce(bt(joint.motor_force));
  return made;
}
std::unique_ptr<btTypedConstraint> ball(const PeerJoint& joint, btRigidBody& a, btRigidBody& b) {
  if (joint.cone > 0) {
    auto made = std::make_unique<btConeTwistConstraint>(a, b, frame_of_x(joint.on_a), frame_of_x(joint.on_b));
    made->setLimit(bt(joint.cone), bt(joint.cone), bt(joint.upper));
    return made;
  }
  if (joint.a < 0) return std::make_unique<btPoint2PointConstraint>(b, bt(joint.on_b.position));
  return std::make_unique<btPoint2PointConstraint>(a, b, bt(joint.on_a.position), bt(joint.on_b.position));
}

}  // namespace

std::unique_ptr<btTypedConstraint> bullet_joint(const PeerJoint& joint, btRigidBody& a, btRigidBody& b, double hz) {
  switch (joint.type) {
    case JointType::ball: return ball(joint, a, b);
    case JointType::hinge:
      if (joint.is_spring) throw scenes::SceneError("", "Bullet has no spring of a hinge");
      return hinge(joint, a, b, hz);
    case JointType::fixed: return std::make_unique<btFixedConstraint>(a, b, frame(joint.on_a), frame(joint.on_b));
    case JointType::slider: return slider(joint, a, b);
    case JointType::distance: throw scenes::SceneError("", "Bullet has no distance joint");
    case JointType::cylindrical:
    case JointType::planar:
    case JointType::universal:
    case JointType::constant_velocity:
    case JointType::angular:
    case JointType::six_axis: break;
  }
  throw scenes::SceneError("", "a joint that Bullet is not asked for");
}

std::unique_ptr<btTypedConstraint> bullet_gear(const PeerGear& gear, const std::vector<PeerJoint>& joints,
                                               btRigidBody& a, btRigidBody& b) {
  const auto axis = [&](std::size_t joint) { return bt(to_matrix(joints[joint].on_b.orientation).column(2)); };
  return std::make_unique<btGearConstraint>(a, b, axis(gear.joint_a), axis(gear.joint_b),
                                            bt(gear.ratio_b / gear.ratio_a));
}

}  // namespace isostep::bench
