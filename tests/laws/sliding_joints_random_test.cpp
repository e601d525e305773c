// Laws of one random body on a joint that slides or holds angles: it has no more energy than it was given, leaves its
// joint by little, and rests within its limits. ISOSTEP_SLIDING_JOINTS=200 tries so many of each kind.
// SPDX-License-Identifier: MIT

#include <sstream>

#include "random/asked.hpp"
#include "random/joint_angles.hpp"
#include "random/parts.hpp"

namespace isostep::test {
namespace sliding_joints_random_test {

constexpr JointType kKinds[] = {JointType::slider,    JointType::cylindrical,       JointType::planar,
                                JointType::universal, JointType::constant_velocity, JointType::angular};
constexpr double kFall = 10;        // [m/s^2] gravity
constexpr double kFaster = 1.1;     // speeds may be above what the energy allows by that much
constexpr double kPassed = 0.02;    // [m] or [rad] past a limit, at rest on it
constexpr double kRest = 0.02;      // [m/s] slower is at rest
constexpr double kOff = 0.005;      // [m] or [rad] a metre
constexpr double kOffOfPgs = 0.05;  // it solves once in 1/60 s
constexpr double kFold = 2.8;       // [rad] a constant velocity joint that bends further lets go of its twist
constexpr int kFrames = 360, kTogether = 25;

/// The error of a joint against what it holds.
struct Off {
  double place;  // [m]
  double angle;  // [rad]
};
template <class S> Off off(const World<S>& w, JointId id) {
  const JointProperties<S>& p = *w.joint(id);
  const JointAngles now = angles_of(w, p);
  const double place = to_double(w.joint_error(id)), twist = std::fabs(now.twist);
  switch (p.type) {
    case JointType::slider:
    case JointType::angular: return {place, now.swing + twist};
    case JointType::constant_velocity: return {place, twist};
    case JointType::universal: return {place, 0};
    default: return {place, now.swing};
  }
}

template <class S> class OneBody {
 public:
  OneBody(World<S>& w, JointType kind, Dice& dice, D3 at) : kind_(kind) {
    const std::uint32_t hold = dice.below(4);
    const double mass = dice.magnitude(0.25, 4);
    const D3 arm = dice.arrow_of(dice.magnitude(0.1, 1));
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), at + D3{0.25, 0.25, 0});
    d.collide = d.allow_sleep = false;
    d.mass = num<S>(50 * mass);
    d.gravity_scale = S(0);
    d.type = hold == 1 ? BodyType::static_ : hold == 2 ? BodyType::kinematic : BodyType::dynamic;
    if (hold != 0) hold_ = w.create(d);
    const double x = dice.magnitude(0.1, 0.5), y = dice.magnitude(0.1, 0.5), z = dice.magnitude(0.1, 0.5);
    d.shape = add_box(w, x, y, z);
    d.type = BodyType::dynamic;
    d.position = vec<S>(at + arm);
    d.orientation = dice.orientation<S>();
    d.mass = num<S>(mass);
    const bool endless = kind == JointType::planar || kind == JointType::angular;
    d.gravity_scale = endless ? S(0) : S(1);  // what nothing stops would fall for 180 m
    d.velocity = vec<S>(dice.arrow(0, 2));
    d.angular_velocity = vec<S>(dice.arrow(0, 3));
    body_ = w.create(d);
    fall_ = endless ? 0 : kFall;
    JointProperties<S> p = w.joint_at(kind, hold_, body_, {vec<S>(at), dice.orientation<S>()});
    draw_joint(w, dice, Drive::motors, p);
    if (measure_of(kind) == JointMeasure::length) p.flags |= joint_flag::kLimit;
    joint_ = w.create(p);
    if (!joint_) return;
    const JointAngles now = angles_of(w, p);
    given_ = energy(w);
    last_ = driven_place(w, p);
    if ((p.flags & joint_flag::kSpring) != 0) {
      const bool turns = measure_of(kind) == JointMeasure::angle;
      const double inertia = turns ? inertia_about(w.view(body_), now.anchor, now.axis) : mass;
      const double stretch = last_ - to_double(p.spring_target);
      given_ += 0.5 * inertia * std::pow(2 * kPi * to_double(p.spring_frequency) * stretch, 2);
    }
  }
  bool made() const { return static_cast<bool>(joint_); }

