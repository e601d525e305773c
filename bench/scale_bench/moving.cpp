// The cost of a crowd of which a part moves, while the rest sleeps.
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <span>

#include "apart.hpp"
#include "crowds.hpp"
#include "isostep/store/state.hpp"
#include "scale.hpp"
#include "scene_bench/clock.hpp"
#include "scene_bench/resident.hpp"
#include "scenes/build.hpp"

namespace isostep::bench {
namespace {

constexpr std::size_t kKept = 8;
constexpr std::uint64_t kTurnTicks = 32;

/// Columns slide to and fro by a third of a metre, which is not as far as their neighbours: no box, contact or proxy of
/// them is as it was a step ago.
template <class S> void drive(World<S>& world, std::span<const BodyId> moving) {
  const S speed = world.tick() / kTurnTicks % 2 == 0 ? S(0.625) : S(-0.625);  // [m/s]
  for (const BodyId body : moving) world.set_velocity(body, {speed, S(0), S(0)}, {S(0), S(0), S(0)});
}

template <class S, class Drive> void time_states(World<S>& world, const Drive& push, int frames, CrowdRow& row) {
  typename World<S>::Snapshot settled;
  std::array<typename World<S>::Snapshot, kKept> ring;
  world.save(settled);
  for (auto& snapshot : ring) world.save(snapshot);
  row.snapshot_bytes = settled.bytes();
  std::uint64_t hashes = 0;
  const auto step = [&] {
    push();
    world.step();
  };
  row.save_us = 1e3 * median_milliseconds(frames, step, [&] { world.save(ring[world.tick() % kKept]); });
  row.hash_us = 1e3 * median_milliseconds(frames, step, [&] { hashes ^= world.hash(); });
  row.load_us = 1e3 * median_milliseconds(frames, step, [&] { world.load(settled); });
  if (hashes == 1) std::fputs("", stderr);  // the hashes are used
}

template <class S> CrowdRow measure(int moving, const ScaleOptions& options) {
  const scenes::Scene scene = sleepers(moving, options.crowd - moving, options.column);
  const double before = begin_peak();
  World<S> world(scenes::settings_of<S>(scene));
  const std::vector<BodyId> bodies = scenes::build(scene, world).bodies;
  const auto awake = static_cast<std::uint32_t>(moving);
  const std::span<const BodyId> driven = std::span<const BodyId>(bodies).subspan(1, awake);  // after the floor
  const auto push = [&] { drive(world, driven); };
  step_until_asleep(world, awake);
  for (int i = 0; i < options.settle; ++i) {
    push();
    world.step();
  }
  CrowdRow row;
  row.step_us = 1e3 * median_milliseconds(options.frames, push, [&] { world.step(); });
  row.peak_megabytes = peak_megabytes() - before;
  const WorldCounts counts = world.counts();
  row.bodies = counts.awake + counts.asleep;
  row.awake = counts.awake;
  row.contacts = counts.contacts;
  time_states(world, push, options.frames, row);
  return row;
}

}  // namespace

std::vector<CrowdRow> measure_crowds(const ScaleOptions& options) {
  std::vector<CrowdRow> rows;
  for (const int moving : options.moving) {
    if (moving > options.crowd) continue;
#define ISO_MEASURE(S)                          \
  if (options.scalar == ScalarTraits<S>::kName) \
    rows.push_back(measure_apart<CrowdRow>([&] { return measure<S>(moving, options); }));
    ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
    std::fprintf(stderr, "%d of %d move\n", moving, options.crowd);
  }
  return rows;
}

std::string table_of(const std::vector<CrowdRow>& rows) {
  std::string text =
      "| bodies | awake | contacts | step ms | ns an awake body | save us | load us | hash us | snapshot MB | peak MB "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const CrowdRow& row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "| %u | %u | %u | %.3f | %.0f | %.1f | %.1f | %.1f | %.2f | %.0f |\n", row.bodies,
                  row.awake, row.contacts, 1e-3 * row.step_us, 1e3 * row.step_us / std::max(1u, row.awake), row.save_us,
                  row.load_us, row.hash_us, 1e-6 * static_cast<double>(row.snapshot_bytes), row.peak_megabytes);
    text += line;
  }
  return text;
}

}  // namespace isostep::bench
