// Trials of joints: heavy ends, stretched starts, limits.
// SPDX-License-Identifier: MIT
#include "chains.hpp"

#include "families.hpp"
#include "judges.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr double kTop = 30;  // [m]

/// The i-th link's middle `x` from the fixed point.
void add_link(Scene& scene, double x) {
  SceneBody link = body_of(capsule_part(0.05, kLink / 2 - 0.05), {x, kTop, 0});
  link.orientation = {0, 0, -kHalfRoot, kHalfRoot};
  link.mass = 1;
  link.collide = false;
  scene.bodies.push_back(link);
}
SceneJoint joint_at(JointType type, int a, int b, double x) { return joint_of(type, a, b, {x, kTop, 0}); }

Scene chain_of(int frames, int substeps) {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = frames;
  scene.substeps = substeps;
  return scene;
}
}  // namespace

Scene ball_chain(int links, double ball_mass) {
  Scene scene = chain_of(600, 16);
  for (int i = 0; i < links; ++i) {
    add_link(scene, (i + 0.5) * kLink);
    scene.joints.push_back(joint_at(JointType::ball, i - 1, i, i * kLink));
  }
  SceneBody ball = body_of(sphere_part(0.5), {links * kLink + 0.5, kTop, 0});
  ball.mass = ball_mass;
  ball.collide = false;
  scene.bodies.push_back(ball);
  scene.joints.push_back(joint_at(JointType::ball, links - 1, links, links * kLink));
  return scene;
}

namespace {

Scene thousandfold_ball() { return ball_chain(16, 1000); }
Scene sixhundredfold_ball() { return ball_chain(32, 600); }

/// [%] The largest separation of a joint over a link's length.
class Stretch : public Separation {
 public:
  Stretch() : Separation(kLink / 100) {}
};

constexpr int kLongRun = 10000;  // frames

/// Rods of 0.1 m between the links' ends, which start 0.35 m apart.
Scene stretched_chain() {
  constexpr int kLinks = 20;
  constexpr double kRod = 0.1, kGap = 0.35;  // [m]
  Scene scene = chain_of(kLongRun, 8);
  for (int i = 0; i < kLinks; ++i) {
    const double start = i * (kLink + kGap);
    SceneJoint rod = joint_at(JointType::distance, i - 1, i, start);
    rod.anchor_b = {start + kGap, kTop, 0};
    rod.flags = joint_flag::kLimit;
    rod.lower = rod.upper = kRod;
    scene.joints.push_back(rod);
    add_link(scene, start + kGap + kLink / 2);
  }
  return scene;
}

/// Hinges about z that bend by 0.3 rad at most.
Scene limited_chain() {
  constexpr int kLinks = 16;
  Scene scene = chain_of(kLongRun, 8);
  for (int i = 0; i < kLinks; ++i) {
    SceneJoint hinge = joint_at(JointType::hinge, i - 1, i, i * kLink);
    hinge.flags = joint_flag::kLimit;
    hinge.lower = -0.3;
    hinge.upper = 0.3;
    scene.joints.push_back(hinge);
    add_link(scene, (i + 0.5) * kLink);
  }
  return scene;
}

/// [%] The rise of energy over what the scene's masses gain by falling as far as they reach from the fixed point: the
/// most by which total energy was above that of the first sight that counts, or above the peak of any ten seconds
/// before. Peaks, because a soft limit takes energy and gives it back. Sights before `from` [s] do not count.
class EnergyRise : public Judge {
 public:
  EnergyRise(const Scene& scene, double from) : from_(from) {
    for (const SceneBody& body : scene.bodies) {
      double x = 0, mass = 0;
      TextError error = TextError::none;
      body.position[0].read(x, error);
      body.mass.read(mass, error);
      fall_ += 10 * mass * x;
    }
  }
  void see(const Sight& sight) override {
    if (sight.time < from_) return;
    const double energy = sight.energy.total();
    const int window = static_cast<int>((sight.time - from_) / kWindow);
    if (window > window_) {
      allowed_ = window_ < 0 ? energy : std::fmin(allowed_, peak_);
      window_ = window;
      peak_ = energy;
    }
    peak_ = worse(peak_, energy);
    rise_ = worse(rise_, energy - allowed_);
  }
  double figure() const override { return 100 * rise_ / fall_; }

 private:
  static constexpr double kWindow = 10;  // [s]
  double from_;                          // [s]
  double fall_ = 0;                      // [J]
  int window_ = -1;
  double peak_ = 0, allowed_ = 0, rise_ = 0;  // [J] of this window; of those before; above that
};
std::unique_ptr<Judge> rise_from_start(const Scene& scene) { return std::make_unique<EnergyRise>(scene, 0); }
std::unique_ptr<Judge> rise_when_contracted(const Scene& scene) { return std::make_unique<EnergyRise>(scene, 1); }

constexpr char kRise[] = "rise of energy above earlier peaks over 10 000 steps, of that of the fall";

}  // namespace

std::span<const Trial> chain_trials() {
  static const Trial trials[] = {
      {"chain_16_ball_1000", "5", "16 links of 1 kg swing with a ball of 1000 kg", kStretch, "%", 5, thousandfold_ball,
       judge_of<Stretch>},
      {"chain_32_ball_600", "5", "32 links of 1 kg swing with a ball of 600 kg", kStretch, "%", 5, sixhundredfold_ball,
       judge_of<Stretch>},
      {"stretched_chain", "7", "20 links on rods that start 3.5 times too long", "largest speed over 10 000 steps",
       "m/s", 100, stretched_chain, judge_of<TopSpeed>},
      {"stretched_chain_energy", "7", "the same chain, once its rods have had a second", kRise, "%", 1, stretched_chain,
       rise_when_contracted},
      {"limited_chain", "7", "16 links on hinges with limits, for there are no sliders", kRise, "%", 1, limited_chain,
       rise_from_start},
  };
  return trials;
}

}  // namespace isostep::scenes
