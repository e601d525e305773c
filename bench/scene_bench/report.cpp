// The report.
// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare.hpp"
#include "dated.hpp"
#include "scenes/shapes.hpp"
#include "text.hpp"

namespace isostep::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string ratio_text(const Row& row, const std::optional<Fastest>& peer) {
  if (!peer || shown_ms(row) < 0) return "-";
  return print("%.2f", shown_ms(row) / peer->ms);
}

bool is(const Row& row, std::initializer_list<const char*> scenes) {
  for (const char* scene : scenes) {
    if (row.scene == scene) return true;
  }
  return false;
}

/// Scenes after Box3D's and Jolt's, of which the mean overlap is told.
constexpr std::initializer_list<const char*> kTheirPiles = {
    "large_pyramid", "many_pyramids", "jolt_pyramid", "convex_pile", "junkyard", "washer", "convex_on_land"};
/// [m] A tooth of a wheel is so long.
constexpr double kTooth = scenes::kTurn / 40;

/// [m] The error of a run that the chart shows: the one that its scene is about.
double error_of(const Row& row) {
  if (is(row, {"slider_crank"})) return row.figure / 1000;
  if (is(row, {"braked_gears"})) return row.figure * kTooth;
  if (is(row, {"S1", "S1x5", "S1x10", "S1s"})) return std::abs(row.top_error);
  if (is(row, {"S4", "S4s", "S5", "S10", "S10s", "S11", "S12"}) || is(row, kTheirPiles)) return row.overlap.mean;
  if (is(row, {"S6", "S6v", "S7", "S20", "joint_grid", "human_rain", "figures"})) return row.joint_worst;
  return row.overlap.worst;
}

/// The text of what this scene is about.
std::string particular(const Row& row) {
  std::string text;
  if (is(row, {"S1", "S1x5", "S1x10", "S1s"})) {
    text = print("top %+.1f mm, drift %.2f mm", 1e3 * row.top_error, 1e3 * row.drift);
  } else if (is(row, {"S2", "S3", "S8"})) {
    text = print("moved %.1f mm, drop %.1f mm", 1e3 * row.moved, 1e3 * row.drop);
  } else if (is(row, {"S6", "S6v"})) {
    text = print("joint %.2f mm, reach %+.2f mm, loss %.2f J/kg", 1e3 * row.joint_worst, 1e3 * row.reach_error,
                 row.energy_loss);
  } else if (is(row, {"S7", "joint_grid", "human_rain"})) {
    text = print("joint %.2f mm, at the end %.3f mm", 1e3 * row.joint_worst, 1e3 * row.joint_end);
  } else if (is(row, {"S20", "figures"})) {
    text = print("joint %.2f mm, at the end %.3f mm; limits passed by %.3f rad, at the end %.4f", 1e3 * row.joint_worst,
                 1e3 * row.joint_end, row.limit_worst, row.limit_end);
  } else if (is(row, {"S9"})) {
    text = print("longest step %.3f ms", row.max);
  }
  if (is(row, {"slider_crank"})) {
    text = print("piston %.3g mm from where the crank puts it; crank %.4f rad/s, joint %.3g mm", row.figure,
                 row.speeds[0], 1e3 * row.joint_worst);
  } else if (is(row, {"braked_gears"})) {
    text = print("%.3g teeth slipped; %.4f rad/s, ratios %.5f, %.5f", row.figure, row.speeds[0],
                 row.speeds[1] / row.speeds[0], row.speeds[2] / row.speeds[0]);
  }
  if (row.through >= 0) text = print("%d through", row.through);
  if (row.bump >= 0) text = print("bump %.2f mm/s", 1e3 * row.bump);
  if (row.outside > 0) text += print("%s%d outside", text.empty() ? "" : ", ", row.outside);
  if (row.faults > 0) text += print("%s%d faulty steps", text.empty() ? "" : ", ", row.faults);
  if (row.asleep_at >= 0) text += print(", asleep at %.2f s, then %.2f us a step", row.asleep_at, 1e3 * row.asleep_ms);
  return text.empty() ? "-" : text;
}

Json positive(double value) { return value >= 0 ? Json(value) : Json(nullptr); }

