// The cost of sleepers to those who are awake.
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <span>

#include "crowds.hpp"
#include "isostep/store/state.hpp"
#include "scale.hpp"
#include "scene_bench/clock.hpp"
#include "scenes/build.hpp"

namespace isostep::bench {
namespace {

constexpr int kRuns = 61;
constexpr std::size_t kKept = 8;

template <class S> SleeperRow measure(int sleeping, const ScaleOptions& options) {
  const scenes::Scene scene = sleepers(options.awake, sleeping, options.column);
  World<S> world(scenes::settings_of<S>(scene));
  const std::vector<BodyId> bodies = scenes::build(scene, world).bodies;
  const auto awake = static_cast<std::uint32_t>(options.awake);
  step_until_asleep(world, awake);
  for (int i = 0; i < 30; ++i) world.step();

  SleeperRow row;
  row.awake = world.counts().awake;
  row.asleep = world.counts().asleep;
  row.islands = static_cast<unsigned>(world.state().sleeping.size());
  typename World<S>::Snapshot settled;
  std::array<typename World<S>::Snapshot, kKept> ring;
  world.save(settled);
  for (auto& snapshot : ring) world.save(snapshot);
  row.snapshot_bytes = settled.bytes();
  std::uint64_t hashes = 0;
  const auto step = [&] { world.step(); };
  const auto reload = [&] { world.load(settled); };
  const auto nothing = [] {};
  row.step_us = 1e3 * median_milliseconds(kRuns, nothing, step);
  row.save_us = 1e3 * median_milliseconds(kRuns, step, [&] { world.save(ring[world.tick() % kKept]); });
  row.hash_us = 1e3 * median_milliseconds(kRuns, step, [&] { hashes ^= world.hash(); });
  row.load_us = 1e3 * median_milliseconds(kRuns, step, reload);
  if (hashes == 1) std::fputs("", stderr);  // the hashes are used
  if (sleeping == 0) return row;
  row.wake_one_us = 1e3 * median_milliseconds(11, reload, [&] { world.wake(bodies.back()); });
  row.destroy_one_us = 1e3 * median_milliseconds(11, reload, [&] { world.destroy(bodies.back()); });
  const std::vector<BodyId> asleep(bodies.end() - static_cast<std::ptrdiff_t>(row.asleep), bodies.end());
  row.destroy_all_ms = median_milliseconds(3, reload, [&] { world.destroy(std::span<const BodyId>(asleep)); });
  const Vec3<S> gravity = world.settings().gravity;
  row.wake_all_ms = median_milliseconds(3, reload, [&] { world.set_gravity(gravity); });
  const int until_they_sleep = world.settings().hz / 2 - 2;  // steps that leave the clocks just short
  for (int i = 0; i < until_they_sleep; ++i) world.step();
  row.sleep_all_ms = median_milliseconds(1, nothing, [&] { step_until_asleep(world, awake); });
  return row;
}

}  // namespace

std::vector<SleeperRow> measure_sleepers(const ScaleOptions& options) {
  std::vector<SleeperRow> rows;
  for (const int sleeping : options.sleeping) {
#define ISO_MEASURE(S) \
  if (options.scalar == ScalarTraits<S>::kName) rows.push_back(measure<S>(sleeping, options));
    ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
    std::fprintf(stderr, "%d sleepers\n", sleeping);
  }
  return rows;
}

std::string table_of(const std::vector<SleeperRow>& rows) {
  std::string text =
      "| awake | asleep | islands | step us | save us | load us | hash us | snapshot bytes | wake one us "
      "| destroy one us | wake all ms | destroy all ms | last steps until all sleep ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const SleeperRow& row : rows) {
    char line[256];
    std::snprintf(line, sizeof line,
                  "| %u | %u | %u | %.1f | %.1f | %.1f | %.1f | %zu | %.1f | %.1f | %.1f | %.1f | %.1f |\n", row.awake,
                  row.asleep, row.islands, row.step_us, row.save_us, row.load_us, row.hash_us, row.snapshot_bytes,
                  row.wake_one_us, row.destroy_one_us, row.wake_all_ms, row.destroy_all_ms, row.sleep_all_ms);
    text += line;
  }
  return text;
}

}  // namespace isostep::bench
