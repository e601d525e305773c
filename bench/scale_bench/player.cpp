// The cost of a field of sleepers to a player who runs through it and wakes what it touches.
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <stdexcept>

#include "crowds.hpp"
#include "isostep/store/state.hpp"
#include "scale.hpp"
#include "scene_bench/clock.hpp"
#include "scenes/build.hpp"

namespace isostep::bench {
namespace {

constexpr int kFrames = 600, kWalks = 3;
constexpr std::uint64_t kTurnTicks = 90;
constexpr std::size_t kKept = 8;

/// Gives the player its 6 m/s again, now half left and now half right of straight on.
template <class S> void push(World<S>& world, BodyId player) {
  const S aside = world.tick() / kTurnTicks % 2 == 0 ? S(3) : S(-3);  // [m/s]
  const Vec3<S> now = world.velocity(player);
  const S mass = world.mass(player);
  world.apply_impulse(player, {mass * (S(5.1875) - now.x), S(0), mass * (aside - now.z)});
}

/// [ms] of each frame, the least of equal walks: what other work on the machine adds is not the step's.
struct Times {
  std::vector<double> step = std::vector<double>(kFrames, 1e9), save = step;
};

template <class S> void walk(World<S>& world, BodyId player, Times& times) {
  std::array<typename World<S>::Snapshot, kKept> ring;
  for (auto& snapshot : ring) world.save(snapshot);
  for (std::size_t i = 0; i < kFrames; ++i) {
    push(world, player);
    const double start = thread_milliseconds();
    world.step();
    const double stepped = thread_milliseconds();
    world.save(ring[i % kKept]);
    const double saved = thread_milliseconds();
    times.step[i] = std::min(times.step[i], stepped - start);
    times.save[i] = std::min(times.save[i], saved - stepped);
  }
}

/// Counting looks at every body, so it has a walk of its own.
template <class S> void count(World<S>& world, BodyId player, PlayerRow& row) {
  std::vector<double> awake;
  for (int i = 0; i < kFrames; ++i) {
    push(world, player);
    world.step();
    const std::uint32_t now = world.counts().awake;
    awake.push_back(now);
    row.most_awake = std::max(row.most_awake, now);
  }
  row.awake = static_cast<unsigned>(median(awake));
}

template <class S> PlayerRow measure(const ScaleOptions& options) {
  const scenes::Scene scene = field(options.field);
  World<S> world(scenes::settings_of<S>(scene));
  const BodyId player = scenes::build(scene, world).bodies[1];
  step_until_asleep(world, 1);
  PlayerRow row;
  row.boxes = world.counts().asleep;
  row.rest_us = 1e3 * median_milliseconds(
                          kFrames, [] {}, [&] { world.step(); });
  typename World<S>::Snapshot settled;
  world.save(settled);
  count(world, player, row);
  const std::uint64_t end = world.hash();
  Times times;
  for (int i = 0; i < kWalks; ++i) {
    world.load(settled);
    walk(world, player, times);
    if (world.hash() != end) throw std::runtime_error("the player's walks differ");
  }
  row.step_us = 1e3 * median(times.step);
  row.worst_us = 1e3 * quantile(times.step, 1);
  row.save_us = 1e3 * median(times.save);
  row.worst_save_us = 1e3 * quantile(times.save, 1);
  return row;
}

}  // namespace

PlayerRow measure_player(const ScaleOptions& options) {
  PlayerRow row;
#define ISO_MEASURE(S) \
  if (options.scalar == ScalarTraits<S>::kName) row = measure<S>(options);
  ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
  return row;
}

std::string table_of(const PlayerRow& row) {
  char line[256];
  std::snprintf(line, sizeof line, "| %u | %.1f | %.1f | %.1f | %u | %u | %.1f | %.1f |\n", row.boxes, row.rest_us,
                row.step_us, row.worst_us, row.awake, row.most_awake, row.save_us, row.worst_save_us);
  return std::string(
             "| asleep before | step us at rest | step us | worst step us | awake | awake at most "
             "| save us | worst save us |\n"
             "|---|---|---|---|---|---|---|---|\n") +
         line;
}

}  // namespace isostep::bench
