// What laws of single solvers share: settings in which nothing falls asleep, and the name of a case.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "unit/world/worlds.hpp"

namespace isostep::test {

/// `gravity` [m/s^2] along y.
template <class S> Settings<S> awake(SolverName solver, double gravity = -10, int substeps = 8) {
  Settings<S> s = settings<S>(gravity, 60, substeps);
  s.solver = solver;
  s.allow_sleep = false;
  return s;
}

inline std::string named(SolverName solver, const std::string& which) {
  return kSolverNames[static_cast<int>(solver)] + (", " + which);
}

}  // namespace isostep::test
