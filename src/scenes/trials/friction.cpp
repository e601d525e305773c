// Trials of friction: slopes just below and just above the critical one, belts, and balls that slide, roll and stop.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "furthest_way.hpp"
#include "scene_numbers.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// Both surfaces have `friction`.
Scene with_ground(double friction, int frames, SceneBody ground) {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = frames;
  ground.friction = friction;
  scene.bodies.push_back(ground);
  return scene;
}
void add(Scene& scene, SceneBody body) {
  body.friction = scene.bodies.front().friction;
  scene.bodies.push_back(std::move(body));
}

constexpr double kSlopeFriction = 0.5;  // [1]

/// Falls along +x; its face passes through the origin.
struct Slope {
  double sine, cosine;
  explicit Slope(double tangent) : sine(tangent / std::sqrt(1 + tangent * tangent)), cosine(sine / tangent) {}

  Vec3<double> down() const { return {cosine, -sine, 0}; }
  Rotation orientation() const { return {0, 0, -std::sqrt((1 - cosine) / 2), std::sqrt((1 + cosine) / 2)}; }
  Point above(double height, double z) const { return {height * sine, height * cosine, z}; }
};
constexpr double kCalm = 0.9, kSteep = 1.1;  // [1] of the critical slope

Scene slope_with(double share, std::span<const Point> boxes, int frames) {
  const Slope slope(share * kSlopeFriction);
  SceneBody ramp = fixed_box(slope.above(-0.5, 0), {20, 0.5, 10});
  ramp.orientation = slope.orientation();
  Scene scene = with_ground(kSlopeFriction, frames, ramp);
  double z = -4;
  for (const Point half : boxes) {
    SceneBody box = body_of(box_part(half), slope.above(half.y, z));
    box.orientation = slope.orientation();
    add(scene, box);
    z += 4;
  }
  return scene;
}
constexpr Point kSlopeBoxes[] = {{0.5, 0.5, 0.5}, {0.5, 0.1, 0.5}, {0.1, 0.1, 0.1}};

Scene resting_slope() { return slope_with(kCalm, kSlopeBoxes, 3660); }
Scene sliding_slope() { return slope_with(kSteep, kSlopeBoxes, 240); }

/// [mm/min] The way after the first second, in which contacts settle, of a run of 61 s.
std::unique_ptr<Judge> judge_creep(const Scene&) { return std::make_unique<FurthestWay>(1, 0.001); }

/// [%] Velocities gained since the first second, as vectors, against g (sin - friction cos) downhill.
class SlopeSlide : public Judge {
 public:
  void see(const Sight& sight) override {
    if (sight.time < 1) return;
    if (settled_.bodies.empty()) settled_ = sight;
    const double elapsed = sight.time - settled_.time;
    if (elapsed < 1) return;
    const Slope slope(kSteep * kSlopeFriction);
    const double gained = kGravity * (slope.sine - kSlopeFriction * slope.cosine) * elapsed;
    for (std::size_t i = 1; i < settled_.bodies.size(); ++i) {
      const Vec3<double> change = sight.bodies[i].velocity - settled_.bodies[i].velocity;
      worst_ = worse(worst_, length_of(change - slope.down() * gained) / gained);
    }
  }
  double figure() const override { return 100 * worst_; }

 private:
  Sight settled_;
  double worst_ = 0;
};

/// [%] Error of velocity and of way at the end, as vectors, over those that theory names; where it names no speed, over
/// the speed at the start.
class Travel : public Judge {
 public:
  Travel(double way, double speed, double scale) : way_(way), speed_(speed), scale_(scale) {}
  void see(const Sight& sight) override {
    const BodySight& body = sight.bodies.back();
    if (sight.time <= 0) start_ = body.centre;
    const Vec3<double> off = body.centre - start_ - Vec3<double>{way_, 0, 0};
    last_ = worse(length_of(off) / way_, length_of(body.velocity - Vec3<double>{speed_, 0, 0}) / scale_);
  }
  double figure() const override { return 100 * last_; }

