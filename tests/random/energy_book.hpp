// The energy that a world has, and at most can have: what commands put in, forces, motors and springs gave.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "random/joint_angles.hpp"
#include "scenes/measure.hpp"

namespace isostep::test {

/// A force that a command gave for the length of the next step.
struct AppliedForce {
  BodyId body;
  D3 force, torque;  // [N], [N m]
};

template <class S> class EnergyBook {
 public:
  /// The energy of motion and height. What springs hold is booked when they come: they can give no more.
  static double energy_of(const World<S>& w) { return scenes::measure_energy(w).total(); }

  /// Around all that is done to a world between two steps: what it has more for it was put in, what less taken out.
  void before_commands(const World<S>& w) { before_ = energy_of(w); }
  void after_commands(const World<S>& w) {
    const double change = energy_of(w) - before_;
    allowed_ += change;
    if (change > 0) given_ += change;
  }
  /// [J] the most that a spring can hold when it comes, between bodies of so much mass or inertia together.
  void add_spring(const JointProperties<S>& p, double stretch, double inertia) {
    const double rate = 2 * 3.14159265358979323846 * to_double(p.spring_frequency);
    give(0.5 * inertia * rate * rate * stretch * stretch);
  }
  /// Around a step: forces work along the way, motors where a body turns with them and more slowly.
  void before_step(const World<S>& w, std::vector<AppliedForce> forces) {
    forces_.clear();
    motors_.clear();
    for (const AppliedForce& f : forces) {
      if (w.contains(f.body)) forces_.push_back({f, real(w.center_of_mass(f.body))});
    }
    for (const JointId id : w.joints()) {
      const JointProperties<S>& p = *w.joint(id);
      if ((p.flags & joint_flag::kMotor) != 0) motors_.push_back({id, p, driven_place(w, p)});
    }
  }
  void after_step(const World<S>& w) {
    const double hz = w.settings().hz;
    for (const Pushed& push : forces_) {
      const double work = dot(push.force.force, real(w.center_of_mass(push.force.body)) - push.from) +
                          dot(push.force.torque, real(w.angular_velocity(push.force.body))) / hz;
      give(std::max(work, 0.0));
    }
    for (const Driven& motor : motors_) {
      const JointProperties<S>& p = motor.properties;
      const double speed = to_double(p.motor_speed), most = kMargin * std::fabs(speed) / hz;
      if (!w.contains(motor.joint)) {  // it broke
        give(to_double(p.max_force) * most);
        continue;
      }
      const double moved = driven_place(w, p) - motor.place;
      const bool turns = measure_of(p.type) == JointMeasure::angle;
      const double turned = turns ? std::remainder(moved, 2 * 3.14159265358979323846) : moved;
      give(to_double(p.max_force) * std::clamp(speed < 0 ? -turned : turned, 0.0, most));
    }
  }

  /// [J] The energy above what it may have: what it began with, and what it was given.
  double excess(const World<S>& w) const { return energy_of(w) - allowed_; }
  /// [J] The energy above the least that it ever had, and what it was given since. For worlds without springs alone,
  /// which hold energy back and give it later.
  double rise(const World<S>& w) {
    least_ = std::min(least_, excess(w));
    return excess(w) - least_;
  }
  double given() const { return given_; }

 private:
  static constexpr double kMargin = 1.5;  // a motor pushes for a part of a step in which its speed is passed

  struct Pushed {
    AppliedForce force;
    D3 from;  // [m]
  };
  struct Driven {
    JointId joint;
    JointProperties<S> properties;
    double place;  // [rad] or [m]
  };
  void give(double energy) {
    allowed_ += energy;
    given_ += energy;
  }

  double before_ = 0, allowed_ = 0, given_ = 0, least_ = 0;  // [J]
  std::vector<Pushed> forces_;
  std::vector<Driven> motors_;
};

}  // namespace isostep::test
