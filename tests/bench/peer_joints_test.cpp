// Motors, limits and gears move bodies in peers as they do in ours, whichever end of a joint is the world.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "scene_bench/engine.hpp"
#include "scenes/shapes.hpp"
#include "scenes/trials/mechanism_parts.hpp"

namespace isostep::bench {
namespace peer_joints_test {

using scenes::Scene;
using scenes::SceneJoint;

constexpr double kLower = -0.3, kUpper = 0.8;  // [rad] or [m]
constexpr double kNear = 0.03;                 // [1] of a second's motion: ten iterations leave no more

scenes::SceneBody cube(double x, double mass) {
  return scenes::apart(scenes::weighing(scenes::body_of(scenes::box_part({0.5, 0.5, 0.5}), {x, 0, 0}), mass));
}
/// The end of a joint that is the world. None: a is a body a hundred times as heavy as b.
enum class World { a, b, none };
SceneJoint joint_of(JointType type, World world) {
  const bool a = world == World::a, b = world == World::b;
  SceneJoint joint = scenes::joint_of(type, a ? -1 : 0, b ? -1 : a ? 0 : 1, {0, 0, 0});
  if (type == JointType::slider) joint.orientation = {0, scenes::kHalfRoot, 0, scenes::kHalfRoot};  // z to x
  return joint;
}
scenes::Sight end_of(const Maker& maker, const Scene& scene) {
  const std::unique_ptr<Engine> engine = maker.make(scene, {});
  for (int frame = 0; frame < scene.frames; ++frame) {
    engine->before_step(frame);
    engine->step();
  }
  return engine->sight();
}
/// The angle by which b has turned about z, or the way that it has gone along x, against a after a second.
double second_of(const Maker& maker, const SceneJoint& joint, World world) {
  Scene scene = scenes::weightless(60);
  scene.bodies.push_back(cube(0, world == World::none ? 100 : 1));
  if (world == World::none) scene.bodies.push_back(cube(0, 1));
  scene.joints.push_back(joint);
  const scenes::Sight sight = end_of(maker, scene);
  const auto place = [&](int body) {
    if (body < 0) return 0.0;
    const scenes::BodySight& at = sight.bodies[static_cast<std::size_t>(body)];
    return joint.type == JointType::hinge ? scenes::angle_of(at) : at.centre.x;
  };
  return place(joint.b) - place(joint.a);
}

/// Calls `check` with every engine, kind of joint and way to hang it up.
template <class Check> void for_all(Check&& check) {
  for (const Maker& maker : makers()) {
    const std::string_view name = maker.name;
    if (name == "dart") continue;           // its hinges and sliders are of trees: it refuses them
    if (name.ends_with("-best")) continue;  // the same joints, more exactly
    for (const JointType type : {JointType::hinge, JointType::slider}) {
      for (const World world : {World::a, World::b, World::none}) {
        SCOPED_TRACE(std::string(maker.name) + " " + kJointNames[static_cast<int>(type)] + " " +
                     std::to_string(static_cast<int>(world)));
        check(maker, joint_of(type, world), world);
      }
    }
  }
}

TEST(PeerJoints, motors_turn_and_push_b_forwards) {
  for_all([](const Maker& maker, const SceneJoint& joint, World world) {
    EXPECT_NEAR(second_of(maker, scenes::driven(joint, 1, 1e4), world), 1, kNear);
  });
}
TEST(PeerJoints, what_a_motor_drives_against_a_limit_stays_there) {
  for_all([](const Maker& maker, const SceneJoint& joint, World world) {
    const SceneJoint limited = scenes::stopped(joint, kLower, kUpper);
    EXPECT_NEAR(second_of(maker, scenes::driven(limited, 2, 10), world), kUpper, kNear);
    EXPECT_NEAR(second_of(maker, scenes::driven(limited, -2, 10), world), kLower, kNear);
  });
}
TEST(PeerJoints, a_weak_motor_gives_no_more_than_its_force) {
  for_all([](const Maker& maker, const SceneJoint& joint, World world) {
    const double inertia = joint.type == JointType::hinge ? 1.0 / 6 : 1;  // of a cube of 1 kg
    EXPECT_NEAR(second_of(maker, scenes::driven(joint, 10, inertia), world), 0.5, kNear);
  });
}

/// Two wheels on the world, 20 and 40 teeth, the first driven at 2 rad/s.
Scene gears() {
  Scene scene = scenes::weightless(60);
  for (int i = 0; i < 2; ++i) {
    scene.bodies.push_back(cube(1.5 * i, 1));
    scene.joints.push_back(scenes::joint_of(JointType::hinge, -1, i, {1.5 * i, 0, 0}));
  }
  scene.joints[0] = scenes::driven(scene.joints[0], 2, 1e4);
  scene.records.push_back({"coupling", {{"joint_a", {0}}, {"joint_b", {1}}, {"ratio_a", {20}}, {"ratio_b", {40}}}});
  return scene;
}
TEST(PeerJoints, gears_turn_against_each_other_by_their_teeth_or_are_refused) {
  for (const Maker& maker : makers()) {
    SCOPED_TRACE(maker.name);
    const std::string_view name = maker.name;
    if (!maker.ours && !name.starts_with("bullet") && !name.starts_with("ode")) {
      EXPECT_THROW(end_of(maker, gears()), scenes::SceneError);
      continue;
    }
    const scenes::Sight sight = end_of(maker, gears());
    EXPECT_NEAR(scenes::angle_of(sight.bodies[0]), 2, kNear);
    EXPECT_NEAR(scenes::angle_of(sight.bodies[1]), -1, kNear);
  }
}

/// A wheel on the world that turns at 1 rad/s against a spring of 1 Hz: a quarter of a second later it is furthest.
Scene sprung_wheel() {
  Scene scene = scenes::weightless(60);
  scene.hz = 240;
  scene.bodies.push_back(cube(0, 1));
  scene.bodies.back().angular_velocity = {0, 0, 1};
  scene.joints.push_back(scenes::joint_of(JointType::hinge, -1, 0, {0, 0, 0}));
  scene.joints.back().flags = joint_flag::kSpring;
  scene.joints.back().spring_frequency = 1;
  return scene;
}
TEST(PeerJoints, springs_of_hinges_are_as_stiff_as_ours_or_are_refused) {
  int sprung = 0;
  for (const Maker& maker : makers()) {
    SCOPED_TRACE(maker.name);
    try {
      EXPECT_NEAR(scenes::angle_of(end_of(maker, sprung_wheel()).bodies[0]), 1 / scenes::kTurn,
                  0.005);  // [rad] of .159
      ++sprung;
    } catch (const scenes::SceneError& error) {
      EXPECT_NE(std::string(error.what()).find("spring"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(sprung, 1);
}

}  // namespace peer_joints_test
}  // namespace isostep::bench