 private:
  double way_, speed_, scale_;      // [m], [m/s], [m/s]
  Vec3<double> start_ = {0, 0, 0};  // [m]
  double last_ = 0;
};

constexpr double kBeltFriction = 0.5, kBeltSpeed = 2;  // [1], [m/s]

Scene conveyor() {
  SceneBody belt = fixed_box({0, -0.5, 0}, {10, 0.5, 1});
  belt.surface_velocity = vector_of({kBeltSpeed, 0, 0});
  Scene scene = with_ground(kBeltFriction, 300, belt);
  add(scene, body_of(box_part({0.25, 0.25, 0.25}), {-8, 0.25, 0}));
  return scene;
}
/// Slips for v / (friction g), and loses half of what the belt moves in that time.
std::unique_ptr<Judge> judge_conveyor(const Scene& scene) {
  const double slip = kBeltSpeed / (kBeltFriction * kGravity);
  const double way = kBeltSpeed * (duration_of(scene) - slip / 2);
  return std::make_unique<Travel>(way, kBeltSpeed, kBeltSpeed);
}

constexpr double kBall = 0.5;  // [m] radius
constexpr double kCueFriction = 0.2, kCueSpeed = 5;

Scene billiard() {
  Scene scene = with_ground(kCueFriction, 180, fixed_box({0, -0.5, 0}, {20, 0.5, 2}));
  SceneBody ball = body_of(sphere_part(kBall), {-8, kBall, 0});
  ball.velocity = vector_of({kCueSpeed, 0, 0});
  add(scene, ball);
  return scene;
}
/// Slides for 2 v / (7 friction g), over 12 v^2 / (49 friction g), then rolls at 5/7 v.
std::unique_ptr<Judge> judge_billiard(const Scene& scene) {
  const double grip = kCueFriction * kGravity, rolling = 5 * kCueSpeed / 7, slide = 2 * kCueSpeed / (7 * grip);
  const double way = 12 * kCueSpeed * kCueSpeed / (49 * grip) + rolling * (duration_of(scene) - slide);
  return std::make_unique<Travel>(way, rolling, rolling);
}

constexpr double kLever = 0.05, kRollSpeed = 2;  // [m], [m/s]

Scene rolling_stop() {
  Scene scene = with_ground(0.5, 300, fixed_box({0, -0.5, 0}, {20, 0.5, 2}));
  SceneBody ball = body_of(sphere_part(kBall), {-8, kBall, 0});
  ball.velocity = vector_of({kRollSpeed, 0, 0});
  ball.angular_velocity = vector_of({0, 0, -kRollSpeed / kBall});
  ball.rolling_resistance = kLever;
  add(scene, ball);
  return scene;
}
/// The way of a solid ball that goes on rolling, r m d + 2/5 m r d = lever m g: d = 5/7 lever g / r, and v^2 / (2 d) to
/// stop.
std::unique_ptr<Judge> judge_rolling_stop(const Scene&) {
  const double slowing = 5 * kLever * kGravity / (7 * kBall);
  return std::make_unique<Travel>(kRollSpeed * kRollSpeed / (2 * slowing), 0, kRollSpeed);
}

}  // namespace

std::span<const Trial> friction_trials() {
  static const Trial trials[] = {
      {"resting_slope", "17", "boxes on a slope of 0.9 of their friction, for a minute", "furthest creep", "mm/min", 1,
       resting_slope, judge_creep},
      {"sliding_slope", "17", "boxes slide down a slope of 1.1 of their friction", "error of acceleration", "%", 2,
       sliding_slope, judge_of<SlopeSlide>},
      {"conveyor", "23", "a belt takes a box along", "error of way or speed", "%", 2, conveyor, judge_conveyor},
      {"billiard", "23", "a ball slides, then rolls", "error of way or speed", "%", 2, billiard, judge_billiard},
      {"rolling_stop", "23", "a ball rolls to a stop by rolling resistance", "error of way or speed", "%", 2,
       rolling_stop, judge_rolling_stop},
  };
  return trials;
}

}  // namespace isostep::scenes
