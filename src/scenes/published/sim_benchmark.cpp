// SimBenchmark's tests of rigid bodies: rolling, balls that press, balls that bounce, a tower of blocks.
// Source:  Kang, Hwangbo 2018, SimBenchmark, with its figures of 2018: github.com/leggedrobotics/SimBenchmark.
// SPDX-License-Identifier: MIT
#include "published.hpp"
#include "scenes/shapes.hpp"
#include "scenes/trials/judges.hpp"
#include "scenes/trials/scene_numbers.hpp"

namespace isostep::scenes {
namespace {

constexpr double kFall = 9.81;  // [m/s^2]

/// A scene whose floor's top is at height 0, of so many frames a second.
Scene on_the_ground(int hz, double seconds, double friction, double restitution) {
  Scene scene = awake(static_cast<int>(seconds * hz));
  scene.hz = hz;
  scene.gravity = vector_of({0, -kFall, 0});
  scene.bodies.push_back(fixed_box({0, -1, 0}, {100, 1, 100}));
  scene.bodies.back().friction = friction;
  scene.bodies.back().restitution = restitution;
  return scene;
}
SceneBody ball(double radius, double mass, Point at) {
  SceneBody body = body_of(sphere_part(radius), at);
  body.mass = mass;
  return body;
}

/// The mean over all sights of a square of something.
class MeanSquare : public Judge {
 public:
  void see(const Sight& sight) final {
    sum_ += square(sight);
    ++sights_;
  }
  double figure() const final { return sum_ / sights_; }

 protected:
  virtual double square(const Sight& sight) = 0;

 private:
  double sum_ = 0;
  int sights_ = 0;
};

// Rolling: a box on the ground is pulled from under 25 balls, which roll without slip.

constexpr double kBox = 10, kPull = 150;                // [kg], [N]
constexpr double kBoxOnGround = 0.4, kBallOnBox = 0.8;  // [1] friction of pairs
constexpr int kRollingSide = 5;                         // balls

/// `axis`, `across`: the pull's direction.
Scene rolling(double axis, double across) {
  // Friction of a pair is the root of the product.
  Scene scene = on_the_ground(100, 4, kBoxOnGround * kBoxOnGround / kBallOnBox, 0);
  SceneBody box = body_of(box_part({10, 0.5, 10}), {0, 0.5, 0});
  box.mass = kBox;
  box.friction = kBallOnBox;
  scene.bodies.push_back(box);
  for (int i = 0; i < kRollingSide; ++i) {
    for (int k = 0; k < kRollingSide; ++k) {
      scene.bodies.push_back(ball(0.5, 1, {2.0 * i - 4, 1.5, 2.0 * k - 4}));
      scene.bodies.back().friction = kBallOnBox;
    }
  }
  scene.records.push_back({"thruster", {{"body", {1}}, {"force", {kPull * axis, 0, kPull * across}}}});
  return scene;
}
constexpr double kAlong[] = {0.5, 0.866025403784439};
Scene rolling_on_axis() { return rolling(0, 1); }
Scene rolling_diagonally() { return rolling(kAlong[0], kAlong[1]); }

/// [m^2/s^2] Square of the error of the box's velocity and of the first ball's.
class RollingError : public MeanSquare {
 public:
  RollingError(double axis, double across) : direction_{axis, 0, across} {}

