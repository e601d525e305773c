// The world of a recording.
// SPDX-License-Identifier: MIT
#include "recorded_file.hpp"

#include <cstdio>

#include "tool.hpp"

namespace isostep::tool {

void refuse(const std::string& path, VerifyOutcome outcome, const Error& error) {
  throw ToolError(exit_code(outcome),
                  path + ": " + std::string(error.message.view()) + " (" + std::string(error.place.view()) + ")");
}

RecordedWorld world_of(const Input& input) {
  const ReplayReader& replay = input.replay;
  if (replay.status() == ReplayStatus::corrupt) refuse(input.path, VerifyOutcome::corrupt, replay.error());
  if (replay.status() == ReplayStatus::incompatible) refuse(input.path, VerifyOutcome::incompatible, replay.error());
  if (!replay.has_state()) refuse(input.path, VerifyOutcome::truncated, replay.error());
  if (replay.status() == ReplayStatus::truncated) {
    std::fprintf(stderr, "isostep: %s is cut off: what is left of it is compared\n", input.path.c_str());
  }
  const Result<RecordedWorld> world = recorded_world(replay.header());
  if (!world) refuse(input.path, VerifyOutcome::incompatible, world.error());
  return world.value();
}

}  // namespace isostep::tool
