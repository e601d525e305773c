// A program of the tests: the probe joint as the engine's own files treat it, in a copy that has it in its list. A body
// of 1 kg slides for a second along a line that leans 30 degrees from the vertical.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <utility>

#include "isostep/dynamics/joints/joint_alone.inl"
#include "isostep/dynamics/joints/joint_checks.hpp"
#include "isostep/geometry/validate.inl"
#include "isostep/scalar/math.inl"

using namespace isostep;

int main() {
  JointProperties<float> joint;
  joint.type = JointType::probe;
  joint.frame_a.orientation = joint.frame_b.orientation = {0.5f, 0, 0, 0.8660254f};  // z is (0, -0.866, 0.5)
  JointState<float> state = {};
  BodyState<float> body = {};
  body.orientation = Quat<float>::identity();
  SolverBodies<float> bodies;
  bodies.velocity.assign(2, MotionRow<float>::zero());
  bodies.mass = {{0, Mat3<float>::diagonal({0, 0, 0})}, {1, Mat3<float>::diagonal({10, 10, 10})}};
  const JointStep<float> step = {&body, &bodies, 240, 1 / 240.0f, joint_softness(240.0f)};
  JointConstraint<float> held;
  const std::span<JointConstraint<float>> joints(&held, 1);
  for (int i = 0; i < 240; ++i) {
    prepare_joint(joint, state, {0, Pose<float>::identity()}, {1, {body.centre, body.orientation}}, bodies, held);
    bodies.velocity[1].linear.y -= 10 * step.h;
    warm_start_joints(joints, step);
    solve_joints(joints, step, false);
    body.centre += bodies.velocity[1].linear * step.h;
    solve_joints(joints, step, true);
    store_joint(held, state);
  }
  const Vec3<float> v = bodies.velocity[1].linear;
  const auto [pull, error] = visit_joint_type(joint.type, [&](auto kind) {
    using Joint = typename decltype(kind)::template Of<float>;
    const Pose<float> at_b = {body.centre, joint.frame_b.orientation};
    return std::pair(Joint::pull(held), Joint::error(joint, joint.frame_a, at_b));
  });
  const bool taken = detail::fault_of(joint, 240) == Fault::none;
  joint.flags = joint_flag::kMotor;
  std::printf("%s speed %.2f %.2f %.2f pull %.3f off %.3f taken %d motor: %s\n", kJointNames[kJointTypes - 1],
              double{v.x}, double{v.y}, double{v.z}, double{pull.z}, double{error}, taken,
              detail::fault_of(joint, 240).expected);
}
