// Standings: figures of three sources in one list.
// SPDX-License-Identifier: MIT
#include "standing.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/dynamics/settings.hpp"
#include "scenes/published/published.hpp"
#include "tool/lab/articulated_run.hpp"
#include "tool/lab/report/html.hpp"

namespace isostep::tool::lab {
namespace {

/// "soft_step"; of articulations the model, for they have one method.
const std::string& method_of(const LabPoint& p) { return p.model == kArticulation ? p.model : p.solver; }

Standing standing_of(const LabResult& result, double figure) {
  Standing s;
  const LabPoint& p = result.point;
  const scenes::Scene plain;
  s.ours = p.engine == kOwnEngine;
  s.engine = s.ours ? "isostep " + p.scalar + ", " + method_of(p) + ", " + std::to_string(p.substeps) + " sub-steps"
                    : p.engine;
  s.scalar = p.scalar;
  s.state = result.state;
  s.is_articulation = p.model == kArticulation;
  const bool plain_steps = s.ours && p.substeps == plain.substeps;
  s.is_default =
      plain_steps && method_of(p) == (s.is_articulation ? kArticulation : kSolverNames[static_cast<int>(plain.solver)]);
  s.figure = figure;
  s.seconds = result.ms_mean * 60 / 1000;
  s.ended = result.state == kDone && result.faults == 0 && std::isfinite(figure);
  if (s.ended) return s;
  s.reason = result.state != kDone ? result.state : "its numbers are none";
  if (!result.reason.empty()) s.reason += ": " + result.reason;
  return s;
}

/// [1/s] The rate of the shortest steps in which any engine ran the test.
int shortest_steps(const scenes::PublishedTest& test, const std::vector<LabResult>& results) {
  int most = 0;
  for (const LabResult& result : results) {
    if (result.point.scene == test.trial.name) most = std::max(most, result.point.hz);
  }
  return most;
}
/// [m] The distance from the run of the same setting at another rate.
double distance_from(int hz, const LabResult& of, const std::vector<LabResult>& results) {
  LabPoint same = of.point;
  same.hz = hz;
  const auto found = std::find_if(results.begin(), results.end(), [&](const LabResult& r) { return r.point == same; });
  return found == results.end() ? kUnknown : scenes::distance_of(of.outcome, found->outcome);
}

}  // namespace

std::vector<Standing> standings_of(const scenes::PublishedTest& test, int hz, const std::vector<LabResult>& results) {
  const int shortest = test.compares_steps ? shortest_steps(test, results) : 0;
  if (hz == shortest) return {};
  std::vector<Standing> all;
  for (const LabResult& result : results) {
    if (result.point.scene != test.trial.name || result.point.hz != hz) continue;
    const double figure = test.compares_steps ? distance_from(shortest, result, results) : result.figure;
    all.push_back(standing_of(result, figure));
  }
  for (const scenes::PublishedFigure& figure : test.figures) {
    if (figure.hz != hz) continue;
    Standing s;
    s.engine = std::string(figure.engine) + " (" + std::to_string(test.year) + ")";
    s.published = true;
    s.figure = figure.figure;
    all.push_back(s);
  }
  std::stable_sort(all.begin(), all.end(), [](const Standing& a, const Standing& b) {
    if (a.ended != b.ended) return a.ended;
    return a.ended && a.figure < b.figure;
  });
  return all;
}

int place_of(const std::vector<Standing>& standings, bool (*chosen)(const Standing&)) {
  int place = 0;
  const Standing* last = nullptr;
  for (const Standing& s : standings) {
    if (!s.ended) return 0;
    if (s.ours && !chosen(s)) continue;  // we are one engine
    if (last == nullptr || last->figure < s.figure) ++place;
    last = &s;
    if (chosen(s)) return place;
  }
  return 0;
}

std::string step_text(int hz) { return short_number(1000.0 / hz) + " ms"; }

}  // namespace isostep::tool::lab
