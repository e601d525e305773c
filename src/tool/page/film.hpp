// Pages of recordings: any replay or desync bundle is played here, alone or beside another, for a browser to show.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "page.hpp"

namespace isostep::tool {

/// Throws ToolError 69 where this build cannot make pages.
void require_pages();
/// Writes the page. `told`: a line on stdout says so, with its size and `more`.
void write_page(const page::Film& film, const std::string& path, bool told, const std::string& more = "");

/// A page that plays one recording: so many frames, or with -1 all of them, every so many of them.
void film_recording(const std::string& path, int frames, int every, const std::string& html);
/// Both, over the frames that both have; of one kind of world and scalar.
void film_both(const std::string& path_a, const std::string& path_b, const std::string& html);

}  // namespace isostep::tool
