// isostep lab --published: published comparisons of engines repeated, beside the figures of their authors.
// SPDX-License-Identifier: MIT
#pragma once

#include "tool/lab/report/report.hpp"

namespace isostep::tool::lab {

/// published.html, its pictures and its table. With peers, where the sources still are, a report that is not short and
/// leaves out no run of ours renews bench/charts/published.png (of the first publication), published_steps.png (of the
/// others) and bench/results/published.md too. A short report has the longest steps of tests that end within a minute
/// of simulation, and the shortest where those compare. `full`: steps below a millisecond too. An exit status; throws
/// ToolError.
int write_published_report(const ReportOptions& options, bool full);

}  // namespace isostep::tool::lab
