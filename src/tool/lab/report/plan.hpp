// The plan of a report: the scenes and trials, over what they run, and how its charts show a scene.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenes/bars.hpp"
#include "tool/lab/result.hpp"

namespace isostep::tool::lab {

/// A benchmark scene in a chart: the one error it is about.
struct SceneView {
  const char* scene;
  const char* title;
  scenes::Measure error;
  double scale;  // from the measure's unit to that of `unit`
  const char* unit;
  bool large;  // many steps of it take long
};
/// S1 to S9, in their order.
std::span<const SceneView> scene_views();
/// Returns null for what is none of them.
const SceneView* find_view(const std::string& scene);

/// The value of a measure in a run of the laboratory; nothing of those that it does not take.
std::optional<double> value_of(const LabResult& result, scenes::Measure measure);
/// The error as the chart shows it, in the view's unit.
double error_of(const LabResult& result, const SceneView& view);
/// The scene fell, fell apart, lost a body, or had numbers mended.
bool is_lost(const LabResult& result);
scenes::Reach reach_of(const LabResult& result);

/// The effort with which a trial is tried.
struct Effort {
  int rate;  // [1] times the scene's own steps a second
  int substeps;
};

struct Plan {
  std::vector<std::string> scenes, trials;
  std::vector<int> small_substeps, large_substeps;  // of scenes
  std::vector<Effort> trial_efforts;                // ascending: more only where less did not survive
  std::vector<std::string> scalars, solvers;
};
Plan whole_plan();
/// The plan that takes under a minute on two cores.
Plan short_plan();

/// The whole grid of every scene.
std::vector<LabPoint> scene_points(const Plan& plan);
/// Those of the trials with the plan's n-th effort, but for methods that `before` says to leave: they survived with
/// less, or are too long, or are refused.
std::vector<LabPoint> trial_points(const Plan& plan, std::size_t n, const std::vector<LabResult>& before);

}  // namespace isostep::tool::lab
