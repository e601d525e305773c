// SimBenchmark's tests of an articulated robot: momentum when a ball hits it, energy in flight, standing by servos.
// Source:  Kang, Hwangbo 2018, SimBenchmark, with its figures of 2018: github.com/leggedrobotics/SimBenchmark.
// SPDX-License-Identifier: MIT
#include "hinged.hpp"
#include "published.hpp"
#include "scenes/trials/judges.hpp"
#include "scenes/trials/scene_numbers.hpp"

namespace isostep::scenes {
namespace {

// ANYmal: a trunk and four legs of three hinges. Masses and joints are the robot's; a leg's links are a ball and two
// capsules, its inertias rounded. x is ahead, y up, z to the right.

constexpr double kRobotFall = 9.81;  // [m/s^2]
constexpr std::size_t kRobotHinges = 12;
constexpr double kTrunk = 21.44, kHip = 1.1064, kThigh = 1.51, kShank = 0.5106;  // [kg]
constexpr double kFoot = 0.03;                                                   // [m] radius
constexpr double kHipTurn = 0.03, kThighTurn = 0.4, kKneeTurn = 0.8;             // [rad] of the pose in which it stands

struct Turned {
  Vec3<double> at;
  Quat<double> turn;
  Vec3<double> point(Vec3<double> of) const { return at + to_matrix(turn) * of; }
};
Quat<double> about_x(double angle) {
  const SinCos<double> half = sin_cos(angle / 2);
  return {half.sin, 0, 0, half.cos};
}
Quat<double> about_z(double angle) {
  const SinCos<double> half = sin_cos(angle / 2);
  return {0, 0, half.sin, half.cos};
}
Rotation rotation_of(Quat<double> q) { return {q.x, q.y, q.z, q.w}; }

SceneBody link_of(ScenePart part, const Turned& frame, Vec3<double> centre, double mass, Point inertia) {
  SceneBody body = body_of(std::move(part), point_of(frame.point(centre)));
  body.orientation = rotation_of(frame.turn);
  body.mass = mass;
  body.inertia = vector_of(inertia);
  return body;
}

/// `ahead` and `right` are 1 or -1. Hips turn about x, thighs and shanks about z of the link above.
void add_leg(Scene& scene, int trunk, double ahead, double right) {
  const Quat<double> z_to_x = {0, kHalfRoot, 0, kHalfRoot};
  const int first = static_cast<int>(scene.bodies.size());
  const Vec3<double> centre = value(scene.bodies[static_cast<std::size_t>(trunk)].position);
  // Theirs turns the left side by +.03 about x, the right side by -.03; thighs of the front by +.4 about -z.
  const Turned hip = {centre + Vec3<double>{0.2629 * ahead, 0, 0.115 * right}, about_x(-right * kHipTurn)};
  const Turned thigh = {hip.point({0.0585 * ahead, 0, 0.0315 * right}),
                        normalise(hip.turn * about_z(-ahead * kThighTurn))};
  const Turned shank = {thigh.point({0, -0.25, 0.111 * right}), normalise(thigh.turn * about_z(ahead * kKneeTurn))};
  scene.bodies.push_back(
      link_of(sphere_part(0.04), hip, {0.0542 * ahead, 0, -0.0136 * right}, kHip, {0.0012, 0.0014, 0.001}));
  scene.bodies.push_back(
      link_of(capsule_part(0.04, 0.04), thigh, {0, -0.1975, 0.0545 * right}, kThigh, {0.0148, 0.0018, 0.0144}));
  scene.bodies.push_back(
      link_of(capsule_part(kFoot, 0.155), shank, {0, -0.155, -0.016 * right}, kShank, {0.0124, 0.0005, 0.0124}));
  scene.joints.push_back(hinge_of(trunk, first, point_of(hip.at), rotation_of(z_to_x)));
  scene.joints.push_back(hinge_of(first, first + 1, point_of(thigh.at), rotation_of(hip.turn)));
  scene.joints.push_back(hinge_of(first + 1, first + 2, point_of(shank.at), rotation_of(thigh.turn)));
}
/// The bodies of a robot do not meet each other.
void add_robot(Scene& scene, Point at, std::uint32_t group) {
  const int trunk = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(link_of(box_part({0.2655, 0.13, 0.116}), {{0, 0, 0}, {0, 0, 0, 1}}, {at.x, at.y, at.z}, kTrunk,
                                 {0.268, 0.829, 0.884}));
  for (const double ahead : {1.0, -1.0}) {
    for (const double right : {-1.0, 1.0}) add_leg(scene, trunk, ahead, right);
  }
  for (std::size_t i = static_cast<std::size_t>(trunk); i < scene.bodies.size(); ++i) {
    scene.bodies[i].group = group;
    scene.bodies[i].friction = 0.8;
  }
}

// Momentum: a ball of 10 kg hits the robot from the side, without gravity or friction.

Scene robot_and_ball() {
  Scene scene = weightless(1000);
  scene.hz = 100;
  add_robot(scene, {0, 2, 0}, 1);
  SceneBody ball = body_of(sphere_part(0.2), {0, 2, 5});
  ball.mass = 10;
  ball.velocity = vector_of({0, 0, -5});
  scene.bodies.push_back(ball);
  for (SceneBody& body : scene.bodies) body.friction = 0;
  return scene;
}
/// [kg^2 m^2/s^2] Square of the change of momentum, mean over the run.
class MomentumOff : public FromStart {
 public:
  explicit MomentumOff(const Scene& scene) : inertias_(scene) {}
  double figure() const override { return sum_ / sights_; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    const Vec3<double> off = inertias_.momentum(now) - inertias_.momentum(start);
    sum_ += dot(off, off);
    ++sights_;
  }
  Inertias inertias_;
  double sum_ = 0;
  int sights_ = 0;
};

// Energy: the robot flies, its joints turning; nothing damps or touches.

Scene flying_robot() {
  Scene scene = awake(200);
  scene.hz = 100;
  scene.gravity = vector_of({0, -kRobotFall, 0});
  add_robot(scene, {0, 2, 0}, 1);
  for (SceneBody& body : scene.bodies) body.collide = false;
  scene.bodies.front().velocity = vector_of({0, kRobotFall, 0});  // as after a second of twice its weight
  Draws draws(18);
  std::vector<double> rates;
  for (std::size_t i = 0; i < kRobotHinges; ++i) rates.push_back(draws.between(-4, 4));
  turn_hinges(scene, 0, rates);
  return scene;
}
/// [J^2] Square of the change of energy, mean over the run.
class EnergyOff : public FromStart {
 public:
  double figure() const override { return sum_ / sights_; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    const double off = now.energy.total() - start.energy.total();
    sum_ += off * off;
    ++sights_;
  }
  double sum_ = 0;
  int sights_ = 0;
};

// PD: four robots stand by servos.

constexpr double kStiffness = 40, kDamping = 1;  // [N m/rad], [N m s/rad]
constexpr int kRobotRow = 2;                     // of robots
constexpr double kRobotPitch = 2;                // [m]
constexpr double kStandingHeight = 0.542;        // [m] of a trunk whose feet touch the ground

/// [kg m^2] What a body resists a torque about an axis of the world with.
double inertia_about(const SceneBody& body, Vec3<double> axis) {
  const Vec3<double> own = transposed_times(to_matrix(value(body.orientation)), axis), of = value(body.inertia);
  return 1 / (own.x * own.x / of.x + own.y * own.y / of.y + own.z * own.z / of.z);
}
/// A spring is told by frequency and damping of what two bodies resist with.
void add_servo(const Scene& scene, SceneJoint& joint) {
  const Vec3<double> axis = to_matrix(value(joint.orientation)).column(2);
  const double a = inertia_about(scene.bodies[static_cast<std::size_t>(joint.a)], axis);
  const double b = inertia_about(scene.bodies[static_cast<std::size_t>(joint.b)], axis);
  const double inertia = a * b / (a + b), rate = std::sqrt(kStiffness / inertia);
  joint.flags |= joint_flag::kSpring;
  joint.spring_frequency = rate / kTurn;
  joint.spring_damping = kDamping / (2 * inertia * rate);
}
Scene standing_robots() {
  Scene scene = awake(2000);
  scene.hz = 200;
  scene.gravity = vector_of({0, -kRobotFall, 0});
  scene.bodies.push_back(fixed_box({0, -1, 0}, {100, 1, 100}));
  scene.bodies.back().friction = 0.8;
  for (int i = 0; i < kRobotRow; ++i) {
    for (int k = 0; k < kRobotRow; ++k) {
      const std::uint32_t group = static_cast<std::uint32_t>(scene.joints.size() / kRobotHinges) + 1;
      add_robot(scene, {kRobotPitch * i, kStandingHeight, kRobotPitch * k}, group);
    }
  }
  for (SceneJoint& joint : scene.joints) add_servo(scene, joint);
  return scene;
}
/// [m] The furthest way of a trunk after 3 s, in which they sink into their servos; 1 for one that fell.
class TrunkDrift : public Judge {
 public:
  void see(const Sight& sight) override {
    constexpr double kStands = 0.3;  // [m] of a trunk, from .54
    if (sight.time < 3 - 1e-6) return;
    if (start_.bodies.empty()) start_ = sight;
    for (std::size_t i = 1; i < sight.bodies.size(); i += kRobotHinges + 1) {
      const Vec3<double> way = way_of(start_, sight, i);
      worst_ = worse(worst_, length_of(way));
      if (!(sight.bodies[i].centre.y > kStands)) worst_ = worse(worst_, 1);
    }
  }
  double figure() const override { return worst_; }

