// One of every record: the fewest bodies that ask for all of them.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

enum Place {
  ground,
  raft,
  buoy,
  moon,
  swing,
  kite,
  cube,
  hammer,
  crate,
  sled,
  walker,
  cart,
  shaft,
  wheel,
  bob,
  shelf,
  arm,
  feeler
};

SceneBody of_mass(ScenePart part, Point at, double mass, Point velocity = {0, 0, 0}) {
  SceneBody body = body_of(std::move(part), at);
  body.mass = mass;
  body.velocity = vector_of(velocity);
  return body;
}
void add_bodies(Scene& scene) {
  scene.bodies = {fixed_box({0, -1, 0}, {24, 1, 8}),
                  of_mass(box_part({0.75, 0.25, 0.5}), {-8, 1, 0}, 300),
                  of_mass(sphere_part(0.5), {-12, 1.5, 0}, 20),
                  of_mass(sphere_part(0.25), {-4, 4, 0}, 1, {0, 0, 2}),
                  of_mass(box_part({0.25, 0.25, 0.25}), {0, 3, 0}, 2),
                  of_mass(box_part({0.5, 0.125, 0.5}), {4, 2, 0}, 2),
                  of_mass(box_part({0.5, 0.5, 0.5}), {8, 0.5, 0}, 10),
                  of_mass(sphere_part(0.25), {8, 0.75, 3}, 4, {0, 0, -12}),
                  of_mass(box_part({0.5, 0.5, 0.5}), {14, 0.5, 0}, 5),
                  of_mass(box_part({0.5, 0.25, 0.5}), {-1, 0.25, 4}, 5, {4, 0, 0}),
                  body_of(capsule_part(0.25, 0.5), {-2, 0.75, -4}),
                  of_mass(box_part({0.375, 0.125, 0.75}), {18, 0.75, 4}, 100),
                  of_mass(box_part({0.25, 0.25, 0.125}), {18, 3, -4}, 5),
                  of_mass(box_part({0.5, 0.5, 0.125}), {19.5, 3, -4}, 20),
                  of_mass(sphere_part(0.25), {22, 5, -4}, 2),
                  fixed_box({2.25, 2.8125, 0}, {3, 0.0625, 1}),
                  of_mass(box_part({0.5, 0.125, 0.125}), {12, 4, -4}, 2),
                  body_of(sphere_part(0.5), {-2, 0.75, -4})};
  scene.bodies[walker].type = BodyType::kinematic;
  scene.bodies[feeler].type = BodyType::kinematic;
  scene.bodies[feeler].sensor = true;
  scene.bodies[ground].kind = 1;
  scene.bodies[sled].kind = 2;
  scene.bodies[sled].static_friction = 0.75;
  scene.bodies[sled].anisotropy = {0.25, 1, 1};
}
void add_medium(Scene& scene) {
  scene.records.push_back({"water",
                           {{"surface_height", {1}},
                            {"middle", {-8, 0, 0}},
                            {"half", {2, 2, 4}},
                            {"current", {0, 0, 0.25}},
                            {"wave_height", {0.125}},
                            {"wave_length", {6}}}});
  scene.records.push_back({"buoyancy", {{"body", {buoy}}, {"max_depth", {0.5}}, {"volume", {0.5}}, {"density", {80}}}});
  scene.records.push_back(
      {"force_zone", {{"shape", {2}}, {"pose", {4, 4, 0, 0, 0, 0, 1}}, {"half", {2, 4, 4}}, {"wind", {-2, 0, 0}}}});
}
void add_pulls(Scene& scene) {
  scene.records.push_back({"attractor", {{"body", {swing}}, {"strength", {5}}, {"range", {8}}}});
  scene.records.push_back({"body_spring",
                           {{"a", {swing}},
                            {"b", {-1}},
                            {"anchor_a", {0, 0.25, 0}},
                            {"anchor_b", {0, 4, 0}},
                            {"rest_length", {0.5}},
                            {"stiffness", {60}},
                            {"damping", {1}}}});
  scene.records.push_back({"thruster", {{"body", {kite}}, {"force", {0, 21, 0}}}});
  scene.records.push_back(
      {"drag", {{"body", {moon}}, {"linear", {0.25}}, {"quadratic", {0.125}}, {"angular", {0.125}}}});
  scene.records.push_back(
      {"aero_surface",
       {{"body", {kite}}, {"point", {0, 0, 0.25}}, {"tensor", {-0.5, 0, 0, -0.25, -2, 0, 0, 0, -0.5}}}});
  scene.records.push_back({"character", {{"body", {walker}}, {"move", {2, 0, 0.25}}, {"jump", {3}}}});
}
void add_blows(Scene& scene) {
  scene.records.push_back({"material_pair", {{"kind_a", {1}}, {"kind_b", {2}}, {"friction", {0.125}}}});
  scene.records.push_back(
      {"breakable",
       {{"body", {cube}}, {"break_impulse", {10}}, {"most_pieces", {8}}, {"small_mass", {4}}, {"lifetime", {60}}}});
  scene.records.push_back({"explosion",
                           {{"centre", {12, 0.25, 0}},
                            {"begin", {30}},
                            {"implosion_force", {20}},
                            {"implosion_most", {6}},
                            {"implosion_duration", {0.125}},
                            {"wave_force", {800}},
                            {"wave_speed", {40}},
                            {"wave_duration", {0.25}},
                            {"chimney_force", {50}},
                            {"chimney_radius", {3}},
                            {"chimney_height", {4}},
                            {"chimney_duration", {0.5}},
                            {"is_shielded", {1}}}});
}
/// The crate drives itself like a tank; the walker feels what is before it; the kite rises through a shelf, in which
/// the swing hangs from the start.
void add_rules(Scene& scene) {
  scene.records.push_back({"surface_velocity", {{"body", {crate}}, {"linear", {0, 0, 1}}, {"angular", {0, 0.125, 0}}}});
  scene.records.push_back({"sensor_mount", {{"sensor", {feeler}}, {"on", {walker}}, {"position", {0.75, 0, 0}}}});
  scene.records.push_back({"one_way", {{"body", {shelf}}, {"least_cosine", {0.75}}}});
  scene.records.push_back({"ghost", {{"a", {shelf}}, {"b", {swing}}}});
  scene.records.push_back({"hit_report", {{"body", {hammer}}, {"speed", {2}}}});
  scene.records.push_back({"contact_report", {{"body", {crate}}}});
  scene.records.push_back({"kind_ghost", {{"kind_a", {2}}, {"kind_b", {3}}}});
  scene.records.push_back({"force_zone",
                           {{"shape", {1}},
                            {"position", {22, 5, -4}},
                            {"half", {2, 0, 0}},
                            {"acceleration", {0, -10.5, 0}},
                            {"priority", {1}},
                            {"replaces", {5}}}});
}
/// The ground's side of the sled, what slows the swing, and a lower level around the raft.
void add_media(Scene& scene) {
  scene.records.push_back(
      {"kind_response", {{"kind_a", {2}}, {"kind_b", {1}}, {"inverse_inertia_scale_a", {0.5}}, {"max_force", {75}}}});
  scene.records.push_back({"damping_zone",
                           {{"shape", {1}},
                            {"position", {0, 3, 0}},
                            {"half", {1, 0, 0}},
                            {"linear", {0.5}},
                            {"angular", {1}},
                            {"priority", {1}},
                            {"replaces", {1}}}});
  scene.records.push_back({"water",
                           {{"surface_height", {0.875}},
                            {"middle", {-8, 0, 0}},
                            {"half", {1, 2, 2}},
                            {"linear_drag", {1}},
                            {"priority", {1}},
                            {"replaces", {1}}}});
}
/// Drives round a curve.
void add_cart(Scene& scene) {
  scene.records.push_back({"vehicle",
                           {{"body", {cart}},
                            {"engine_torque", {20}},
                            {"gears", {1, 0, 0, 0, 0, 0, 0, 0}},
                            {"throttle", {1}},
                            {"steer", {0.5}}}});
  for (const int i : {0, 1, 2, 3}) {
    const bool front = i < 2;
    scene.records.push_back({"wheel",
                             {{"body", {cart}},
                              {"hard_point", {i % 2 == 0 ? 0.375 : -0.375, 0, front ? 0.625 : -0.625}},
                              {"stiffness", {4000}},
                              {"damping", {250}},
                              {"radius", {0.25}},
                              {"steer_angle", {front ? 1.0 : 0.0}},
                              {"drive_share", {front ? 0.0 : 1.0}},
                              {"axle", {front ? 1.0 : 2.0}},
                              {"anti_roll", {500}}}});
  }
}

