// The observations of `run` on a game's world, beside times and hashes, by the kind of game.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "isostep/geometry/content.hpp"
#include "isostep/store/state.hpp"
#include "run_report.hpp"
#include "scenes/bars.hpp"
#include "scenes/measure.hpp"
#include "scenes/trials/trial_run.hpp"
#include "tool/common/scene_game.hpp"

namespace isostep::tool {

/// The watch of rigid bodies. A kind's watch has a Report with the members that Run fills, and json_of and table_of for
/// it.
template <class S> class RigidWatch {
 public:
  using Report = RunReport;

  explicit RigidWatch(const World<S>& world) {
    found_.energy_start = scenes::measure_energy(world).total();
    observe_joints(world);
  }
  /// Judges from now on a trial's scene, as built.
  void judge(const scenes::Trial& trial, const scenes::Scene& scene, const World<S>& world) {
    trial_.emplace(trial, scene).see(world);
  }
  /// Counts in a benchmark scene, as built, what leaves its place or passes what is in its way.
  void count_lost(const std::string& scene, const World<S>& world) {
    benchmark_ = scene;
    start_ = scenes::sight_of(world, 0).bodies;
  }
  /// `last_second`: of the run.
  void stepped(const World<S>& world, const StepReport& step, int frame, bool last_second) {
    found_.faults += std::uint64_t{step.clamped_speed} + step.clamped_force + step.clamped_position + step.stopped +
                     step.crowded + step.cut_compounds;
    if (found_.asleep_at < 0 && world.state().awake.states.empty()) found_.asleep_at = frame;
    observe_joints(world);
    if (trial_) trial_->see(world, step);
    if (!last_second) return;
    const scenes::Energy energy = scenes::measure_energy(world);
    if (energy.mass > 0) unrest_.push_back(energy.kinetic / energy.mass);
  }
  /// All that is known of the world, which has come to the run's end.
  RunReport report(const World<S>& world) const {
    RunReport report = found_;
    report.solver = solver_name(world.settings().solver);
    if (world.settings().solver == SolverName::worst_first)
      report.projection = kProjectionNames[static_cast<std::uint32_t>(world.settings().projection)];
    report.simd = world.simd_name();
    report.substeps = world.settings().substeps;
    const WorldCounts counts = world.counts();
    report.contacts = counts.contacts;
    report.points = counts.points;
    report.bodies = counts.bodies;
    report.awake = counts.awake;
    const scenes::Overlap overlap = scenes::measure_overlap(world);
    report.penetration_max = overlap.worst;
    report.penetration_mean = overlap.mean;
    report.residuals = scenes::measure_residuals(world);
    report.energy_end = scenes::measure_energy(world).total();
    if (trial_) report.trial = TrialReport{&trial_->trial(), trial_->verdict(), trial_->over()};
    if (!benchmark_.empty()) {
      const std::vector<scenes::BodySight> now = scenes::sight_of(world, 0).bodies;
      report.through = scenes::count_through(benchmark_, start_, now);
      if (!report.through) report.lost = scenes::count_outside(benchmark_, now);
    }
    report.blobs = blobs_of(*world.state().geometry);
    for (const double value : unrest_) report.unrest += value / static_cast<double>(unrest_.size());
    return report;
  }

 private:
  static std::vector<BlobReport> blobs_of(const GeometryStore& store) {
    std::vector<BlobReport> blobs;
    for (std::uint32_t place = 0; place < store.names().size(); ++place) {
      if (!store.is_taken(place)) continue;
      const Blob& blob = *store.content(place);
      blobs.push_back({kShapeNames[static_cast<std::uint32_t>(blob.type())], store.names()[place].id,
                       blob.bytes().size(), memory_of(blob), static_cast<std::uint32_t>(store.names()[place].uses)});
    }
    return blobs;
  }
  static std::size_t memory_of(const Blob& blob) {
    return visit_shape_type(blob.type(), [&](auto tag) -> std::size_t {
      using Shape = typename decltype(tag)::template Of<S>;
      if constexpr (!Shape::kHasBlob) return 0;
      else return static_cast<const typename Shape::Content*>(content_of<S>(blob))->memory();
    });
  }
  void observe_joints(const World<S>& world) {
    if (!world.state().joint_slots.entries().empty()) {
      found_.joint_error_max = std::max(found_.joint_error_max, scenes::largest_joint_error(world));
    }
  }

  RunReport found_;
  std::optional<scenes::TrialRun> trial_;
  std::vector<double> unrest_;
  std::string benchmark_;  // its name; empty: the scene is none
  std::vector<scenes::BodySight> start_;
};
template <class S> RigidWatch<S> watch_of(const World<S>& world) { return RigidWatch<S>(world); }

namespace detail {
template <class T> std::string list(const Vec3<T>& v) {
  return "[" + to_text(v.x) + ", " + to_text(v.y) + ", " + to_text(v.z) + "]";
}
template <class U> std::string list(const Quat<U>& q) {
  return "[" + to_text(q.x) + ", " + to_text(q.y) + ", " + to_text(q.z) + ", " + to_text(q.w) + "]";
}
}  // namespace detail

/// Bodies in the order of their creation, which is their user data.
template <class S> std::string dump_of(const World<S>& world) {
  std::vector<BodyId> bodies = world.bodies();
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](BodyId a, BodyId b) { return world.user_data(a) < world.user_data(b); });
  std::string text = "{\"bodies\": [";
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Pose<S> pose = world.pose(bodies[i]);
    text += (i == 0 ? "\n  {\"position\": " : ",\n  {\"position\": ") + detail::list(pose.position);
    text += ", \"orientation\": " + detail::list(pose.orientation);
    text += ", \"velocity\": " + detail::list(world.velocity(bodies[i]));
    text += ", \"angular_velocity\": " + detail::list(world.angular_velocity(bodies[i])) + "}";
  }
  return text + "]}\n";
}

}  // namespace isostep::tool
