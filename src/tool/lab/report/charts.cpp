// Tables for gnuplot.
// SPDX-License-Identifier: MIT
#include "charts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace isostep::tool::lab {
namespace {

/// The least error of a chart, in a view's unit. The axis is logarithmic, and less than that is nothing in any scene.
constexpr double kLeastError = 1e-6;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// The fields of every line but the head, where all lines have `width` of them.
std::vector<std::vector<std::string>> lines_of(const std::string& tsv, std::size_t width) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream text(tsv);
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::vector<std::string> fields;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, '\t');) fields.push_back(field);
    if (fields.size() != width) return {};
    lines.push_back(std::move(fields));
  }
  return lines;
}

}  // namespace

std::string accuracy_tsv(const std::vector<LabResult>& results) {
  std::string text = "scene\ttitle\tunit\tengine\tscalar\tsolver\tsubsteps\tms\terror\tlost\n";
  for (const SceneView& view : scene_views()) {
    for (const LabResult& result : results) {
      const LabPoint& point = result.point;
      if (point.scene != view.scene || point.model != "rigid" || result.state != kDone || !(result.ms > 0)) continue;
      const std::string scalar = point.scalar.empty() ? "-" : point.scalar;
      const std::string solver = point.solver.empty() ? "-" : point.solver;
      text += point.scene + "\t" + view.title + "\t" + view.unit + "\t" + point.engine + "\t" + scalar + "\t" + solver +
              "\t" + std::to_string(point.substeps) + "\t" + number(result.ms) + "\t" +
              number(std::max(kLeastError, error_of(result, view))) + "\t" + (is_lost(result) ? "1" : "0") + "\n";
    }
  }
  return text;
}

std::string growth_tsv(const std::vector<GrowthSample>& samples) {
  std::string text = "scene\tscalar\ttime\tdistance\n";
  for (const GrowthSample& s : samples) {
    text += s.scene + "\t" + s.scalar + "\t" + number(s.time) + "\t" + number(s.distance) + "\n";
  }
  return text;
}
std::string stages_tsv(const std::vector<StageCost>& costs) {
  std::string text = "scene\tscalar\tstage\tus\n";
  for (const StageCost& c : costs) text += c.scene + "\t" + c.scalar + "\t" + c.stage + "\t" + number(c.us) + "\n";
  return text;
}

std::vector<StageCost> stages_of(const std::string& tsv) {
  std::vector<StageCost> costs;
  for (const auto& f : lines_of(tsv, 4)) costs.push_back({f[0], f[1], f[2], std::strtod(f[3].c_str(), nullptr)});
  return costs;
}

}  // namespace isostep::tool::lab