 private:
  double square(const Sight& sight) override {
    const double balls = kRollingSide * kRollingSide;
    const double slide = kBoxOnGround * (kBox + balls) * kFall;         // [N]
    const double roll = (kPull - slide) / kBox / (3.5 + balls / kBox);  // [m/s^2] of a ball
    const Vec3<double> of_box = direction_ * (3.5 * roll * sight.time), of_ball = direction_ * (roll * sight.time);
    return error(sight.bodies[1].velocity - of_box) + error(sight.bodies[2].velocity - of_ball);
  }
  static double error(Vec3<double> v) { return dot(v, v); }
  Vec3<double> direction_;
};
std::unique_ptr<Judge> judge_on_axis(const Scene&) { return std::make_unique<RollingError>(0, 1); }
std::unique_ptr<Judge> judge_diagonal(const Scene&) { return std::make_unique<RollingError>(kAlong[0], kAlong[1]); }

// 666: six by six by six balls of 10 kg without friction fall and spread.

constexpr double kBallRadius = 0.1, kBallMass = 10;  // [m], [kg]

/// Without friction.
SceneBody smooth_ball(double restitution, Point at) {
  SceneBody body = ball(kBallRadius, kBallMass, at);
  body.friction = 0;
  body.restitution = restitution;
  return body;
}

Scene cube_of_balls(double height, double restitution) {
  Scene scene = on_the_ground(100, 10, 0, restitution);
  Draws draws(42);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < 6; ++k) {
        const double x = 0.21 * i + 0.001 * draws.unit(), z = 0.21 * j + 0.001 * draws.unit();
        const double y = 0.21 * k + 0.001 * draws.unit() + height;
        scene.bodies.push_back(smooth_ball(restitution, {x, y, z}));
      }
    }
  }
  return scene;
}
Scene pressing_balls() { return cube_of_balls(0.101, 0); }
Scene elastic_balls() { return cube_of_balls(1.101, 1); }

/// [m^2] Sum of the squares of all overlaps.
class BallOverlap : public MeanSquare {
  double square(const Sight& sight) override {
    double sum = 0;
    const auto add = [&](double overlap) { sum += overlap > 0 ? overlap * overlap : 0; };
    for (std::size_t i = 1; i < sight.bodies.size(); ++i) {
      const Vec3<double> at = sight.bodies[i].centre;
      add(kBallRadius - at.y);
      for (std::size_t k = i + 1; k < sight.bodies.size(); ++k) {
        const Vec3<double> way = sight.bodies[k].centre - at;
        if (dot(way, way) < 4 * kBallRadius * kBallRadius) add(2 * kBallRadius - length_of(way));
      }
    }
    return sum;
  }
};

/// [J^2] Square of the change of all balls' energy.
class EnergyError : public MeanSquare {
  double square(const Sight& sight) override {
    double energy = 0;
    for (const BodySight& body : sight.bodies) {
      if (body.dynamic) energy += kBallMass * (0.5 * dot(body.velocity, body.velocity) + kFall * body.centre.y);
    }
    if (!started_) start_ = energy;
    started_ = true;
    return (energy - start_) * (energy - start_);
  }
  bool started_ = false;
  double start_ = 0;  // [J]
};

// Bouncing: 49 balls of restitution 1 from a height of 5 m.

Scene bouncing() {
  Scene scene = on_the_ground(100, 20, 0, 1);
  for (int i = 0; i < 7; ++i) {
    for (int k = 0; k < 7; ++k) scene.bodies.push_back(smooth_ball(1, {2.0 * i, 5, 2.0 * k}));
  }
  return scene;
}

// Kapla: 102 blocks of 10 kg, twelve layers.

constexpr double kKaplaLayers = 12, kKaplaLayer = 0.1;  // [1], [m]
constexpr double kKaplaSeconds = 600;

Scene kapla() {
  Scene scene = on_the_ground(100, kKaplaSeconds, 0.8, 0);
  const auto add = [&](Point half, Point at) {
    SceneBody block = body_of(box_part(half), at);
    block.mass = 10;
    block.friction = 0.8;
    scene.bodies.push_back(block);
  };
  for (int layer = 0; layer < kKaplaLayers; ++layer) {
    const double y = kKaplaLayer * (layer + 0.5);
    if (layer % 2 == 0) {
      for (int i = 0; i < 8; ++i) add({0.025, kKaplaLayer / 2, 0.125}, {0.2 * i, y, 0});
      continue;
    }
    const auto wall = [&](double x, double z) { add({0.1, kKaplaLayer / 2, 0.025}, {x, y, z}); };
    for (const double x : {0.1, 0.5, 0.9, 1.3}) wall(x, -0.1);
    for (const double x : {0.3, 0.7, 1.1, 0.1, 1.3}) wall(x, 0.1);
  }
  return scene;
}
/// [s] By which the tower fell before its time: its last block was lower than the top layer.
class FellEarly : public Judge {
 public:
  void see(const Sight& sight) override {
    if (!(sight.bodies.back().centre.y >= kKaplaLayer * (kKaplaLayers - 2)) && stood_ == kKaplaSeconds)
      stood_ = sight.time;
  }
  double figure() const override { return kKaplaSeconds - stood_; }

