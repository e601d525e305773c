// Trials of turning: free bodies that tumble, and rods that whirl onto a floor.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "judges.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// [%] Change of the angular momentum as a vector, so of length or direction; gain of energy; or way of the centre, of
/// a metre.
class FreeTurning : public Judge {
 public:
  explicit FreeTurning(const Scene& scene) : inertia_(inertia_of(scene.bodies[0])) {}

  void see(const Sight& sight) override {
    const BodySight& body = sight.bodies.front();
    const Mat3<double> axes = to_matrix(body.orientation);
    const Vec3<double> momentum = axes * (inertia_ * transposed_times(axes, body.angular_velocity));
    const double energy = 0.5 * dot(momentum, body.angular_velocity);
    if (!(energy_ > 0)) {
      centre_ = body.centre;
      momentum_ = momentum;
      energy_ = energy;
    }
    worst_ = worse(worst_, length_of(momentum - momentum_) / length_of(momentum_));
    worst_ = worse(worst_, energy / energy_ - 1);
    worst_ = worse(worst_, length_of(body.centre - centre_));
  }
  double figure() const override { return 100 * worst_; }

 private:
  Mat3<double> inertia_;
  Vec3<double> centre_ = {0, 0, 0};    // [m] at the start
  Vec3<double> momentum_ = {0, 0, 0};  // [kg m^2/s] at the start
  double energy_ = 0;                  // [J] at the start
  double worst_ = 0;
};

/// Moments 1.56, 3.57, 4.76 kg m^2 about x, y, z: about its stem, y, it turns over once in about two seconds.
Scene t_handle() {
  Scene scene = weightless(600);
  SceneBody body = body_of(box_part({0.5, 0.1, 0.1}), {0, 0, 0});
  body.parts.push_back(box_part({0.1, 0.2, 0.1}));
  body.parts.back().position = vector_of({0, -0.3, 0});
  body.density = 1000;
  body.angular_velocity = vector_of({0.05, 10, 0});
  scene.bodies.push_back(body);
  return scene;
}

Scene tilted_box() {
  Scene scene = weightless(600);
  SceneBody body = body_of(box_part({0.5, 0.125, 0.25}), {0, 0, 0});
  body.orientation = {0.1, 0.3, 0.3, 0.9};
  body.density = 1000;
  body.angular_velocity = vector_of({6, 8, 3});
  scene.bodies.push_back(body);
  return scene;
}

constexpr double kRodRadius = 0.02, kRodHalf = 0.98;  // [m]

/// Points of rods below the floor's face, y = 0, in radii; or energy gained, in percent of the start's.
class Whirl : public Judge {
 public:
  void see(const Sight& sight) override {
    if (!(start_ > 0)) start_ = sight.energy.total();
    for (const BodySight& body : sight.bodies) {
      if (!body.dynamic) continue;
      const double rise = to_matrix(body.orientation).column(1).y * kRodHalf;
      worst_ = worse(worst_, (std::abs(rise) + kRodRadius - body.centre.y) / kRodRadius);
    }
    worst_ = worse(worst_, 100 * (sight.energy.total() / start_ - 1));
  }
  double figure() const override { return worst_; }

 private:
  double start_ = 0;  // [J]
  double worst_ = 0;
};

/// Four rods of 2 m on a floor 10 cm thick; their tips move at 20 m/s, a third of a metre a frame.
Scene whirling_rods() {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = 300;
  scene.bodies.push_back(fixed_box({0, -0.05, 0}, {100, 0.05, 100}));
  const Point angular_velocities[] = {{0, 0, 20}, {20, 0, 0}, {0, 6, -19}, {-12, 0, 16}};
  for (int i = 0; i < 4; ++i) {
    SceneBody rod = body_of(capsule_part(kRodRadius, kRodHalf), {12.0 * (i % 2), 1.25, 12.0 * (i / 2)});
    rod.density = 1000;
    rod.angular_velocity = vector_of(angular_velocities[i]);
    scene.bodies.push_back(rod);
  }
  return scene;
}

}  // namespace

std::span<const Trial> motion_trials() {
  static const Trial trials[] = {
      {"t_handle", "12", "a T of two boxes turns over and over, weightless",
       "change of angular momentum, or energy gained", "%", 2, t_handle, judge_of<FreeTurning>},
      {"tilted_box", "12", "a flat box tumbles about no axis of its own, weightless",
       "change of angular momentum, or energy gained", "%", 2, tilted_box, judge_of<FreeTurning>},
      {"whirling_rods", "13", "thin rods fall onto a thin floor, their tips at 20 m/s",
       "depth below the floor over a rod's radius, or percent of energy gained", "", 1, whirling_rods, judge_of<Whirl>},
  };
  return trials;
}

}  // namespace isostep::scenes