/// A motor turns a wheel by a gear; a bob swings until what it hangs on breaks; a servo lifts an arm that swings in a
/// cone.
void add_joints(Scene& scene) {
  const auto joined = [](JointType type, int body, Point anchor) {
    SceneJoint joint;
    joint.type = type;
    joint.b = body;
    joint.anchor = joint.anchor_b = vector_of(anchor);
    return joint;
  };
  scene.joints = {joined(JointType::hinge, shaft, {18, 3, -4}), joined(JointType::hinge, wheel, {19.5, 3, -4}),
                  joined(JointType::ball, bob, {21, 5, -4}), joined(JointType::six_axis, arm, {11.5, 4, -4})};
  scene.joints[0].flags = joint_flag::kMotor;
  scene.joints[0].motor_speed = 6;
  scene.joints[0].max_force = 100;
  scene.joints[3].flags = joint_flag::kLockPoint | joint_flag::kCone;
  for (const int axis : {3, 4}) {
    scene.records.push_back({"axis_drive",
                             {{"joint", {3}},
                              {"axis", {static_cast<double>(axis)}},
                              {"limited", {1}},
                              {"lower", {axis == 3 ? -0.25 : -0.5}},
                              {"upper", {axis == 3 ? 0.25 : 0.5}}}});
  }
  scene.records.push_back({"axis_drive",
                           {{"joint", {3}},
                            {"axis", {5}},
                            {"limited", {1}},
                            {"lower", {-1}},
                            {"upper", {0.25}},
                            {"spring_mass", {0.5}},
                            {"limit_frequency", {8}},
                            {"limit_damping", {0.5}},
                            {"spring_target", {0.5}},
                            {"spring_frequency", {2}},
                            {"spring_damping", {1}},
                            {"max_force", {12}}}});
  scene.records.push_back({"joint_load", {{"joint", {2}}, {"break_force", {45}}}});
  scene.records.push_back(
      {"coupling", {{"joint_a", {0}}, {"joint_b", {1}}, {"ratio_a", {1}}, {"ratio_b", {2}}, {"upper", {0.125}}}});
}

}  // namespace

Scene elements() {
  Scene scene;
  scene.frames = kElementsFrames;
  add_bodies(scene);
  add_medium(scene);
  add_pulls(scene);
  add_blows(scene);
  add_media(scene);
  add_cart(scene);
  add_joints(scene);
  add_rules(scene);
  return scene;
}

}  // namespace isostep::scenes
