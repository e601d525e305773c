// Which world a recording is of.
// SPDX-License-Identifier: MIT
#include "recorded_file.hpp"

#include <cstdio>

#include "isostep/world/world_kinds.hpp"
#include "tool.hpp"

namespace isostep::tool {

void refuse(const std::string& path, VerifyOutcome outcome, const Error& error) {
  throw ToolError(exit_code(outcome),
                  path + ": " + std::string(error.message.view()) + " (" + std::string(error.place.view()) + ")");
}

ReplayKind kind_of(const Input& input) {
  const ReplayReader replay(input.bytes);
  if (replay.status() == ReplayStatus::corrupt) refuse(input.path, VerifyOutcome::corrupt, replay.error());
  if (replay.status() == ReplayStatus::incompatible) refuse(input.path, VerifyOutcome::incompatible, replay.error());
  if (!replay.has_state()) refuse(input.path, VerifyOutcome::truncated, replay.error());
  if (replay.status() == ReplayStatus::truncated) {
    std::fprintf(stderr, "isostep: %s is cut off: what is left of it is compared\n", input.path.c_str());
  }
  const Result<std::uint64_t> id = replay.header().number("scalar_id");
  if (!id) refuse(input.path, VerifyOutcome::incompatible, id.error());
  const ReplayField* world = replay.header().find(kWorldKey);
  return {world == nullptr ? "" : std::string(world->value.view()), id.value()};
}

}  // namespace isostep::tool
