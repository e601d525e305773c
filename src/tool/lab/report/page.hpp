// The report as one page, and as a short table.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "growth.hpp"
#include "matrix.hpp"
#include "plan.hpp"
#include "stage_costs.hpp"

namespace isostep::tool::lab {

struct ReportData {
  Plan plan;
  std::vector<LabResult> results;  // ours, then the peers'
  Matrix matrix;                   // of the trials
  std::vector<StageCost> stages;
  // Pictures as SVG files; empty: gnuplot was not there.
  std::string accuracy, growth, springs, stage_chart;
  bool is_short = false;
};

/// The cheapest of our results for the scene in that scalar (empty: any) that reaches so far; null: none.
const LabResult* cheapest_that(const std::vector<LabResult>& results, const std::string& scene,
                               const std::string& scalar, scenes::Reach reach);

/// "soft_step, 8 sub-steps", of pgs "pgs, 8 passes"; at another rate than 60 Hz that too.
std::string setting_of(const LabPoint& point);

/// One HTML page that needs nothing else.
std::string page_of(const ReportData& data);
/// Markdown: every trial with what is recommended in double and q32.32, and how the peers fared.
std::string summary_of(const ReportData& data);

}  // namespace isostep::tool::lab
