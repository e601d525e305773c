// The angles of a joint, by its stored frames and its bodies' poses, in double: what laws of joints are about.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

struct JointAngles {
  double twist = 0;             // [rad] of b's frame against a's about z, in (-pi, pi]; a hinge's angle
  double swing = 0;             // [rad] between the z axes
  double apart = 0;             // [m] between the anchors
  double along = 0;             // [m] of b's anchor along a's z
  double angular_velocity = 0;  // [rad/s] of b against a about a's z
  D3 axis = {0, 0, 0};          // [1] a's z, world
  D3 anchor = {0, 0, 0};        // [m] on a, world
};

namespace joint_angles_detail {

template <class U> Quat<double> wide(const Quat<U>& q) {
  return normalise(Quat<double>{to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)});
}
struct End {
  Quat<double> frame;
  D3 anchor, angular_velocity;
};
template <class S> End end_of(const World<S>& w, std::uint32_t slot, std::uint32_t generation, const Pose<S>& frame) {
  if (slot == kNoBody) return {wide(frame.orientation), real(frame.position), {0, 0, 0}};
  const BodyView<S> body = w.view({slot, generation});
  const Quat<double> turned = wide(body.state->orientation);
  return {turned * wide(frame.orientation), real(body.state->centre) + to_matrix(turned) * real(frame.position),
          real(body.state->angular_velocity)};
}

}  // namespace joint_angles_detail

template <class S> JointAngles angles_of(const World<S>& w, const JointProperties<S>& p) {
  using namespace joint_angles_detail;
  const End a = end_of(w, p.body_a, p.generation_a, p.frame_a), b = end_of(w, p.body_b, p.generation_b, p.frame_b);
  Quat<double> q = conjugate(a.frame) * b.frame;
  if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
  JointAngles angles;
  angles.twist = 2 * std::atan2(q.z, q.w);
  angles.swing = 2 * std::atan2(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  angles.apart = length(b.anchor - a.anchor);
  angles.axis = to_matrix(a.frame).column(2);
  angles.anchor = a.anchor;
  angles.along = dot(b.anchor - a.anchor, angles.axis);
  angles.angular_velocity = dot(b.angular_velocity - a.angular_velocity, angles.axis);
  return angles;
}

/// [rad] or [m] The coordinate that a motor of the joint moves.
template <class S> double driven_place(const World<S>& w, const JointProperties<S>& p) {
  const JointAngles now = angles_of(w, p);
  return measure_of(p.type) == JointMeasure::angle ? now.twist : now.along;
}

/// [J] The kinetic energy of one dynamic body; kappa is mass times inverse inertia about the principal axes.
template <class S> double kinetic_energy(const BodyView<S>& body) {
  using namespace joint_angles_detail;
  const Mat3<double> axes = to_matrix(wide(body.state->orientation)) * to_matrix(wide(body.properties->principal));
  const D3 v = real(body.state->velocity), kappa = real(body.properties->kappa);
  const D3 angular_velocity = transposed_times(axes, real(body.state->angular_velocity));
  double square = dot(v, v);
  for (int i = 0; i < 3; ++i) square += kappa[i] > 0 ? angular_velocity[i] * angular_velocity[i] / kappa[i] : 0.0;
  return to_double(body.properties->mass) * square / 2;
}
/// [kg m^2] The inertia of one body about an axis through a point, both world.
template <class S> double inertia_about(const BodyView<S>& body, D3 point, D3 axis) {
  using namespace joint_angles_detail;
  const Mat3<double> axes = to_matrix(wide(body.state->orientation)) * to_matrix(wide(body.properties->principal));
  const D3 kappa = real(body.properties->kappa), own = transposed_times(axes, axis);
  const D3 across = cross(real(body.state->centre) - point, axis);
  double square = dot(across, across);
  for (int i = 0; i < 3; ++i) square += kappa[i] > 0 ? own[i] * own[i] / kappa[i] : 0.0;
  return to_double(body.properties->mass) * square;
}

}  // namespace isostep::test
