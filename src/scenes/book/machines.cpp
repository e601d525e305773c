// Small machines: a catenary, a top, a door that swings, a piston.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// The rotation from y to the way that leads on in the plane of x and y.
Rotation along(double cosine, double sine) {
  // Half of the angle from y: cos(a) = sine, sin(a) = -cosine.
  const double half_cos = sqrt((1 + sine) / 2), half_sin = sqrt((1 - sine) / 2);
  return {0, 0, cosine < 0 ? half_sin : -half_sin, half_cos};
}

}  // namespace

/// 12.6 m of links between hooks 10 m apart, laid out as an arc below them; they swing and come to rest.
Scene catenary() {
  constexpr double kLength = 0.25, kHalfSpan = 5, kTop = 10;  // [m]
  // Chords of a circle: n links that each turn by 2 a span 2 R sin(n a) with R = kLength / (2 sin a).
  constexpr double kAngle = 0.0229;  // [rad] half of a link's turn, to within a millimetre of the span
  Scene scene = awake(1800);
  const double radius = kLength / (2 * sin(kAngle));
  Point from = {-kHalfSpan, kTop, 0};
  const double whole = kCatenaryLinks * kAngle;
  const double scale = kHalfSpan / (radius * sin(whole));
  for (int i = 0; i < kCatenaryLinks; ++i) {
    const double heading = -whole + (2 * i + 1) * kAngle;
    const Point step = {kLength * scale * cos(heading), kLength * scale * sin(heading), 0};
    SceneBody link = body_of(capsule_part(0.04, 0.08), {from.x + step.x / 2, from.y + step.y / 2, 0});
    link.orientation = along(cos(heading), sin(heading));
    link.mass = 0.5;
    link.collide = false;
    link.linear_damping = 0.5;
    link.angular_damping = 0.5;
    scene.bodies.push_back(link);
    scene.joints.push_back(joint_of(JointType::ball, i - 1, i, from));
    from = {from.x + step.x, from.y + step.y, 0};
  }
  scene.joints.push_back(joint_of(JointType::ball, kCatenaryLinks - 1, -1, from));
  return scene;
}

/// A disc on a pole without weight, its middle 1 m from the point. It begins in steady precession and does not nod.
Scene top() {
  Scene scene = awake(600);
  scene.substeps = 16;  // it turns by a sixteenth of a radian in each: with 8 it precesses 2 % too slowly
  SceneBody disc = body_of(round_part(ShapeType::cylinder, 0.5, 0.1), {0, 1, 0});
  const SinCos<double> half = sin_cos(kTopTilt / 2), whole = sin_cos(kTopTilt);
  disc.position = {-whole.sin, whole.cos, 0};
  disc.orientation = {0, 0, half.sin, half.cos};
  disc.mass = 1;
  disc.collide = false;
  const double spin = kTopSpin - kTopPrecession * whole.cos;
  disc.angular_velocity = {-spin * whole.sin, spin * whole.cos + kTopPrecession, 0};
  disc.velocity = {0, 0, kTopPrecession * whole.sin};
  scene.bodies.push_back(disc);
  scene.joints.push_back(joint_of(JointType::ball, -1, 0, {0, 0, 0}));
  return scene;
}

/// A physical pendulum: a plank that hangs on a hinge at its end, let go level.
Scene pendulum_door() {
  Scene scene = awake(600);
  SceneBody door = body_of(box_part({0.05, 0.5, 0.4}), {0.5, 2, 0});
  door.orientation = {0, 0, -kHalfRoot, kHalfRoot};
  door.mass = 10;
  door.collide = false;
  scene.bodies.push_back(door);
  scene.joints.push_back(joint_of(JointType::hinge, -1, 0, {0, 2, 0}));
  return scene;
}

/// The block may only move along x. The rod is a distance between the crank's pin and the block.
Scene piston() {
  Scene scene = awake(600);
  SceneBody crank = body_of(round_part(ShapeType::cylinder, 0.5, 0.1), {0, 1, 0});
  crank.orientation = {kHalfRoot, 0, 0, kHalfRoot};  // its axis along z
  crank.mass = 5;
  crank.collide = false;
  SceneBody block = body_of(box_part({0.3, 0.2, 0.2}), {2, 1, 0});
  block.mass = 2;
  block.collide = false;
  block.locks = body_flag::kLockX << 1 | body_flag::kLockX << 2 | body_flag::kAngularLocks;
  scene.bodies = {crank, block};
  SceneJoint motor = joint_of(JointType::hinge, -1, 0, {0, 1, 0});
  motor.flags = joint_flag::kMotor;
  motor.motor_speed = 4;
  motor.max_force = 100;
  SceneJoint rod = joint_of(JointType::distance, 0, 1, {0.4, 1, 0});
  rod.anchor_b = {2, 1, 0};
  rod.flags = joint_flag::kLimit;
  rod.lower = rod.upper = 1.6;
  scene.joints = {motor, rod};
  return scene;
}

}  // namespace isostep::scenes
