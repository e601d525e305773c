// Random bodies, each on one joint with a spring, a motor or limits, and what such a body may do: swing with the energy
// that it has, drive at its motor's speed, rest on its limits.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "isostep/dynamics/solver_body.hpp"
#include "random/dice.hpp"
#include "random/joint_angles.hpp"

namespace isostep::test {

enum class JointKind { spring, motor, limit, spring_limit, motor_limit, twist, cone, cone_twist, free };
inline constexpr int kJointKinds = 9;
inline constexpr const char* kJointKindNames[kJointKinds] = {"hinge, spring",
                                                             "hinge, motor",
                                                             "hinge, limit",
                                                             "hinge, spring and limit",
                                                             "hinge, motor and limit",
                                                             "ball, twist",
                                                             "ball, cone",
                                                             "ball, cone and twist",
                                                             "hinge, free"};

/// The holder of the joint's other end.
enum class Hold { world, static_body, kinematic, heavy };

inline constexpr double kFall = 10;  // [m/s^2] gravity

/// One body of `mass` at `arm` from its joint, at rest. Lengths [m], angles [rad].
struct SingleJoint {
  JointKind kind;
  Hold hold;
  bool box;
  double mass;   // [kg]
  D3 half;       // of a box; x: radius of a ball
  D3 arm;        // from the joint to the body's centre
  D3 axis;       // [1] the joint's z
  D3 tilt_axis;  // [1]
  double tilt;   // of the body
  double lower, upper, cone;
  double speed, torque;               // [rad/s], [N m]
  double target, frequency, damping;  // [rad], [Hz], [1]

  bool hinge() const { return kind <= JointKind::motor_limit || kind == JointKind::free; }
  std::uint32_t flags() const {
    using namespace joint_flag;
    constexpr std::uint32_t kFlags[kJointKinds] = {kSpring,         kMotor, kLimit, kSpring | kLimit,
                                                   kMotor | kLimit, kLimit, kCone,  kCone | kLimit};
    return kFlags[static_cast<int>(kind)];
  }
  bool has(std::uint32_t flag) const { return (flags() & flag) != 0; }
};

inline SingleJoint draw_joint(JointKind kind, std::uint64_t seed) {
  Dice dice(seed * kJointKinds + static_cast<std::uint64_t>(kind) + 1600000);
  SingleJoint j;
  j.kind = kind;
  j.hold = dice.below(2) == 0 ? Hold::world : static_cast<Hold>(dice.below(4));
  j.box = dice.one_in(2);
  j.mass = dice.magnitude(0.25, 4);
  const double size = dice.magnitude(0.05, 0.5);
  j.half = {size, j.box ? dice.magnitude(0.05, 0.5) : size, j.box ? dice.magnitude(0.05, 0.5) : size};
  j.arm = dice.arrow_of(dice.magnitude(0.1, 2));
  j.axis = dice.direction();
  j.tilt_axis = dice.direction();
  j.tilt = dice.in(-kPi, kPi);
  j.lower = -dice.in(0.05, 1.5);
  j.upper = dice.in(0.05, 1.5);
  j.cone = dice.in(0.1, 1.5);
  j.speed = (dice.one_in(2) ? 1 : -1) * dice.in(0.5, 6);
  j.torque = dice.magnitude(0.1, 200);
  j.target = dice.in(-1, 1);
  j.frequency = dice.magnitude(0.25, 8);
  j.damping = dice.in(0, 1.5);
  return j;
}

/// Settings under which a joint is tried.
struct JointTrial {
  SolverName solver;
  int substeps;
  int frames;  // at 60 a second
};

/// The errors of joints, counted, with words for the first of each.
struct JointFindings {
  int tried = 0, too_fast = 0, past_limit = 0, motor_off = 0;
  int rested = 0, drove = 0;  // that rested on a limit, that had to reach their speed: what the others mean
  int jumped = 0;             // whose twist jumped: their speed says nothing
  double fastest = 0;         // [m/s] of those too fast
  double furthest = 0;        // [rad] past a limit, at rest
  std::string words;

