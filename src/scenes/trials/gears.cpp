// Trials of gears: wheels of 20, 40 and 10 teeth in a row.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "mechanism_parts.hpp"

namespace isostep::scenes {
namespace {

constexpr double kTeeth[] = {20, 40, 10};

void couple(Scene& scene, double a, double ratio_a, double b, double ratio_b) {
  scene.records.push_back(
      {"coupling", {{"joint_a", {a}}, {"joint_b", {b}}, {"ratio_a", {ratio_a}}, {"ratio_b", {ratio_b}}}});
}
/// Wheels as large as their teeth, meshed; the first is driven at `speed` [rad/s].
Scene wheels(double speed) {
  Scene scene = awake(3600);
  double x = 0;
  for (int i = 0; i < 3; ++i) {
    const double radius = kTeeth[i] / 40;
    x += i == 0 ? 0 : kTeeth[i - 1] / 40 + radius;
    scene.bodies.push_back(apart(weighing(body_of(box_part({radius, radius, 0.1}), {x, 0, 0}), kTeeth[i])));
    scene.joints.push_back(joint_of(JointType::hinge, -1, i, {x, 0, 0}));
  }
  scene.joints[0] = driven(scene.joints[0], speed, 2000);
  couple(scene, 0, kTeeth[0], 1, kTeeth[1]);
  couple(scene, 1, kTeeth[1], 2, kTeeth[2]);
  return scene;
}

/// The last winds up a weight on a slider.
Scene gear_train() {
  Scene scene = wheels(1);
  const double winch = 0.25, x = value(scene.joints[2].anchor).x;  // [m]
  scene.bodies.push_back(apart(weighing(body_of(box_part({0.25, 0.25, 0.25}), {x, -2, 0}), 4)));
  SceneJoint slide = joint_of(JointType::slider, -1, 3, {x, -2, 0});
  slide.anchor_b = slide.anchor;
  slide.orientation = {-kHalfRoot, 0, 0, kHalfRoot};  // z to y
  scene.joints.push_back(slide);
  couple(scene, 2, 1, 3, -1 / winch);
  return scene;
}
/// [teeth] The error of mesh, of either pair.
class MeshError : public Off {
 public:
  MeshError() : Off(1) {}

 private:
  double error(const Sight&, const Sight& now) const override {
    double worst = 0;
    for (int i = 0; i < 2; ++i) {
      const double teeth = (kTeeth[i] * angle_of(now.bodies[static_cast<std::size_t>(i)]) +
                            kTeeth[i + 1] * angle_of(now.bodies[static_cast<std::size_t>(i) + 1])) /
                           kTurn;
      worst = worse(worst, std::abs(teeth - std::round(teeth)));
    }
    return worst;
  }
};

constexpr double kSpeed = 10;  // [rad/s] of the first wheel

/// A motor that stands still brakes the last with 10 N m: engines without winches have all that it takes.
Scene braked_gears() {
  Scene scene = wheels(kSpeed);
  scene.joints[2] = driven(scene.joints[2], 0, 10);
  return scene;
}
/// [teeth] that slipped, of either pair, whole ones too. No number, where the last wheel has not turned as often as the
/// motor says, to a per cent.
class Slip : public Judge {
 public:
  void see(const Sight& now) override {
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = angle_of(now.bodies[i]);
      turned_[i] += std::remainder(angle - last_[i], kTurn);
      last_[i] = angle;
    }
    for (std::size_t i = 0; i < 2; ++i)
      worst_ = worse(worst_, std::abs(kTeeth[i] * turned_[i] + kTeeth[i + 1] * turned_[i + 1]) / kTurn);
    time_ = now.time;
  }
  double figure() const override {
    const double asked = kSpeed * kTeeth[0] / kTeeth[2] * time_;
    return std::abs(turned_[2] - asked) < 0.01 * asked ? worst_ : std::nan("");
  }

 private:
  double turned_[3] = {}, last_[3] = {};  // [rad]
  double worst_ = 0, time_ = 0;
};

}  // namespace

std::span<const Trial> gear_trials() {
  static const Trial trials[] = {
      {"gear_train", "S19", "wheels of 20, 40 and 10 teeth lift a weight", "teeth out of mesh", "", 0.05, gear_train,
       judge_of<MeshError>},
      {"braked_gears", "S19", "wheels of 20, 40 and 10 teeth turn against a brake for a minute", "teeth that slipped",
       "", 0.05, braked_gears, judge_of<Slip>},
  };
  return trials;
}

}  // namespace isostep::scenes
