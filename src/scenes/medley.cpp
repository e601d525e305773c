// `medley`: the fewest bodies that ask for every part of the engine; what self-checks replay.
// SPDX-License-Identifier: MIT
#include "medley.hpp"

#include "mixed.hpp"
#include "named.hpp"

namespace isostep::scenes {
namespace {

/// The ground, a belt, a paddle that turns above it, and a sensor through which things fall.
void add_scenery(Scene& scene) {
  SceneBody ground;
  ScenePart plane;
  plane.type = ShapeType::half_space;
  ground.type = BodyType::static_;
  ground.parts.push_back(plane);
  scene.bodies.push_back(ground);
  SceneBody belt = fixed_box({-3.5, 0, 0}, {1, 0.25, 2});
  belt.surface_velocity = {1, 0, 0.5};
  scene.bodies.push_back(belt);
  SceneBody paddle = body_of(box_part({1.5, 0.1, 0.3}), {0, 1.2, 0});
  paddle.type = BodyType::kinematic;
  paddle.angular_velocity = {0, 1.5, 0};
  scene.bodies.push_back(paddle);
  SceneBody sensor = fixed_box({0, 2, 0}, {1, 0.5, 1});
  sensor.sensor = true;
  scene.bodies.push_back(sensor);
}

/// Falls onto the paddle: every shape, alone and in a compound, one that bounces and one that rolls badly.
void add_heap(Scene& scene) {
  Draws draws(2718);
  for (int n = 0; n < 8; ++n) {
    const Point at = {(n % 2 - 0.5) * 1.1, 1.9 + 0.8 * (n / 4), (n / 2 % 2 - 0.5) * 1.1};
    SceneBody body = n == 3 ? dumbbell(at) : n == 6 ? bracket(at) : drawn_body(n, at, draws, 1);
    body.report_contacts = true;
    if (n % 3 == 1) body.restitution = 0.5;
    if (n % 3 == 2) body.rolling_resistance = 0.02;
    scene.bodies.push_back(body);
  }
  SceneBody slider = body_of(sphere_part(0.25), {-3.5, 0.6, 0});  // on the belt
  slider.friction = 0.25;
  scene.bodies.push_back(slider);
}

/// Adds a stack where nothing disturbs it, so that it falls asleep.
void add_stack(Scene& scene) {
  for (int n = 0; n < 3; ++n) scene.bodies.push_back(body_of(box_part({0.4, 0.3, 0.4}), {8, 0.3 + 0.6 * n, 0}));
}

/// An arm of one joint after another, each body 0.5 m below the one before.
class Arm {
 public:
  Arm(Scene& scene, Point top) : scene_(scene), at_(top) {}
  SceneJoint& add(JointType type, std::uint32_t flags, const ScenePart& part) {
    scene_.bodies.push_back(body_of(part, {at_.x, at_.y - 0.25, at_.z}));
    SceneJoint joint;
    joint.type = type;
    joint.flags = flags;
    joint.a = last_;
    joint.b = last_ = static_cast<int>(scene_.bodies.size()) - 1;
    joint.anchor = vector_of(at_);
    joint.anchor_b = type == JointType::distance ? vector_of({at_.x, at_.y - 0.25, at_.z}) : joint.anchor;
    at_.y -= 0.5;
    scene_.joints.push_back(joint);
    return scene_.joints.back();
  }

 private:
  Scene& scene_;
  Point at_;
  int last_ = -1;
};

/// Motor, limits, springs, cone, rod, rope and weld; sideways from the vertical by their motor and spring.
void add_arms(Scene& scene) {
  using namespace joint_flag;
  Arm driven(scene, {5, 4, 0});
  SceneJoint& motor = driven.add(JointType::hinge, kMotor | kLimit, box_part({0.1, 0.2, 0.1}));
  motor.motor_speed = 2;
  motor.max_force = 5;
  motor.lower = -0.5;
  motor.upper = 1;
  driven.add(JointType::fixed, 0, capsule_part(0.1, 0.1));
  SceneJoint& neck = driven.add(JointType::ball, kCone | kLimit, sphere_part(0.2));
  neck.orientation = {kHalfRoot, 0, 0, kHalfRoot};  // its axis hangs down, so that to swing is to tilt it
  neck.cone = 0.25;
  neck.lower = -0.25;
  neck.upper = 0.25;
  Arm sprung(scene, {6, 4, 1.5});
  SceneJoint& flap = sprung.add(JointType::hinge, kSpring, box_part({0.2, 0.2, 0.05}));
  flap.spring_target = 0.75;
  flap.spring_frequency = 2;
  flap.spring_damping = 0.25;
  SceneJoint& bob = sprung.add(JointType::distance, kSpring | kLimit, sphere_part(0.15));
  bob.spring_target = 0.25;
  bob.spring_frequency = 3;
  bob.spring_damping = 0.5;
  bob.lower = 0.125;
  bob.upper = 0.5;
  SceneJoint& rope = sprung.add(JointType::distance, kLimit, sphere_part(0.2));
  rope.upper = 0.5;
}

}  // namespace

Scene medley() {
  Scene scene;
  scene.script = Script::medley;
  scene.frames = 180;
  add_scenery(scene);
  add_heap(scene);
  add_stack(scene);
  add_arms(scene);
  return scene;
}

}  // namespace isostep::scenes
