// Charts by gnuplot, where it is installed.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace isostep::tool::lab {

/// The word within single quotes; inside them `quote` stands for one.
std::string quoted(const std::string& word, const char* quote);
inline std::string shell_quoted(const std::string& word) { return quoted(word, "'\\''"); }

/// bench/chart/NAME.gp draws DIRECTORY/NAME.tsv to NAME.svg beside it. False, and one line on stderr, where gnuplot or
/// the script is not there. Throws ToolError 74.
bool draw_chart(const std::string& directory, const std::string& name);
/// rsvg-convert draws an SVG to a PNG. False, and one line on stderr, where it is not there. Throws ToolError 74.
bool rasterise(const std::string& svg, const std::string& png);

}  // namespace isostep::tool::lab
