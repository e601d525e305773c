// The report's scenes, and the points that are run.
// SPDX-License-Identifier: MIT
#include "plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/named.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/rigid_run.hpp"

namespace isostep::tool::lab {
namespace {

using scenes::Measure;

constexpr SceneView kViews[] = {
    {"S1", "20 boxes stacked: sag", Measure::top, 1e3, "mm", false},
    {"S1x10", "10 boxes stacked: sag", Measure::top, 1e3, "mm", false},
    {"S2", "wall of 210: worst overlap", Measure::penetration, 1e3, "mm", false},
    {"S3", "pyramid of 1240: worst overlap", Measure::penetration, 1e3, "mm", true},
    {"S4", "pile of 1000: mean overlap", Measure::penetration_mean, 1e3, "mm", true},
    {"S4s", "pile of 200: mean overlap", Measure::penetration_mean, 1e3, "mm", false},
    {"S5", "4000 spheres: mean overlap", Measure::penetration_mean, 1e3, "mm", true},
    {"S6", "swinging chain with 100 kg: worst joint", Measure::joint_error, 1e3, "mm", false},
    {"S6v", "hanging chain with 100 kg: stretch", Measure::stretch, 1e3, "mm", false},
    {"S7", "50 ragdolls: worst joint", Measure::joint_error, 1e3, "mm", true},
    {"S8", "pyramid that may sleep: worst overlap", Measure::penetration, 1e3, "mm", true},
    {"S9", "drum of 600: worst overlap", Measure::penetration, 1e3, "mm", true},
};

/// Steps times bodies: what a run costs, roughly.
double size_of(const scenes::Trial& trial) {
  const scenes::Scene scene = trial.make();
  return static_cast<double>(scene.frames) * static_cast<double>(scene.bodies.size() + scene.joints.size());
}

LabPoint point_of(const std::string& scene, const std::string& scalar, const std::string& solver, int substeps) {
  LabPoint point;
  point.scene = scene;
  point.scalar = scalar;
  point.solver = solver;
  const std::optional<scenes::Scene> made = scenes::find_scene(scene);
  if (made) point.hz = made->hz;
  point.substeps = substeps;
  return point;
}

}  // namespace

std::span<const SceneView> scene_views() { return kViews; }

const SceneView* find_view(const std::string& scene) {
  const auto found =
      std::find_if(std::begin(kViews), std::end(kViews), [&](const SceneView& v) { return scene == v.scene; });
  return found == std::end(kViews) ? nullptr : found;
}

std::optional<double> value_of(const LabResult& result, Measure measure) {
  switch (measure) {
    case Measure::penetration: return result.penetration;
    case Measure::penetration_mean: return result.penetration_mean;
    case Measure::unrest: return result.unrest;
    case Measure::joint_error: return result.joint_error;
    case Measure::energy_loss: return result.energy_loss;
    case Measure::energy_gain: return result.energy_gain;
    default: break;
  }
  if (measure == scenes::own_measure(result.point.scene)) return result.figure;
  return std::nullopt;
}

double error_of(const LabResult& result, const SceneView& view) {
  return view.scale * std::abs(value_of(result, view.error).value_or(0));
}

/// A chain whose links are further apart than one is long is no chain.
bool is_lost(const LabResult& result) {
  constexpr double kLink = 0.5;  // [m]
  if (result.state != kDone || result.faults != 0 || !result.stood || !std::isfinite(result.unrest)) return true;
  const std::string& scene = result.point.scene;
  const SceneView* view = find_view(scene);
  if (view == nullptr) return result.judged && !result.survived;
  if (scene.rfind("S6", 0) == 0) return !(result.joint_error <= kLink);
  return scenes::own_measure(scene) == Measure::outside && result.figure != 0;
}

scenes::Reach reach_of(const LabResult& result) {
  const scenes::Reach reach = scenes::reach_of(scenes::bars_of(result.point.scene, result.point.scalar == "q16.16"),
                                               [&](Measure measure) { return value_of(result, measure); });
  return reach != scenes::Reach::no_bar && is_lost(result) ? scenes::Reach::misses : reach;
}

Plan whole_plan() {
  Plan plan = {{},
               {},
               {2, 4, 8, 16, 32},
               {2, 4, 8, 16},
               {{1, 4}, {1, 8}, {1, 16}, {1, 32}, {4, 8}, {8, 8}},
               scalar_names(),
               rigid_solvers()};
  for (const SceneView& view : kViews) plan.scenes.push_back(view.scene);
  for (const scenes::Trial& trial : scenes::trials()) plan.trials.push_back(trial.name);
  return plan;
}

Plan short_plan() {
  constexpr std::size_t kTrials = 16;
  Plan plan = {{"S1x10", "S6v"}, {}, {4, 8}, {}, {{1, 8}}, scalar_names(), rigid_solvers()};
  std::vector<std::pair<double, std::string>> by_size;
  for (const scenes::Trial& trial : scenes::trials()) by_size.push_back({size_of(trial), trial.name});
  std::stable_sort(by_size.begin(), by_size.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < std::min(kTrials, by_size.size()); ++i) plan.trials.push_back(by_size[i].second);
  return plan;
}

std::vector<LabPoint> scene_points(const Plan& plan) {
  std::vector<LabPoint> points;
  for (const std::string& scene : plan.scenes) {
    const SceneView* view = find_view(scene);
    const bool large = view != nullptr && view->large;
    for (const std::string& scalar : plan.scalars) {
      for (const std::string& solver : plan.solvers) {
        for (const int substeps : large ? plan.large_substeps : plan.small_substeps) {
          points.push_back(point_of(scene, scalar, solver, substeps));
        }
      }
    }
  }
  return points;
}

std::vector<LabPoint> trial_points(const Plan& plan, std::size_t n, const std::vector<LabResult>& before) {
  std::map<std::string, bool> settled;
  const auto key = [](const LabPoint& point) { return point.scene + " " + point.scalar + " " + point.solver; };
  for (const LabResult& result : before) {
    const bool survived = result.state == kDone && result.survived;
    settled[key(result.point)] |= survived || result.state == kLeftOut || result.state == kRefused;
  }
  std::vector<LabPoint> points;
  for (const std::string& trial : plan.trials) {
    for (const std::string& scalar : plan.scalars) {
      for (const std::string& solver : plan.solvers) {
        LabPoint point = point_of(trial, scalar, solver, plan.trial_efforts[n].substeps);
        point.hz *= plan.trial_efforts[n].rate;
        if (!settled[key(point)]) points.push_back(point);
      }
    }
  }
  return points;
}

}  // namespace isostep::tool::lab
