// Text of the reports: printf into a string, and tables that read well raw and as Markdown.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::bench {

std::string print(const char* format, ...);

/// The first line is the head. Columns are as wide as they must be; cells are plain ASCII.
std::string markdown(const std::vector<std::vector<std::string>>& cells);

}  // namespace isostep::bench
