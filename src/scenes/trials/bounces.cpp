// Trials of restitution 1: what bounces must keep its energy, however steps and contacts fall.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "judges.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// [%] Largest change of a group's energy of motion and height above `floor`, a kilogram, over that of the start.
class EnergyKept : public Judge {
 public:
  /// `together`: energy may pass between bodies, so that only their sum counts.
  EnergyKept(double floor, double gravity, bool together) : floor_(floor), gravity_(gravity), together_(together) {}
  void see(const Sight& sight) override {
    std::vector<double> now;
    for (const BodySight& body : sight.bodies) {
      if (!body.dynamic) continue;
      const double energy = 0.5 * dot(body.velocity, body.velocity) + gravity_ * (body.centre.y - floor_);
      if (together_ && !now.empty()) now.front() += energy;
      else now.push_back(energy);
    }
    if (start_.empty()) start_ = now;
    for (std::size_t i = 0; i < start_.size(); ++i) worst_ = worse(worst_, std::abs(now[i] / start_[i] - 1));
  }
  double figure() const override { return 100 * worst_; }

 private:
  double floor_, gravity_;  // [m], [m/s^2]
  bool together_;
  std::vector<double> start_;  // [J/kg]
  double worst_ = 0;
};

SceneBody bouncer(double radius, Point at) {
  SceneBody ball = body_of(sphere_part(radius), at);
  ball.restitution = 1;
  ball.friction = 0;
  return ball;
}

/// Three balls dropped from 1, 2.1 and 4.7 m: the first bounces eleven times in the run.
Scene bouncing_balls() {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = 600;
  add_floor(scene);
  double x = -3;
  for (const double height : {1.0, 2.1, 4.7}) {
    scene.bodies.push_back(bouncer(0.5, {x, 0.5 + height, 0}));
    x += 3;
  }
  return scene;
}
std::unique_ptr<Judge> judge_bouncing(const Scene&) { return std::make_unique<EnergyKept>(0.5, kGravity, false); }

/// Balls at 7, 20 and 50 m/s between walls 10 m apart, weightless.
Scene rallies() {
  Scene scene;
  scene.gravity = zero_vector();
  scene.allow_sleep = false;
  scene.frames = 900;
  for (const double side : {-1.0, 1.0}) scene.bodies.push_back(fixed_box({7 * side, 0, 0}, {2, 2, 5}));
  double z = -3;
  for (const double speed : {7.0, 20.0, 50.0}) {
    scene.bodies.push_back(bouncer(0.25, {0.1 * z, 0, z}));
    scene.bodies.back().velocity = vector_of({speed, 0, 0});
    z += 3;
  }
  return scene;
}
std::unique_ptr<Judge> judge_rallies(const Scene&) { return std::make_unique<EnergyKept>(0, 0, false); }

constexpr double kString = 1.25, kHook = 3, kCradleBall = 0.25;  // [m]

/// Five balls touch, hung by strings that are rods; the first is let go at 60 degrees. A swing takes about 2.4 s.
Scene cradle() {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = 780;
  for (int i = 0; i < 5; ++i) {
    const double x = 2 * kCradleBall * (i - 2), sine = i == 0 ? std::sqrt(0.75) : 0.0, cosine = i == 0 ? 0.5 : 1.0;
    const Point centre = {x - kString * sine, kHook - kString * cosine, 0};
    scene.bodies.push_back(bouncer(kCradleBall, centre));
    SceneJoint rod;
    rod.type = JointType::distance;
    rod.b = i;
    rod.anchor = vector_of({x, kHook, 0});
    rod.anchor_b = vector_of(centre);
    rod.flags = joint_flag::kLimit;
    rod.lower = rod.upper = kString;
    scene.joints.push_back(rod);
  }
  return scene;
}
std::unique_ptr<Judge> judge_cradle(const Scene&) {
  return std::make_unique<EnergyKept>(kHook - kString, kGravity, true);
}

}  // namespace

std::span<const Trial> bounce_trials() {
  static const Trial trials[] = {
      {"bouncing_balls", "24", "balls of restitution 1 bounce on a floor for ten seconds", "change of energy", "%", 2,
       bouncing_balls, judge_bouncing},
      {"rallies", "24", "balls of restitution 1 fly to and fro between walls at up to 50 m/s", "change of energy", "%",
       2, rallies, judge_rallies},
      {"newtons_cradle", "24", "Newton's cradle of five balls for ten knocks", "change of energy", "%", 2, cradle,
       judge_cradle},
  };
  return trials;
}

}  // namespace isostep::scenes
