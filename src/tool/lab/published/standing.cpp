// Standings: figures of three sources in one list.
// SPDX-License-Identifier: MIT
#include "standing.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/dynamics/settings.hpp"
#include "scenes/published/published.hpp"
#include "tool/lab/report/html.hpp"

namespace isostep::tool::lab {
namespace {

Standing standing_of(const LabResult& result) {
  Standing s;
  const LabPoint& p = result.point;
  s.ours = p.engine == kOwnEngine;
  s.engine =
      s.ours ? "isostep " + p.scalar + ", " + p.solver + ", " + std::to_string(p.substeps) + " sub-steps" : p.engine;
  s.scalar = p.scalar;
  s.state = result.state;
  const scenes::Scene plain;
  s.is_default = s.ours && p.substeps == plain.substeps && p.solver == kSolverNames[static_cast<int>(plain.solver)];
  s.figure = result.figure;
  s.seconds = result.ms_mean * 60 / 1000;
  s.ended = result.state == kDone && result.faults == 0 && std::isfinite(result.figure);
  if (s.ended) return s;
  s.reason = result.state != kDone ? result.state : "its numbers are none";
  if (!result.reason.empty()) s.reason += ": " + result.reason;
  return s;
}

}  // namespace

std::vector<Standing> standings_of(const scenes::PublishedTest& test, int hz, const std::vector<LabResult>& results) {
  std::vector<Standing> all;
  for (const LabResult& result : results) {
    if (result.point.scene == test.trial.name && result.point.hz == hz) all.push_back(standing_of(result));
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
