// A tool's output, line by line.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>

namespace isostep_lint {

/// One word of sh's.
inline std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word += "'";
}

/// Calls `each(line)` for every line that a command prints; false when it fails.
template <class Each> bool run(const std::string& command, Each&& each) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return false;
  std::string line;
  for (int c; (c = std::fgetc(pipe)) != EOF;) {
    if (c == '\n') {
      each(line);
      line.clear();
    } else {
      line += static_cast<char>(c);
    }
  }
  return pclose(pipe) == 0;
}

}  // namespace isostep_lint
