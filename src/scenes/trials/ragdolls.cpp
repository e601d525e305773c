// Trials of ragdolls whose joints have limits: they fall, and gain nothing.
// SPDX-License-Identifier: MIT
#include "scenes/ragdolls.hpp"

#include "families.hpp"
#include "judges.hpp"
#include "scene_numbers.hpp"
#include "scenes/limits.hpp"
#include "scenes/named.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// [J/kg] rounding moves the energy of what has hardly begun to fall by less.
constexpr double kRise = 1e-3;

/// [%] The error of joints, limits and energy, over the run and at its end: the one nearest to its bar, over that bar.
class LimitedRagdolls : public FromStart {
 public:
  explicit LimitedRagdolls(const Scene& scene) : limits_(scene) {
    for (const SceneBody& body : scene.bodies) mass_ += body.type == BodyType::dynamic ? mass_of(body) : 0;
  }
  double figure() const override { return 100 * worse(worse(over_, end_), rise_); }

 private:
  void compare(const Sight& start, const Sight& now) override {
    constexpr double kJoint = 0.05, kJointEnd = 0.005;  // [m]
    constexpr double kLimit = 0.15, kLimitEnd = 0.02;   // [rad]
    const double passed = limits_.passed(start.bodies, now.bodies), joint = now.joint_error;
    over_ = worse(over_, worse(joint / kJoint, passed / kLimit));
    end_ = worse(joint / kJointEnd, passed / kLimitEnd);
    rise_ = worse(rise_, (now.energy.total() - start.energy.total()) / (mass_ * kRise));
  }
  JointLimits limits_;
  double mass_ = 0;                       // [kg]
  double over_ = 0, end_ = 0, rise_ = 0;  // [1] of their bars
};

/// [J/kg] the most that any one ragdoll, by itself, had more than at its start.
class RagdollEnergy : public Judge {
 public:
  explicit RagdollEnergy(const Scene& scene) {
    for (const SceneBody& body : scene.bodies) {
      if (body.type != BodyType::dynamic) ++fixed_;
      else masses_.push_back({mass_of(body), inertia_of(body)});
    }
  }
  void see(const Sight& sight) override {
    std::vector<double> now;
    for (std::size_t i = 0; i < masses_.size(); i += kRagdollParts) now.push_back(energy_of(sight, i));
    if (start_.empty()) start_ = now;
    for (std::size_t i = 0; i < now.size(); ++i) rise_ = worse(rise_, now[i] - start_[i]);
  }
  double figure() const override { return rise_; }

 private:
  struct Mass {
    double mass;           // [kg]
    Mat3<double> inertia;  // [kg m^2] body frame
  };
  double energy_of(const Sight& sight, std::size_t first) const {
    double energy = 0, mass = 0;
    for (std::size_t i = first; i < first + kRagdollParts; ++i) {
      const BodySight& body = sight.bodies[fixed_ + i];
      const Vec3<double> angular_velocity =
          transposed_times(to_matrix(normalise(body.orientation)), body.angular_velocity);
      energy += masses_[i].mass * (dot(body.velocity, body.velocity) / 2 + 10 * body.centre.y);
      energy += dot(angular_velocity, masses_[i].inertia * angular_velocity) / 2;
      mass += masses_[i].mass;
    }
    return energy / mass;
  }
  std::size_t fixed_ = 0;  // bodies, which come first
  std::vector<Mass> masses_;
  std::vector<double> start_;
  double rise_ = 0;
};

// ---- into a corner

constexpr double kCorner = 3, kThrown = 60;  // [m] of the walls' faces, [m/s]

/// A ragdoll with limits is thrown into the corner of two walls and a floor.
Scene thrown_ragdoll() {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = 300;
  add_floor(scene);
  scene.bodies.push_back(fixed_box({kCorner + 0.5, 20, 0}, {0.5, 20, 20}));
  scene.bodies.push_back(fixed_box({0, 20, kCorner + 0.5}, {20, 20, 0.5}));
  const std::size_t first = scene.bodies.size();
  add_ragdoll(scene, {-1, 2, -1}, 0, true);
  const double speed = kThrown * kHalfRoot;
  for (std::size_t i = first; i < scene.bodies.size(); ++i) scene.bodies[i].velocity = vector_of({speed, 0, speed});
  return scene;
}
/// [%] The error of joints, over the run and after a second: the one nearest to its bar, over that bar; 1000 for what
/// is through.
class CornerOfRagdoll : public Judge {
 public:
  void see(const Sight& sight) override {
    constexpr double kOver = 0.05, kAfter = 0.001;  // [m]
    worst_ = worse(worst_, sight.joint_error / (sight.time < 1 ? kOver : kAfter));
    for (const BodySight& body : sight.bodies) {
      const bool through = body.centre.x > kCorner || body.centre.z > kCorner || body.centre.y < 0;
      if (body.dynamic && through) worst_ = worse(worst_, 10);
    }
  }
  double figure() const override { return 100 * worst_; }

 private:
  double worst_ = 0;  // [1]
};

}  // namespace

std::span<const Trial> ragdoll_trials() {
  static const Trial trials[] = {
      {"ragdolls_with_limits", "S20", "50 ragdolls with the limits of a body's joints fall into a pit",
       "joints of 50 mm, 5 mm at the end, limits passed by 0.15 rad, 0.02 rad at the end, or energy gained: the worst, "
       "of its bar",
       "%", 100, limited_ragdolls, judge_of<LimitedRagdolls>},
      {"ragdoll_from_every_tilt", "26", "a ragdoll with limits falls 2 m, at a hundred tilts",
       "energy that any of them gained", "J/kg", kRise, tilted_ragdolls, judge_of<RagdollEnergy>},
      {"ragdoll_into_corner", "34", "a ragdoll with limits at 60 m/s into the corner of two walls",
       "joints of 50 mm, 1 mm after a second: the worst, of its bar; 1000 for a part that is through", "%", 100,
       thrown_ragdoll, judge_of<CornerOfRagdoll>},
  };
  return trials;
}

}  // namespace isostep::scenes
