// Rollback: each operation alone, and the whole correction of eight frames.
// SPDX-License-Identifier: MIT
#include "rollback.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "clock.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/script.hpp"

namespace isostep::bench {
namespace {

constexpr int kRuns = 41;
constexpr std::size_t kFrames = 8;

template <class S> RollbackRow measure(const scenes::Scene& scene) {
  World<S> world(scenes::settings_of<S>(scene));
  scenes::build(scene, world);
  const auto act = [&] { scenes::before_step(scene.script, world); };
  const int frames = scene.script == scenes::Script::mixer ? scenes::kMixerBirthsEnd - 100 : scene.frames;
  for (int i = 0; i < frames; ++i) {  // births go on while it is measured
    act();
    world.step();
  }

  typename World<S>::Snapshot settled;
  std::array<typename World<S>::Snapshot, kFrames> ring;
  world.save(settled);
  for (auto& snapshot : ring) world.save(snapshot);
  std::uint64_t hashes = 0;
  const auto nothing = [] {};
  const auto reload = [&] { world.load(settled); };
  const auto reload_and_act = [&] {
    world.load(settled);
    act();
  };
  const auto step_once = [&] {
    act();
    world.step();
  };
  const auto correct = [&] {
    world.load(settled);
    for (auto& snapshot : ring) {
      step_once();
      world.save(snapshot);
      hashes ^= world.hash();
    }
  };

  RollbackRow row;
  row.scene = scene.name;
  row.scalar = ScalarTraits<S>::kName;
  row.awake = world.counts().awake;
  row.snapshot_bytes = settled.bytes();
  row.bytes_per_awake = static_cast<double>(settled.bytes()) / std::max(1u, row.awake);
  // A step goes before each: what is saved, loaded or hashed then lies where a game leaves it.
  row.save_us = 1e3 * median_milliseconds(kRuns, step_once, [&] { world.save(ring[0]); });
  row.hash_us = 1e3 * median_milliseconds(kRuns, step_once, [&] { hashes ^= world.hash(); });
  row.load_us = 1e3 * median_milliseconds(kRuns, step_once, reload);
  row.step_ms = median_milliseconds(kRuns, reload_and_act, [&] { world.step(); });
  row.eight_frames_ms = median_milliseconds(kRuns, nothing, correct);
  if (hashes == 1) std::fputs("", stderr);  // the hashes are used
  return row;
}

}  // namespace

std::vector<RollbackRow> measure_rollback(std::string_view name, const std::vector<std::string>& scalars) {
  std::vector<RollbackRow> rows;
  const std::optional<scenes::Scene> scene = scenes::find_scene(name);
  if (!scene) return rows;
#define ISO_MEASURE(S)                                                                        \
  if (std::count(scalars.begin(), scalars.end(), std::string(ScalarTraits<S>::kName)) != 0) { \
    rows.push_back(measure<S>(*scene));                                                       \
  }
  ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
  return rows;
}

std::string table_of(const std::vector<RollbackRow>& rows) {
  std::string text =
      "| scene | scalar | awake | save us | load us | hash us | step ms | load + 8 x (step, save, hash) ms | snapshot "
      "bytes | per awake body |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const RollbackRow& row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "| %s | %s | %u | %.1f | %.1f | %.1f | %.3f | %.2f | %zu | %.0f |\n",
                  row.scene.c_str(), row.scalar.c_str(), row.awake, row.save_us, row.load_us, row.hash_us, row.step_ms,
                  row.eight_frames_ms, row.snapshot_bytes, row.bytes_per_awake);
    text += line;
  }
  return text;
}

}  // namespace isostep::bench