Json json_of(const Row& row, const FastestPeers& fastest) {
  if (!row.refused.empty()) return {{"scene", row.scene}, {"engine", row.engine}, {"refused", row.refused}};
  const auto ratio = [&](const std::optional<Fastest>& peer) {
    return peer ? positive(shown_ms(row) / peer->ms) : Json(nullptr);
  };
  return {{"scene", row.scene},
          {"engine", row.engine},
          {"settings", row.settings},
          {"failed", row.failed},
          {"bar", row.bar},
          {"ms_median", row.ms},
          {"ms_p99", row.p99},
          {"ms_max", row.max},
          {"ratio_fastest_here", ratio(fastest.here)},
          {"ratio_fastest_dated", ratio(fastest.dated)},
          {"peak_rss_mb", positive(row.memory.peak)},
          {"rss_before_mb", positive(row.memory.before)},
          {"error", error_of(row)},
          {"penetration_worst", row.overlap.worst},
          {"penetration_mean", row.overlap.mean},
          {"penetration_p99", row.overlap.p99},
          {"deeper_than_5cm", row.overlap.deep},
          {"close_pairs", row.overlap.pairs},
          {"kinetic_per_kg", row.kinetic},
          {"energy_loss_per_kg", row.energy_loss},
          {"moved", row.moved},
          {"drift", row.drift},
          {"drop", row.drop},
          {"top_error", row.top_error},
          {"reach_error", row.reach_error},
          {"joint_error_worst", row.joint_worst},
          {"joint_error_end", row.joint_end},
          {"limit_passed_worst", row.limit_worst},
          {"limit_passed_end", row.limit_end},
          {"energy_gain_per_kg", row.energy_gain},
          {"outside", row.outside},
          {"through", row.through >= 0 ? Json(row.through) : Json(nullptr)},
          {"bump", positive(row.bump)},
          {"figure", row.trial != nullptr ? Json(row.figure) : Json(nullptr)},
          {"speeds", row.speeds},
          {"faults", row.faults},
          {"asleep_at_s", positive(row.asleep_at)},
          {"asleep_step_ms", positive(row.asleep_ms)}};
}

Json json_of(const QueryRow& row) {
  Json json = {{"engine", row.engine}, {"bar", scenes::kReachNames[static_cast<int>(row.reach)]}};
  for (std::size_t kind = 0; kind < kQueryKinds; ++kind) {
    const std::string name = kQueryNames[kind];
    json[name + "_us"] = positive(row.us[kind]);
    json[name + "_hits"] = row.hits[kind] >= 0 ? Json(row.hits[kind]) : Json(nullptr);
  }
  return json;
}

Json json_of(const RollbackRow& row) {
  return {{"scene", row.scene},
          {"scalar", row.scalar},
          {"awake", row.awake},
          {"save_us", row.save_us},
          {"load_us", row.load_us},
          {"hash_us", row.hash_us},
          {"step_ms", row.step_ms},
          {"eight_frames_ms", row.eight_frames_ms},
          {"snapshot_bytes", row.snapshot_bytes},
          {"bytes_per_awake_body", row.bytes_per_awake}};
}

std::vector<std::string> figures(const Row& row, const FastestPeers& fastest) {
  if (!row.refused.empty()) {
    std::vector<std::string> line(13, "-");
    line[0] = row.scene;
    line[1] = row.engine;
    line[11] = print("no figures: %s", row.refused.c_str());
    return line;
  }
  std::vector<std::string> line = {row.scene, row.engine, print("%.4f%s", row.ms, row.failed ? " x" : ""),
                                   print("%.4f", row.p99)};
  line.push_back(ratio_text(row, fastest.here));
  line.push_back(ratio_text(row, fastest.dated));
  const scenes::Overlap& o = row.overlap;
  const bool collides = row.trial == nullptr && !is(row, {"S6", "S6v"});
  for (const double overlap : {o.worst, o.mean, o.p99}) line.push_back(collides ? print("%.3g", 1e3 * overlap) : "-");
  line.push_back(collides ? print("%u", o.deep) : "-");
  line.push_back(print("%.1e", row.kinetic));
  line.push_back(particular(row));
  line.push_back(row.bar);
  return line;
}

