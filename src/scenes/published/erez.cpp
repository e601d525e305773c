// Tests of engines for robots: drift of energy and momentum, and how soon runs agree as the step shrinks.
// Source:  Erez, Tassa, Todorov 2015, Simulation tools for model-based robotics: comparison of Bullet, Havok, MuJoCo,
//          ODE and PhysX, ICRA. Differs: the same kinds of systems and measures, bodies and drives of our own, so that
//          its figures are not repeated.
// SPDX-License-Identifier: MIT
#include "hinged.hpp"
#include "published.hpp"
#include "scenes/ragdolls.hpp"
#include "scenes/trials/judges.hpp"
#include "scenes/trials/scene_numbers.hpp"

namespace isostep::scenes {
namespace {

constexpr int kShort = 50;  // frames of 10 ms: the time after which runs are compared

/// Compares a run with another one by the places of its bodies at its end.
class EndOfRun : public Judge {
 public:
  void see(const Sight& sight) override { end_ = sight; }
  double figure() const override { return 0; }
  std::vector<double> outcome() const override {
    std::vector<double> places;
    for (const BodySight& body : end_.bodies) {
      if (body.dynamic) places.insert(places.end(), {body.centre.x, body.centre.y, body.centre.z});
    }
    return places;
  }

 private:
  Sight end_;
};

// Planar chain: ten links on parallel hinges, weightless, nothing touches.

Scene planar_chain(int frames) {
  constexpr int kLinks = 10;
  constexpr double kLength = 0.5;  // [m]
  Scene scene = weightless(frames);
  scene.hz = 100;
  Draws draws(2015);
  std::vector<double> rates;
  for (int i = 0; i < kLinks; ++i) {
    SceneBody link = body_of(capsule_part(0.05, 0.2), {kLength * (i + 0.5), 0, 0});
    link.orientation = {0, 0, -kHalfRoot, kHalfRoot};
    link.mass = 1;
    link.collide = false;
    scene.bodies.push_back(link);
    if (i == 0) continue;
    scene.joints.push_back(hinge_of(i - 1, i, {kLength * i, 0, 0}));
    rates.push_back(draws.between(-1, 1.5));
  }
  turn_hinges(scene, 0, rates);
  return scene;
}
Scene chain_for_long() { return planar_chain(1000); }
Scene chain_for_short() { return planar_chain(kShort); }

/// [%] The largest change of energy, of that at the start.
class EnergyDrift : public FromStart {
 public:
  double figure() const override { return 100 * worst_; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    worst_ = worse(worst_, std::abs(now.energy.total() / start.energy.total() - 1));
  }
  double worst_ = 0;
};
/// [kg m^2/s] The largest change of angular momentum about the centre of mass.
class MomentumDrift : public FromStart {
 public:
  explicit MomentumDrift(const Scene& scene) : inertias_(scene) {}
  double figure() const override { return worst_; }

 protected:
  double at_start() const { return at_start_; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    const Vec3<double> before = inertias_.angular_momentum(start);
    at_start_ = length_of(before);
    worst_ = worse(worst_, length_of(inertias_.angular_momentum(now) - before));
  }
  Inertias inertias_;
  double worst_ = 0, at_start_ = 0;
};
/// [%] The same, of that at the start.
class MomentumShare : public MomentumDrift {
 public:
  using MomentumDrift::MomentumDrift;
  double figure() const override { return 100 * MomentumDrift::figure() / at_start(); }
};

// 27 capsules fall and meet.

Scene capsules() {
  Scene scene = awake(kShort);
  scene.hz = 100;
  add_floor(scene);
  Draws draws(27);
  for (int n = 0; n < 27; ++n) {
    const double x = 0.45 * (n % 3), y = 0.2 + 0.3 * (n / 9), z = 0.45 * (n / 3 % 3);
    SceneBody body = body_of(capsule_part(0.1, 0.1), {x, y, z});
    const double turn = draws.between(0, kTurn), tilt = draws.between(-0.3, 0.3);
    const SinCos<double> yaw_half = sin_cos(turn / 2), tilt_half = sin_cos((kTurn / 4 + tilt) / 2);
    // First tilted from y towards z about x, then turned about y.
    body.orientation = {yaw_half.cos * tilt_half.sin, yaw_half.sin * tilt_half.cos, -yaw_half.sin * tilt_half.sin,
                        yaw_half.cos * tilt_half.cos};
    body.mass = 1;
    scene.bodies.push_back(body);
  }
  return scene;
}

// Humanoid: eleven bodies on ten hinges, whose motors move it while it falls; nothing touches.

Scene humanoid(int frames) {
  Scene scene = awake(frames);
  scene.hz = 100;
  add_ragdoll(scene, {0, 10, 0}, 0, false);
  for (SceneBody& body : scene.bodies) body.collide = false;
  Draws draws(25);
  for (SceneJoint& joint : scene.joints) {
    joint.type = JointType::hinge;
    joint.orientation = {0, kHalfRoot, 0, kHalfRoot};  // z to x
    joint.flags = joint_flag::kMotor;
    joint.motor_speed = draws.between(-3, 3);
    joint.max_force = draws.between(0.2, 1);
  }
  return scene;
}
Scene humanoid_for_long() { return humanoid(200); }
Scene humanoid_for_short() { return humanoid(kShort); }

// Grasp: two fingers of two links press a block between them by their motors and hold it.

constexpr double kPalm = 1;  // [m] its height

Scene grasp() {
  constexpr double kNear = 2, kFar = 0.5, kClosing = 1;  // [N m] [N m] [rad/s]
  Scene scene = awake(500);
  scene.hz = 100;
  scene.bodies.push_back(fixed_box({0, kPalm, 0}, {0.2, 0.03, 0.1}));
  for (const double side : {-1.0, 1.0}) {
    const int first = static_cast<int>(scene.bodies.size());
    const double x = 0.12 * side;
    for (const double y : {kPalm - 0.09, kPalm - 0.21}) {
      scene.bodies.push_back(body_of(box_part({0.02, 0.055, 0.03}), {x, y, 0}));
      scene.bodies.back().mass = 0.2;
    }
    scene.joints.push_back(hinge_of(0, first, {x, kPalm - 0.03, 0}));
    scene.joints.push_back(hinge_of(first, first + 1, {x, kPalm - 0.15, 0}));
    for (const double torque : {kNear, kFar}) {
      SceneJoint& joint = scene.joints[scene.joints.size() - (torque == kNear ? 2 : 1)];
      joint.flags = joint_flag::kMotor;
      joint.motor_speed = -side * kClosing;
      joint.max_force = torque;
    }
  }
  scene.bodies.push_back(body_of(box_part({0.1, 0.05, 0.05}), {0, kPalm - 0.22, 0}));
  scene.bodies.back().mass = 0.5;
  for (SceneBody& body : scene.bodies) body.friction = 0.8;
  return scene;
}
/// [mm] The furthest way of the block after the first second; its fall where it fell.
class Slip : public Judge {
 public:
  void see(const Sight& sight) override {
    if (sight.time < 1 - 1e-6) return;
    if (start_.bodies.empty()) start_ = sight;
    worst_ = worse(worst_, length_of(way_of(start_, sight, sight.bodies.size() - 1)));
    worst_ = worse(worst_, kPalm - 0.5 - sight.bodies.back().centre.y);
  }
  double figure() const override { return 1000 * worst_; }

