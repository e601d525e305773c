// ODE's joints. Their coordinates are those of a against b, ours the other way round: axes are turned round.
// SPDX-License-Identifier: MIT
#include "ode_joints.hpp"

#include <cmath>

#include "scenes/scene.hpp"

namespace isostep::bench {
namespace {

/// A spring as its manual has it: `push` [N s/m] is stiffness times the step, `damping` [N s/m].
void soften(dJointID joint, double push, double damping) {
  dJointSetDBallParam(joint, dParamERP, push / (push + damping));
  dJointSetDBallParam(joint, dParamCFM, 1 / (push + damping));
}
void set_drive(dJointID made, const PeerJoint& joint, void (*set)(dJointID, int, dReal)) {
  if (joint.is_limited) {
    set(made, dParamLoStop, joint.lower);
    set(made, dParamHiStop, joint.upper);
  }
  if (!joint.has_motor) return;
  set(made, dParamVel, joint.motor_speed);
  set(made, dParamFMax, joint.motor_force);
}

dJointID ball(dWorldID world, const PeerJoint& joint, const OdePlace& at) {
  if (joint.cone > 0) throw scenes::SceneError("", "ODE has no cone");
  const dJointID made = dJointCreateBall(world, nullptr);
  dJointAttach(made, at.a, at.b);
  dJointSetBallAnchor(made, at.on_b.x, at.on_b.y, at.on_b.z);
  return made;
}
/// ODE takes b for its first body where a is the world, and so the coordinate of b, but the axis as it is given.
dJointID hinge(dWorldID world, const PeerJoint& joint, const OdePlace& at, double hz) {
  const dJointID made = dJointCreateHinge(world, nullptr);
  dJointAttach(made, at.a, at.b);
  dJointSetHingeAnchor(made, at.on_b.x, at.on_b.y, at.on_b.z);
  const Vec3<double> axis = at.a == nullptr ? at.axis : -at.axis;
  dJointSetHingeAxis(made, axis.x, axis.y, axis.z);
  set_drive(made, joint, dJointSetHingeParam);
  if (!joint.is_spring) return made;
  // A stop at both sides of the rest is a spring and damper by ERP and CFM, as its manual says.
  const double step = joint.stiffness / hz;
  dJointSetHingeParam(made, dParamLoStop, joint.rest);
  dJointSetHingeParam(made, dParamHiStop, joint.rest);
  dJointSetHingeParam(made, dParamStopERP, step / (step + joint.damping));
  dJointSetHingeParam(made, dParamStopCFM, 1 / (step + joint.damping));
  return made;
}
dJointID slider(dWorldID world, const PeerJoint& joint, const OdePlace& at) {
  const dJointID made = dJointCreateSlider(world, nullptr);
  dJointAttach(made, at.a, at.b);
  dJointSetSliderAxis(made, -at.axis.x, -at.axis.y, -at.axis.z);
  set_drive(made, joint, dJointSetSliderParam);
  return made;
}
dJointID weld(dWorldID world, const OdePlace& at) {
  const dJointID made = dJointCreateFixed(world, nullptr);
  dJointAttach(made, at.a, at.b);
  dJointSetFixed(made);
  return made;
}
dJointID distance(dWorldID world, const PeerJoint& joint, const OdePlace& at, double hz) {
  if (!joint.is_spring && joint.lower != joint.upper) throw scenes::SceneError("", "ODE has no rope");
  const dJointID made = dJointCreateDBall(world, nullptr);
  dJointAttach(made, at.a, at.b);
  dJointSetDBallAnchor1(made, at.on_a.x, at.on_a.y, at.on_a.z);
  dJointSetDBallAnchor2(made, at.on_b.x, at.on_b.y, at.on_b.z);
  dJointSetDBallDistance(made, joint.is_spring ? joint.rest : joint.upper);
  if (joint.is_spring) soften(made, joint.stiffness / hz, joint.damping);
  return made;
}

}  // namespace

void add_ode_joint(dWorldID world, const PeerJoint& joint, const OdePlace& at, double hz) {
  switch (joint.type) {
    case JointType::ball: ball(world, joint, at); return;
    case JointType::hinge: hinge(world, joint, at, hz); return;
    case JointType::fixed: weld(world, at); return;
    case JointType::distance: distance(world, joint, at, hz); return;
    case JointType::slider: slider(world, joint, at); return;
    case JointType::cylindrical:
    case JointType::planar:
    case JointType::universal:
    case JointType::constant_velocity:
    case JointType::angular:
    case JointType::six_axis: break;
  }
  throw scenes::SceneError("", "a joint that ODE is not asked for");
}

void add_ode_gear(dWorldID world, const PeerGear& gear, const OdePlace& a, const OdePlace& b) {
  const double ratio = gear.ratio_a / gear.ratio_b;
  const bool parallel = std::abs(dot(a.axis, b.axis)) > 0.999;
  if (!parallel || !(ratio > 0)) throw scenes::SceneError("", "ODE is given gears that mesh on parallel axes");
  const dJointID made = dJointCreateTransmission(world, nullptr);
  dJointAttach(made, a.b, b.b);
  dJointSetTransmissionMode(made, dTransmissionParallelAxes);
  dJointSetTransmissionRatio(made, ratio);  // of the wheels' radii
  dJointSetTransmissionAnchor1(made, a.on_b.x, a.on_b.y, a.on_b.z);
  dJointSetTransmissionAnchor2(made, b.on_b.x, b.on_b.y, b.on_b.z);
  dJointSetTransmissionAxis(made, a.axis.x, a.axis.y, a.axis.z);
}

}  // namespace isostep::bench
