// Trials that strain the numbers themselves: far apart in size, without direction, very fast, very slow, very long.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "furthest_way.hpp"
#include "pairs_apart.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr double kGiant = 50, kDie = 0.005;  // [m] half of a side

/// Dice of a gram lie on a cube of a thousand tonnes, and beside it.
Scene sizes_apart() {
  Scene scene = awake(600);
  scene.bodies.push_back(fixed_box({0, -1, 0}, {70, 1, 70}));
  SceneBody giant = body_of(box_part({kGiant, kGiant, kGiant}), {0, kGiant, 0});
  giant.mass = 1e6;
  scene.bodies.push_back(giant);
  for (int i = 0; i < 8; ++i) {
    const bool above = i % 2 == 0;
    const double side = 10.0 * (i / 2 - 1.5);
    SceneBody die =
        body_of(box_part({kDie, kDie, kDie}), {above ? side : kGiant + 2, above ? 2 * kGiant + kDie : kDie, side});
    die.mass = 0.001;
    scene.bodies.push_back(die);
  }
  return scene;
}

/// [mm]
std::unique_ptr<Judge> judge_sizes(const Scene&) { return std::make_unique<FurthestWay>(0, 0.001); }

/// Pairs whose centres, axes or faces coincide, or nearly: nothing says which way apart.
Scene coincident_pairs() {
  Scene scene = weightless(300);
  const ScenePart box = box_part({0.5, 0.5, 0.5}), small = box_part({0.1, 0.1, 0.1}), ball = sphere_part(0.5);
  const ScenePart capsule = capsule_part(0.25, 0.5);
  const Rotation none = no_rotation(),
                 turned = {0, std::sqrt((1 - std::sqrt(0.5)) / 2), 0, std::sqrt((1 + std::sqrt(0.5)) / 2)};
  const Rotation across = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
  const struct {
    ScenePart a, b;
    Point offset;
    Rotation orientation;
  } pairs[] = {
      {ball, ball, {0, 0, 0}, none},         {ball, ball, {0x1p-16, 0, 0}, none},   {box, box, {0, 0, 0}, none},
      {box, box, {0, 0, 0}, turned},         {box, box, {0, 0x1p-16, 0}, none},     {capsule, capsule, {0, 0, 0}, none},
      {capsule, capsule, {0, 0, 0}, across}, {capsule, capsule, {0, 0.5, 0}, none}, {box, ball, {0, 0, 0}, none},
      {box, ball, {0.5, 0, 0}, none},        {box, capsule, {0, 0, 0}, none},       {box, small, {0.05, 0, 0}, none},
      {box, small, {0.4, 0.4, 0.4}, turned}, {ball, capsule, {0, 0, 0}, none}};
  double z = 0;
  for (const auto& pair : pairs) {
    scene.bodies.push_back(body_of(pair.a, {0, 0, z}));
    scene.bodies.push_back(body_of(pair.b, {pair.offset.x, pair.offset.y, pair.offset.z + z}));
    scene.bodies.back().orientation = pair.orientation;
    z += 12;
  }
  return scene;
}

constexpr double kBeam = 50, kBeamWidth = 0.5, kBeamMass = 100;     // [m] half, [m] half, [kg]
constexpr double kShotMass = 10, kShotSpeed = 8000, kShotArm = 45;  // [kg], [m/s], [m] from the beam's centre

/// A shot near the end of a beam of 100 m, from 1 cm away and without loss: the tip leaves at 4 km/s.
Scene long_lever() {
  Scene scene = weightless(60);
  SceneBody beam = body_of(box_part({kBeam, kBeamWidth, kBeamWidth}), {0, 0, 0});
  beam.mass = kBeamMass;
  SceneBody shot = body_of(sphere_part(0.5), {kShotArm, -kBeamWidth - 0.51, 0});
  shot.mass = kShotMass;
  shot.velocity = vector_of({0, kShotSpeed, 0});
  for (SceneBody* body : {&beam, &shot}) {
    body->friction = 0;
    body->restitution = 1;
    scene.bodies.push_back(*body);
  }
  return scene;
}

/// [%] Errors of both velocities and of the beam's angular velocity after the hit, over what theory says. An impulse
/// j = 2 v / (1/m + 1/M + arm^2 / I) acts on each.
class LeverError : public Judge {
 public:
  void see(const Sight& sight) override {
    const double inertia = kBeamMass * (kBeam * kBeam + kBeamWidth * kBeamWidth) / 3;
    const double impulse = 2 * kShotSpeed / (1 / kShotMass + 1 / kBeamMass + kShotArm * kShotArm / inertia);
    const auto error = [](Vec3<double> is, Vec3<double> ought) { return length_of(is - ought) / length_of(ought); };
    last_ = worse(error(sight.bodies[0].velocity, {0, impulse / kBeamMass, 0}),
                  error(sight.bodies[0].angular_velocity, {0, 0, impulse * kShotArm / inertia}));
    last_ = worse(last_, error(sight.bodies[1].velocity, {0, kShotSpeed - impulse / kShotMass, 0}));
  }
  double figure() const override { return 100 * last_; }

 private:
  double last_ = 0;
};

constexpr double kAngularSpeed = 5;  // [rad/s]

