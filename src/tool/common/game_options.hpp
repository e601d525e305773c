// Options of a run in place of the scene's own rate and methods.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace isostep::tool {

struct GameOptions {
  int hz = -1, substeps = -1;                            // -1: the scene's
  std::string solver, projection, integrator, stepping;  // names; empty: the scene's
};

}  // namespace isostep::tool
