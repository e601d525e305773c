// Text of the reports.
// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace isostep::bench {

std::string print(const char* format, ...) {
  char text[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string markdown(const std::vector<std::vector<std::string>>& cells) {
  std::vector<std::size_t> widths(cells.front().size(), 3);
  for (const auto& line : cells) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text.append("| ").append(cells[n][i]).append(widths[i] - cells[n][i].size() + 1, ' ');
    }
    text += "|\n";
    if (n != 0) continue;
    for (const std::size_t width : widths) text.append("|").append(width + 2, '-');
    text += "|\n";
  }
  return text;
}

}  // namespace isostep::bench
