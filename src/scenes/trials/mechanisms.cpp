// Trials of mechanisms whose motion is known in closed form: cranks, ropes, stops, shafts, beams.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "isostep/math/rotations.hpp"
#include "mechanism_parts.hpp"

namespace isostep::scenes {
namespace {

// ---- a crank drives a piston

constexpr double kCrank = 0.5, kRod = 1.5;  // [m]

/// Along x, the crank at the origin; the piston weighs 1 kg. In the plane: the rod's pins are hinges.
Scene slider_crank() {
  Scene scene = awake(3600);
  scene.bodies = {apart(weighing(body_of(box_part({kCrank / 2, 0.05, 0.05}), {kCrank / 2, 0, 0}), 1)),
                  apart(weighing(body_of(box_part({kRod / 2, 0.05, 0.05}), {kCrank + kRod / 2, 0, 0}), 1)),
                  apart(weighing(body_of(box_part({0.2, 0.2, 0.2}), {kCrank + kRod, 0, 0}), 1))};
  SceneJoint slide = joint_of(JointType::slider, -1, 2, {kCrank + kRod, 0, 0});
  slide.anchor_b = slide.anchor;
  slide.orientation = {0, kHalfRoot, 0, kHalfRoot};  // z to x
  scene.joints = {driven(joint_of(JointType::hinge, -1, 0, {0, 0, 0}), kTurn, 200),
                  joint_of(JointType::hinge, 0, 1, {kCrank, 0, 0}),
                  joint_of(JointType::hinge, 1, 2, {kCrank + kRod, 0, 0}), slide};
  return scene;
}
/// [mm] The distance of the piston from where the crank's angle puts it.
class CrankError : public Off {
 public:
  CrankError() : Off(0) {}

 private:
  double error(const Sight&, const Sight& now) const override {
    const double angle = angle_of(now.bodies[0]), across = kCrank * std::sin(angle);
    return 1000 * (now.bodies[2].centre.x - kCrank * std::cos(angle) - std::sqrt(kRod * kRod - across * across));
  }
};

// ---- a rope over two wheels

/// 1 and 2 kg; the rope between them is 20 m long, and they move for three seconds.
Scene atwood() {
  Scene scene = awake(180);
  const double xs[] = {-1, 1}, depths[] = {18, 2};  // [m] of the weights below their wheels
  for (int i = 0; i < 2; ++i) {
    scene.bodies.push_back(apart(weighing(body_of(sphere_part(0.25), {xs[i], -depths[i], 0}), 1 + i)));
    SceneJoint rope = stopped(joint_of(JointType::distance, -1, i, {xs[i], 0, 0}), 0, 40);
    rope.anchor_b = vector_of({xs[i], -depths[i], 0});
    scene.joints.push_back(rope);
  }
  scene.records.push_back(
      {"coupling", {{"joint_a", {0}}, {"joint_b", {1}}, {"ratio_a", {1}}, {"ratio_b", {1}}, {"upper", {20}}}});
  return scene;
}
/// [%] The error of their acceleration, a third of gravity's; a millimetre of rope counts as half a per cent.
class AtwoodError : public Off {
 public:
  AtwoodError() : Off(1) {}