std::string every_figure(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> cells = {{"scene", "engine", "ms", "p99", "/ here", "/ dated", "worst mm",
                                                  "mean mm", "p99 mm", "> 5 cm", "J/kg", "of this scene", "bar"}};
  for (const Row& row : rows) cells.push_back(figures(row, fastest_peers(rows, row.scene)));
  return markdown(cells);
}

/// [MB] peak, and before the world was made.
std::string memory_table(const std::vector<Row>& rows) {
  std::vector<std::vector<std::string>> cells = {{"scene", "engine", "peak MB", "before"}};
  for (const Row& row : rows) {
    if (row.memory.peak < 0) continue;
    cells.push_back({row.scene, row.engine, print("%.1f", row.memory.peak), print("%.1f", row.memory.before)});
  }
  return cells.size() == 1 ? "" : markdown(cells);
}

constexpr char kLegend[] =
    "\nCPU time of a step, median of the settled half (S9, and the peers' scenes: of the run), lowest of the rounds. "
    "Bold: the fastest peer. In brackets: ours as a multiple of it. Behind a stroke: an engine's best settings, see "
    "bench/pages/peers.md. x: the scene was lost.\n";
constexpr char kDatedLegend[] =
    "\\* not run here: its time in the run of bench/scene_bench/dated.cpp, times how much slower Rapier SIMD is here, "
    "which is the median of all scenes where it has no time of that run. As a multiple of what it took then: ";
constexpr char kQueryLegend[] =
    "\nQueries of S14, microseconds each, median of ten frames, lowest of the rounds; and how many of all of them "
    "hit:\n\n";
constexpr char kRatioLegend[] =
    "\n/ here, / dated: time as a multiple of the fastest peer measured here, and of the fastest of Rapier SIMD and "
    "those "
    "marked \\*.\n";

}  // namespace

std::string tables_of(const Report& report) {
  std::string text =
      print("%s, %s, best of %d.\n\n", report.date.c_str(), report.processor.c_str(), report.options.rounds);
  text.append(comparison(report.rows)).append(kLegend);
  const std::string then = anchor_since(report.rows);
  if (!then.empty()) text.append(kDatedLegend).append(then).append(". Far from 1: this machine is busy.\n");
  text.append("\n").append(every_figure(report.rows)).append(kRatioLegend);
  const std::string memory = memory_table(report.rows);
  if (!memory.empty()) text.append("\nPeak memory, and before the world was made:\n\n").append(memory);
  if (!report.queries.empty()) text.append(kQueryLegend).append(table_of(report.queries));
  if (!report.rollback.empty()) text.append("\nRollback:\n\n").append(table_of(report.rollback));
  return text;
}

std::string json_of(const Report& report) {
  Json json = {{"date", report.date},
               {"processor", report.processor},
               {"rounds", report.options.rounds},
               {"block_frames", report.options.block},
               {"runs", Json::array()},
               {"queries", Json::array()},
               {"rollback", Json::array()}};
  for (const Row& row : report.rows) json["runs"].push_back(json_of(row, fastest_peers(report.rows, row.scene)));
  for (const QueryRow& row : report.queries) json["queries"].push_back(json_of(row));
  for (const RollbackRow& row : report.rollback) json["rollback"].push_back(json_of(row));
  return json.dump(1) + "\n";
}

std::string chart_points(const Report& report) {
  std::string text = "date\tscene\tengine\tms\terror_mm\tfailed\n";
  const auto add = [&](const std::string& scene, const char* engine, double ms, double error, bool failed) {
    text += print("%s\t%s\t%s\t%.6g\t%.6g\t%d\n", report.date.c_str(), scene.c_str(), engine, ms, 1e3 * error,
                  failed ? 1 : 0);
  };
  std::string scene;  // of the row before
  for (const Row& row : report.rows) {
    if (row.refused.empty() && shown_ms(row) >= 0) {
      add(row.scene, row.engine.c_str(), shown_ms(row), error_of(row), row.failed);
    }
    if (row.scene == scene) continue;
    scene = row.scene;
    for (const char* engine : kDatedEngines) {
      const std::optional<double> ms = estimated_ms(report.rows, scene, engine);
      const std::optional<Dated> then = dated(engine, scene);
      if (ms && then->error >= 0) add(scene, engine, *ms, then->error, then->lost);
    }
  }
  return text;
}

}  // namespace isostep::bench
