// Sweeps: many runs of scenes over scalars, solvers, rates and models, side by side on all cores, kept as they end.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "result.hpp"
#include "work.hpp"

namespace isostep::tool::lab {

/// The settings to vary; an empty list: all there is.
struct GridOptions {
  std::vector<std::string> scalars;
  std::vector<std::string> solvers;  // of rigid bodies and of particles, by name
  std::vector<std::string> models;   // those that the scene offers
  std::vector<int> substeps;         // 1, 2, 4, 8, 16, 32, and the scene's own
  std::vector<int> hz;               // the scene's own
};
/// The points of one scene, with its own setting in every scalar among them. Throws ToolError 64 for a scene, a name or
/// a model that is not there.
std::vector<LabPoint> grid(const std::string& scene, const GridOptions& options);
/// The scene as it is when nobody asks for anything else: its solver, sub-steps and rate.
LabPoint default_point(const std::string& scene, const std::string& scalar);

struct SweepOptions {
  std::string out = "build/lab";  // directory of results.jsonl; empty: nothing is kept
  int jobs = 0;                   // runs at a time; 0: as many as there are cores
  int frames = -1;                // at the scene's own rate, which other rates match in time; -1: the scene's
  double limit = kStandardLimit;  // work_of a run, beyond which it is left out
  bool fresh = false;             // run again what is already kept
  bool progress = true;           // one line on stderr
};
/// The results in the points' order. What `out` already holds of this version is not run again. Interrupted it throws
/// ToolError 130, and what is done is kept.
std::vector<LabResult> sweep(const std::vector<LabPoint>& points, const SweepOptions& options);

}  // namespace isostep::tool::lab
