// A small scene that asks a solver for everything it has: for the tests that every solver must pass.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "unit/world/worlds.hpp"

namespace isostep::test {

template <class S> Settings<S> solver_settings(SolverName solver) {
  Settings<S> s = settings<S>(-10, 60, 4);
  s.solver = solver;
  return s;
}

/// Stacks, balls that bounce and roll, a belt, a paddle, and a chain of every kind of joint. Sleepless, so that every
/// step has work.
template <class S> class SolverScene {
 public:
  explicit SolverScene(World<S>& w) {
    add_ground(w);
    const ShapeId box = add_box(w, 0.5, 0.25, 0.375), ball = add_ball(w, 0.25), plank = add_box(w, 2, 0.25, 1);
    BodyDefinition<S> d = still<S>(plank, {6, 0.25, 0});
    d.material.surface_velocity = vec<S>(1, 0, 0.25);
    w.create(d);
    d = still<S>(plank, {0, 1.25, -6});
    d.type = BodyType::kinematic;
    d.angular_velocity = vec<S>(0, 1.5, 0);
    w.create(d);
    for (int i = 0; i < 9; ++i) add(w, moving<S>(box, {2.0 * (i / 3) - 2, 0.25 + 0.5 * (i % 3), 0}));
    add(w, moving<S>(box, {5, 0.75, 0}));
    for (int i = 0; i < 4; ++i) {
      d = moving<S>(ball, {0.75 * i - 1, 2.25, -6}, {0.5, -2, 0.25});
      d.material.restitution = num<S>(0.5);
      if (i % 2 == 0) d.material.rolling_resistance = num<S>(0.03125);
      add(w, d);
    }
    add_chain(w, ball, box);
  }

  /// Commands of a frame, for a command log to hold.
  void play(World<S>& w, std::uint64_t frame) const {
    const BodyId id = bodies_[frame * 5 % bodies_.size()];
    if (frame % 6 == 0) w.apply_impulse(id, vec<S>(0.25, 0.125, -0.125), vec<S>(0, 0.03125, 0));
    if (frame % 9 == 4) w.apply_force(id, vec<S>(2, 0, 1), vec<S>(0, 0, 0.25));
    w.step();
  }

  const std::vector<BodyId>& bodies() const { return bodies_; }

 private:
  void add(World<S>& w, BodyDefinition<S> d) {
    d.allow_sleep = false;
    bodies_.push_back(w.create(d));
  }
  void add_chain(World<S>& w, ShapeId ball, ShapeId box) {
    const JointType kinds[] = {JointType::ball,     JointType::hinge, JointType::fixed,
                               JointType::distance, JointType::ball,  JointType::hinge};
    BodyId last;
    for (int i = 0; i < 6; ++i) {
      const double y = 5 - 0.75 * i;
      add(w, moving<S>(i % 2 == 0 ? ball : box, {-6, y, 0.125 * i}, {0, 0, 1}));
      JointProperties<S> j =
          w.joint_at(kinds[i], last, bodies_.back(), {vec<S>(-6, y + 0.375, 0.125 * i), Quat<Unit<S>>::identity()});
      if (j.type == JointType::distance) j.upper = num<S>(0.25);
      if (i == 1) {
        j.flags = joint_flag::kMotor | joint_flag::kLimit;
        j.motor_speed = S(1);
        j.max_force = num<S>(0.5);
        j.lower = num<S>(-0.5);
        j.upper = num<S>(0.25);
      }
      if (i == 4) {
        j.flags = joint_flag::kCone;
        j.cone = num<S>(0.25);
      }
      if (!w.create(j)) ADD_FAILURE() << describe(w.fault());
      last = bodies_.back();
    }
  }

  std::vector<BodyId> bodies_;
};

}  // namespace isostep::test
