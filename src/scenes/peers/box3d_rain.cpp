// After Box3D's rain: figures of 14 capsules, whose joints have limits, springs and friction, fall on rings.
// SPDX-License-Identifier: MIT
#include "land.hpp"
#include "peers.hpp"

namespace isostep::scenes {
namespace {

/// A capsule upright, or along x.
struct Limb {
  double x, y;          // [m] its middle
  double radius, half;  // [m]
  bool sideways;
  int parent;           // place in the table
  double at_x, at_y;    // [m] the joint with it
  double cone;          // [rad] 0: a hinge about x, or of an arm about y
  double lower, upper;  // [rad] of the twist, or of the hinge
  double friction;      // [1] of Box3D's 5 N m
};
/// Radii, lengths, limits and frictions after Box3D's human, whose stance is another.
constexpr Limb kHuman[] = {{0, 0.95, 0.13, 0.07, true, -1, 0, 0, 0, 0, 0, 0},  // pelvis
                           {0, 1.12, 0.12, 0.06, true, 0, 0, 1.04, 0.44, -0.26, 0.26, 1},
                           {0, 1.26, 0.10, 0.08, true, 1, 0, 1.19, 0.44, -0.26, 0.26, 1},
                           {0, 1.42, 0.13, 0.11, true, 2, 0, 1.34, 0.26, -0.17, 0.17, 1},
                           {0, 1.58, 0.07, 0.04, false, 3, 0, 1.52, 0.79, -0.26, 0.26, 0.8},
                           {0, 1.74, 0.10, 0.03, false, 4, 0, 1.64, 0.26, -0.26, 0.26, 0.4},
                           {0.10, 0.68, 0.09, 0.20, false, 0, 0.10, 0.92, 0.17, -1.05, 0.70, 1},  // legs
                           {0.10, 0.24, 0.075, 0.21, false, 6, 0.10, 0.46, 0, -0.79, 0.09, 1},
                           {-0.10, 0.68, 0.09, 0.20, false, 0, -0.10, 0.92, 0.17, -0.70, 1.05, 1},
                           {-0.10, 0.24, 0.075, 0.21, false, 8, -0.10, 0.46, 0, -0.79, 0.09, 1},
                           {0.38, 1.46, 0.07, 0.12, true, 3, 0.24, 1.46, 1.05, -0.09, 0.09, 1},  // arms
                           {0.66, 1.46, 0.05, 0.14, true, 10, 0.52, 1.46, 0, -0.09, 1.05, 1},
                           {-0.38, 1.46, 0.07, 0.12, true, 3, -0.24, 1.46, 1.05, -0.09, 0.09, 1},
                           {-0.66, 1.46, 0.05, 0.14, true, 12, -0.52, 1.46, 0, -1.05, 0.09, 1}};
constexpr double kTorque = 5, kSpring = 1, kDamping = 0.7;  // [N m], [Hz], [1]

/// A joint's frame at the start: its z axis goes along the limb, and of a hinge across it.
Rotation frame_of(const Limb& limb) {
  if (limb.cone == 0)
    return limb.sideways ? Rotation{-kHalfRoot, 0, 0, kHalfRoot} : Rotation{0, kHalfRoot, 0, kHalfRoot};
  if (limb.at_x != 0 && limb.sideways) return Rotation{0, limb.at_x > 0 ? kHalfRoot : -kHalfRoot, 0, kHalfRoot};
  return Rotation{limb.y > limb.at_y ? -kHalfRoot : kHalfRoot, 0, 0, kHalfRoot};
}

void drive(Scene& scene, double axis, double lower, double upper, double friction) {
  scene.records.push_back({"axis_drive",
                           {{"joint", {static_cast<double>(scene.joints.size()) - 1}},
                            {"axis", {axis}},
                            {"limited", {1}},
                            {"motor", {1}},
                            {"lower", {lower}},
                            {"upper", {upper}},
                            {"spring_frequency", {kSpring}},
                            {"spring_damping", {kDamping}},
                            {"max_force", {kTorque * friction}}}});
}
void tie(Scene& scene, int first, int n, Point feet) {
  const Limb& limb = kHuman[n];
  SceneJoint joint =
      joint_of(JointType::hinge, first + limb.parent, first + n, {feet.x + limb.at_x, feet.y + limb.at_y, feet.z});
  joint.orientation = frame_of(limb);
  if (limb.cone == 0) {
    joint.flags = joint_flag::kLimit | joint_flag::kMotor | joint_flag::kSpring;
    joint.lower = limb.lower;
    joint.upper = limb.upper;
    joint.max_force = kTorque * limb.friction;
    joint.spring_frequency = kSpring;
    joint.spring_damping = kDamping;
  } else {
    joint.type = JointType::six_axis;
    joint.flags = joint_flag::kLockPoint | joint_flag::kCone;
  }
  scene.joints.push_back(joint);
}

void add_human(Scene& scene, Point at) {
  const int first = static_cast<int>(scene.bodies.size());
  for (const Limb& limb : kHuman) {
    SceneBody body = body_of(capsule_part(limb.radius, limb.half), {at.x + limb.x, at.y + limb.y, at.z});
    if (limb.sideways) body.orientation = {0, 0, -kHalfRoot, kHalfRoot};
    body.density = 1000;
    body.friction = 0.6;
    body.rolling_resistance = 0.2 * limb.radius;
    scene.bodies.push_back(body);
  }
  for (int n = 1; n < static_cast<int>(std::size(kHuman)); ++n) {
    const Limb& limb = kHuman[n];
    tie(scene, first, n, at);
    if (limb.cone == 0) continue;
    drive(scene, 3, -limb.cone, limb.cone, limb.friction);
    drive(scene, 4, -limb.cone, limb.cone, limb.friction);
    drive(scene, 5, limb.lower, limb.upper, limb.friction);
  }
  // Limbs that begin in one another.
  for (const auto& [a, b] : {std::pair{6, 8}, {1, 6}, {1, 8}}) {
    scene.records.push_back(
        {"ghost", {{"a", {static_cast<double>(first + a)}}, {"b", {static_cast<double>(first + b)}}}});
  }
}

/// [m] A ring that stands upright.
ScenePart ring() {
  constexpr int kAlong = 16, kAround = 16;
  constexpr double kRing = 3.75, kTube = 1;
  ScenePart part;
  part.type = ShapeType::mesh;
  for (int a = 0; a < kAround; ++a) {
    const SinCos<double> v = sin_cos(kTurn * a / kAround);
    for (int b = 0; b < kAlong; ++b) {
      const SinCos<double> u = sin_cos(kTurn * b / kAlong);
      const double out = kRing + kTube * v.cos;
      part.vertices.push_back({on_grid(out * u.cos), on_grid(out * u.sin), on_grid(kTube * v.sin)});
    }
  }
  for (int a = 0; a < kAround; ++a) {
    for (int b = 0; b < kAlong; ++b) {
      const auto at = [&](int i, int k) { return static_cast<double>(i % kAround * kAlong + k % kAlong); };
      part.triangles.push_back({at(a, b), at(a, b + 1), at(a + 1, b + 1)});
      part.triangles.push_back({at(a + 1, b + 1), at(a + 1, b), at(a, b)});
    }
  }
  return part;
}

}  // namespace

Scene human_rain() {
  constexpr int kTiles = 10, kCells = 8, kHumans = 3;                  // along a side; in a column over a tile
  constexpr double kTile = 15, kLowest = 6, kRise = 5, kShift = 0.75;  // [m]
  Scene scene;
  scene.frames = 400;
  SceneBody tile = body_of(land(kCells, kCells, kTile / kCells, [](int, int) { return 0.0; }), {0, 0, 0});
  tile.parts.push_back(ring());
  tile.type = BodyType::static_;
  tile.friction = 0.6;
  const auto middle = [&](int n) { return (n - (kTiles - 1) * 0.5) * kTile; };
  for (int n = 0; n < kTiles * kTiles; ++n) {
    tile.position = {middle(n / kTiles), 0, middle(n % kTiles)};
    scene.bodies.push_back(tile);
  }
  for (int n = 0; n < kTiles * kTiles * kHumans; ++n) {
    const int column = n / kHumans, above = n % kHumans;
    add_human(scene,
              {middle(column / kTiles) + kShift * (above - 1), kLowest + kRise * above, middle(column % kTiles)});
  }
  return scene;
}

}  // namespace isostep::scenes