 private:
  double error(const Sight&, const Sight& now) const override {
    const double speed = now.bodies[0].velocity.y, want = kGravity / 3 * now.time;
    const double rope = length_of(now.bodies[0].centre - Vec3<double>{-1, 0, 0}) +
                        length_of(now.bodies[1].centre - Vec3<double>{1, 0, 0});
    return worse(100 * std::abs(speed / want - 1), 500 * std::abs(rope - 20));
  }
};

// ---- stops

/// A rod runs into a stop at 270 degrees, driven at 20 rad/s all the time.
Scene far_stop() {
  Scene scene = awake(300);
  scene.bodies = {apart(weighing(body_of(box_part({0.5, 0.05, 0.05}), {0.5, 0, 0}), 1))};
  scene.joints = {stopped(driven(joint_of(JointType::hinge, -1, 0, {0, 0, 0}), 20, 50), 0, 0.75 * kTurn)};
  return scene;
}
/// A rod on a motor of 100 N m against a limit, for a minute.
Scene pressed_stop() {
  Scene scene = far_stop();
  scene.frames = 3600;
  scene.joints = {stopped(driven(joint_of(JointType::hinge, -1, 0, {0, 0, 0}), 10, 100), -kTurn / 12, kTurn / 12)};
  return scene;
}
/// [degrees] The angle from the stop, a second after the start and later.
template <int kDegrees> class StopError : public Off {
 public:
  StopError() : Off(1) {}

 private:
  double error(const Sight&, const Sight& now) const override {
    const double off = angle_of(now.bodies[0]) / kTurn - kDegrees / 360.0;
    return 360 * (off - std::round(off));
  }
};

// ---- a lift

/// A platform of a ton on a slider, driven at 2 m/s up to a stop at 10 m, with ten crates of 100 kg.
Scene loaded_lift() {
  Scene scene = awake(600);
  scene.bodies = {weighing(body_of(box_part({2, 0.25, 2}), {0, 0, 0}), 1000)};
  for (int i = 0; i < 10; ++i) {
    const Point at = {-1.5 + (i % 5) * 0.75, 0.5, i < 5 ? -0.75 : 0.75};
    scene.bodies.push_back(weighing(body_of(box_part({0.25, 0.25, 0.25}), at), 100));
  }
  SceneJoint slide = joint_of(JointType::slider, -1, 0, {0, 0, 0});
  slide.anchor_b = slide.anchor;
  slide.orientation = {-kHalfRoot, 0, 0, kHalfRoot};  // z to y
  scene.joints = {stopped(driven(slide, 2, 40'000), 0, 10)};
  return scene;
}
/// [mm] The distance of the platform from its stop, 8 s after the start and later; 1000 where a crate fell off.
class LiftError : public Off {
 public:
  LiftError() : Off(8) {}  // the crates have landed, twice

 private:
  double error(const Sight&, const Sight& now) const override {
    double worst = 1000 * std::abs(now.bodies[0].centre.y - 10);
    for (std::size_t i = 1; i < now.bodies.size(); ++i)
      worst = worse(worst, now.bodies[i].centre.y < 10 ? 1000.0 : 0.0);  // fell off
    return worst;
  }
};

// ---- a beam of twenty boxes

constexpr int kBoxes = 20;

/// A beam of boxes, welded to each other and to the world, level.
Scene cantilever() {
  Scene scene = awake(600);
  for (int i = 0; i < kBoxes; ++i) {
    scene.bodies.push_back(apart(weighing(body_of(box_part({0.25, 0.25, 0.25}), {0.25 + 0.5 * i, 0, 0}), 1)));
    scene.joints.push_back(joint_of(JointType::fixed, i - 1, i, {0.5 * i, 0, 0}));
  }
  return scene;
}
/// [%] The way of the beam's tip over the beam's length.
class Sag : public Off {
 public:
  Sag() : Off(0) {}

 private:
  double error(const Sight& start, const Sight& now) const override {
    return 100 * length_of(way_of(start, now, kBoxes - 1)) / (0.5 * kBoxes);
  }
};

// ---- a parallelogram through its change points

constexpr double kSide = 3;  // [m] of ground and coupler; crank and rocker are 1 m
constexpr int kChangePoints = 1000;

/// The crank is turned twice a second: every half turn all four lie on one line, where it might go on as a crossed
/// one.
Scene parallelogram() {
  Scene scene = awake(15 * kChangePoints + 60);
  const auto rod = [&](Point middle, double half) {
    scene.bodies.push_back(apart(weighing(body_of(box_part({half, 0.05, 0.05}), middle), 1)));
  };
  rod({0.5, 0, 0}, 0.5);
  rod({1 + kSide / 2, 0, 0}, kSide / 2);
  rod({kSide + 0.5, 0, 0}, 0.5);
  scene.joints = {driven(joint_of(JointType::hinge, -1, 0, {0, 0, 0}), 2 * kTurn, 200),
                  joint_of(JointType::hinge, 0, 1, {1, 0, 0}), joint_of(JointType::hinge, 1, 2, {kSide + 1, 0, 0}),
                  joint_of(JointType::hinge, -1, 2, {kSide, 0, 0})};
  return scene;
}
/// [mm] The way out of the plane, of any rod; a rocker that is not parallel to the crank any more counts as a metre. No
/// number, where the crank has not passed as many.
class Flip : public Judge {
 public:
  void see(const Sight& now) override {
    for (const BodySight& body : now.bodies) worst_ = worse(worst_, 1000 * std::abs(body.centre.z));
    const double angle = angle_of(now.bodies[0]);
    const double apart = std::remainder(angle - angle_of(now.bodies[2]), kTurn);
    worst_ = worse(worst_, std::abs(apart) > 0.25 ? 1000.0 : 0.0);
    passed_ += std::signbit(angle) != std::signbit(angle_);
    angle_ = angle;
  }
  double figure() const override { return passed_ < kChangePoints ? std::nan("") : worst_; }

 private:
  double worst_ = 0, angle_ = 0;
  int passed_ = 0;
};

// ---- an arm of servos

constexpr int kLinks = 3;  // of a metre

/// Level, with 100 kg at its end; `held` holds each link.
template <class Hold> Scene loaded_arm(const Hold& held) {
  Scene scene = awake(600);
  for (int i = 0; i < kLinks; ++i) {
    scene.bodies.push_back(apart(weighing(body_of(box_part({0.5, 0.1, 0.1}), {i + 0.5, 0, 0}), 1)));
    held(scene, i);
  }
  scene.bodies.push_back(apart(weighing(body_of(box_part({0.25, 0.25, 0.25}), {double(kLinks), 0, 0}), 100)));
  scene.joints.push_back(joint_of(JointType::fixed, kLinks - 1, kLinks, {double(kLinks), 0, 0}));
  return scene;
}
/// [Hz] The frequency of each spring, made for what hangs behind it: it lets the load down by g / (2 pi f)^2: 2.5 mm,
/// 7.6 mm by the three. Made for its two links alone, a spring of 240 Hz, as fast as there are, gives by 3 % of the
/// arm.
constexpr double kServoRate = 10;
Scene arm_of_springs() {
  return loaded_arm([](Scene& scene, int i) {
    SceneJoint hinge = joint_of(JointType::six_axis, i - 1, i, {double(i), 0, 0});
    hinge.flags = joint_flag::kLockPoint | joint_flag::kLockSwing;
    scene.joints.push_back(hinge);
    const double lever = kLinks - i;  // [m] to the load
    scene.records.push_back({"axis_drive",
                             {{"joint", {double(i)}},
                              {"axis", {5}},
                              {"spring_frequency", {kServoRate}},
                              {"spring_damping", {1}},
                              {"spring_mass", {100 * lever * lever}}}});
  });
}
Scene arm_of_motors() {
  return loaded_arm([](Scene& scene, int i) {
    scene.joints.push_back(driven(joint_of(JointType::hinge, i - 1, i, {double(i), 0, 0}), 0, 20'000));
  });
}
/// [%] The way of the load from the third second on, or how far it still swings, over the arm's length.
class ArmSag : public FromStart {
 public:
  double figure() const override { return 100 * worse(sag_, highest_ - lowest_) / kLinks; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    const Vec3<double> way = way_of(start, now, kLinks);
    if (now.time < 3) return;
    sag_ = worse(sag_, length_of(way));
    highest_ = worse(highest_, way.y);
    lowest_ = -worse(-lowest_, -way.y);
  }
  double sag_ = 0, highest_ = -1000, lowest_ = 1000;  // [m]
};

// ---- a twist far past its limit

/// A lever of a metre to either side, held in its middle by a ball joint whose twist must be a sixth of a turn more.
Scene twisted_lever() {
  Scene scene = weightless(600);
  scene.bodies = {apart(weighing(body_of(box_part({1, 0.1, 0.1}), {0, 0, 0}), 1))};
  scene.joints = {stopped(joint_of(JointType::ball, -1, 0, {0, 0, 0}), kTurn / 6, kTurn / 4)};
  return scene;
}
/// [m/s] The speed of its ends, by their way in a frame: a correction of poses has no velocity. No number, where it is
/// not back at its limit in the end.
class ReturnSpeed : public Judge {
 public:
  void see(const Sight& sight) override {
    const double angle = angle_of(sight.bodies[0]), passed = sight.time - time_;
    if (passed > 0) fastest_ = worse(fastest_, std::abs(std::remainder(angle - angle_, kTurn)) / passed);
    angle_ = angle;
    time_ = sight.time;
  }
  double figure() const override { return angle_ < kTurn / 6 - 0.02 ? std::nan("") : fastest_; }

 private:
  double fastest_ = 0, angle_ = 0, time_ = 0;
};

}  // namespace

std::span<const Trial> mechanism_trials() {
  static const Trial trials[] = {
      {"slider_crank", "S19", "a crank of 0.5 m drives a piston by a rod of 1.5 m, a turn a second",
       "the piston, from where the crank puts it", "mm", 0.5, slider_crank, judge_of<CrankError>},
      {"atwood", "S19", "1 and 2 kg on a rope over two wheels", "their acceleration; 2 um of rope count as 0.001", "%",
       0.5, atwood, judge_of<AtwoodError>},
      {"loaded_lift", "S19", "a platform with ten crates rises to its stop at 10 m", "the platform, from its stop",
       "mm", 1, loaded_lift, judge_of<LiftError>},
      {"far_stop", "27", "a motor of 20 rad/s runs into a stop at 270 degrees", "the rod, from its stop", "degrees",
       0.5, far_stop, judge_of<StopError<270>>},
      {"pressed_stop", "28", "a motor presses a rod against its stop for a minute", "the rod, from its stop", "degrees",
       0.01, pressed_stop, judge_of<StopError<30>>},
      {"parallelogram", "29", "a crank of 1 m, a coupler of 3 m and a rocker of 1 m pass a thousand change points",
       "out of the plane; a metre where it flips", "mm", 1, parallelogram, judge_of<Flip>},
      {"arm_of_springs", "30",
       "three springs, made for what hangs behind them, hold an arm of 3 m with 100 kg at its end",
       "sag or swing over length", "%", 1, arm_of_springs, judge_of<ArmSag>},
      {"arm_of_motors", "30", "the same by motors that stand still", "sag or swing over length", "%", 1, arm_of_motors,
       judge_of<ArmSag>},
      {"twisted_lever", "35", "a lever of a metre, twisted 60 degrees past its limit, returns", "speed of its ends",
       "m/s", 4, twisted_lever, judge_of<ReturnSpeed>},
      {"cantilever", "31", "twenty boxes welded to a beam that is held at one end", "sag over length", "%", 1,
       cantilever, judge_of<Sag>},
  };
  return trials;
}

}  // namespace isostep::scenes
