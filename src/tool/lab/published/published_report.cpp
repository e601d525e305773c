// The published report: runs, standings, and the three forms in which they are read.
// SPDX-License-Identifier: MIT
#include "published_report.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "isostep/core/scalars.hpp"
#include "isostep/dynamics/settings.hpp"
#include "published_page.hpp"
#include "scenes/trials/scene_numbers.hpp"
#include "standing.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/articulated_run.hpp"
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

/// [1/s] The longest steps alone in a short report, with the shortest where steps are compared.
std::vector<int> rates_of(const scenes::PublishedTest& test, bool is_short, bool full) {
  std::vector<int> rates;
  for (const int hz : test.rates) {
    if (full || hz <= kMillisecond) rates.push_back(hz);
  }
  if (!is_short) return rates;
  if (test.compares_steps) return {rates.front(), rates.back()};
  return {rates.front()};
}

/// [m]
double resolution_of(const std::string& scalar) {
  double resolution = 0;
  with_scalar(scalar, [&](auto tag) { resolution = to_double(isostep::resolution<typename decltype(tag)::Type>()); });
  return resolution;
}

/// The same in joint coordinates.
LabPoint articulated(LabPoint point) {
  point.model = kArticulation;
  point.solver = kArticulatedBody;
  return point;
}

std::vector<LabPoint> points_of(const ReportOptions& options, bool full) {
  std::vector<LabPoint> points;
  for (const scenes::PublishedTest& test : scenes::published_tests()) {
    const scenes::Scene scene = test.trial.make();
    if (options.is_short && scenes::duration_of(scene) > kMinute) continue;
    const bool is_articulation = refusal_of_articulation(scene).empty();
    LabPoint point = default_point(test.trial.name, "");
    for (const int hz : rates_of(test, options.is_short, full)) {
      point.hz = hz;
      for (const std::string& scalar : scalar_names()) {
        if (resolution_of(scalar) > test.starts_differ_by && test.starts_differ_by > 0) continue;
        point.scalar = scalar;
        for (const int substeps : substeps_at(hz)) {
          point.substeps = substeps;
          points.push_back(point);
          if (is_articulation) points.push_back(articulated(point));
        }
      }
    }
  }
  return points;
}

/// The pictures and the table that people read in the repository, from those of the report.
void renew_repository(const std::string& out, const std::string& summary) {
  const fs::path bench = fs::path(ISOSTEP_CHART_DIR).parent_path();
  if (!fs::is_directory(bench / "charts") || !fs::is_directory(bench / "results")) return;
  for (const char* name : {"published", "published_steps"}) {
    rasterise(out + "/" + name + ".svg", (bench / "charts" / name).string() + ".png");
  }
  write_file((bench / "results/published.md").string(), summary);
  std::cerr << "lab: renewed published.md and the charts of published tests in " << bench.string() << "\n";
}

}  // namespace

int write_published_report(const ReportOptions& options, bool full) {
  open_report(options, "published.html");
  const auto in = [&](const char* name) { return options.out + "/" + name; };
  const std::vector<LabPoint> points = points_of(options, full);
  std::cerr << "lab, part 1 of 2: " << points.size() << " runs of published tests\n";
  std::vector<LabResult> results = sweep(points, sweep_options_of(options));
  std::cerr << "lab, part 2 of 2: other engines\n";
  const std::string words = full ? "--published" : "--published --most-hz " + std::to_string(kMillisecond);
  const auto counts = [](const std::string& scene) { return scenes::find_published_test(scene) != nullptr; };
  const Peers peers = peers_of(options, {"published_peers.jsonl", words, counts});
  results.insert(results.end(), peers.results.begin(), peers.results.end());

  const std::span<const scenes::PublishedTest> first = tests_of_first_source(), all = scenes::published_tests();
  write_file(in("published.svg"), published_svg(first, results));
  write_file(in("published_steps.svg"), published_svg(all.subspan(first.size()), results));
  write_file(in("published.html"), published_page(results));
  const std::string summary = published_summary(results) + "\n" + stamp();
  write_file(in("published.md"), summary);
  const bool is_whole = !options.is_short && std::none_of(results.begin(), results.end(), [](const LabResult& r) {
    return r.point.engine == kOwnEngine && r.state == kLeftOut;
  });
  if (!options.peers.empty() && is_whole) renew_repository(options.out, summary);
  std::cout << in("published.html") << "\n";
  return status_of(peers, options);
}

}  // namespace isostep::tool::lab
