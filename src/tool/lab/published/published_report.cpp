// The published report: runs, standings, and the three forms in which they are read.
// SPDX-License-Identifier: MIT
#include "published_report.hpp"

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

namespace isostep::tool::lab {
namespace {

namespace fs = std::filesystem;

constexpr double kMinute = 60;      // [s]
constexpr int kMillisecond = 1000;  // [1/s] more steps a second only where all are asked for

/// The default's sub-steps and half of them; 1 where those are more than a world takes.
std::vector<int> substeps_at(int hz) {
  std::vector<int> fitting;
  for (const int substeps : {4, 8}) {
    if (hz * substeps <= kMaxRate) fitting.push_back(substeps);
  }
  return fitting.empty() ? std::vector<int>{1} : fitting;
}

std::vector<LabPoint> points_of(const ReportOptions& options, bool full) {
  std::vector<LabPoint> points;
  for (const scenes::PublishedTest& test : scenes::published_tests()) {
    if (options.is_short && scenes::duration_of(test.trial.make()) > kMinute) continue;
    LabPoint point = default_point(test.trial.name, "");
    for (const int hz : test.rates.first(options.is_short ? 1 : test.rates.size())) {
      if (!full && hz > kMillisecond) continue;
      point.hz = hz;
      for (const std::string& scalar : scalar_names()) {
        point.scalar = scalar;
        for (const int substeps : substeps_at(hz)) {
          point.substeps = substeps;
          points.push_back(point);
        }
      }
    }
  }
  return points;
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

int write_published_report(const ReportOptions& options, bool full) {
  open_report(options, "published.html");
  const auto in = [&](const char* name) { return options.out + "/" + name; };
  const std::vector<LabPoint> points = points_of(options, full);
  std::cerr << "lab: " << points.size() << " runs of published tests\n";
  std::vector<LabResult> results = sweep(points, sweep_options_of(options));
  const std::string words = full ? "--published" : "--published --most-hz " + std::to_string(kMillisecond);
  const auto counts = [](const std::string& scene) { return scenes::find_published_test(scene) != nullptr; };
  std::vector<LabResult> peers = peers_of(options, {"published_peers.jsonl", words, counts});
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
