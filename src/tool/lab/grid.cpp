// The points of a sweep.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <set>

#include "isostep/particles/settings.hpp"
#include "rigid_run.hpp"
#include "subject.hpp"
#include "sweep.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

const std::vector<int> kSubsteps = {1, 2, 4, 8, 16, 32};

std::vector<std::string> solvers_of(const std::string& model) {
  if (model == "particles") return {std::begin(kParticleSolverNames), std::end(kParticleSolverNames)};
  return rigid_solvers();
}

template <class T> bool contains(const std::vector<T>& list, const T& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}
/// Every name asked for is one of `known`.
void require_known(const std::vector<std::string>& names, const std::vector<std::string>& known, const char* what) {
  for (const std::string& name : names) {
    if (contains(known, name)) continue;
    std::string text = std::string("no ") + what + " is named \"" + name + "\"; there are:";
    for (const std::string& other : known) text += " " + other;
    throw ToolError(exit_status::kUsage, text);
  }
}

std::vector<std::string> models_of(const Subject& subject, const GridOptions& options) {
  require_known(options.models, {std::begin(kModels), std::end(kModels)}, "model");
  for (const std::string& model : options.models) {
    const std::string& reason = refusal_of(subject, model);
    if (!reason.empty()) throw ToolError(exit_status::kUsage, subject.name + " has no " + model + ": " + reason);
  }
  std::vector<std::string> models = options.models;
  for (const char* model : kModels) {
    if (options.models.empty() && refusal_of(subject, model).empty()) models.emplace_back(model);
  }
  return models;
}

LabPoint default_of(const Subject& subject, const std::string& scalar) {
  const scenes::Scene& scene = subject.scene;
  return {subject.name, kOwnEngine, scalar,        kSolverNames[static_cast<std::uint32_t>(scene.solver)],
          "rigid",      scene.hz,   scene.substeps};
}

}  // namespace

LabPoint default_point(const std::string& scene, const std::string& scalar) {
  return default_of(subject_of(scene), scalar);
}

std::vector<LabPoint> grid(const std::string& scene, const GridOptions& options) {
  const Subject subject = subject_of(scene);
  std::vector<std::string> solvers = solvers_of("rigid");
  for (const std::string& name : solvers_of("particles")) {
    if (!contains(solvers, name)) solvers.push_back(name);
  }
  require_known(options.scalars, scalar_names(), "scalar");
  require_known(options.solvers, solvers, "solver");
  const std::vector<int> substeps = options.substeps.empty() ? kSubsteps : options.substeps;
  const std::vector<int> rates = options.hz.empty() ? std::vector<int>{subject.scene.hz} : options.hz;
  std::vector<LabPoint> points;
  for (const std::string& model : models_of(subject, options)) {
    for (const std::string& scalar : options.scalars.empty() ? scalar_names() : options.scalars) {
      for (const std::string& solver : solvers_of(model)) {
        if (!options.solvers.empty() && !contains(options.solvers, solver)) continue;
        for (const int hz : rates) {
          for (const int count : substeps) points.push_back({scene, kOwnEngine, scalar, solver, model, hz, count});
        }
      }
      const LabPoint own = default_of(subject, scalar);
      if (!contains(points, own)) points.push_back(own);
    }
  }
  return points;
}

}  // namespace isostep::tool::lab
