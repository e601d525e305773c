// Trials of bodies that begin inside one another, and of bodies so small that margins and sleep speeds are large.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "families.hpp"
#include "furthest_way.hpp"
#include "pairs_apart.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

Rotation lying() { return {0, 0, std::sqrt(0.5), std::sqrt(0.5)}; }

/// Boxes, balls and capsules, 25 % and 50 % of their width inside one another, weightless and far from other pairs.
Scene overlapped_pairs() {
  Scene scene;
  scene.gravity = zero_vector();
  scene.allow_sleep = false;
  scene.frames = 300;
  const ScenePart box = box_part({0.5, 0.5, 0.5}), ball = sphere_part(0.5), capsule = capsule_part(0.5, 0.5);
  double z = 0;
  for (const double share : {0.25, 0.5}) {
    const auto add_pair = [&](const ScenePart& a, const ScenePart& b, Point offset) {
      scene.bodies.push_back(body_of(a, {0, 0, z}));
      scene.bodies.push_back(body_of(b, {offset.x, offset.y, offset.z + z}));
      z += 10;
    };
    const double way = 1 - share;
    add_pair(box, box, {way, 0, 0});
    add_pair(box, box, {way, 0.3, 0.2});
    add_pair(ball, ball, {0.6 * way, 0.8 * way, 0});
    add_pair(box, ball, {0, way, 0.1});
    add_pair(capsule, capsule, {0, 0, way});
    scene.bodies.back().orientation = lying();
  }
  return scene;
}

/// [m/s] Greatest speed of a body beyond what it gains by falling, no further than to the floor, from the highest point
/// that it has reached.
class ExitSpeed : public Judge {
 public:
  void see(const Sight& sight) override {
    highest_.resize(sight.bodies.size(), -HUGE_VAL);
    for (std::size_t i = 0; i < sight.bodies.size(); ++i) {
      const BodySight& body = sight.bodies[i];
      if (!body.dynamic) continue;
      highest_[i] = std::max(highest_[i], body.centre.y);
      const double square = dot(body.velocity, body.velocity) - 2 * 10 * (highest_[i] - std::max(body.centre.y, 0.0));
      worst_ = worse(worst_, square < 0 ? 0.0 : std::sqrt(square));
    }
  }
  double figure() const override { return worst_; }

 private:
  std::vector<double> highest_;  // [m]
  double worst_ = 0;
};

Scene on_floor() {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = 300;
  add_floor(scene);
  return scene;
}

/// Ten unit boxes as in a wall, each a quarter inside its neighbours.
Scene overlapped_wall() {
  Scene scene = on_floor();
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; i < 4 - row; ++i) {
      const Point at = {0.75 * (i - (3 - row) * 0.5), 0.5 + 0.75 * row, 0};
      scene.bodies.push_back(body_of(box_part({0.5, 0.5, 0.5}), at));
    }
  }
  return scene;
}

/// 27 unit boxes, each 40 % inside its neighbours.
Scene overlapped_pile() {
  Scene scene = on_floor();
  for (int i = 0; i < 27; ++i) {
    const Point at = {(i % 3 - 1) * 0.6, 0.5 + (i / 9) * 0.6, (i / 3 % 3 - 1) * 0.6};
    scene.bodies.push_back(body_of(box_part({0.5, 0.5, 0.5}), at));
  }
  return scene;
}

constexpr double kBrick = 0.05;  // [m] side
constexpr int kBase = 20;

/// The wall of S2 at a twentieth of its size.
Scene tiny_wall() {
  Scene scene;
  scene.frames = 600;
  add_floor(scene);
  for (int row = 0; row < kBase; ++row) {
    for (int i = 0; i < kBase - row; ++i) {
      const double x = (i - (kBase - 1 - row) * 0.5) * 1.05 * kBrick;
      SceneBody brick = body_of(box_part({kBrick / 2, kBrick / 2, kBrick / 2}), {x, (0.5 + row) * kBrick, 0});
      brick.density = 1000;
      scene.bodies.push_back(brick);
    }
  }
  return scene;
}

/// [%] The furthest way of a brick over its side.
std::unique_ptr<Judge> judge_bricks(const Scene&) { return std::make_unique<FurthestWay>(0, kBrick / 100); }

constexpr double kTray = 0.06;  // [m] half of its inside

/// 24 dice of a centimetre and a gram drop into a tray.
Scene tiny_dice() {
  Scene scene;
  scene.frames = 600;
  add_floor(scene);
  for (const double side : {-1.0, 1.0}) {
    scene.bodies.push_back(fixed_box({side * (kTray + 0.02), 0.1, 0}, {0.02, 0.1, kTray + 0.04}));
    scene.bodies.push_back(fixed_box({0, 0.1, side * (kTray + 0.02)}, {kTray, 0.1, 0.02}));
  }
  Draws draws(99);
  for (int i = 0; i < 24; ++i) {
    SceneBody die =
        body_of(box_part({0.005, 0.005, 0.005}), {(i % 3 - 1) * 0.03, 0.03 + 0.02 * (i / 9), (i / 3 % 3 - 1) * 0.03});
    const double a = draws.between(0, kTurn), b = draws.between(0, kTurn);
    die.orientation = {0.6 * std::sin(a), 0.8 * std::sin(b), 0.6 * std::cos(a), 0.8 * std::cos(b)};
    die.density = 1000;
    scene.bodies.push_back(die);
  }
  return scene;
}

/// [s] The time until every die sleeps in the tray; the whole run when one does not, or lies elsewhere.
class TimeToRest : public Judge {
 public:
  explicit TimeToRest(const Scene& scene) : duration_(duration_of(scene)) {}
  void see(const Sight& sight) override {
    for (const BodySight& body : sight.bodies) {
      if (!body.dynamic) continue;
      if (body.awake) moving_ = sight.time;
      const Vec3<double> p = body.centre;
      lost_ = lost_ || !(std::abs(p.x) < kTray && std::abs(p.z) < kTray && p.y > 0);
    }
  }
  double figure() const override { return lost_ ? duration_ : moving_; }

 private:
  double duration_, moving_ = 0;  // [s]
  bool lost_ = false;
};

}  // namespace

std::span<const Trial> recovery_trials() {
  static const Trial trials[] = {
      {"overlapped_pairs", "18", "pairs begin a quarter and a half inside one another, weightless",
       "exit speed over 3 m/s, or overlap left over 5 % of the width", "", 1, overlapped_pairs, judge_of<PairsApart>},
      {"overlapped_wall", "18", "ten boxes of a wall begin a quarter inside one another",
       "exit speed beyond that of falling", "m/s", 3, overlapped_wall, judge_of<ExitSpeed>},
      {"overlapped_pile", "18", "27 boxes begin 40 % inside one another", "exit speed beyond that of falling", "m/s", 3,
       overlapped_pile, judge_of<ExitSpeed>},
      {"tiny_wall", "19", "a wall of 210 bricks of 5 cm", "furthest way of a brick, of its side", "%", 25, tiny_wall,
       judge_bricks},
      {"tiny_dice", "19", "24 dice of a centimetre and a gram fall into a tray", "time until all sleep in it", "s", 5,
       tiny_dice, judge_of<TimeToRest>},
  };
  return trials;
}

}  // namespace isostep::scenes
