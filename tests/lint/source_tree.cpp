// The reader of source files, and of lines without their comments and texts.
// SPDX-License-Identifier: MIT
#include "source_tree.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <set>

namespace isostep_lint {
namespace {

namespace fs = std::filesystem;

int found = 0;

/// Comments become nothing, texts and characters become empty ones. Raw strings end at the first )".
std::vector<std::string> code_of(const std::vector<std::string>& lines) {
  std::vector<std::string> code;
  bool in_comment = false, in_raw = false;
  for (const std::string& line : lines) {
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (in_comment || in_raw) {
        const char* end = in_comment ? "*/" : ")\"";
        if (line.compare(i, 2, end) == 0) {
          in_comment = in_raw = false;
          ++i;
        }
      } else if (line.compare(i, 2, "//") == 0) {
        break;
      } else if (line.compare(i, 2, "/*") == 0) {
        in_comment = true;
        ++i;
      } else if (line.compare(i, 3, "R\"(") == 0) {
        in_raw = true;
        i += 2;
      } else if (line[i] == '"' ||
                 (line[i] == '\'' && (i == 0 || std::isalnum(static_cast<unsigned char>(line[i - 1])) == 0))) {
        const char quote = line[i];
        for (++i; i < line.size() && line[i] != quote; ++i) i += line[i] == '\\';
        out += quote;
        out += quote;
      } else {
        out += line[i];
      }
    }
    code.push_back(out);
  }
  return code;
}

}  // namespace

std::vector<File> read_tree(const std::filesystem::path& root, const std::vector<std::string>& folders) {
  const std::set<std::string> kinds = {".hpp", ".inl", ".cpp"};
  std::vector<File> files;
  for (const std::string& folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || kinds.count(entry.path().extension().string()) == 0) continue;
      File file{fs::relative(entry.path(), root).generic_string(), {}, {}};
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) file.lines.push_back(line);
      file.code = code_of(file.lines);
      files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.path < b.path; });
  return files;
}

void report(const File& file, std::size_t line, const std::string& what) {
  std::printf("%s:%zu: %s\n", file.path.c_str(), line + 1, what.c_str());
  ++found;
}
int findings() { return found; }

bool starts_with(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }
bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace isostep_lint
