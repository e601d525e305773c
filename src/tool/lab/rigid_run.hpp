// One run of rigid bodies, as the laboratory watches it.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "isostep/store/state.hpp"
#include "result.hpp"
#include "scenes/build.hpp"
#include "scenes/residuals.hpp"
#include "scenes/script.hpp"
#include "scenes/sight.hpp"
#include "subject.hpp"

namespace isostep::tool::lab {

/// Those that this build holds.
inline std::vector<std::string> rigid_solvers() {
#define ISO_NAME(name) #name,
  return {ISO_FOR_EACH_BUILT_SOLVER(ISO_NAME)};
#undef ISO_NAME
}
/// The solver of that name. Throws scenes::SceneError.
inline SolverName rigid_solver(const std::string& name) {
  if (const std::optional<SolverName> solver = solver_named(name)) return *solver;
  throw scenes::SceneError("", "rigid bodies have no solver " + name);
}

/// A run of rigid bodies, with the members that `watch` asks of every kind of run. The constructor throws
/// scenes::SceneError for what the scalar refuses.
template <class S> class RigidRun {
 public:
  RigidRun(const Subject& subject, const LabPoint& point)
      : scene_(point.model == "spheres" ? subject.spheres.model : subject.scene), world_(settings_of(scene_, point)) {
    if (scene_.script != scenes::Script::none && point.hz != scene_.hz)
      throw scenes::SceneError("", "its script counts steps: it keeps its own rate");
    scenes::build(scene_, world_);
  }

  /// It is called between steps, and not timed.
  void prepare() { scenes::before_step(scene_.script, world_); }
  /// Steps once. Returns whether the step had to mend numbers.
  bool step() { return !world_.step().clean(); }
  scenes::Energy energy() const { return scenes::measure_energy(world_); }
  double joint_error() const {
    return world_.state().joint_slots.entries().empty() ? 0 : scenes::largest_joint_error(world_);
  }
  scenes::Overlap overlap() const { return scenes::measure_overlap(world_); }
  scenes::ContactResiduals residuals() const { return scenes::measure_residuals(world_); }
  scenes::Sight sight(int faults) const { return scenes::sight_of(world_, faults); }

 private:
  static Settings<S> settings_of(const scenes::Scene& scene, const LabPoint& point) {
    scenes::Scene asked;  // bodies are not needed
    asked.gravity = scene.gravity;
    asked.allow_sleep = scene.allow_sleep;
    asked.hz = point.hz;
    asked.substeps = point.substeps;
    asked.solver = rigid_solver(point.solver);
    asked.projection = scene.projection;
    return scenes::settings_of<S>(asked);
  }

  const scenes::Scene& scene_;
  World<S> world_;
};

}  // namespace isostep::tool::lab
