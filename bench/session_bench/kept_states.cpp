// The cost of keeping the states of the last second, for the cause of a desync to be found in.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include "isostep/replay/frame_history.hpp"
#include "parts.hpp"
#include "scene_bench/clock.hpp"
#include "scene_bench/resident.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {
namespace {

constexpr std::size_t kKept = 64;
constexpr int kRuns = 64;
/// [saves] A snapshot allocates whenever there are more contacts than it ever held: three rounds, and it rarely does.
constexpr int kGrowing = 3 * static_cast<int>(kKept);

struct Row {
  double megabytes = 0, first_us = 0, ring_us = 0, same_us = 0, warm_us = 0;
  double history_megabytes = 0, history_us = 0;
};

template <class S> void measure_saves(World<S>& world, Row& row) {
  using Snapshot = typename World<S>::Snapshot;
  std::vector<Snapshot> ring(kKept);
  std::size_t next = 0;
  const auto step = [&] { world.step(); };
  const auto save_next = [&] { world.save(ring[next++ % kKept]); };
  const auto save_one = [&] { world.save(ring[0]); };
  return_freed_memory();
  const double before = resident_megabytes();
  row.first_us = 1e3 * median_milliseconds(static_cast<int>(kKept), step, save_next);
  row.megabytes = resident_megabytes() - before;
  for (int i = 0; i < kGrowing; ++i) {
    step();
    save_next();
  }
  row.ring_us = 1e3 * median_milliseconds(kRuns, step, save_next);
  row.same_us = 1e3 * median_milliseconds(kRuns, step, save_one);
  row.warm_us = 1e3 * median_milliseconds(kRuns, save_one, save_one);
}

/// All that the observer does in a frame: the command log, a hash and a save.
template <class S> void measure_history(World<S>& world, Row& row) {
  return_freed_memory();
  const double before = resident_megabytes();
  FrameHistory<S> history(world, {.frames = kKept});
  std::vector<double> times;
  constexpr Frame kFirst = static_cast<Frame>(kKept) + kGrowing;
  for (Frame frame = 0; frame < kFirst + kRuns; ++frame) {
    const double start = thread_milliseconds();
    history.before_step(frame);
    const double begun = thread_milliseconds();
    world.step();
    const double stepped = thread_milliseconds();
    history.after_step(frame);
    const double end = thread_milliseconds();
    if (frame >= kFirst) times.push_back(begun - start + end - stepped);
  }
  row.history_megabytes = resident_megabytes() - before;
  row.history_us = 1e3 * median(times);
}

template <class S> void report(const SessionBenchOptions& options) {
  const char* name = ScalarTraits<S>::kName;
  if (std::count(options.scalars.begin(), options.scalars.end(), std::string(name)) == 0) return;
  const scenes::Scene scene = scenes::find_scene("S4").value();
  World<S> world(scenes::settings_of<S>(scene));
  scenes::build(scene, world);
  for (int i = 0; i < scene.frames; ++i) world.step();
  Row row;
  measure_saves(world, row);
  measure_history(world, row);
  std::printf("| %s | %.1f | %.0f | %.0f | %.0f | %.0f | %.1f | %.0f |\n", name, row.megabytes, row.warm_us,
              row.same_us, row.ring_us, row.first_us, row.history_megabytes, row.history_us);
  std::fflush(stdout);
}

}  // namespace

void report_kept_states(const SessionBenchOptions& options) {
  std::printf(
      "\n64 states kept, S4 after 600 frames: memory, and us of one save:\n\n"
      "| scalar | MB | at once again | after a step, one snapshot | after a step, 64 in turn | the first time | "
      "FrameHistory: MB | us a step |\n"
      "|---|---|---|---|---|---|---|---|\n");
#define ISO_REPORT(S) report<S>(options);
  ISO_FOR_EACH_SCALAR(ISO_REPORT)
#undef ISO_REPORT
}

}  // namespace isostep::bench
