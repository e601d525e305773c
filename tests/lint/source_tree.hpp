// The files of the source tree as the rules read them, and how a rule reports what it finds.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace isostep_lint {

struct File {
  std::string path;                // from the root, with slashes
  std::vector<std::string> lines;  // as they are
  std::vector<std::string> code;   // without comments and texts
};

/// The .hpp, .inl and .cpp files below these folders of the root, ascending by path.
std::vector<File> read_tree(const std::filesystem::path& root, const std::vector<std::string>& folders);

/// Prints one line; `line` counts from 0.
void report(const File& file, std::size_t line, const std::string& what);
/// The number of lines that were reported.
int findings();

bool starts_with(const std::string& text, const char* prefix);
bool ends_with(const std::string& text, const std::string& end);

}  // namespace isostep_lint
