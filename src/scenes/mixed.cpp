// `mixed`: a pile with a little of everything that a world remembers.
// SPDX-License-Identifier: MIT
#include "mixed.hpp"

#include "named.hpp"

namespace isostep::scenes {
namespace {

void add_rope(Scene& scene, Point top) {
  int last = -1;
  for (int i = 0; i < 4; ++i) {
    scene.bodies.push_back(body_of(capsule_part(0.06, 0.14), {top.x, top.y - 0.2 - 0.4 * i, top.z}));
    SceneJoint joint;
    joint.a = last;
    joint.b = last = static_cast<int>(scene.bodies.size()) - 1;
    joint.anchor = {top.x, top.y - 0.4 * i, top.z};
    scene.joints.push_back(joint);
  }
}
/// A bar that a motor turns about the world's z axis, and bodies fixed to it and sprung from it.
void add_machine(Scene& scene, Point at) {
  const int bar = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(body_of(box_part({0.8, 0.08, 0.2}), at));
  scene.bodies.push_back(body_of(box_part({0.1, 0.1, 0.1}), {at.x + 0.7, at.y + 0.18, at.z}));
  scene.bodies.push_back(body_of(sphere_part(0.15), {at.x, at.y + 0.8, at.z}));
  SceneJoint hinge;
  hinge.type = JointType::hinge;
  hinge.b = bar;
  hinge.anchor = vector_of(at);
  hinge.flags = joint_flag::kMotor;
  hinge.motor_speed = 1.5;
  hinge.max_force = 5;
  scene.joints.push_back(hinge);
  SceneJoint weld;
  weld.type = JointType::fixed;
  weld.a = bar;
  weld.b = bar + 1;
  weld.anchor = {at.x + 0.7, at.y + 0.08, at.z};
  scene.joints.push_back(weld);
  SceneJoint rope;
  rope.type = JointType::distance;
  rope.a = bar;
  rope.b = bar + 2;
  rope.anchor = vector_of(at);
  rope.anchor_b = {at.x, at.y + 0.8, at.z};
  rope.flags = joint_flag::kLimit;
  rope.upper = 0.9;
  scene.joints.push_back(rope);
}

}  // namespace

SceneBody dumbbell(Point at) {
  SceneBody body = body_of(capsule_part(0.08, 0.3), at);
  for (const double y : {0.3, -0.3}) {
    ScenePart end = sphere_part(0.2);
    end.position = {0, y, 0};
    body.parts.push_back(end);
  }
  return body;
}
SceneBody bracket(Point at) {
  SceneBody body = body_of(box_part({0.4, 0.1, 0.15}), at);
  ScenePart arm = box_part({0.1, 0.3, 0.15});
  const SinCos<double> half = sin_cos(0.2);
  arm.position = {0.35, 0.3, 0.05};
  arm.orientation = {0, 0, half.sin, half.cos};
  body.parts.push_back(arm);
  return body;
}

SceneBody mixed_body(Draws& draws) {
  const int kind = static_cast<int>(draws.next() >> 16) % 5;
  const double x = draws.between(-2, 2), z = draws.between(-2, 2);
  const Point at = {x, draws.between(3.5, 5), z};
  if (kind == 3) return dumbbell(at);
  if (kind == 4) return bracket(at);
  return drawn_body(kind, at, draws, 0.8);
}

Scene mixed() {
  Scene scene;
  scene.script = Script::mixed;
  add_pit(scene, 6);
  SceneBody sensor = fixed_box({0, 1, 0}, {1, 1, 1});
  sensor.sensor = true;
  scene.bodies.push_back(sensor);
  Draws draws(31337);
  for (int n = 0; n < 48; ++n) {
    const int layer = n / 16, column = n % 16;
    const Point at = {(column % 4 - 1.5) * 1.3, 0.6 + 1.1 * layer, (column / 4 - 1.5) * 1.3};
    scene.bodies.push_back(n % 8 == 3 ? dumbbell(at) : n % 8 == 6 ? bracket(at) : drawn_body(n, at, draws, 1));
  }
  for (int n = 0; n < 18; ++n) {  // stacks beside the pit, islands of their own that fall asleep
    scene.bodies.push_back(body_of(box_part({0.4, 0.3, 0.4}), {8.0 + 2.0 * (n / 3), 0.3 + 0.6 * (n % 3), 0}));
  }
  add_rope(scene, {-2.2, 7, 0});
  add_rope(scene, {2.2, 7, 0.4});
  add_machine(scene, {0, 6, -1.5});
  return scene;
}

}  // namespace isostep::scenes