 private:
  double stood_ = kKaplaSeconds;
};

// Their figures: of each engine the best of its solvers, with push-out or without, whichever is better.

constexpr int kRates[] = {25, 100, 250, 1000, 2500, 10000};
constexpr int kRollingRates[] = {1000};
constexpr int kKaplaRates[] = {100};

constexpr PublishedFigure kRollingOnAxis[] = {{"RaiSim", 1000, 4.08e-7},
                                              {"Bullet", 1000, 7.3e-28},
                                              {"ODE", 1000, 7.6e-9},
                                              {"MuJoCo", 1000, 2.2e-3},
                                              {"DART", 1000, 0.426}};
constexpr PublishedFigure kRollingDiagonal[] = {{"RaiSim", 1000, 4.09e-7},
                                                {"Bullet", 1000, 3.9e-27},
                                                {"ODE", 1000, 3.14},
                                                {"MuJoCo", 1000, 2.0e-3},
                                                {"DART", 1000, 3.14}};
constexpr PublishedFigure kPressing[] = {
    {"RaiSim", 25, 0.250},      {"ODE", 25, 0.237},         {"MuJoCo", 25, 3.85},     {"Bullet", 25, 728},
    {"DART", 25, 1367},         {"RaiSim", 100, 0.0153},    {"ODE", 100, 0.0161},     {"MuJoCo", 100, 0.933},
    {"Bullet", 100, 37.4},      {"DART", 100, 215},         {"RaiSim", 250, 2.11e-3}, {"ODE", 250, 2.08e-3},
    {"MuJoCo", 250, 0.374},     {"Bullet", 250, 5.78},      {"DART", 250, 9293},      {"RaiSim", 1000, 1.35e-4},
    {"ODE", 1000, 1.55e-4},     {"MuJoCo", 1000, 0.0950},   {"Bullet", 1000, 0.382},  {"DART", 1000, 2.82e-4},
    {"RaiSim", 2500, 2.36e-5},  {"ODE", 2500, 2.42e-5},     {"MuJoCo", 2500, 0.0392}, {"Bullet", 2500, 0.0630},
    {"DART", 2500, 7.18e-3},    {"RaiSim", 10000, 1.64e-6}, {"ODE", 10000, 1.55e-6},  {"MuJoCo", 10000, 0.0113},
    {"Bullet", 10000, 3.53e-3}, {"DART", 10000, 1.98e-7}};
constexpr PublishedFigure kBouncing[] = {
    {"RaiSim", 25, 12691},      {"ODE", 25, 313419},  {"DART", 25, 1.191e8},  {"Bullet", 25, 1.192e8},
    {"RaiSim", 100, 186},       {"ODE", 100, 18808},  {"DART", 100, 7.376e6}, {"Bullet", 100, 7.407e6},
    {"RaiSim", 250, 4.76},      {"ODE", 250, 2983},   {"DART", 250, 1.190e6}, {"Bullet", 250, 1.202e6},
    {"RaiSim", 1000, 0.0186},   {"ODE", 1000, 185},   {"DART", 1000, 72274},  {"Bullet", 1000, 75245},
    {"RaiSim", 2500, 4.77e-4},  {"ODE", 2500, 29.6},  {"DART", 2500, 10871},  {"Bullet", 2500, 12038},
    {"RaiSim", 10000, 1.86e-6}, {"ODE", 10000, 1.85}, {"DART", 10000, 483},   {"Bullet", 10000, 752}};
