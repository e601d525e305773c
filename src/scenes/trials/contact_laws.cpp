// Trials of the laws of contact: cubes pulled in every direction, a tower whose masses grow, cubes in a groove.
// Source:  Le Lidec et al. 2023, Contact Models in Robotics: a Comparative Analysis, section IV. Its wedge is a groove.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "furthest_way.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr double kFriction = 0.5;           // [1]
constexpr double kLess = 0.9, kMore = 1.1;  // [1] of the force that friction bears

/// [%] Over the way that theory names: the error of what slides, or the way of what must stay.
class SlidesOrStays : public Judge {
 public:
  /// `accelerations` [m/s^2]: of the bodies after the first `fixed`, 0 of one that stays. `usual` is the size of all
  /// others.
  SlidesOrStays(std::size_t fixed, double usual, std::vector<Vec3<double>> accelerations)
      : fixed_(fixed), usual_(usual), accelerations_(std::move(accelerations)) {}
  void see(const Sight& sight) override {
    if (start_.empty()) start_ = sight.bodies;
    if (!(sight.time > 0)) return;
    const double half = 0.5 * sight.time * sight.time;
    worst_ = 0;
    for (std::size_t i = 0; i < accelerations_.size(); ++i) {
      const Vec3<double> way = sight.bodies[fixed_ + i].centre - start_[fixed_ + i].centre;
      worst_ = worse(worst_, length_of(way - accelerations_[i] * half) / (usual_ * half));
    }
  }
  double figure() const override { return 100 * worst_; }

 private:
  std::size_t fixed_;
  double usual_;
  std::vector<Vec3<double>> accelerations_;
  std::vector<BodySight> start_;
  double worst_ = 0;
};

constexpr int kDirections = 16;

/// A direction across the ground. None lies along an axis, where a pyramid in place of the cone is right.
Point direction_of(int n) {
  const SinCos<double> turn = sin_cos(kTurn * (n + 0.3) / kDirections);
  return {turn.cos, 0, turn.sin};
}

/// Two rows of flat boxes of 1 kg, each pulled in a direction of its own by less and by more than friction bears.
Scene pulled_cubes() {
  Scene scene = awake(120);
  scene.bodies.push_back(fixed_box({0, -1, 0}, {60, 1, 20}));
  scene.bodies.back().friction = kFriction;
  for (const double share : {kLess, kMore}) {
    for (int n = 0; n < kDirections; ++n) {
      SceneBody box = body_of(box_part({0.5, 0.25, 0.5}), {5.0 * (n - 7.5), 0.25, share == kLess ? -6.0 : 6.0});
      box.mass = 1;
      box.friction = kFriction;
      scene.bodies.push_back(box);
      const Point d = direction_of(n);
      const double force = share * kFriction * kGravity;
      const auto place = static_cast<double>(scene.bodies.size() - 1);
      scene.records.push_back({"thruster", {{"body", {place}}, {"force", {force * d.x, 0, force * d.z}}}});
    }
  }
  return scene;
}
std::unique_ptr<Judge> judge_pulled(const Scene&) {
  const double usual = (kMore - 1) * kFriction * kGravity;
  std::vector<Vec3<double>> accelerations(kDirections, Vec3<double>{0, 0, 0});  // the first row stays
  for (int n = 0; n < kDirections; ++n) {
    const Point d = direction_of(n);
    accelerations.push_back(Vec3<double>{d.x, 0, d.z} * usual);
  }
  return std::make_unique<SlidesOrStays>(1, usual, std::move(accelerations));
}

/// Boxes of a side of 1 m, each four times as heavy as the one below: 1 kg to 256 kg.
Scene rising_tower() {
  Scene scene = awake(600);
  add_floor(scene);
  double mass = 1;
  for (int i = 0; i < 5; ++i, mass *= 4) {
    scene.bodies.push_back(body_of(box_part({0.5, 0.5, 0.5}), {0, 0.5 + i, 0}));
    scene.bodies.back().mass = mass;
  }
  return scene;
}
/// Stacks of eight boxes of a side of 1 m, of 10 g, of 1 kg and of a tonne each: a unit of mass has no say.
Scene mass_scales() {
  Scene scene = awake(600);
  add_floor(scene);
  double x = -4;
  for (const double mass : {0.01, 1.0, 1000.0}) {
    for (int i = 0; i < 8; ++i) {
      scene.bodies.push_back(body_of(box_part({0.5, 0.5, 0.5}), {x, 0.5 + i, 0}));
      scene.bodies.back().mass = mass;
    }
    x += 4;
  }
  return scene;
}

/// [%] The furthest way of any box over its side.
std::unique_ptr<Judge> judge_tower(const Scene&) { return std::make_unique<FurthestWay>(0, 0.01); }

// The groove's two sides meet at a right angle along x and bear 1 / sqrt 2 of a cube's weight each, so that friction
// bears sqrt 2 times as much as on a plane.
constexpr double kGrooveSine = 0.6, kGrooveCosine = 0.8;  // of its fall: gravity is tilted in place of the groove

double groove_friction(double share) { return kGrooveSine / kGrooveCosine * kHalfRoot * share; }

/// Two cubes stand on an edge in a groove: friction holds one, and falls short by a tenth at the other.
Scene groove() {
  Scene scene = awake(90);
  scene.gravity = vector_of({kGravity * kGrooveSine, -kGravity * kGrooveCosine, 0});
  const SinCos<double> eighth = sin_cos(kTurn / 16);
  for (const double side : {-1.0, 1.0}) {
    scene.bodies.push_back(fixed_box({0, kHalfRoot, 3 * side * kHalfRoot}, {40, 1, 2}));
    scene.bodies.back().orientation = {-side * eighth.sin, 0, 0, eighth.cos};
    scene.bodies.back().friction = 1;
  }
  for (const double share : {kMore, 1 / kMore}) {
    SceneBody cube = body_of(box_part({0.5, 0.5, 0.5}), {share == kMore ? -20.0 : 0.0, kHalfRoot, 0});
    cube.orientation = {eighth.sin, 0, 0, eighth.cos};
    const double friction = groove_friction(share);
    cube.friction = friction * friction;  // of a pair the root of the product
    scene.bodies.push_back(cube);
  }
  return scene;
}
std::unique_ptr<Judge> judge_groove(const Scene&) {
  const double usual = kGravity * kGrooveSine * (1 - 1 / kMore);
  return std::make_unique<SlidesOrStays>(2, usual, std::vector<Vec3<double>>{{0, 0, 0}, {usual, 0, 0}});
}

}  // namespace

std::span<const Trial> contact_law_trials() {
  static const Trial trials[] = {
      {"pulled_cubes", "36", "boxes pulled in 16 directions by .9 and 1.1 of their friction", "error of way", "%", 2,
       pulled_cubes, judge_pulled},
      {"rising_tower", "37", "five boxes, each four times as heavy as the one below", "furthest way over a side", "%",
       10, rising_tower, judge_tower},
      {"mass_scales", "39", "stacks of eight boxes of 10 g, of 1 kg and of a tonne each", "furthest way over a side",
       "%", 2, mass_scales, judge_tower},
      {"groove", "38", "cubes in a groove that falls by .9 and 1.1 of what friction bears there", "error of way", "%",
       2, groove, judge_groove},
  };
  return trials;
}

}  // namespace isostep::scenes
