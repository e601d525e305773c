// One driven coordinate of a joint, in double: where it stands, its limits, and the energy that its motor and spring
// can give.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "random/joint_hold.hpp"

namespace isostep::test {

/// [kg m^2] or [kg] The most that a joint's spring without a mass of its own feels: of the lighter body, about its far
/// end.
template <class S> double most_felt(const World<S>& w, const JointProperties<S>& p, bool turns) {
  const auto of_end = [&](std::uint32_t slot, std::uint32_t generation, const Pose<S>& frame) {
    if (slot == kNoBody || w.type({slot, generation}) != BodyType::dynamic) return 1e30;
    const BodyProperties<S>& body = *w.view({slot, generation}).properties;
    const D3 kappa = real(body.kappa), arm = real(frame.position);
    const double own = 1 / std::min({kappa.x, kappa.y, kappa.z});
    return to_double(body.mass) * (turns ? own + dot(arm, arm) : 1.0);
  };
  return std::min(of_end(p.body_a, p.generation_a, p.frame_a), of_end(p.body_b, p.generation_b, p.frame_b));
}

class DrivenAxis {
 public:
  /// The axis that the joint's own properties drive: of all kinds but six_axis.
  template <class S> static DrivenAxis of(const World<S>& w, JointId joint) {
    const JointProperties<S>& p = *w.joint(joint);
    DrivenAxis d;
    d.joint_ = joint;
    d.kind_ = p.type;
    d.turns_ = measure_of(p.type) == JointMeasure::angle;
    d.twists_ = p.type == JointType::ball;
    d.limited_ = (p.flags & joint_flag::kLimit) != 0 && p.type != JointType::distance;
    d.set_range(to_double(p.lower), to_double(p.upper));
    if ((p.flags & joint_flag::kMotor) != 0) d.set_motor(to_double(p.motor_speed), to_double(p.max_force));
    if ((p.flags & joint_flag::kSpring) != 0)
      d.set_spring(most_felt(w, p, d.turns_), to_double(p.spring_frequency), to_double(p.spring_target), 0);
    d.begin(w);
    return d;
  }
  template <class S> static DrivenAxis of(const World<S>& w, const AxisDrive<S>& asked) {
    const JointProperties<S>& p = *w.joint(asked.joint);
    DrivenAxis d;
    d.joint_ = asked.joint;
    d.kind_ = p.type;
    d.axis_ = asked.axis;
    d.turns_ = !is_length(asked.axis);
    d.twists_ = asked.axis == JointAxis::twist && (p.flags & joint_flag::kLockSwing) != joint_flag::kLockSwing;
    d.swings_ = asked.axis == JointAxis::swing_x || asked.axis == JointAxis::swing_y;
    const bool hard = asked.limited && !(S(0) < asked.limit_frequency);
    d.limited_ = hard && !(d.swings_ && (p.flags & joint_flag::kCone) != 0);
    d.yields_ = asked.limited && !hard;
    d.set_range(to_double(asked.lower), to_double(asked.upper));
    if (asked.motor) d.set_motor(to_double(asked.motor_speed), to_double(asked.max_force));
    if (S(0) < asked.spring_frequency) {
      const double mass = S(0) < asked.spring_mass ? to_double(asked.spring_mass) : most_felt(w, p, d.turns_);
      d.set_spring(mass, to_double(asked.spring_frequency), to_double(asked.spring_target),
                   asked.motor ? 0.0 : to_double(asked.max_force));
    }
    d.begin(w);
    return d;
  }

  /// [J] The energy in its spring.
  double held() const { return held_at(place_); }
  bool stores() const { return 0 < stiffness_ || yields_; }
  /// [J] that it can have given since it was last asked. A motor gives while the joint moves its way, more slowly than
  /// it, and for a part of a step in which it becomes faster. An angle with limits that passes half a turn stretches
  /// its spring anew.
  template <class S> double work(const World<S>& w) {
    constexpr double kMargin = 1.5;
    const double before = place_, hz = w.settings().hz;
    place_ = place(w);
    const double way = place_ - before, moved = turns_ ? std::remainder(way, 2 * kPi) : way;
    double given = 0;
    if (speed_ != 0) given += force_ * std::clamp(speed_ < 0 ? -moved : moved, 0.0, kMargin * std::fabs(speed_) / hz);
    if (turns_ && !goes_round() && std::fabs(way) > kPi) given += std::max(held_at(place_) - held_at(before), 0.0);
    return given;
  }
  /// [m] or [rad] The way past a hard limit. A joint that folds so far that a swing or twist means nothing may be
  /// anywhere when it comes back.
  double past(double swing) {
    lost_ = lost_ || (twists_ && kTwistEnds < swing) || (swings_ && kSwingEnds < swing);
    return limited_ && !lost_ ? std::max({place_ - upper_, lower_ - place_, 0.0}) : 0.0;
  }
  JointId joint() const { return joint_; }

 private:
  void set_range(double lower, double upper) {
    lower_ = lower;
    upper_ = upper;
  }
  void set_motor(double speed, double force) {
    speed_ = speed;
    force_ = force;
  }
  void set_spring(double mass, double frequency, double target, double most) {
    stiffness_ = mass * (2 * kPi * frequency) * (2 * kPi * frequency);
    target_ = target;
    most_ = most;
  }
  template <class S> void begin(const World<S>& w) { place_ = place(w); }
  template <class S> double place(const World<S>& w) const {
    const JointProperties<S>& p = *w.joint(joint_);
    if (kind_ == JointType::six_axis) return to_double(w.joint_position(joint_, axis_));
    return kind_ == JointType::distance ? angles_of(w, p).apart : driven_place(w, p);
  }
  bool goes_round() const { return turns_ && !swings_ && !limited_ && !yields_; }
  double held_at(double place) const {
    const double way = place - target_;
    const double stretch = std::fabs(goes_round() ? std::remainder(way, 2 * kPi) : way);
    const double whole = 0.5 * stiffness_ * stretch * stretch;
    return 0 < most_ ? std::min(whole, most_ * stretch) : whole;
  }

  JointId joint_;
  JointType kind_ = JointType::ball;
  JointAxis axis_ = JointAxis::x;
  bool turns_ = false, twists_ = false, swings_ = false;
  bool limited_ = false, yields_ = false, lost_ = false;  // by hard limits, by soft ones
  double lower_ = 0, upper_ = 0;                          // [m] or [rad]
  double speed_ = 0, force_ = 0;                          // of a motor
  double stiffness_ = 0, target_ = 0, most_ = 0;          // of a spring; most_ 0: any force
  double place_ = 0;
};

}  // namespace isostep::test