 private:
  Sight start_;
  double worst_ = 0;
};

constexpr int kRobotRates[] = {100, 250, 1000, 2500, 10000};
constexpr int kServoRates[] = {200};

constexpr PublishedFigure kMomentum[] = {
    {"ODE", 100, 4.0e-28},     {"MuJoCo", 100, 2.4e-5},    {"RaiSim", 100, 5.39e-3},   {"Bullet", 100, 0.0227},
    {"DART", 100, 105},        {"ODE", 250, 5.4e-28},      {"MuJoCo", 250, 3.26e-7},   {"RaiSim", 250, 9.15e-4},
    {"Bullet", 250, 4.27e-3},  {"DART", 250, 146},         {"ODE", 1000, 1.3e-27},     {"MuJoCo", 1000, 3.0e-13},
    {"RaiSim", 1000, 4.7e-5},  {"Bullet", 1000, 2.66e-4},  {"DART", 1000, 162},        {"ODE", 2500, 1.3e-26},
    {"MuJoCo", 2500, 7.3e-13}, {"RaiSim", 2500, 6.2e-6},   {"Bullet", 2500, 4.23e-5},  {"DART", 2500, 180},
    {"ODE", 10000, 5.8e-26},   {"MuJoCo", 10000, 1.7e-16}, {"RaiSim", 10000, 3.85e-7}, {"Bullet", 10000, 2.64e-6},
    {"DART", 10000, 182}};
constexpr PublishedFigure kFlight[] = {
    {"MuJoCo", 100, 5.6e-11},   {"RaiSim", 100, 1.40},      {"Bullet", 100, 343},      {"ODE", 100, 378},
    {"DART", 100, 918},         {"MuJoCo", 250, 4.5e-14},   {"RaiSim", 250, 0.215},    {"Bullet", 250, 55.7},
    {"ODE", 250, 61.6},         {"DART", 250, 393},         {"MuJoCo", 1000, 1.6e-17}, {"RaiSim", 1000, 0.0118},
    {"Bullet", 1000, 3.65},     {"ODE", 1000, 3.89},        {"DART", 1000, 237},       {"MuJoCo", 2500, 3.6e-19},
    {"RaiSim", 2500, 1.81e-3},  {"ODE", 2500, 0.624},       {"Bullet", 2500, 0.643},   {"DART", 2500, 214},
    {"MuJoCo", 10000, 1.6e-21}, {"RaiSim", 10000, 1.11e-4}, {"ODE", 10000, 0.0391},    {"Bullet", 10000, 0.0745},
    {"DART", 10000, 203}};

constexpr PublishedBar kMomentumBars[] = {{100, 1e-9, 4e-28}};
constexpr PublishedBar kFlightBars[] = {{100, 10, 1.4}, {1000, 0.1, 0.0118}};
constexpr PublishedBar kServoBars[] = {{200, 1e-6, 1e-7}};

constexpr const char* kRobotSource = "SimBenchmark, Kang and Hwangbo";

}  // namespace

std::span<const PublishedTest> sim_benchmark_robot_tests() {
  static const PublishedTest tests[] = {
      with_first_bar(
          {.trial = {"simbenchmark_anymal_momentum", "ANYmal, hit",
                     "a ball of 10 kg at 5 m/s hits a robot of 13 bodies and 12 hinges, weightless, 10 s",
                     "mean square error of momentum", "kg^2 m^2/s^2", 0, robot_and_ball, judge_of<MomentumOff>},
           .source = kRobotSource,
           .year = 2018,
           .differs = "the links are a box, balls and capsules, theirs boxes and cylinders; masses and joints "
                      "are the robot's",
           .rates = kRobotRates,
           .figures = kMomentum,
           .bars = kMomentumBars}),
      with_first_bar({.trial = {"simbenchmark_anymal_energy", "ANYmal, flight",
                                "the robot flies up and falls for 2 s, its joints turning; nothing damps or touches",
                                "mean square error of energy", "J^2", 0, flying_robot, judge_of<EnergyOff>},
                      .source = kRobotSource,
                      .year = 2018,
                      .differs = "theirs is lifted by a force for a second first, ours begins with that speed and with "
                                 "drawn speeds of its joints",
                      .rates = kRobotRates,
                      .figures = kFlight,
                      .bars = kFlightBars}),
      with_first_bar({.trial = {"simbenchmark_anymal_pd", "ANYmal, stands",
                                "four robots stand for 10 s by servos of 40 N m/rad and 1 N m s/rad",
                                "furthest way of a trunk after 3 s; 1 for one that fell", "m", 0, standing_robots,
                                judge_of<TrunkDrift>},
                      .source = kRobotSource,
                      .year = 2018,
                      .differs = "theirs measures speed alone, of up to 225 robots for 250 s; friction 0.8",
                      .rates = kServoRates,
                      .bars = kServoBars}),
  };
  return tests;
}

}  // namespace isostep::scenes