Scene spin_for_an_hour() {
  Scene scene = weightless(216'000);
  scene.bodies.push_back(body_of(box_part({0.5, 0.125, 0.25}), {0, 0, 0}));
  scene.bodies.back().angular_velocity = vector_of({0, kAngularSpeed, 0});
  return scene;
}

/// [ppm] The worst error of the orientation's norm, of its axis' tilt in radians, of the centre's way in metres, and at
/// the end of the angle turned through.
class HourOfSpin : public Judge {
 public:
  void see(const Sight& sight) override {
    const Quat<double> q = sight.bodies[0].orientation;
    worst_ = worse(worst_, std::abs(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w) - 1));
    worst_ = worse(worst_, 2 * std::hypot(q.x, q.z));
    worst_ = worse(worst_, length_of(sight.bodies[0].centre));
    const double angle = 2 * std::atan2(q.y, q.w);
    turned_ += std::remainder(angle - angle_, kTurn);
    angle_ = angle;
    time_ = sight.time;
  }
  double figure() const override {
    double worst = worst_;
    if (time_ > 0) worst = worse(worst, std::abs(turned_ / (kAngularSpeed * time_) - 1));
    return 1e6 * worst;
  }

 private:
  double angle_ = 0, turned_ = 0;  // [rad]
  double time_ = 0;                // [s]
  double worst_ = 0;
};

constexpr double kSlow = 0.001;  // [m/s]

/// Three bodies at rest and one at a millimetre a second along each axis, weightless, for ten minutes.
Scene slow_drift() {
  Scene scene = weightless(36'000);
  scene.bodies.push_back(body_of(sphere_part(0.5), {3.3, 7.1, -2.9}));
  scene.bodies.push_back(body_of(box_part({0.3, 0.4, 0.5}), {-9.7, 2.2, 4.1}));
  scene.bodies.push_back(body_of(box_part({0.3, 0.4, 0.5}), {-6.1, -5.3, 1.7}));
  scene.bodies.back().orientation = {0.1, 0.3, 0.3, 0.9};
  scene.bodies.push_back(body_of(sphere_part(0.5), {10.7, 11.3, 12.9}));
  scene.bodies.back().velocity = vector_of({kSlow, -kSlow, kSlow});
  return scene;
}

/// [% of 1 mm/s] The speed at which a body has left the way that its first velocity prescribes, at the end.
class DriftSpeed : public Judge {
 public:
  explicit DriftSpeed(const Scene& scene) {
    for (const SceneBody& body : scene.bodies) ways_.push_back({value(body.position), value(body.velocity)});
  }
  void see(const Sight& sight) override {
    if (sight.time <= 0) return;
    last_ = 0;
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      const Vec3<double> way = sight.bodies[i].centre - ways_[i].from - ways_[i].velocity * sight.time;
      last_ = worse(last_, length_of(way) / (kSlow * sight.time));
    }
  }
  double figure() const override { return 100 * last_; }

 private:
  struct Way {
    Vec3<double> from, velocity;  // [m], [m/s]
  };
  std::vector<Way> ways_;
  double last_ = 0;
};

/// 40 boxes heaped in a pit, never asleep, for three minutes. Balls might roll as long without fault.
Scene soak() {
  constexpr int kBoxAlways = 0;
  Scene scene = awake(10'800);
  add_pit(scene, 4);
  Draws draws(31337);
  for (int n = 0; n < 40; ++n) {
    const int layer = n / 9, cell = n % 9;
    const double x = draws.between(-0.3, 0.3), z = draws.between(-0.3, 0.3);
    const Point at = {(cell % 3 - 1) * 1.15 + x, 1 + 1.2 * layer, (cell / 3 - 1) * 1.15 + z};
    scene.bodies.push_back(drawn_body(kBoxAlways, at, draws, 1));
  }
  return scene;
}

/// [mm/min] The way in the last minute.
std::unique_ptr<Judge> judge_soak(const Scene& scene) {
  return std::make_unique<FurthestWay>(duration_of(scene) - 60, 0.001);
}

}  // namespace

std::span<const Trial> fixed_point_trials() {
  static const Trial trials[] = {
      {"sizes_apart", "f1", "dice of a gram on and beside a cube of 100 m and a thousand tonnes", "furthest way", "mm",
       5, sizes_apart, judge_sizes},
      {"coincident_pairs", "f2", "pairs whose centres or faces coincide, weightless",
       "exit speed over 3 m/s, or overlap left over 5 % of the width", "", 1, coincident_pairs, judge_of<PairsApart>},
      {"long_lever", "f3", "a shot at 8 km/s hits the end of a beam of 100 m", "error of linear and angular velocity",
       "%", 2, long_lever, judge_of<LeverError>},
      {"spin_hour", "f4", "a box turns for an hour, weightless", "error of norm, axis or angle", "ppm", 100,
       spin_for_an_hour, judge_of<HourOfSpin>},
      {"slow_drift", "f5", "bodies at rest and at 1 mm/s, weightless, for ten minutes", "drift, of 1 mm/s", "%", 1,
       slow_drift, judge_of<DriftSpeed>},
      {"soak", "f6", "40 boxes heaped in a pit, never asleep, for three minutes", "furthest creep in the last minute",
       "mm/min", 10, soak, judge_soak},
  };
  return trials;
}

}  // namespace isostep::scenes
