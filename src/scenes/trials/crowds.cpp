// Trials of many: dominoes, a crowd that is woken, a crowd without room.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "families.hpp"
#include "judges.hpp"
#include "scenes/named.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// Along +x; the first one leans beyond its edge and falls.
Scene dominoes() {
  constexpr int kCount = 200;
  constexpr double kPitch = 0.24, kLean = 0.2;  // [m], [rad]
  constexpr Point kHalf = {0.04, 0.25, 0.125};  // [m]
  const SinCos<double> lean = sin_cos(kLean), half = sin_cos(kLean / 2);
  Scene scene = stack(0);
  scene.frames = 1800;
  for (int i = 0; i < kCount; ++i) {
    scene.bodies.push_back(body_of(box_part(kHalf), {(i - (kCount - 1) * 0.5) * kPitch, kHalf.y, 0}));
  }
  SceneBody& first = scene.bodies[1];  // after the floor
  first.position[1] = kHalf.y * lean.cos + kHalf.x * lean.sin;
  first.orientation = {0, 0, -half.sin, half.cos};
  return scene;
}

/// [%] The standard deviation over the mean of the times in which the front passes ten dominoes, over the second half
/// of the line. 100 where not all fell. A domino is passed when it leans by kPassed, between frames in proportion.
class FrontSpread : public Judge {
 public:
  void see(const Sight& sight) override {
    std::size_t domino = 0;
    for (const BodySight& body : sight.bodies) {
      if (body.dynamic) observe(domino++, lean_of(body), sight.time);
    }
    before_ = sight.time;
  }
  double figure() const override {
    if (passed_.empty() || std::count(passed_.begin(), passed_.end(), kNever) > 0) return 100;
    std::vector<double> times;
    for (std::size_t i = passed_.size() / 2; i + kBlock < passed_.size(); i += kBlock) {
      times.push_back(passed_[i + kBlock] - passed_[i]);
    }
    double mean = 0, square = 0;
    for (const double time : times) mean += time / static_cast<double>(times.size());
    for (const double time : times) square += (time - mean) * (time - mean) / static_cast<double>(times.size());
    return 100 * std::sqrt(square) / mean;
  }

 private:
  static constexpr double kPassed = 0.3, kNever = -1;  // [rad], [s]
  static constexpr std::size_t kBlock = 10;

  /// [rad] The angle between a body's y axis and the world's.
  static double lean_of(const BodySight& body) {
    const Quat<double>& q = body.orientation;
    return std::acos(std::clamp(1 - 2 * (q.x * q.x + q.z * q.z), -1.0, 1.0));
  }
  void observe(std::size_t domino, double lean, double time) {
    if (domino == passed_.size()) {
      passed_.push_back(kNever);
      leans_.push_back(lean);
    }
    const double last = std::exchange(leans_[domino], lean);
    if (passed_[domino] != kNever || !(lean >= kPassed)) return;
    passed_[domino] = last < lean ? before_ + (time - before_) * (kPassed - last) / (lean - last) : time;
  }

  double before_ = 0;           // [s] of the last sight
  std::vector<double> leans_;   // [rad] in the last sight
  std::vector<double> passed_;  // [s]
};

/// Spheres in a cubic lattice fill a pit without a gap and sleep; the last one, in the middle of the top, is hit.
Scene woken_crowd() {
  constexpr int kSide = 20, kLayers = 25;
  constexpr double kRadius = 0.25;
  Scene scene;
  scene.frames = 360;
  scene.script = Script::hit;
  add_pit(scene, 2 * kRadius * kSide);
  const auto add = [&](int layer, int i, int k) {
    const auto across = [&](int n) { return (n - (kSide - 1) * 0.5) * 2 * kRadius; };
    scene.bodies.push_back(body_of(sphere_part(kRadius), {across(i), (2 * layer + 1) * kRadius, across(k)}));
  };
  for (int n = 0; n < kSide * kSide * kLayers; ++n) {
    const int layer = n / (kSide * kSide), i = n / kSide % kSide, k = n % kSide;
    if (layer < kLayers - 1 || i != kSide / 2 || k != kSide / 2) add(layer, i, k);
  }
  add(kLayers - 1, kSide / 2, kSide / 2);
  return scene;
}

/// Spheres of 1 m, roughly at a pitch of 0.9 m, between walls that leave them no more; no gravity.
Scene confined_crowd() {
  constexpr int kSide = 9;
  constexpr double kPitch = 0.9, kHalf = kSide * kPitch / 2;  // [m]
  Scene scene;
  scene.allow_sleep = false;
  scene.gravity = zero_vector();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vector at = zero_vector(), half = {kHalf + 1, kHalf + 1, kHalf + 1};
      at[static_cast<std::size_t>(axis)] = side * (kHalf + 0.5);
      half[static_cast<std::size_t>(axis)] = 0.5;
      SceneBody wall = fixed_box({0, 0, 0}, {0, 0, 0});
      wall.position = at;
      wall.parts[0].half_extents = half;
      scene.bodies.push_back(wall);
    }
  }
  Draws draws(25);
  const auto across = [&](int n) { return (n - (kSide - 1) * 0.5) * kPitch + draws.between(-0.05, 0.05); };
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    const double x = across(n % kSide), y = across(n / kSide % kSide);
    const Point at = {x, y, across(n / kSide / kSide)};
    scene.bodies.push_back(body_of(sphere_part(0.5), at));
  }
  return scene;
}

}  // namespace

std::span<const Trial> crowd_trials() {
  static const Trial trials[] = {
      {"dominoes", "11", "200 dominoes in a line",
       "spread of the front's speed over the second half; 100 where not all fall", "%", 2, dominoes,
       judge_of<FrontSpread>},
      {"woken_crowd", "25", "10 000 spheres asleep in a pit, one is hit with 20 m/s (by a script)", "largest speed",
       "m/s", 20, woken_crowd, judge_of<TopSpeed>},
      {"confined_crowd", "25", "729 spheres between walls with room for fewer", "largest speed", "m/s", 3,
       confined_crowd, judge_of<TopSpeed>},
  };
  return trials;
}

}  // namespace isostep::scenes
