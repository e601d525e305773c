// The bars of the benchmark set, scene by scene.
// SPDX-License-Identifier: MIT
#include "verdict.hpp"

#include <cmath>
#include <string_view>

namespace isostep::bench {
namespace {

bool starts_with(std::string_view name, std::string_view head) { return name.substr(0, head.size()) == head; }

/// A stack that stands has every box over its neighbour and none lower by half a box.
bool stack_stands(const Row& row) { return row.drift < 0.25 && row.drop < 0.5; }
bool nothing_moved(const Row& row) { return row.moved < 0.25; }

/// [m] A chain whose ends of links are further apart than a link is long is no chain.
constexpr double kLink = 0.5;

bool lost(const Row& row) {
  const std::string_view scene = row.scene;
  if (row.faults != 0 || row.outside != 0 || !std::isfinite(row.kinetic)) return true;
  if (starts_with(scene, "S1")) return !stack_stands(row);
  if (scene == "S2" || scene == "S3" || scene == "S8") return !nothing_moved(row);
  if (starts_with(scene, "S6")) return row.joint_worst > kLink;
  return false;
}

struct Bars {
  bool must, aim;
};

/// Fixed point of 32 bits is for particles and small scenes, and has bars for those alone.
Bars small_bars(const Row& row, bool& any) {
  const scenes::Overlap& o = row.overlap;
  const double top = std::abs(row.top_error);
  any = true;
  if (row.scene == "S1x10") return {top < 0.05 && row.drift < 0.05, top < 0.025 && row.drift < 0.025};
  if (row.scene == "S4s") return {o.worst < 0.08 && o.mean < 0.008, o.worst < 0.04 && o.mean < 0.004};
  if (row.scene == "S2") return {nothing_moved(row), row.moved < 0.125};
  any = false;
  return {};
}

Bars bars(const Row& row, bool& any) {
  const std::string_view scene = row.scene;
  const scenes::Overlap& o = row.overlap;
  const double top = std::abs(row.top_error);
  any = true;
  if (scene == "S1") return {top < 0.12 && row.drift < 0.01, top < 0.02 && row.drift < 0.005};
  if (scene == "S1x10") return {top < 0.03, top < 0.01};
  if (scene == "S2" || scene == "S3") {
    return {o.worst < 0.004 && row.kinetic < 1e-8, o.worst < 0.001 && row.kinetic < 1e-9};
  }
  if (scene == "S4") {
    return {o.worst < 0.04 && o.mean < 0.0025, o.worst < 0.02 && o.mean < 0.0015 && row.kinetic < 2e-5};
  }
  if (scene == "S5") return {o.worst < 0.03 && o.mean < 0.0035, o.worst < 0.02 && o.mean < 0.0016};
  if (scene == "S6") return {row.joint_worst < 0.15, row.joint_worst < 0.05 && std::abs(row.energy_loss) < 20};
  if (scene == "S6v") return {row.reach_error < 0.7, row.reach_error < 0.05};
  if (scene == "S7") {
    return {row.joint_worst < 0.12 && row.joint_end < 0.005, row.joint_worst < 0.05 && row.joint_end < 0.001};
  }
  if (scene == "S8") {
    const bool asleep = row.asleep_at >= 0;
    return {asleep && row.asleep_at < 2 && row.asleep_ms < 0.002, asleep && row.asleep_at < 1 && row.asleep_ms < 0.001};
  }
  if (scene == "S9") return {o.worst < 0.06, o.worst < 0.03};
  any = false;
  return {};
}

}  // namespace

int count_outside(const scenes::Scene& scene, const std::vector<Place>& places) {
  int outside = 0;
  const bool pit = starts_with(scene.name, "S4") || scene.name == "S5" || scene.name == "S7";
  const bool drum = scene.name == "S9", floor = !drum && !starts_with(scene.name, "S6");
  for (const Place& place : places) {
    if (!place.dynamic) continue;
    const Vec3<double> c = place.centre;
    bool in = !floor || c.y > 0;
    if (pit) in = in && std::abs(c.x) < 5 && std::abs(c.z) < 5;
    if (drum) in = std::hypot(c.x, c.y - 6) < 4.5 && std::abs(c.z) < 4;
    outside += in ? 0 : 1;
  }
  return outside;
}

void judge(Row& row) {
  bool any = false;
  const Bars reached = row.engine == "q16.16" ? small_bars(row, any) : bars(row, any);
  row.failed = lost(row);
  const bool must = reached.must && !row.failed;
  row.bar = !row.ours || !any ? "-" : !must ? "misses" : reached.aim ? "aim" : "must";
}

}  // namespace isostep::bench
