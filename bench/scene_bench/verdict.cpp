// The bars of the benchmark set, scene by scene.
// SPDX-License-Identifier: MIT
#include "verdict.hpp"

#include <cmath>
#include <limits>
#include <string_view>

#include "scenes/bars.hpp"

namespace isostep::bench {
namespace {

using scenes::Measure;

bool starts_with(std::string_view name, std::string_view head) { return name.substr(0, head.size()) == head; }

/// S10 to S16, which are no stacks.
bool is_of_shapes(std::string_view scene) {
  return scene.size() > 2 && scene[0] == 'S' && scene[1] == '1' && scene[2] >= '0' && scene[2] <= '6';
}

/// A stack that stands has every box over its neighbour and none lower by half a box.
bool stack_stands(const Row& row) { return row.drift < 0.25 && row.drop < 0.5; }
bool nothing_moved(const Row& row) { return row.moved < 0.25; }

/// [m] A chain whose ends of links are further apart than a link is long is no chain.
constexpr double kLink = 0.5;

/// The bullets that passed are as many as the scene's bar forbids.
bool passed(const Row& row) {
  for (const scenes::Bar& bar : scenes::bars_of(row.scene, false)) {
    if (bar.measure == Measure::through && row.through >= bar.must) return true;
  }
  return false;
}

/// A thin body that hits something fast turns by more than a radian a sub-step: that ours cuts and reports it loses no
/// body.
bool turns_are_cut(const Row& row) {
  return row.ours && (starts_with(row.scene, "S13") || starts_with(row.scene, "S15"));
}

bool lost(const Row& row) {
  const std::string_view scene = row.scene;
  if (row.faults != 0 && !turns_are_cut(row)) return true;
  if (row.trial != nullptr) return !std::isfinite(row.figure);
  if (row.outside != 0 || !std::isfinite(row.kinetic) || passed(row)) return true;
  if (is_of_shapes(scene)) return false;
  if (starts_with(scene, "S1")) return !stack_stands(row);
  if (scene == "S2" || scene == "S3" || scene == "S8") return !nothing_moved(row);
  if (starts_with(scene, "S6")) return row.joint_worst > kLink;
  return false;
}

std::optional<double> value_of(const Row& row, Measure measure) {
  switch (measure) {
    case Measure::top: return row.top_error;
    case Measure::drift: return row.drift;
    case Measure::moved: return row.moved;
    case Measure::stretch: return row.reach_error;
    case Measure::outside: return row.outside;
    case Measure::penetration: return row.overlap.worst;
    case Measure::penetration_mean: return row.overlap.mean;
    case Measure::unrest: return row.kinetic;
    case Measure::joint_error: return row.joint_worst;
    case Measure::joint_end: return row.joint_end;
    case Measure::limit_passed: return row.limit_worst;
    case Measure::limit_end: return row.limit_end;
    case Measure::energy_loss: return row.energy_loss;
    case Measure::energy_gain: return row.energy_gain;
    case Measure::asleep_at: return row.asleep_at < 0 ? std::numeric_limits<double>::infinity() : row.asleep_at;
    case Measure::asleep_ms: return row.asleep_at < 0 ? std::numeric_limits<double>::infinity() : row.asleep_ms;
    case Measure::through: return row.through < 0 ? std::nullopt : std::optional<double>(row.through);
    case Measure::bump: return row.bump < 0 ? std::nullopt : std::optional<double>(row.bump);
  }
  return std::nullopt;
}

}  // namespace

void judge(Row& row) {
  row.failed = lost(row);
  if (row.trial != nullptr) {
    const bool holds = !row.failed && row.figure <= row.trial->bar;
    row.bar = scenes::kReachNames[static_cast<int>(!row.ours ? scenes::Reach::no_bar
                                                   : holds   ? scenes::Reach::must
                                                             : scenes::Reach::misses)];
    return;
  }
  const std::vector<scenes::Bar> bars = scenes::bars_of(row.scene, row.engine == "q16.16");
  const scenes::Reach reach = scenes::reach_of(bars, [&](Measure measure) { return value_of(row, measure); });
  const bool misses = row.failed && reach != scenes::Reach::no_bar;
  row.bar = scenes::kReachNames[!row.ours ? 0 : static_cast<int>(misses ? scenes::Reach::misses : reach)];
}

}  // namespace isostep::bench
