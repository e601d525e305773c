// The cost of a step with ever more bodies, stage by stage.
// SPDX-License-Identifier: MIT
#include "scale.hpp"

#include <cstdio>

#include "crowds.hpp"
#include "scene_bench/clock.hpp"
#include "scenes/build.hpp"

namespace isostep::bench {
namespace {

/// CPU time between one stage and the next [us].
class StageClock {
 public:
  void begin() { last_ = thread_milliseconds(); }
  StageObserver observer() { return {&StageClock::after, this}; }
  double median_us(std::uint32_t stage) const { return 1e3 * median(times_[stage]); }
  double last() const { return last_; }

 private:
  static void after(void* user, Stage stage, const StageView&) {
    StageClock& clock = *static_cast<StageClock*>(user);
    const double now = thread_milliseconds();
    clock.times_[static_cast<std::uint32_t>(stage)].push_back(now - clock.last_);
    clock.last_ = now;
  }

  double last_ = 0;
  std::array<std::vector<double>, kStages> times_;
};

template <class S> ScaleRow measure(const std::string& name, int size, const ScaleOptions& options) {
  const scenes::Scene scene = name == "pyramid" ? pyramid_of(size) : pile_of(size);
  World<S> world(scenes::settings_of<S>(scene));
  scenes::build(scene, world);
  for (int i = 0; i < options.settle; ++i) world.step();
  StageClock clock;
  std::vector<double> steps;
  for (int i = 0; i < options.frames; ++i) {
    const double start = thread_milliseconds();
    clock.begin();
    world.step(clock.observer());
    steps.push_back(thread_milliseconds() - start);
  }
  ScaleRow row;
  row.scene = name;
  const WorldCounts counts = world.counts();
  row.bodies = counts.awake;
  row.contacts = counts.contacts;
  row.points = counts.points;
  row.step_us = 1e3 * median(steps);
  for (std::uint32_t stage = 0; stage < kStages; ++stage) row.stage_us[stage] = clock.median_us(stage);
  typename World<S>::Snapshot snapshot;
  world.save(snapshot);
  row.snapshot_bytes = snapshot.bytes();
  return row;
}

/// The stages a table shows; the others are summed.
constexpr Stage kShown[] = {Stage::find_pairs, Stage::update_manifolds, Stage::colour_constraints,
                            Stage::prepare,    Stage::solve_substeps,   Stage::finalise_bodies};

}  // namespace

std::vector<ScaleRow> measure_scale(const ScaleOptions& options) {
  std::vector<ScaleRow> rows;
  for (const std::string& scene : options.scenes) {
    for (const int size : options.sizes) {
#define ISO_MEASURE(S) \
  if (options.scalar == ScalarTraits<S>::kName) rows.push_back(measure<S>(scene, size, options));
      ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
      std::fprintf(stderr, "%s of %d\n", scene.c_str(), size);
    }
  }
  return rows;
}

std::string table_of(const std::vector<ScaleRow>& rows) {
  std::string text = "| scene | bodies | contacts | points | step ms | ns a body | ns a contact |";
  for (const Stage stage : kShown) text += std::string(" ") + kStageNames[static_cast<std::uint32_t>(stage)] + " |";
  text += " others | snapshot bytes a body |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  char cell[160];
  for (const ScaleRow& row : rows) {
    const double per_body = 1e3 / std::max(1u, row.bodies);
    std::snprintf(cell, sizeof cell, "| %s | %u | %u | %u | %.3f | %.0f | %.0f |", row.scene.c_str(), row.bodies,
                  row.contacts, row.points, row.step_us * 1e-3, row.step_us * per_body,
                  1e3 * row.step_us / std::max(1u, row.contacts));
    text += cell;
    double others = 0;
    for (const double time : row.stage_us) others += time;
    for (const Stage stage : kShown) {
      const double time = row.stage_us[static_cast<std::uint32_t>(stage)];
      others -= time;
      std::snprintf(cell, sizeof cell, " %.0f |", time * per_body);
      text += cell;
    }
    std::snprintf(cell, sizeof cell, " %.0f | %.0f |\n", others * per_body,
                  static_cast<double>(row.snapshot_bytes) / std::max(1u, row.bodies));
    text += cell;
  }
  return text;
}

std::string tsv_of(const std::vector<ScaleRow>& rows) {
  std::string text = "scene\tbodies\tcontacts\tstep";
  for (const char* name : kStageNames) text += std::string("\t") + name;
  text += "\n";
  char cell[96];
  for (const ScaleRow& row : rows) {
    const double per_body = 1e3 / std::max(1u, row.bodies);
    std::snprintf(cell, sizeof cell, "%s\t%u\t%u\t%.2f", row.scene.c_str(), row.bodies, row.contacts,
                  row.step_us * per_body);
    text += cell;
    for (const double time : row.stage_us) {
      std::snprintf(cell, sizeof cell, "\t%.3f", time * per_body);
      text += cell;
    }
    text += "\n";
  }
  return text;
}

}  // namespace isostep::bench
