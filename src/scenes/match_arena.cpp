// The match's arena: floor, walls, ring, pile, mill, ropes and pucks.
// SPDX-License-Identifier: MIT
#include "match_arena.hpp"

#include "shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr double kPilePitch = 1.25;                      // [m] between neighbours in the pile
constexpr double kPuckRadius = 0.45;                     // [m]
const Rotation kAxisUp = {-kHalfRoot, 0, 0, kHalfRoot};  // z, a joint's axis, to y

/// Two spheres on a capsule, or two boxes: the pile's compounds.
SceneBody compound_body(bool dumbbell, Point at) {
  SceneBody body = body_of(dumbbell ? capsule_part(0.12, 0.3) : box_part({0.4, 0.1, 0.25}), at);
  for (const double side : {-0.3, 0.3}) {
    ScenePart part = dumbbell ? sphere_part(0.26) : box_part({0.1, 0.2, 0.25});
    part.position = dumbbell ? Vector{0, side, 0} : Vector{side, 0.3, 0};
    body.parts.push_back(part);
  }
  return body;
}

void add_walls(Scene& scene, double half, double height) {
  const double length = half - 1.5, middle = height / 2 - 0.5, tall = height / 2 + 0.5;
  for (const double side : {-1.0, 1.0}) {
    scene.bodies.push_back(fixed_box({side * (half + 0.5), middle, 0}, {0.5, tall, length}));
    scene.bodies.push_back(fixed_box({0, middle, side * (half + 0.5)}, {length, tall, 0.5}));
  }
}

/// `edge` bodies a side and layer, above the mill.
void add_pile(Scene& scene, int count, int edge, std::uint32_t seed) {
  Draws draws(seed);
  for (int n = 0; n < count; ++n) {
    const int layer = n / (edge * edge), column = n % (edge * edge);
    const double x = (column % edge - (edge - 1) * 0.5) * kPilePitch,
                 z = (column / edge - (edge - 1) * 0.5) * kPilePitch;
    const Point at = {x, 1.3 + kPilePitch * layer, z};
    const int kind = n % 5;
    SceneBody body = kind < 3 ? drawn_body(kind, at, draws, 1.2) : compound_body(kind == 3, at);
    body.angular_damping = 1;
    scene.bodies.push_back(body);
  }
}

/// Adds a mill, which a motor turns about the world's y axis.
int add_mill(Scene& scene) {
  SceneJoint hinge;
  hinge.type = JointType::hinge;
  hinge.b = static_cast<int>(scene.bodies.size());
  hinge.anchor = {0, 0.4, 0};
  hinge.orientation = kAxisUp;
  hinge.flags = joint_flag::kMotor;
  hinge.motor_speed = 1.5;
  hinge.max_force = 10;
  scene.joints.push_back(hinge);
  scene.bodies.push_back(body_of(box_part({1.8, 0.25, 0.2}), {0, 0.4, 0}));
  return static_cast<int>(scene.joints.size()) - 1;
}

/// Links of capsules and a ball at the end.
void add_weighted_rope(Scene& scene, Point top) {
  constexpr int kLinks = 4;
  constexpr double kLength = 0.5;  // [m]
  int last = -1;
  for (int n = 0; n <= kLinks; ++n) {
    const double y = top.y - kLength * n;
    SceneBody body = n < kLinks ? body_of(capsule_part(0.15, 0.1), {top.x, y - kLength / 2, top.z})
                                : body_of(sphere_part(0.3), {top.x, y - 0.3, top.z});
    body.mass = n < kLinks ? 0.3 : 0.5;
    body.angular_damping = 2;
    SceneJoint joint;
    joint.a = last;
    joint.b = last = static_cast<int>(scene.bodies.size());
    joint.anchor = {top.x, y, top.z};
    scene.bodies.push_back(body);
    scene.joints.push_back(joint);
  }
}

void add_pucks(Scene& scene, int players, double distance) {
  for (int player = 0; player < players; ++player) {
    const SinCos<double> turn = sin_cos(kTurn * player / players);
    SceneBody body = body_of(sphere_part(kPuckRadius), {distance * turn.cos, kPuckRadius, distance * turn.sin});
    body.density = 1.25;
    body.restitution = 0.5;
    body.angular_damping = 1;
    body.report_contacts = true;
    scene.bodies.push_back(body);
  }
}

}  // namespace

MatchSettings within_range(MatchSettings settings) {
  settings.players = clamp(settings.players, 1, static_cast<std::int32_t>(kMostPucks));
  settings.pile = clamp(settings.pile, 0, 4000);
  settings.hz = clamp(settings.hz, kLeastHz, kMostHz);
  settings.substeps = clamp(settings.substeps, 1, min(64, kMaxRate / settings.hz));
  return settings;
}

MatchPlan plan_match(const MatchSettings& settings) {
  int edge = 4;
  while (edge * edge * edge < settings.pile) ++edge;
  const double half = edge * kPilePitch / 2 + 2.5;
  MatchPlan plan = {{}, 0, 0, 0, 0, half};
  Scene& scene = plan.scene;
  scene.name = "match";
  scene.bodies.push_back(fixed_box({0, -1, 0}, {half, 1, half}));
  add_walls(scene, half, 1 + 0.5 * edge);
  plan.ring = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(fixed_box({0, 1.5, 0}, {1, 1, 1}));
  scene.bodies.back().sensor = true;
  add_pile(scene, settings.pile, edge, static_cast<std::uint32_t>(settings.seed));
  plan.mill_joint = add_mill(scene);
  plan.first_rope = static_cast<int>(scene.bodies.size());
  for (const double side : {-1.0, 1.0}) add_weighted_rope(scene, {side * (half - 1.2), 3.8, side});
  plan.first_puck = static_cast<int>(scene.bodies.size());
  add_pucks(scene, settings.players, half - 0.8);
  return plan;
}

}  // namespace isostep::scenes
