// The commands lab and lab springs: the options of each; each returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tool/lab/work.hpp"

namespace isostep::tool {

struct LabOptions {
  std::string scene;
  std::string tolerance;
  std::vector<std::string> scalars, solvers, models;  // empty: all
  std::vector<int> substeps, hz;                      // empty: see lab/sweep.hpp
  int frames = -1;                                    // -1: the scene's
  double limit = 1e-6 * lab::kStandardLimit;          // [million] body sub-steps of a run, see lab/work.hpp
  int jobs = 0;                                       // 0: as many as cores
  bool fresh = false;
  std::string out = "build/lab";  // directory, or empty
  std::string csv;                // file, or empty
  bool json = false;
  // Instead of one scene the report, see lab/report/report.hpp, or that of lab/published.
  bool all = false, is_short = false, published = false, full = false;
  std::string peers;  // program that runs the peers, or empty
};
int command_lab(const LabOptions& options);

struct LabSpringsOptions {
  bool quick = false;  // fewer stiffnesses, steps timed once
  bool json = false;
  bool quiet = false;  // no table
  std::string out;     // directory for the table and its chart, or empty
};
int command_lab_springs(const LabSpringsOptions& options);

}  // namespace isostep::tool
