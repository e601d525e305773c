// Files: read whole, written whole or not at all, or grown as a replay grows.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "isostep/state/replay_format.hpp"

namespace isostep::tool {

/// Throws ToolError 66.
std::vector<std::uint8_t> read_file(const std::string& path);

/// Writes beside the place and then moves the file there, so that nobody meets half of one; devices and pipes are
/// written directly. Throws ToolError 74.
void write_file(const std::string& path, std::string_view content);
void write_file(const std::string& path, Bytes content);

/// Throws ToolError 74 when no file can be made there; an empty name is no file. So that a run does not end in vain.
void expect_writable(const std::string& path);

/// Open for a replay until `close`, beside the place as write_file has it: what was there stays until the new one is
/// whole. A process that is killed leaves a valid beginning in PATH.part, all but its last second; a command that fails
/// leaves nothing.
class ReplayFile {
 public:
  /// Throws ToolError 74.
  explicit ReplayFile(const std::string& path);
  ~ReplayFile();
  ReplayFile(const ReplayFile&) = delete;
  ReplayFile& operator=(const ReplayFile&) = delete;

  ReplaySink sink();
  /// Checks what a recorder wrote there. Throws ToolError 74 with the file and the system's reason, or the recorder's.
  void check(const Result<void>& result) const;
  /// Throws ToolError 74 when the bytes are not safely there.
  void close();

 private:
  std::string path_, aside_;  // aside_: where it is written
  std::FILE* file_;
  int error_ = 0;  // errno of the first bytes that could not be written
};

/// Throws ToolError 74 for what cannot be recorded into memory.
void expect_written(const Result<void>& result);

}  // namespace isostep::tool
