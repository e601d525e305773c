// The work of a run.
// SPDX-License-Identifier: MIT
#include "work.hpp"

#include <cstdio>

#include "isostep/dynamics/solver_name.hpp"

namespace isostep::tool::lab {
namespace {

constexpr double kStep = 4;  // [sub-steps] pairs, islands and all that a step does once

/// [1] The time of a body's sub-step beside that of soft_step, in crowds.
double weight_of(const std::string& solver) {
  const auto name = solver_named(solver);
  if (!name) return 1;
  return *name == SolverName::worst_first ? 16 : solves_islands(*name) ? 32 : 1;
}

}  // namespace

double work_of(const Subject& subject, const LabPoint& point, int frames) {
  const double parts = static_cast<double>(subject.scene.bodies.size() + subject.scene.joints.size());
  return weight_of(point.solver) * parts * frames * (point.substeps + kStep);
}

std::string too_long(double work) {
  char text[64];
  std::snprintf(text, sizeof text, "too long: %.3g million body sub-steps", 1e-6 * work);
  return text;
}

}  // namespace isostep::tool::lab
