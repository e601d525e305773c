// A world for six-axis joints, its boxes, frames and drives.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "laws/awake.hpp"
#include "laws/exact_rollback.hpp"
#include "random/joint_angles.hpp"

namespace isostep::test {

template <class S> class SixAxis : public ::testing::Test {
 protected:
  static Settings<S> with(SolverName solver, double gravity = 0) { return awake<S>(solver, gravity); }
  static Pose<S> at(D3 place) { return {vec<S>(place), Quat<Unit<S>>::identity()}; }
  static BodyId box(World<S>& w, D3 place, double mass = 1, double x = 0.25, double y = 0.25, double z = 0.25) {
    BodyDefinition<S> d = moving<S>(add_box(w, x, y, z), place);
    d.mass = num<S>(mass);
    return w.create(d);
  }
  static AxisDrive<S> limit(JointAxis axis, double lower, double upper) {
    AxisDrive<S> d;
    d.axis = axis;
    d.limited = true;
    d.lower = num<S>(lower);
    d.upper = num<S>(upper);
    return d;
  }
  static std::string name(SolverName solver) { return kSolverNames[static_cast<int>(solver)]; }
};

}  // namespace isostep::test
