// isostep lab --all: every scene and trial swept, measured beside the peers, and written as one page.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace isostep::tool::lab {

struct ReportOptions {
  std::string out = "build/lab";  // directory; what it holds of this version is not run again
  bool is_short = false;          // a set for CI
  bool fresh = false;             // run again what is already kept
  int jobs = 0;                   // runs at a time; 0: as many as there are cores
  double limit = 8;               // [s] CPU time of a run
  std::string peers;              // program that runs the peers; empty: what peers.jsonl already holds
};

/// report.html, its pictures and tables; a whole run renews bench/charts/lab_*.png and bench/results/lab.md too, where
/// the sources still are. An exit status; throws ToolError.
int write_lab_report(const ReportOptions& options);

}  // namespace isostep::tool::lab
