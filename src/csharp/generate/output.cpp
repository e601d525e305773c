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

int write_or_check(const std::filesystem::path& package, const Files& files, bool check) {
  int differ = 0;
  for (const auto& [name, text] : files) {
    const std::filesystem::path path = package / name;
    if (std::filesystem::exists(path) && read_file(path) == text) continue;
    ++differ;
    if (check) {
      std::fprintf(stderr, "%s: is not what the generator makes; run isostep_csharp\n", path.string().c_str());
      continue;
    }
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) {
      std::fprintf(stderr, "%s: cannot be written\n", path.string().c_str());
      std::exit(1);
    }
  }
  return differ;
}

}  // namespace isostep::csharp
