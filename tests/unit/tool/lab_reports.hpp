// Reports of the laboratory on results made by hand, for the tests of its pages.
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lab_results.hpp"
#include "tool/lab/report/page.hpp"

namespace isostep::tool::lab {
namespace lab_reports {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

inline LabResult run(const std::string& scene, const std::string& scalar, const std::string& solver, int substeps,
                     double ms) {
  LabResult r;
  r.point = point(scalar, solver, substeps);
  r.point.scene = scene;
  r.ms = ms;
  r.frames = 600;
  return r;
}
inline LabResult trial(const std::string& scalar, const std::string& solver, int substeps, double ms, double figure,
                       bool survived) {
  LabResult r = run("tall_stack", scalar, solver, substeps, ms);
  r.judged = true;
  r.figure = figure;
  r.survived = survived;
  return r;
}
inline LabResult peer(const std::string& scene, const std::string& engine, double ms) {
  LabResult r = run(scene, "", "", 0, ms);
  r.point.engine = engine;
  return r;
}
inline Matrix small_matrix(const std::vector<LabResult>& results) {
  return matrix_of({"tall_stack"}, {"double", "q32.32"}, {"soft_step", "direct"}, results);
}
inline bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

/// A report of one scene and one trial, with a result that is refused and a peer.
inline ReportData hand_made() {
  ReportData data;
  data.plan = {{"S1x10"}, {"tall_stack"}, {8}, {8}, {{1, 8}}, {"double", "q32.32"}, {"soft_step", "direct"}};
  LabResult wrong = trial("double", "direct", 8, 0.3, 0, false);
  wrong.state = kRefused;
  wrong.reason = "<script>alert('&')</script>";
  data.results = {trial("double", "soft_step", 16, 0.4, 0.1, true), trial("q32.32", "soft_step", 8, 0.9, 0.2, true),
                  wrong, peer("tall_stack", "ode", 0.1), run("S1x10", "double", "soft_step", 8, 0.1)};
  data.matrix = matrix_of(data.plan.trials, data.plan.scalars, data.plan.solvers, data.results);
  data.stages = {{"S3", "double", "prepare", 12.5}};
  data.accuracy = "<svg><g id='p'/></svg>";
  return data;
}

}  // namespace lab_reports
}  // namespace isostep::tool::lab