  void see(const World<S>& w, int frame) {
    const JointProperties<S>& p = *w.joint(joint_);
    const double place = driven_place(w, p), moved = place - last_;
    last_ = place;
    if ((p.flags & joint_flag::kMotor) != 0) {
      const bool turns = measure_of(kind_) == JointMeasure::angle;
      given_ += to_double(p.max_force) * std::fabs(turns ? std::remainder(moved, 2 * kPi) : moved);
    }
    const double mass = to_double(w.mass(body_)), moving = motion(w);
    const double allowed = std::max(given_ - (energy(w) - moving), 0.0);
    const double grain = kFall / 480 + isostep::test::grain<S>(10) * 480;
    const double excess = std::sqrt(2 * moving / mass) - kFaster * std::sqrt(2 * allowed / mass) - grain;
    excess_ = std::isfinite(excess) ? std::max(excess_, excess) : 1e30;
    const Off now = off(w, joint_);
    const JointAngles at = angles_of(w, p);
    folded_ = folded_ || (kind_ == JointType::constant_velocity && at.swing > kFold);
    place_ = std::max(place_, now.place / (1 + at.apart));
    if (!folded_) angle_ = std::max(angle_, now.angle);
    if (frame < kFrames - 30) return;
    speed_ = std::max(speed_, std::sqrt(2 * moving / mass));
    if ((p.flags & joint_flag::kLimit) != 0) {
      passed_ = std::max({passed_, place - to_double(p.upper), to_double(p.lower) - place});
    }
    if ((p.flags & joint_flag::kCone) != 0) {
      passed_ = std::max(passed_, at.swing - to_double(p.cone));
    }
  }

  std::string words(double most_off) const {
    std::ostringstream said;
    if (excess_ > 0) said << excess_ << " m/s too fast; ";
    if (place_ > most_off) said << place_ << " m off; ";
    if (angle_ > most_off) said << angle_ << " rad off; ";
    if (rested() && passed_ > kPassed) said << passed_ << " past its limit; ";
    return said.str();
  }
  bool rested() const { return speed_ < kRest; }

 private:
  double motion(const World<S>& w) const {
    const bool moves = hold_ && w.type(hold_) == BodyType::dynamic;
    return kinetic_energy(w.view(body_)) + (moves ? kinetic_energy(w.view(hold_)) : 0.0);
  }
  double energy(const World<S>& w) const {
    return motion(w) + to_double(w.mass(body_)) * fall_ * to_double(w.center_of_mass(body_).y);
  }

  JointType kind_;
  bool folded_ = false;  // its twist says nothing any more
  BodyId hold_, body_;
  JointId joint_;
  double fall_ = 0;                                                     // [m/s^2]
  double given_ = 0, last_ = 0;                                         // [J], [m] or [rad]
  double excess_ = 0, place_ = 0, angle_ = 0, speed_ = 0, passed_ = 0;  // worst
};

template <class S> class SlidingJointsAtRandom : public ::testing::Test {
 protected:
  static void try_solver(SolverName solver) {
    const int asked_for = static_cast<int>(asked("ISOSTEP_SLIDING_JOINTS", 0)), count = asked_for > 0 ? asked_for : 10;
    std::ostringstream lost;
    int found = 0, tried = 0, rested = 0;
    for (const JointType kind : kKinds) {
      for (int first = 0; first < count; first += kTogether) {
        Settings<S> s = settings<S>(-kFall, 60, 8);
        s.solver = solver;
        World<S> w(s);
        std::vector<OneBody<S>> bodies;
        for (int i = first; i < std::min(count, first + kTogether); ++i) {
          Dice dice(static_cast<std::uint64_t>(i) * 7919 + static_cast<std::uint64_t>(kind) * 104729 + 31);
          bodies.emplace_back(w, kind, dice, D3{5.0 * (i % 5 - 2), 5, 5.0 * (i / 5 % 5 - 2)});
          ASSERT_TRUE(bodies.back().made()) << describe(w.fault());
        }
        for (int frame = 0; frame < kFrames; ++frame) {
          w.step();
          for (OneBody<S>& body : bodies) body.see(w, frame);
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
          ++tried;
          rested += bodies[i].rested() ? 1 : 0;
          const std::string words = bodies[i].words(solver == SolverName::pgs ? kOffOfPgs : kOff);
          if (!words.empty() && ++found < 20) {
            lost << "\n  " << kJointNames[static_cast<int>(kind)] << ", seed " << first + static_cast<int>(i) << ": "
                 << words;
          }
        }
      }
    }
    EXPECT_EQ(found, 0) << "of " << tried << " with " << kSolverNames[static_cast<int>(solver)] << lost.str();
    EXPECT_GT(rested, tried / 20);
  }
};
TYPED_TEST_SUITE(SlidingJointsAtRandom, AllScalars);

TYPED_TEST(SlidingJointsAtRandom, soft_step_holds_them) { this->try_solver(SolverName::soft_step); }
TYPED_TEST(SlidingJointsAtRandom, pgs_holds_them) { this->try_solver(SolverName::pgs); }
TYPED_TEST(SlidingJointsAtRandom, direct_holds_them) { this->try_solver(SolverName::direct); }

}  // namespace sliding_joints_random_test
}  // namespace isostep::test
