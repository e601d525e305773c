// Files that hold worlds: recordings and snapshots, read whole, and how they are refused.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files.hpp"
#include "isostep/replay/world_kinds.hpp"
#include "isostep/state/verify.hpp"

namespace isostep::tool {

struct Input {
  std::string path;
  std::vector<std::uint8_t> bytes;
  ReplayReader replay;  // of the bytes; says what is wrong with those that are no replay

  explicit Input(const std::string& p) : path(p), bytes(read_file(p)), replay(bytes) {}
  bool is_replay() const { return has_replay_magic(bytes); }
};

/// Ends with the exit status of `verify` for such a file.
[[noreturn]] void refuse(const std::string& path, VerifyOutcome outcome, const Error& error);

/// The world of a file that is whole blocks with a start; others are refused. A cut one gets a line on stderr.
RecordedWorld world_of(const Input& input);

}  // namespace isostep::tool
