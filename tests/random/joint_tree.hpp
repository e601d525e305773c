// A random tree of bodies on joints of every kind, with limits, motors, brakes, springs and servos: a function of its
// seed. It hangs on the world or floats; nothing in it touches.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "random/dice.hpp"
#include "random/joint_angles.hpp"
#include "random/parts.hpp"

namespace isostep::test {

/// The size of a tree and its solver.
struct JointTreeTrial {
  SolverName solver;
  bool single;  // one joint: of one body on the world, or between two bodies; else 3 to 12 bodies
};

template <class S> class RandomJointTree {
 public:
  static constexpr double kGravity = 10;       // [m/s^2] of what hangs
  static constexpr double kSlowGravity = 1;    // of what falls for ten seconds: 50 m, where formats still have digits
  static constexpr std::uint32_t kKinds = 16;  // every kind once, and six_axis six times

  RandomJointTree(std::uint64_t seed, const JointTreeTrial& trial)
      : dice(seed * 2654435761u + (trial.single ? 5 : 3)), world(settings_of(trial.solver)) {
    hangs = dice.below(3) != 0;
    falls = dice.below(4) != 0;
    world.set_gravity(vec<S>(0, -gravity(), 0));
    const std::uint32_t count = trial.single ? (hangs ? 1 : 2) : 3 + dice.below(10);
    const double speed = dice.one_in(3) ? 0 : 1;
    for (std::uint32_t i = 0; i < count; ++i) add_body(speed);
    for (std::uint32_t i = hangs ? 0 : 1; i < count && made(); ++i)
      join(i, trial.single ? static_cast<std::uint32_t>(seed % kKinds) : dice.below(kKinds));
  }
  /// The tree was made; a scalar of small range may refuse an arm.
  bool made() const { return fault == Fault::none; }
  double gravity() const { return !falls ? 0 : hangs ? kGravity : kSlowGravity; }

  Dice dice;
  World<S> world;
  std::vector<BodyId> bodies;
  std::vector<JointId> joints;
  bool hangs = false, falls = false;
  double reach = 0;  // [m] sum of all ways from body to body
  Fault fault = Fault::none;

 private:
  Settings<S> settings_of(SolverName solver) {
    constexpr int kSubsteps[] = {4, 8, 16};
    const int substeps = kSubsteps[dice.below(3)];
    Settings<S> s = settings<S>(0, 60, substeps);
    s.solver = solver;
    s.allow_sleep = false;
    return s;
  }
  /// Adds a body off one before it, or off the origin, where the world holds the first.
  void add_body(double speed) {
    const std::uint32_t count = static_cast<std::uint32_t>(bodies.size());
    parents_.push_back(count == 0 ? 0 : dice.below(count));
    const D3 from = count == 0 ? D3{0, 0, 0} : real(world.center_of_mass(bodies[parents_.back()]));
    const double x = dice.magnitude(0.1, 0.5), y = dice.magnitude(0.1, 0.5), z = dice.magnitude(0.1, 0.5);
    const bool box = dice.one_in(2);
    BodyDefinition<S> d = moving<S>(box ? add_box(world, x, y, z) : add_ball(world, x), from);
    const double way = dice.magnitude(0.2, 2);
    d.position = vec<S>(from + dice.arrow_of(way));
    d.orientation = dice.orientation<S>();
    d.mass = num<S>(dice.magnitude(1, 100));
    d.velocity = vec<S>(dice.arrow(0, speed));
    d.angular_velocity = vec<S>(dice.arrow(0, 3 * speed));
    d.collide = d.allow_sleep = false;
    reach += way;
    bodies.push_back(world.create(d));
    if (!bodies.back()) fault = world.fault().fault;
  }
  /// The type of a joint: one that stops nothing in gravity would let its body fall for half a kilometre beside the
  /// world that holds it.
  JointType kind_of(std::uint32_t drawn) const {
    const JointType type = drawn < kJointTypes ? static_cast<JointType>(drawn) : JointType::six_axis;
    const bool endless = type == JointType::planar || type == JointType::angular;
    return endless && hangs && falls ? JointType::six_axis : type;
  }
  void join(std::uint32_t i, std::uint32_t drawn) {
    const BodyId a = i == 0 ? BodyId{} : bodies[parents_[i]], b = bodies[i];
    const JointType type = kind_of(drawn);
    const D3 start = a ? real(world.center_of_mass(a)) : D3{0, 0, 0}, end = real(world.center_of_mass(b));
    const double share = a ? dice.in(0, 1) : 0;
    const Quat<Unit<S>> frame = dice.orientation<S>();
    JointProperties<S> p = world.joint_at(type, a, b, {vec<S>(start + (end - start) * share), frame});
    draw_joint(world, dice, Drive::motors, p);
    strengthen(p, b, length(end - start));
    if (measure_of(type) == JointMeasure::length && type != JointType::distance) p.flags |= joint_flag::kLimit;
    const JointId joint = world.create(p);
    if (!joint) {
      fault = world.fault().fault;
      return;
    }
    joints.push_back(joint);
    if (type == JointType::six_axis) add_drives(joint, b, length(end - start));
  }
  /// draw_joint() is for bodies of a kilogram: motors that lift a quarter to four times the weight of theirs.
  void strengthen(JointProperties<S>& p, BodyId b, double arm) {
    const double lever = measure_of(p.type) == JointMeasure::angle ? arm : 1;
    p.max_force = num<S>(10 * to_double(world.mass(b)) * lever * dice.magnitude(0.25, 4));
  }

  static bool locked(const JointProperties<S>& p, JointAxis axis) { return (p.flags & lock_of(axis)) != 0; }
  /// Adds drives to every axis that the joint leaves. Lengths always have limits. Swings have both, soft ones and
  /// springs too, or neither: beyond 120 degrees they let go, and a soft limit that one swing alone comes back to, a
  /// radian beyond it, pushes with energy that it never took. In a cone both are alike: off an ellipse's axes their
  /// rows are of no one angle.
  void add_drives(JointId joint, BodyId b, double arm) {
    const JointProperties<S> p = *world.joint(joint);
    const bool cone = (p.flags & joint_flag::kCone) != 0;
    const bool bounded = cone || dice.one_in(2);
    AxisDrive<S> swing;
    for (std::uint32_t i = 0; i < kJointAxes; ++i) {
      const JointAxis axis = static_cast<JointAxis>(i);
      const bool way = is_length(axis), swings = axis == JointAxis::swing_x || axis == JointAxis::swing_y;
      AxisDrive<S> d = draw_drive(axis, b, arm, way || (swings ? bounded : !dice.one_in(3)));
      d.joint = joint;
      if (swings && !bounded) d.spring_frequency = S(0);
      if (swings && cone) {
        d.lower = -d.upper;
        d.motor_speed = d.spring_target = S(0);
        if (axis == JointAxis::swing_x) swing = d;
        else d = alike(swing, d);
      }
      if (locked(p, axis) || (dice.one_in(4) && !way && !(swings && bounded))) continue;
      if (!world.add(d)) fault = world.fault().fault;
    }
  }
  static AxisDrive<S> alike(AxisDrive<S> first, const AxisDrive<S>& second) {
    first.axis = second.axis;
    first.lower = second.lower;
    first.upper = second.upper;
    return first;
  }
  AxisDrive<S> draw_drive(JointAxis axis, BodyId b, double arm, bool limited) {
    AxisDrive<S> d;
    const double mass = to_double(world.mass(b)), load = 10 * mass * (is_length(axis) ? 1 : arm);
    d.axis = axis;
    d.limited = limited;
    d.lower = num<S>(-dice.in(0.05, 1.5));
    d.upper = num<S>(dice.in(0.05, 1.5));
    d.motor = dice.one_in(3);
    d.motor_speed = num<S>(dice.one_in(2) ? 0 : dice.in(-3, 3));
    if (d.motor || dice.one_in(2)) d.max_force = num<S>(load * dice.magnitude(0.25, 4));
    const bool yields = dice.one_in(3), sprung = dice.one_in(2), made_for = dice.one_in(2);
    // [1] The factor by which a spring is made for more than its own body: it swings by the root of that faster.
    const double heavier = dice.magnitude(0.125, 16);
    const double target = dice.in(-0.5, 0.5);
    if (sprung) {
      d.spring_frequency = num<S>(dice.magnitude(0.5, 6));
      d.spring_damping = num<S>(dice.in(0, 1));
      d.spring_target = num<S>(made_for ? target / std::sqrt(std::max(heavier, 1.0)) : target);
    }
    if (made_for) d.spring_mass = num<S>(heavier * mass * (is_length(axis) ? 1 : 0.1 + arm * arm));
    if (yields) {
      d.limit_frequency = num<S>(dice.magnitude(2, 60));
      d.limit_damping = num<S>(dice.in(0, 2));
    }
    return d;
  }

  std::vector<std::uint32_t> parents_;  // of each body: the one that it hangs on
};

}  // namespace isostep::test
