// The report.
// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

namespace isostep::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string print(const char* format, ...) {
  char text[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

/// Our time over the peer's; nothing when it did not run.
std::optional<double> ratio(const Row& row, const std::vector<Row>& rows, const char* peer) {
  for (const Row& other : rows) {
    if (other.scene == row.scene && other.engine == peer && other.ms > 0) return row.ms / other.ms;
  }
  return std::nullopt;
}
std::string ratio_text(std::optional<double> value) { return value ? print("%.2f", *value) : "-"; }

bool is(const Row& row, std::initializer_list<const char*> scenes) {
  for (const char* scene : scenes) {
    if (row.scene == scene) return true;
  }
  return false;
}

std::string overlap_text(const Row& row) {
  if (is(row, {"S6", "S6v"})) return "- | - | - | -";
  const scenes::Overlap& o = row.overlap;
  return print("%.2f | %.3f | %.2f | %u", 1e3 * o.worst, 1e3 * o.mean, 1e3 * o.p99, o.deep);
}

/// What this scene is about.
std::string particular(const Row& row) {
  std::string text;
  if (is(row, {"S1", "S1x5", "S1x10", "S1s"})) {
    text = print("top %+.1f mm, drift %.2f mm", 1e3 * row.top_error, 1e3 * row.drift);
  } else if (is(row, {"S2", "S3", "S8"})) {
    text = print("moved %.1f mm, drop %.1f mm", 1e3 * row.moved, 1e3 * row.drop);
  } else if (is(row, {"S6", "S6v"})) {
    text = print("joint %.2f mm, reach %+.2f mm, loss %.2f J/kg", 1e3 * row.joint_worst, 1e3 * row.reach_error,
                 row.energy_loss);
  } else if (is(row, {"S7"})) {
    text = print("joint %.2f mm, at the end %.3f mm", 1e3 * row.joint_worst, 1e3 * row.joint_end);
  } else if (is(row, {"S9"})) {
    text = print("longest step %.3f ms; 1 s after the last new body worst %.1f mm, %u deep", row.max,
                 1e3 * row.calm.worst, row.calm.deep);
  }
  if (row.outside > 0) text += print("%s%d outside", text.empty() ? "" : ", ", row.outside);
  if (row.faults > 0) text += print("%s%d faulty steps", text.empty() ? "" : ", ", row.faults);
  if (row.asleep_at >= 0) text += print(", asleep at %.2f s, then %.2f us a step", row.asleep_at, 1e3 * row.asleep_ms);
  return text.empty() ? "-" : text;
}

Json json_of(const Row& row, const std::vector<Row>& rows) {
  const auto optional = [](std::optional<double> value) { return value ? Json(*value) : Json(nullptr); };
  Json json = {{"scene", row.scene},
               {"engine", row.engine},
               {"settings", row.settings},
               {"failed", row.failed},
               {"bar", row.bar},
               {"ms_median", row.ms},
               {"ms_p99", row.p99},
               {"ms_max", row.max},
               {"ratio_bullet", optional(ratio(row, rows, "bullet"))},
               {"ratio_ode", optional(ratio(row, rows, "ode"))},
               {"penetration_worst", row.overlap.worst},
               {"penetration_mean", row.overlap.mean},
               {"penetration_p99", row.overlap.p99},
               {"deeper_than_5cm", row.overlap.deep},
               {"close_pairs", row.overlap.pairs},
               {"calm_penetration_worst", row.calm.worst},
               {"kinetic_per_kg", row.kinetic},
               {"energy_loss_per_kg", row.energy_loss},
               {"moved", row.moved},
               {"drift", row.drift},
               {"drop", row.drop},
               {"top_error", row.top_error},
               {"reach_error", row.reach_error},
               {"joint_error_worst", row.joint_worst},
               {"joint_error_end", row.joint_end},
               {"outside", row.outside},
               {"faults", row.faults},
               {"asleep_at_s", row.asleep_at >= 0 ? Json(row.asleep_at) : Json(nullptr)},
               {"asleep_step_ms", row.asleep_ms >= 0 ? Json(row.asleep_ms) : Json(nullptr)}};
  return json;
}

}  // namespace

std::string heading() {
  return "| scene | engine | ms | p99 | / Bullet | / ODE | worst mm | mean mm | p99 mm | > 5 cm | J/kg | of this scene "
         "| bar |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string table_of(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    text += print("| %s | %s | %.4f%s | %.4f | %s | %s | ", row.scene.c_str(), row.engine.c_str(), row.ms,
                  row.failed ? " x" : "", row.p99, ratio_text(ratio(row, rows, "bullet")).c_str(),
                  ratio_text(ratio(row, rows, "ode")).c_str());
    text += overlap_text(row) + print(" | %.1e | ", row.kinetic) + particular(row) + " | " + row.bar + " |\n";
  }
  return text;
}

std::string json_of(const std::vector<Row>& rows, const std::vector<RollbackRow>& rollback,
                    const RaceOptions& options) {
  Json json = {{"rounds", options.rounds},
               {"block_frames", options.block},
               {"runs", Json::array()},
               {"rollback", Json::array()}};
  for (const Row& row : rows) json["runs"].push_back(json_of(row, rows));
  for (const RollbackRow& row : rollback) {
    json["rollback"].push_back({{"scene", row.scene},
                                {"scalar", row.scalar},
                                {"awake", row.awake},
                                {"save_us", row.save_us},
                                {"load_us", row.load_us},
                                {"hash_us", row.hash_us},
                                {"step_ms", row.step_ms},
                                {"eight_frames_ms", row.eight_frames_ms},
                                {"snapshot_bytes", row.snapshot_bytes},
                                {"bytes_per_awake_body", row.bytes_per_awake}});
  }
  return json.dump(1) + "\n";
}

}  // namespace isostep::bench
