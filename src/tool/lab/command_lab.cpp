// isostep lab SCENE: which scalar, solver, sub-steps and model are the cheapest that hold a tolerance.
// SPDX-License-Identifier: MIT
#include <iostream>

#include "commands.hpp"
#include "summary.hpp"
#include "sweep.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/published/published_report.hpp"
#include "tool/lab/report/report.hpp"

namespace isostep::tool {

namespace {

lab::ReportOptions report_of(const LabOptions& options, const std::string& word) {
  if (options.out.empty()) throw ToolError(exit_status::kUsage, "lab: " + word + " needs a directory (--out)");
  lab::ReportOptions report;
  report.out = options.out;
  report.is_short = options.is_short;
  report.fresh = options.fresh;
  report.jobs = options.jobs;
  report.limit = 1e6 * options.limit;
  report.peers = options.peers;
  return report;
}
int command_lab_all(const LabOptions& options) { return lab::write_lab_report(report_of(options, "--all")); }
int command_lab_published(const LabOptions& options) {
  return lab::write_published_report(report_of(options, "--published"), options.full);
}

}  // namespace

int command_lab(const LabOptions& options) {
  if (options.published) return command_lab_published(options);
  if (options.all) return command_lab_all(options);
  if (options.scene.empty())
    throw ToolError(exit_status::kUsage, "lab: a scene is missing (isostep scenes lists them; --all: every one)");
  if (options.is_short || !options.peers.empty())
    throw ToolError(exit_status::kUsage, "lab: --short and --peers are for --all and --published, not for a scene");
  const lab::Tolerance tolerance = lab::parse_tolerance(options.tolerance);
  const lab::Subject subject = lab::subject_of(options.scene);
  lab::require_judge(tolerance, subject);
  expect_writable(options.csv);
  lab::SweepOptions sweep;
  sweep.out = options.out;
  sweep.jobs = options.jobs;
  sweep.frames = options.frames;
  sweep.limit = 1e6 * options.limit;
  sweep.fresh = options.fresh;
  const std::vector<lab::LabPoint> points =
      lab::grid(options.scene, {options.scalars, options.solvers, options.models, options.substeps, options.hz});
  const std::vector<lab::LabResult> results = lab::sweep(points, sweep);
  const lab::Summary summary = {subject, results, tolerance, lab::default_point(options.scene, "")};
  std::cout << (options.json ? json_of(summary) : table_of(summary));
  if (!options.csv.empty()) write_file(options.csv, lab::csv_of(results));
  return exit_status::kOk;
}

}  // namespace isostep::tool
