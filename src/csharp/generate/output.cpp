// Files in memory to files on disk.
// SPDX-License-Identifier: MIT
#include "output.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace isostep::csharp {

std::string expand(const std::string& text, const Words& words) {
  std::string result;
  std::size_t at = 0;
  for (;;) {
    const std::size_t begin = text.find('@', at);
    if (begin == std::string::npos) return result + text.substr(at);
    const std::size_t end = text.find('@', begin + 1);
    const std::string word = text.substr(begin + 1, end - begin - 1);
    const auto found = words.find(word);
    if (found == words.end()) {
      std::fprintf(stderr, "a template names @%s@, which nothing replaces\n", word.c_str());
      std::exit(1);
    }
    result += text.substr(at, begin - at) + found->second;
    at = end + 1;
  }
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) {
    std::fprintf(stderr, "%s: cannot be read\n", path.string().c_str());
    std::exit(1);
  }
  return text.str();
}

void write_files(const std::filesystem::path& folder, const Files& files) {
  for (const auto& [name, text] : files) {
    const std::filesystem::path path = folder / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) {
      std::fprintf(stderr, "%s: cannot be written\n", path.string().c_str());
      std::exit(1);
    }
  }
}

}  // namespace isostep::csharp