constexpr PublishedFigure kElastic[] = {
    {"RaiSim", 25, 2.73e9},  {"DART", 25, 5.96e9},   {"RaiSim", 100, 5.18e6},    {"ODE", 100, 8.56e6},
    {"Bullet", 100, 9.86e6}, {"DART", 100, 1.29e10}, {"RaiSim", 250, 264},       {"ODE", 250, 1648},
    {"Bullet", 250, 8.40e5}, {"DART", 250, 6.61e6},  {"RaiSim", 1000, 8.37},     {"ODE", 1000, 112},
    {"Bullet", 1000, 41498}, {"DART", 1000, 3.46e5}, {"RaiSim", 2500, 0.249},    {"ODE", 2500, 17.5},
    {"Bullet", 2500, 3564},  {"DART", 2500, 52415},  {"RaiSim", 10000, 1.10e-3}, {"ODE", 10000, 1.10},
    {"Bullet", 10000, 168},  {"DART", 10000, 2438}};
constexpr PublishedFigure kTower[] = {
    {"RaiSim", 100, 0}, {"Bullet", 100, 49.42}, {"ODE", 100, 535.47}, {"MuJoCo", 100, 567.03}, {"DART", 100, 599.81}};

constexpr PublishedBar kRollingBars[] = {{1000, 4.1e-7, 5.7e-9}};
constexpr PublishedBar kPressingBars[] = {{100, 0.0153, 1.9e-7}, {1000, 1.35e-4, 3.8e-11}};
constexpr PublishedBar kBouncingBars[] = {{100, 3, 0.02}, {1000, 3, 0.02}};
constexpr PublishedBar kElasticBars[] = {{100, 1.4e6, 1.4e6}, {1000, 100, 8.4}};
constexpr PublishedBar kTowerBars[] = {{100, 0, 0}};

PublishedTest test_of(Trial trial, const char* differs, std::span<const int> rates,
                      std::span<const PublishedFigure> figures, std::span<const PublishedBar> bars) {
  return with_first_bar({.trial = trial,
                         .source = "SimBenchmark, Kang and Hwangbo",
                         .year = 2018,
                         .differs = differs,
                         .rates = rates,
                         .figures = figures,
                         .bars = bars});
}
constexpr const char* kInTouch = "theirs begin .02 mm deep, which they do not push out; ours in touch";

}  // namespace

std::span<const PublishedTest> sim_benchmark_tests() {
  static const PublishedTest tests[] = {
      test_of({"simbenchmark_rolling", "rolling", "a box is pulled along an axis from under 25 balls that roll on it",
               "mean square error of velocity", "m^2/s^2", 0, rolling_on_axis, judge_on_axis},
              kInTouch, kRollingRates, kRollingOnAxis, kRollingBars),
      test_of({"simbenchmark_rolling_diagonal", "rolling 60°", "the same, pulled 60 degrees from the axis",
               "mean square error of velocity", "m^2/s^2", 0, rolling_diagonally, judge_diagonal},
              kInTouch, kRollingRates, kRollingDiagonal, kRollingBars),
      test_of({"simbenchmark_666", "666", "216 balls fall .1 m without friction or bounce, and spread",
               "mean sum of squared overlaps", "m^2", 0, pressing_balls, judge_of<BallOverlap>},
              "theirs push no overlap out", kRates, kPressing, kPressingBars),
      test_of({"simbenchmark_bouncing", "bouncing", "49 balls of restitution 1 fall 5 m, 20 s",
               "mean square error of energy", "J^2", 0, bouncing, judge_of<EnergyError>},
              "", kRates, kBouncing, kBouncingBars),
      test_of(
          {"simbenchmark_elastic_666", "elastic 666", "216 balls of restitution 1 fall 1.1 m and meet each other, 10 s",
           "mean square error of energy", "J^2", 0, elastic_balls, judge_of<EnergyError>},
          "", kRates, kElastic, kElasticBars),
      test_of({"simbenchmark_kapla", "kapla", "a tower of 102 blocks of 10 kg stands for 600 s",
               "time by which it fell early", "s", 0, kapla, judge_of<FellEarly>},
              "theirs took 1000 iterations a step", kKaplaRates, kTower, kTowerBars),
  };
  return tests;
}

}  // namespace isostep::scenes
