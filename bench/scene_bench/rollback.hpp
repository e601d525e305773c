// What a rollback costs in a settled scene, one row a scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isostep::bench {

struct RollbackRow {
  std::string scalar;
  double save_us = 0, load_us = 0, hash_us = 0;
  double step_ms = 0;
  double eight_frames_ms = 0;  // load, then eight times step, save and hash
  std::size_t snapshot_bytes = 0;
  double bytes_per_awake = 0;
};

/// The scene is run for its frames first. `scalars` names those wanted.
std::vector<RollbackRow> measure_rollback(std::string_view scene, const std::vector<std::string>& scalars);

}  // namespace isostep::bench
