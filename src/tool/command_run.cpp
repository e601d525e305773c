// isostep run: one scene, measured; and its recording, hashes, snapshot and last frame as files.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>
#include <optional>

#include "commands.hpp"
#include "files.hpp"
#include "isostep/world/state.hpp"
#include "run_report.hpp"
#include "scene_game.hpp"
#include "scenes/measure.hpp"
#include "threads/tbb_runner.hpp"

namespace isostep::tool {
namespace {

template <class T> std::string list(const Vec3<T>& v) {
  return "[" + to_text(v.x) + ", " + to_text(v.y) + ", " + to_text(v.z) + "]";
}
template <class U> std::string list(const Quat<U>& q) {
  return "[" + to_text(q.x) + ", " + to_text(q.y) + ", " + to_text(q.z) + ", " + to_text(q.w) + "]";
}

/// Bodies in the order of their creation, which is their user data.
template <class S> std::string dump_of(const World<S>& world) {
  std::vector<BodyId> bodies = world.bodies();
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](BodyId a, BodyId b) { return world.user_data(a) < world.user_data(b); });
  std::string text = "{\"bodies\": [";
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Pose<S> pose = world.pose(bodies[i]);
    text += (i == 0 ? "\n  {\"position\": " : ",\n  {\"position\": ") + list(pose.position);
    text += ", \"orientation\": " + list(pose.orientation) + ", \"velocity\": " + list(world.velocity(bodies[i]));
    text += ", \"angular_velocity\": " + list(world.angular_velocity(bodies[i])) + "}";
  }
  return text + "]}\n";
}

template <class S> void load_snapshot(World<S>& world, const RunOptions& options) {
  const std::vector<std::uint8_t> bytes = read_file(options.load);
  Reader reader(bytes);
  Result<void> read = world.read_portable(reader);
  if (read) {
    reader.expect_end();
    read = reader.result("snapshot");
  }
  if (!read) {
    throw ToolError(exit_status::kUsage, options.load + ": " + std::string(read.error().message.view()) + " (" +
                                             std::string(read.error().place.view()) + ")");
  }
  if ((options.hz > 0 && options.hz != world.settings().hz) ||
      (options.substeps > 0 && options.substeps != world.settings().substeps)) {
    throw ToolError(exit_status::kUsage, options.load + ": a snapshot keeps its own hz and substeps");
  }
}

template <class S> class Run {
 public:
  Run(const RunOptions& options, const scenes::Scene& scene)
      : options_(options),
        scene_(scene),
        game_(scene, options.hz > 0 ? options.hz : kDefaultHz,
              options.substeps > 0 ? options.substeps : kDefaultSubsteps) {
    if (!options.load.empty()) load_snapshot(game_.world, options);
    use_lanes(game_.world, simd_named(options.simd));
    if (options.threads > 1) game_.world.use_threads(threads_.emplace(options.threads).runner());
  }

  int run() {
    open_recording();
    const int frames = options_.frames >= 0 ? options_.frames : scene_.frames;
    report_.energy_start = scenes::measure_energy(game_.world).total();
    observe_joints();
    for (int i = 0; i < frames && !interrupted(); ++i) step(i, i + 60 >= frames);
    finish(frames);
    return interrupted() ? exit_status::kInterrupted : exit_status::kOk;
  }

 private:
  void open_recording() {
    if (options_.record.empty()) return;
    file_.emplace(options_.record);
    recorder_.emplace(game_.world, file_->sink());
    expect_written(recorder_->begin(scene_.name));
  }

  void step(int frame, bool last_second) {
    World<S>& world = game_.world;
    scenes::before_step(game_.script, world);
    const double before = now();
    const StepReport report = world.step();
    ms_.push_back(now() - before);
    report_.faults += std::uint64_t{report.clamped_speed} + report.clamped_position + report.stopped;
    if (report_.asleep_at < 0 && world.state().awake.states.empty()) report_.asleep_at = frame;
    observe_joints();
    if (last_second) {
      const scenes::Energy energy = scenes::measure_energy(world);
      if (energy.mass > 0) unrest_.push_back(energy.kinetic / energy.mass);
    }
    if (!recorder_ && options_.hashes.empty()) return;
    hashes_.push_back(world.hash());
    if (recorder_) expect_written(recorder_->end_frame(hashes_.back()));
  }
  /// [ms] Of one thread its own time; what several save shows in real time alone.
  double now() const { return options_.threads > 1 ? real_milliseconds() : thread_milliseconds(); }
  void observe_joints() {
    if (!game_.world.state().joint_slots.entries().empty()) {
      report_.joint_error_max = std::max(report_.joint_error_max, scenes::largest_joint_error(game_.world));
    }
  }

  void finish(int frames) {
    if (recorder_) {
      expect_written(recorder_->finish());
      file_->close();
    }
    if (!options_.hashes.empty()) write_file(options_.hashes, hash_lines(hashes_));
    if (!options_.dump.empty()) write_file(options_.dump, dump_of(game_.world));
    if (!options_.save.empty()) {
      std::vector<std::uint8_t> bytes;
      Writer writer(bytes);
      game_.world.write_portable(writer);
      write_file(options_.save, Bytes(bytes));
    }
    if (interrupted()) {
      std::cerr << "isostep: interrupted after " << ms_.size() << " of " << frames << " frames\n";
      return;
    }
    complete_report();
    std::cout << (options_.json ? json_of(report_) : table_of(report_));
  }

  void complete_report() {
    const World<S>& world = game_.world;
    report_.scene = scene_.name;
    report_.scalar = ScalarTraits<S>::kName;
    report_.solver = solver_name(world.settings().solver);
    report_.simd = world.simd_name();
    report_.threads = options_.threads;
    report_.substeps = world.settings().substeps;
    report_.frames = static_cast<int>(ms_.size());
    report_.hash = world.hash();
    report_.ms = summarise(ms_);
    const WorldCounts counts = world.counts();
    report_.contacts = counts.contacts;
    report_.points = counts.points;
    report_.bodies = counts.bodies;
    report_.awake = counts.awake;
    const scenes::Overlap overlap = scenes::measure_overlap(world);
    report_.penetration_max = overlap.worst;
    report_.penetration_mean = overlap.mean;
    report_.energy_end = scenes::measure_energy(world).total();
    for (const double value : unrest_) report_.unrest += value / static_cast<double>(unrest_.size());
  }

  const RunOptions& options_;
  std::optional<threads::TbbRunner> threads_;  // outlives the world
  const scenes::Scene& scene_;
  SceneGame<S> game_;
  std::optional<ReplayFile> file_;
  std::optional<WorldRecorder<S>> recorder_;
  std::vector<double> ms_, unrest_;
  std::vector<std::uint64_t> hashes_;
  RunReport report_;
};

}  // namespace

int command_run(const RunOptions& options) {
  const scenes::Scene scene = load_scene(options.scene);
  int status = exit_status::kSoftware;
  const bool found = with_scalar(options.scalar, [&](auto tag) {
    using S = typename decltype(tag)::Type;
    std::optional<Run<S>> run;
    try {
      run.emplace(options, scene);
    } catch (const scenes::SceneError& error) {
      fail_scene(options.scene, error);
    }
    status = run->run();
  });
  if (!found) throw ToolError(exit_status::kUsage, "this build has no scalar " + options.scalar);
  return status;
}

}  // namespace isostep::tool
