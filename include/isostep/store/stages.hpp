// The step as a list of named stages: the profiler, the divergence finder and the README speak of these.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

enum class Stage : std::uint32_t {
  find_pairs,
  apply_forces,
  update_manifolds,
  colour_constraints,
  prepare,
  solve_substeps,
  store_impulses,
  finalise_bodies,
  continuous,
  update_sensors,
  emit_events,
  update_sleep,
  move_characters,
};
inline constexpr std::uint32_t kStages = 13;
inline constexpr const char* kStageNames[kStages] = {
    "find_pairs",     "apply_forces",   "update_manifolds", "colour_constraints", "prepare",
    "solve_substeps", "store_impulses", "finalise_bodies",  "continuous",         "update_sensors",
    "emit_events",    "update_sleep",   "move_characters"};

/// The number of hashes of one step: before its first stage, then after each.
inline constexpr std::uint32_t kTraceHashes = kStages + 1;

class StageView;  // state/fields.hpp

/// Called after each stage of a step. It sees the world and what the stage left for the next ones, and changes nothing.
struct StageObserver {
  void (*after)(void* user, Stage stage, const StageView& left) = nullptr;
  void* user = nullptr;
};

}  // namespace isostep
