// The measurements of the scale benchmark; each gives rows and a Markdown table, the first TSV for the chart too.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "isostep/store/stages.hpp"

namespace isostep::bench {

struct ScaleOptions {
  std::vector<int> sizes = {100, 300, 1000, 3000, 10000, 30000, 50000};
  std::vector<std::string> scenes = {"pyramid", "pile"};
  std::string scalar = "float";
  int settle = 120;  // frames before the first that counts
  int frames = 41;   // that count
  int awake = 100;
  std::vector<int> sleeping = {0, 1000, 10000, 100000};
  int column = 10;  // sleepers an island
  int crowd = 100000;
  std::vector<int> moving = {1000, 10000, 100000};  // of the crowd
  int field = 50000;                                // boxes around the player
  std::vector<int> most = {131072, 262144, 524288};
};

/// Medians of the CPU time of single steps, of a settled crowd of which nobody sleeps.
struct ScaleRow {
  std::string scene;
  unsigned bodies = 0, contacts = 0, points = 0;
  double step_us = 0;
  std::array<double, kStages> stage_us{};
  std::size_t snapshot_bytes = 0;
};
std::vector<ScaleRow> measure_scale(const ScaleOptions& options);
std::string table_of(const std::vector<ScaleRow>& rows);
/// scene, bodies, contacts, ns a body and step, then ns a body of every stage.
std::string tsv_of(const std::vector<ScaleRow>& rows);

/// A world of which nearly all sleeps. Medians of CPU times; all wake by one set_gravity, one call destroys all.
struct SleeperRow {
  unsigned awake = 0, asleep = 0, islands = 0;
  double step_us = 0, save_us = 0, load_us = 0, hash_us = 0;
  std::size_t snapshot_bytes = 0;
  double wake_one_us = 0, destroy_one_us = 0, wake_all_ms = 0, destroy_all_ms = 0, sleep_all_ms = 0;
};
std::vector<SleeperRow> measure_sleepers(const ScaleOptions& options);
std::string table_of(const std::vector<SleeperRow>& rows);

/// A crowd of which a part moves and the rest sleeps. Medians of CPU times.
struct CrowdRow {
  unsigned bodies = 0, awake = 0, contacts = 0;
  double step_us = 0, save_us = 0, load_us = 0, hash_us = 0;
  std::size_t snapshot_bytes = 0;
  double peak_megabytes = 0;  // of the world's build and steps, without snapshots
};
std::vector<CrowdRow> measure_crowds(const ScaleOptions& options);
std::string table_of(const std::vector<CrowdRow>& rows);

/// A player among sleepers: while it stands, and while it is pushed through them. CPU times over all frames.
struct PlayerRow {
  unsigned boxes = 0, awake = 0, most_awake = 0;
  double rest_us = 0, step_us = 0, worst_us = 0, save_us = 0, worst_save_us = 0;
};
PlayerRow measure_player(const ScaleOptions& options);
std::string table_of(const PlayerRow& row);

/// Boxes in rows that fall, all awake: Jolt's MaxBodies of any size. CPU times.
struct MostRow {
  unsigned bodies = 0, contacts = 0;
  double first_us = 0, step_us = 0;  // the first step, and the median of the others
  double peak_megabytes = 0;         // of the world's build and steps
};
std::vector<MostRow> measure_most(const ScaleOptions& options);
std::string table_of(const std::vector<MostRow>& rows);

}  // namespace isostep::bench
