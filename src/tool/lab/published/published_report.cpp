// The published report: runs, standings, and the three forms in which they are read.
// SPDX-License-Identifier: MIT
#include "published_report.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>

#include "isostep/dynamics/settings.hpp"
#include "published_page.hpp"
#include "scenes/trials/scene_numbers.hpp"
#include "standing.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/gnuplot.hpp"
#include "tool/lab/report/peer_program.hpp"
#include "tool/lab/sweep.hpp"

namespace isostep::tool::lab {
namespace {

namespace fs = std::filesystem;

constexpr double kMinute = 60;          // [s]
constexpr int kMillisecond = 1000;      // [1/s] more steps a second only where all are asked for
constexpr int kSubsteps[] = {1, 4, 8};  // the default's, half of them, and what the most steps a second leave room for

/// The sub-steps with which a rate is run: 4 and 8, or 1 where those are more than a world takes.
std::vector<int> substeps_at(int hz) {
  std::vector<int> fitting;
  for (const int substeps : kSubsteps) {
    if (hz * substeps <= kMaxRate) fitting.push_back(substeps);
  }
  if (fitting.size() > 1) fitting.erase(fitting.begin());
  return fitting;
}

std::vector<LabPoint> points_of(const PublishedOptions& options) {
  std::vector<LabPoint> points;
  for (const scenes::PublishedTest& test : scenes::published_tests()) {
    if (options.is_short && scenes::duration_of(test.trial.make()) > kMinute) continue;
    for (const int hz : test.rates.first(options.is_short ? 1 : test.rates.size())) {
      if (!options.full && hz > kMillisecond) continue;
      for (const std::string& scalar : scalar_names()) {
        for (const int substeps : substeps_at(hz)) {
          points.push_back(
              {test.trial.name, kOwnEngine, scalar, default_point(test.trial.name, "").solver, "rigid", hz, substeps});
        }
      }
    }
  }
  return points;
}

std::vector<LabResult> peers_of(const PublishedOptions& options) {
  const std::string kept = options.out + "/published_peers.jsonl";
  if (!options.peers.empty()) {
    std::string words = "--published";
    if (!options.full) words += " --most-hz " + std::to_string(kMillisecond);
    run_peer_program({options.peers, words, kept, options.jobs, options.limit});
  }
  std::vector<LabResult> peers;
  for (LabRecord& record : read_records(kept)) {
    if (scenes::find_published_test(record.result.point.scene) != nullptr) peers.push_back(std::move(record.result));
  }
  std::stable_sort(peers.begin(), peers.end(),
                   [](const LabResult& a, const LabResult& b) { return name_of(a.point) < name_of(b.point); });
  return peers;
}

/// The picture and the table that people read in the repository.
void renew_repository(const std::string& svg, const std::string& summary) {
  const fs::path bench = fs::path(ISOSTEP_CHART_DIR).parent_path();
  if (!fs::is_directory(bench / "charts") || !fs::is_directory(bench / "results")) return;
  rasterise(svg, (bench / "charts/published.png").string());
  write_file((bench / "results/published.md").string(), summary);
  std::cerr << "lab: renewed charts/published.png and results/published.md in " << bench.string() << "\n";
}

}  // namespace

int write_published_report(const PublishedOptions& options) {
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) throw ToolError(exit_status::kOutput, options.out + ": " + error.message());
  const auto in = [&](const char* name) { return options.out + "/" + name; };
  expect_writable(in("published.html"));
  const std::vector<LabPoint> points = points_of(options);
  std::cerr << "lab: " << points.size() << " runs of published tests\n";
  SweepOptions sweep_options;
  sweep_options.out = options.out;
  sweep_options.jobs = options.jobs;
  sweep_options.limit = options.limit;
  sweep_options.fresh = options.fresh;
  std::vector<LabResult> results = sweep(points, sweep_options);
  std::vector<LabResult> peers = peers_of(options);
  results.insert(results.end(), std::make_move_iterator(peers.begin()), std::make_move_iterator(peers.end()));

  write_file(in("published.svg"), published_svg(results));
  write_file(in("published.html"), published_page(results));
  const std::string summary = published_summary(results);
  write_file(in("published.md"), summary);
  if (!options.peers.empty()) renew_repository(in("published.svg"), summary);
  std::cout << in("published.html") << "\n";
  return exit_status::kOk;
}

}  // namespace isostep::tool::lab
