// One frame of two worlds, stage by stage: where their states part.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "isostep/world/command_codec.hpp"
#include "isostep/world/world.hpp"
#include "state_diff.hpp"

namespace isostep::tool {

/// The state after the commands before the step, then after each stage, then after the commands that follow it.
template <class S> std::vector<WorldState<S>> trace_frame(World<S>& world, Bytes tape) {
  struct Trace {
    const World<S>* world;
    std::vector<WorldState<S>> states;
  } trace{&world, {}};
  const auto keep = [](void* user, Stage) {
    Trace& t = *static_cast<Trace*>(user);
    t.states.push_back(t.world->state());
  };
  const auto step = [&] {
    keep(&trace, {});
    world.step({keep, &trace});
  };
  (void)play_tape<S>(
      tape, [&](const Command<S>& command) { return world.apply(command); }, step);
  keep(&trace, {});
  return std::move(trace.states);
}

/// Of such a list of states or of their hashes.
inline const char* stage_name(std::size_t index) {
  if (index == 0) return "commands";
  return index <= kStages ? kStageNames[index - 1] : "commands after the step";
}

struct StageDifference {
  const char* stage;
  std::size_t index;  // into the traces
};
/// The first stage after which the traces differ, with the differences in `report`.
template <class S>
StageDifference first_different_stage(const std::vector<WorldState<S>>& a, const std::vector<WorldState<S>>& b,
                                      DiffReport& report) {
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    diff_states(a[i], b[i], report);
    if (report.any()) return {stage_name(i), i};
  }
  return {"end of the step", 0};
}

}  // namespace isostep::tool
