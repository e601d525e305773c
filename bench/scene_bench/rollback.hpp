// The cost of a rollback in a settled scene, one row a scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace isostep::bench {

struct RollbackRow {
  std::string scene, scalar;
  std::uint32_t awake = 0;
  double save_us = 0, load_us = 0, hash_us = 0;
  double step_ms = 0;
  double eight_frames_ms = 0;  // load, then eight times step, save and hash; the script acts before each step
  std::size_t snapshot_bytes = 0;
  double bytes_per_awake = 0;
};

/// The scene is run for its frames first. `scalars` names those wanted.
std::vector<RollbackRow> measure_rollback(std::string_view scene, const std::vector<std::string>& scalars);
/// Markdown, so that it can be pasted.
std::string table_of(const std::vector<RollbackRow>& rows);

}  // namespace isostep::bench