  void operator+=(const JointFindings& o) {
    tried += o.tried;
    too_fast += o.too_fast;
    past_limit += o.past_limit;
    motor_off += o.motor_off;
    rested += o.rested;
    drove += o.drove;
    jumped += o.jumped;
    fastest = std::max(fastest, o.fastest);
    furthest = std::max(furthest, o.furthest);
    if (words.size() < 2000) words += o.words;
  }
};

/// Watches one such body. Heights are counted from the lowest that its joint lets it reach.
template <class S> class JointWatch {
 public:
  static constexpr double kTenth = 1.1;    // speeds may be above what the energy allows by that much
  static constexpr double kCoarse = 1.15;  // the same at 60 solutions a second: limits strike half a radian in each
  static constexpr double kPole = 2.8;     // [rad] of swing: beyond, twist jumps by a turn, and the way back is work
  static constexpr double kPassed = 0.02;  // [rad] past a limit, at rest on it
  static constexpr double kRest = 0.02;    // [m/s] slower is at rest

  JointWatch(const World<S>& w, const SingleJoint& j, JointId joint, BodyId body, const JointTrial& trial)
      : j_(j), joint_(joint), body_(body), trial_(trial) {
    const BodyView<S> view = w.view(body);
    const JointAngles at = angles_of(w, *w.joint(joint));
    const double rate = integration_rate(trial.solver, 60, trial.substeps);
    lowest_ = lowest_reach(at, real(view.state->centre));
    highest_ = highest_reach(at, real(view.state->centre));
    start_ = real(view.state->centre).y;
    weight_ = j.mass * kFall;
    inertia_ = inertia_about(view, at.anchor, at.axis);
    grain_ = kFall / rate + grain<S>(10) * rate;
    slow_ = 0.5 * inertia_ * std::pow(to_double(rapid_angular_speed<S>(60)), 2);
    if (j.has(joint_flag::kSpring)) {
      const double w2 = std::pow(2 * kPi * j.frequency, 2);
      sprung_ = 0.5 * inertia_ * w2 * std::pow(at.twist - j.target, 2);
    }
    angle_ = at.twist;
  }

  void see(const World<S>& w) {
    ++frame_;
    const BodyView<S> view = w.view(body_);
    const JointProperties<S>& p = *w.joint(joint_);
    const JointAngles now = angles_of(w, p);
    turned_ += std::fabs(std::remainder(now.twist - angle_, 2 * kPi));
    angle_ = now.twist;
    double energy = weight_ * (real(view.state->centre).y - lowest_) + kinetic_energy(view);
    if (j_.hold == Hold::heavy) energy += kinetic_energy(w.view({p.body_a, p.generation_a}));
    const double speed = std::isfinite(energy) ? speed_of(energy) : 1e30;
    const double more = integration_rate(trial_.solver, 60, trial_.substeps) > 60 ? kTenth : kCoarse;
    const double allowed = more * speed_of(allowed_energy()) + grain_;
    if (speed - allowed > excess_) {
      excess_ = speed - allowed;
      worst_ = speed;
      worst_allowed_ = allowed;
      at_ = frame_;
    }
    if (frame_ > trial_.frames - 30) see_end(now, std::sqrt(2 * kinetic_energy(view) / j_.mass));
    top_angular_speed_ = std::max(top_angular_speed_, std::fabs(now.angular_velocity));
    top_swing_ = std::max(top_swing_, now.swing);
  }

  JointFindings findings(std::uint64_t seed) const {
    JointFindings f;
    f.tried = 1;
    std::ostringstream words;
    const bool jumped = j_.kind == JointKind::twist && kPole < top_swing_;
    f.jumped = jumped ? 1 : 0;
    if (excess_ > 0 && !jumped) {
      f.too_fast = 1;
      f.fastest = worst_;
      words << worst_ << " m/s where " << worst_allowed_ << " are allowed, frame " << at_ << "; ";
      if (!j_.hinge()) words << "swing up to " << top_swing_ << " rad; ";
    }
    if (end_speed_ < kRest && end_past_ > -0.005) f.rested = 1;
    if (end_speed_ < kRest && end_past_ > 0) f.furthest = end_past_;
    if (end_speed_ < kRest && end_past_ > kPassed) {
      f.past_limit = 1;
      words << end_past_ << " rad past its limit at rest; ";
    }
    if (must_drive()) {
      f.drove = 1;
      const double reach = std::fabs(j_.speed), bar = 0.05 * reach + grain_ * j_.mass * radius() / inertia_;
      if (!(end_slip_ <= bar) || !(top_angular_speed_ <= 1.1 * reach + grain_ * j_.mass * radius() / inertia_)) {
        f.motor_off = 1;
        words << "motor of " << j_.speed << " rad/s off by " << end_slip_ << " at the end, at most "
              << top_angular_speed_ << "; ";
      }
    }
    const std::string what = words.str();
    if (what.empty()) return f;
    std::ostringstream line;
    constexpr const char* kHolds[] = {"", " on a static body", " on a kinematic body", " on a heavy body"};
    line << "\n  " << kJointKindNames[static_cast<int>(j_.kind)] << kHolds[static_cast<int>(j_.hold)] << ", seed "
         << seed << ", arm " << length(j_.arm) << " m, " << (j_.box ? "box " : "ball ") << j_.half.x << ", "
         << kSolverNames[static_cast<int>(trial_.solver)] << " with " << trial_.substeps << ": " << what;
    f.words = line.str();
    return f;
  }

 private:
  double speed_of(double energy) const { return std::sqrt(2 * std::max(energy, 0.0) / j_.mass); }
  /// [m] The length of the arm across the axis.
  double radius() const { return length(cross(j_.arm, j_.axis)); }
  /// A motor gives energy only while the body turns more slowly than it: where the other end stands still, never above
  /// that speed at the highest point. Against what moves too, the work that it did.
  double allowed_energy() const {
    const double start = weight_ * (start_ - lowest_) + sprung_, worked = start + j_.torque * turned_;
    if (j_.kind == JointKind::free) return start + slow_;
    if (!j_.has(joint_flag::kMotor)) return start;
    if (j_.hold == Hold::heavy) return worked;
    return std::max(start, std::min(worked, 0.5 * inertia_ * j_.speed * j_.speed + weight_ * (highest_ - lowest_)));
  }
  /// It holds its load everywhere with half to spare, and has the time to come to its speed.
  bool must_drive() const {
    if (j_.kind != JointKind::motor) return false;
    const double load = weight_ * radius();
    return j_.torque > 1.5 * load && inertia_ * std::fabs(j_.speed) / (j_.torque - load) < trial_.frames / 120.0;
  }
  void see_end(const JointAngles& now, double speed) {
    end_speed_ = std::max(end_speed_, speed);
    end_slip_ = std::max(end_slip_, std::fabs(now.angular_velocity - j_.speed));
    double past = -1;
    // Twist is told apart from swing only while the swing is no half turn.
    if (j_.has(joint_flag::kLimit) && now.swing < 2.5) past = std::max(now.twist - j_.upper, j_.lower - now.twist);
    if (j_.has(joint_flag::kCone)) past = std::max(past, now.swing - j_.cone);
    end_past_ = std::max(end_past_, past);
  }

  // A hinge's body stays on a circle, or the part of it between its limits; another one on a ball.
  template <class Pick> double extreme(const JointAngles& at, D3 centre, const Pick& pick) const {
    const D3 arm = centre - at.anchor, along = at.axis * dot(at.axis, arm), across = arm - along;
    const D3 side = cross(at.axis, across);
    const bool limited = j_.has(joint_flag::kLimit);
    const double from = limited ? j_.lower - kPassed : -kPi, to = limited ? j_.upper + kPassed : kPi;
    double found = centre.y;
    for (int i = 0; i <= 256; ++i) {
      const double angle = from + (to - from) * i / 256;
      found = pick(found, (at.anchor + along + across * std::cos(angle) + side * std::sin(angle)).y);
    }
    return found;
  }
  double lowest_reach(const JointAngles& at, D3 centre) const {
    if (!j_.hinge()) return at.anchor.y - length(centre - at.anchor);
    return extreme(at, centre, [](double a, double b) { return std::min(a, b); });
  }
  double highest_reach(const JointAngles& at, D3 centre) const {
    if (!j_.hinge()) return at.anchor.y + length(centre - at.anchor);
    return extreme(at, centre, [](double a, double b) { return std::max(a, b); });
  }

  SingleJoint j_;
  JointId joint_;
  BodyId body_;
  JointTrial trial_;
  double lowest_, highest_, start_;  // [m]
  double weight_, inertia_;          // [N], [kg m^2] about the joint
  double grain_;                     // [m/s] of gravity, and of a place's last digit, between two solutions
  double sprung_ = 0;                // [J] in the spring at the start
  double slow_ = 0;  // [J] below rapid_angular_speed() inertia is that of the step's beginning: gains end there
  double turned_ = 0, angle_ = 0;  // [rad]
  int frame_ = 0, at_ = 0;
  double excess_ = 0, worst_ = 0, worst_allowed_ = 0;  // [m/s]
  double end_speed_ = 0, end_past_ = -1, end_slip_ = 0, top_angular_speed_ = 0, top_swing_ = 0;
};

/// `count` joints of one kind from `first` on, side by side in one world, where they never touch.
template <class S> class JointTrials {
 public:
  JointTrials(JointKind kind, std::uint64_t first, int count, const JointTrial& trial)
      : world_(world_settings(trial)), trial_(trial) {
    for (int i = 0; i < count; ++i) {
      const SingleJoint j = draw_joint(kind, first + static_cast<std::uint64_t>(i));
      const std::pair<JointId, BodyId> made = add(j, {5.0 * (i % 5 - 2), 5.0, 5.0 * (i / 5 - 2)});
      if (!made.first) continue;  // an arm too long for its body, in a scalar of small range
      watches_.emplace_back(world_, j, made.first, made.second, trial);
      seeds_.push_back(first + static_cast<std::uint64_t>(i));
    }
  }

  JointFindings run() {
    for (int frame = 0; frame < trial_.frames; ++frame) {
      world_.step();
      for (JointWatch<S>& watch : watches_) watch.see(world_);
    }
    JointFindings findings;
    for (std::size_t i = 0; i < watches_.size(); ++i) findings += watches_[i].findings(seeds_[i]);
    return findings;
  }

 private:
  static Settings<S> world_settings(const JointTrial& trial) {
    Settings<S> s = settings<S>(-kFall, 60, trial.substeps);
    s.solver = trial.solver;
    return s;
  }
  BodyDefinition<S> definition(ShapeId shape, D3 at) const {
    BodyDefinition<S> d = moving<S>(shape, at);
    d.collide = d.allow_sleep = false;
    return d;
  }
  BodyId add_hold(const SingleJoint& j, D3 at) {
    if (j.hold == Hold::world) return {};
    BodyDefinition<S> d = definition(add_ball(world_, 0.5), at + D3{0.25, 0.25, 0});
    if (j.hold == Hold::static_body) d.type = BodyType::static_;
    if (j.hold == Hold::kinematic) d.type = BodyType::kinematic;
    d.mass = num<S>(50 * j.mass);
    d.gravity_scale = S(0);
    return world_.create(d);
  }
  std::pair<JointId, BodyId> add(const SingleJoint& j, D3 at) {
    const BodyId hold = add_hold(j, at);
    BodyDefinition<S> d =
        definition(j.box ? world_.add_shape(Box<S>{vec<S>(j.half)}) : add_ball(world_, j.half.x), at + j.arm);
    d.mass = num<S>(j.mass);
    d.orientation = turn<S>(j.tilt_axis, j.tilt);
    const BodyId body = world_.create(d);
    const D3 z = {0, 0, 1}, across = cross(z, j.axis);
    const double s = length(across);
    const Quat<Unit<S>> frame = s > 0 ? turn<S>(across * (1 / s), std::atan2(s, j.axis.z)) : Quat<Unit<S>>::identity();
    JointProperties<S> p =
        world_.joint_at(j.hinge() ? JointType::hinge : JointType::ball, hold, body, {vec<S>(at), frame});
    p.flags = j.flags();
    p.lower = num<S>(j.lower);
    p.upper = num<S>(j.upper);
    p.cone = num<S>(j.cone);
    p.motor_speed = num<S>(j.speed);
    p.max_force = num<S>(j.torque);
    p.spring_target = num<S>(j.target);
    p.spring_frequency = num<S>(j.frequency);
    p.spring_damping = num<S>(j.damping);
    const JointId joint = world_.create(p);
    if (!joint) {
      EXPECT_EQ(world_.fault(), Fault::out_of_range);
      world_.destroy(body);
    }
    return {joint, body};
  }

  World<S> world_;
  JointTrial trial_;
  std::vector<JointWatch<S>> watches_;
  std::vector<std::uint64_t> seeds_;
};

}  // namespace isostep::test
