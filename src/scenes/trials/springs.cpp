// Trials of springs far stiffer, and dampers far stronger, than a step can follow: none may gain energy.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "judges.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// One row of balls on springs from the world, or from ball to ball.
struct Row {
  double frequency, damping;   // [Hz], [1]
  std::vector<double> masses;  // [kg] outwards
};

constexpr double kRest = 1, kStretch = 0.05;  // [m]

SceneJoint spring(const Row& row, int a, int b, double z, double from, double to) {
  SceneJoint joint;
  joint.type = JointType::distance;
  joint.flags = joint_flag::kSpring;
  joint.a = a;
  joint.b = b;
  joint.anchor = vector_of({from, 0, z});
  joint.anchor_b = vector_of({to, 0, z});
  joint.spring_target = kRest;
  joint.spring_frequency = row.frequency;
  joint.spring_damping = row.damping;
  return joint;
}

/// Every spring begins stretched by kStretch, every ball with `speed` outwards.
Scene rows_of(const std::vector<Row>& rows, double speed) {
  Scene scene;
  scene.gravity = zero_vector();
  scene.allow_sleep = false;
  scene.frames = 600;
  double z = 0;
  for (const Row& row : rows) {
    int before = -1;
    double x = 0;
    for (const double mass : row.masses) {
      SceneBody ball = body_of(sphere_part(0.1), {x + kRest + kStretch, 0, z});
      ball.mass = mass;
      ball.velocity = vector_of({speed, 0, 0});
      ball.collide = false;
      scene.bodies.push_back(ball);
      const int self = static_cast<int>(scene.bodies.size()) - 1;
      scene.joints.push_back(spring(row, before, self, z, x, x + kRest + kStretch));
      x += kRest + kStretch;
      before = self;
    }
    z += 2;
  }
  return scene;
}

/// k h^2 / m of the first is 110 with h of a frame.
Scene stiff_springs() {
  return rows_of({{100, 0, {1}}, {100, 0.1, {1}}, {100, 1, {1}}, {30, 0, {1}}, {100, 0, {1, 50}}, {100, 0, {1, 1, 1}}},
                 0);
}
/// c h / m of the first is 13 with h of a frame: the springs beside the dampers are weak.
Scene strong_dampers() {
  return rows_of({{1, 64, {1}}, {10, 64, {1}}, {100, 64, {1}}, {10, 64, {1, 50}}, {10, 64, {1, 1, 1}}}, 5);
}

/// [%] Energy gained: kinetic, and of each spring 1/2 m (2 pi f)^2 x^2 with the reduced mass of its ends.
class SpringEnergy : public Judge {
 public:
  explicit SpringEnergy(const Scene& scene) : joints_(scene.joints) {
    for (const SceneBody& body : scene.bodies) masses_.push_back(mass_of(body));
  }
  void see(const Sight& sight) override {
    double energy = 0;
    for (std::size_t i = 0; i < masses_.size(); ++i) {
      energy += 0.5 * masses_[i] * dot(sight.bodies[i].velocity, sight.bodies[i].velocity);
    }
    for (const SceneJoint& joint : joints_) energy += energy_of(joint, sight);
    if (!(start_ > 0)) start_ = energy;
    worst_ = worse(worst_, energy / start_ - 1);
  }
  double figure() const override { return 100 * worst_; }

 private:
  double energy_of(const SceneJoint& joint, const Sight& sight) const {
    const auto b = static_cast<std::size_t>(joint.b);
    Vec3<double> from = value(joint.anchor);
    double mass = masses_[b];
    if (joint.a >= 0) {
      const auto a = static_cast<std::size_t>(joint.a);
      from = sight.bodies[a].centre;
      mass = mass * masses_[a] / (mass + masses_[a]);
    }
    const double x = length_of(sight.bodies[b].centre - from) - value(joint.spring_target);
    const double rate = kTurn * value(joint.spring_frequency);
    return 0.5 * mass * rate * rate * x * x;
  }

  std::vector<SceneJoint> joints_;
  std::vector<double> masses_;  // [kg]
  double start_ = 0;            // [J]
  double worst_ = 0;
};

}  // namespace

std::span<const Trial> spring_trials() {
  static const Trial trials[] = {
      {"stiff_springs", "21", "balls on springs of 30 and 100 Hz, weightless", "energy gained", "%", 0.1, stiff_springs,
       judge_of<SpringEnergy>},
      {"strong_dampers", "21", "balls on dampers that would stop them in a fraction of a step", "energy gained", "%",
       0.1, strong_dampers, judge_of<SpringEnergy>},
  };
  return trials;
}

}  // namespace isostep::scenes
