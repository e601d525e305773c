// One frame of two worlds, stage by stage: where their states part.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "isostep/world/command_codec.hpp"
#include "isostep/world/world.hpp"
#include "state_diff.hpp"

namespace isostep::tool {

template <class S> void apply_commands(World<S>& world, Bytes input) {
  Reader reader(input);
  while (reader.remaining() > 0) {
    const std::optional<Command<S>> command = read_command<S>(reader);
    if (!command || !world.apply(*command)) return;
  }
}

/// The state after the commands, then after each stage.
template <class S> std::vector<WorldState<S>> trace_frame(World<S>& world, Bytes input) {
  struct Trace {
    const World<S>* world;
    std::vector<WorldState<S>> states;
  } trace{&world, {}};
  apply_commands(world, input);
  trace.states.push_back(world.state());
  const auto keep = [](void* user, Stage) {
    Trace& t = *static_cast<Trace*>(user);
    t.states.push_back(t.world->state());
  };
  world.step({keep, &trace});
  return std::move(trace.states);
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
    if (report.any()) return {i == 0 ? "commands" : kStageNames[i - 1], i};
  }
  return {"end of the step", 0};
}

}  // namespace isostep::tool
