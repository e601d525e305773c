// isostep lab --all: every scene and trial swept, measured beside the peers, and written as one page.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tool/lab/sweep.hpp"

namespace isostep::tool::lab {

/// lab --all and lab --published share these.
struct ReportOptions {
  std::string out = "build/lab";  // directory; what it holds of this version is not run again
  bool is_short = false;          // a set for CI
  bool fresh = false;             // run again what is already kept
  int jobs = 0;                   // runs at a time; 0: as many as there are cores
  double limit = kStandardLimit;  // of a run, see lab/work.hpp
  std::string peers;              // program that runs the peers; empty: what their file already holds
};
/// The runs of a report, kept in its directory.
SweepOptions sweep_options_of(const ReportOptions& options);
/// Throws ToolError 74 where `page` cannot be written into the report's directory, which it makes, and 66 where there
/// is no program of that name for the peers.
void open_report(const ReportOptions& options, const std::string& page);

/// "2026-12-02, isostep 0.1.0, behaviour 99bc2b8bef12ab59.": the last line of a table that people keep.
std::string stamp();

/// report.html, its pictures and tables; a whole run renews bench/charts/lab_*.png and bench/results/lab.md too, where
/// the sources still are. An exit status; throws ToolError.
int write_lab_report(const ReportOptions& options);

}  // namespace isostep::tool::lab