 private:
  Sight start_;
  double worst_ = 0;
};

constexpr int kShrinking[] = {50, 100, 250, 500, 1000};
constexpr int kDriftRates[] = {100, 250, 1000};
constexpr int kGraspRates[] = {25, 50, 100, 250, 1000};

constexpr PublishedBar kEnergyDrift[] = {{100, 3, 0.1}};
constexpr PublishedBar kMomentumShare[] = {{100, 4, 1e-6}};
constexpr PublishedBar kMomentumDrift[] = {{100, 2e-3, 1e-6}};
constexpr PublishedBar kChainSteps[] = {{100, 2e-3, 1e-5}};
constexpr PublishedBar kCapsuleSteps[] = {{100, 0.1, 1e-3}};
constexpr PublishedBar kHumanoidSteps[] = {{100, 6e-3, 1e-4}};
constexpr PublishedBar kSlip[] = {{100, 0.05, 0.01}};

constexpr const char* kTheirChain = "a planar chain too, of another length and other masses";
constexpr const char* kTheirHumanoid =
    "a humanoid too; ours has 16 degrees of freedom, is moved by motors and touches nothing";
constexpr const char* kAway = "distance from the same engine's run in the shortest steps, after 0.5 s";

PublishedTest erez_test(Trial trial, const char* differs, std::span<const int> rates,
                        std::span<const PublishedBar> bars, bool compares_steps = false) {
  return with_first_bar({.trial = trial,
                         .source = "After Erez, Tassa and Todorov",
                         .year = 2015,
                         .differs = differs,
                         .compares_steps = compares_steps,
                         .rates = rates,
                         .bars = bars});
}

}  // namespace

std::span<const PublishedTest> erez_tests() {
  static const PublishedTest tests[] = {
      erez_test({"erez_chain_energy", "chain, energy", "ten links on parallel hinges turn, weightless, 10 s",
                 "largest change of energy", "%", 0, chain_for_long, judge_of<EnergyDrift>},
                kTheirChain, kDriftRates, kEnergyDrift),
      erez_test({"erez_chain_momentum", "chain, momentum", "the same", "largest change of angular momentum", "%", 0,
                 chain_for_long, judge_of<MomentumShare>},
                kTheirChain, kDriftRates, kMomentumShare),
      erez_test(
          {"erez_chain", "chain, steps", "the same for 0.5 s", kAway, "m", 0, chain_for_short, judge_of<EndOfRun>},
          kTheirChain, kShrinking, kChainSteps, true),
      erez_test({"erez_capsules", "27 capsules", "27 capsules fall on the ground and on each other", kAway, "m", 0,
                 capsules, judge_of<EndOfRun>},
                "27 capsules too, of other sizes", kShrinking, kCapsuleSteps, true),
      erez_test(
          {"erez_humanoid_momentum", "humanoid", "eleven bodies on ten hinges fall from rest, turned by motors, 2 s",
           "largest angular momentum", "kg m^2/s", 0, humanoid_for_long, judge_of<MomentumDrift>},
          kTheirHumanoid, kDriftRates, kMomentumDrift),
      erez_test({"erez_humanoid", "humanoid, steps", "the same for 0.5 s", kAway, "m", 0, humanoid_for_short,
                 judge_of<EndOfRun>},
                kTheirHumanoid, kShrinking, kHumanoidSteps, true),
      erez_test({"erez_grasp", "grasp", "two fingers of two links hold a block by their motors, 5 s",
                 "furthest way of the block after the first second", "mm", 0, grasp, judge_of<Slip>},
                "theirs squeezes by springs and dampers", kGraspRates, kSlip),
  };
  return tests;
}

}  // namespace isostep::scenes
