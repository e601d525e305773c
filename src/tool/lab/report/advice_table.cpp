// The cheapest setting of each scene that holds its bars.
// SPDX-License-Identifier: MIT
#include "advice_table.hpp"

#include <algorithm>
#include <cmath>

#include "html.hpp"

namespace isostep::tool::lab {
namespace {

using scenes::Measure;
using scenes::Reach;

struct Unit {
  double scale;
  const char* name;
};
Unit unit_of(Measure measure) {
  switch (measure) {
    case Measure::unrest:
    case Measure::energy_loss:
    case Measure::energy_gain: return {1, "J/kg"};
    case Measure::limit_passed:
    case Measure::limit_end: return {1, "rad"};
    case Measure::asleep_at: return {1, "s"};
    case Measure::asleep_ms: return {1e3, "µs"};
    case Measure::bump: return {1e3, "mm/s"};
    case Measure::outside:
    case Measure::through: return {1, ""};
    default: return {1e3, "mm"};
  }
}

/// "worst overlap 40 / 20 mm": must and aim.
std::string text_of(const scenes::Bar& bar) {
  const Unit unit = unit_of(bar.measure);
  const std::string must = std::isfinite(bar.must) ? short_number(unit.scale * bar.must) : "any";
  return std::string(name_of(bar.measure)) + " " + must + " / " + short_number(unit.scale * bar.aim) + " " + unit.name;
}
std::string bars_text(const std::string& scene) {
  std::string text;
  for (const scenes::Bar& bar : scenes::bars_of(scene, false)) text += (text.empty() ? "" : "; ") + text_of(bar);
  return text.empty() ? "-" : text;
}

std::string choice(const LabResult* result, const LabResult* aim) {
  if (result == nullptr) return "none";
  std::string text = setting_of(result->point) + ": " + short_number(result->ms) + " ms";
  if (aim == result) return text + " (aim)";
  if (aim != nullptr) text += "; aim by " + setting_of(aim->point) + ": " + short_number(aim->ms) + " ms";
  return text;
}

std::string fastest_peer(const std::vector<LabResult>& results, const std::string& scene) {
  const LabResult* best = nullptr;
  for (const LabResult& result : results) {
    if (result.point.engine == kOwnEngine || result.point.scene != scene || is_lost(result)) continue;
    if (best == nullptr || is_cheaper(result, *best)) best = &result;
  }
  return best == nullptr ? "-" : best->point.engine + ": " + short_number(best->ms) + " ms";
}

}  // namespace

const LabResult* cheapest_that(const std::vector<LabResult>& results, const std::string& scene,
                               const std::string& scalar, Reach reach) {
  const LabResult* best = nullptr;
  for (const LabResult& result : results) {
    if (result.point.engine != kOwnEngine || result.point.scene != scene) continue;
    if (!scalar.empty() && result.point.scalar != scalar) continue;
    if (reach_of(result) < reach) continue;
    if (best == nullptr || is_cheaper(result, *best)) best = &result;
  }
  return best;
}

std::string setting_of(const LabPoint& point) {
  const std::string count = std::to_string(point.substeps);
  const std::string rate = point.hz == 60 ? "" : " at " + std::to_string(point.hz) + " Hz";
  return point.solver + ", " + count + (counts_passes(point) ? " passes" : " sub-steps") + rate;
}

std::vector<std::vector<std::string>> advice_cells(const ReportData& data) {
  std::vector<std::vector<std::string>> cells(1, {"scene", "bars: must / aim"});
  for (const std::string& scalar : data.plan.scalars) cells[0].push_back(scalar);
  cells[0].push_back("fastest peer that kept it");
  for (const std::string& scene : data.plan.scenes) {
    std::vector<std::string> line = {scene, bars_text(scene)};
    for (const std::string& scalar : data.plan.scalars) {
      const bool any = !scenes::bars_of(scene, scalar == "q16.16").empty();
      line.push_back(!any ? "-"
                          : choice(cheapest_that(data.results, scene, scalar, Reach::must),
                                   cheapest_that(data.results, scene, scalar, Reach::aim)));
    }
    line.push_back(fastest_peer(data.results, scene));
    cells.push_back(std::move(line));
  }
  return cells;
}

}  // namespace isostep::tool::lab
