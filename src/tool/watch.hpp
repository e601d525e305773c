// Recordings on a page: any replay or desync bundle is played here, alone or beside another, for a browser to show.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "commands.hpp"
#include "page/page.hpp"

namespace isostep::tool {

/// Throws ToolError 69 where this build cannot make pages.
void require_pages();
/// Writes the page. `told`: a line on stdout says so, with its size and `more`.
void write_page(const page::Film& film, const std::string& path, bool told, const std::string& more = "");

/// By its first bytes; false for what is no file.
bool is_recording(const std::string& path);
/// `run` of a recording: an exit status.
int watch(const RunOptions& options);
/// Both, over the frames that both have; of one kind of world and scalar.
void watch_both(const std::string& path_a, const std::string& path_b, const std::string& html);

}  // namespace isostep::tool
