// `isostep run` of a recording: a page that plays what was recorded.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "commands.hpp"

namespace isostep::tool {

/// The file is a recording by its first bytes; false for what is no file.
bool is_recording(const std::string& path);
/// An exit status. Throws ToolError 64 for options that only a scene's run has.
int watch(const RunOptions& options);

}  // namespace isostep::tool
