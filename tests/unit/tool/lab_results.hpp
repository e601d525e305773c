// Results of the laboratory made by hand, for its tests.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tool/lab/result.hpp"

namespace isostep::tool::lab {

inline LabPoint point(const std::string& scalar, const std::string& solver, int substeps) {
  return {"S1", kOwnEngine, scalar, solver, "rigid", 60, substeps};
}
inline LabResult result(const std::string& scalar, const std::string& solver, int substeps, double ms,
                        double penetration, double joint = 0) {
  LabResult r;
  r.point = point(scalar, solver, substeps);
  r.ms = r.ms_mean = ms;
  r.frames = 600;
  r.penetration = penetration;
  r.joint_error = joint;
  return r;
}

}  // namespace isostep::tool::lab
