// The program that runs other engines, as the laboratory calls it.
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report.hpp"
#include "tool/lab/result.hpp"

namespace isostep::tool::lab {

/// The runs of peers that a report asks for.
struct PeerRuns {
  std::string file;                                      // in the report's directory, to which lines are added
  std::string words;                                     // options, as the shell takes them
  std::function<bool(const std::string& scene)> counts;  // the file may hold runs of other scenes
};
/// Throws ToolError 66 where the report has a program that is none.
void expect_peers(const ReportOptions& options);

struct Peers {
  std::vector<LabResult> results;
  bool failed = false;  // the program; what it left counts
};
/// The results in the file, by name, after the report's program, if it has one, has run what the file lacks.
Peers peers_of(const ReportOptions& options, const PeerRuns& runs);
/// The report's exit status, with a line on stderr where the program failed.
int status_of(const Peers& peers, const ReportOptions& options);

}  // namespace isostep::tool::lab
