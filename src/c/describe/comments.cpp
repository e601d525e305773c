// Finds a struct's declaration by its name and a member's comment on its line, or on the lines above it.
// SPDX-License-Identifier: MIT
#include "comments.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

namespace isostep::c_header {
namespace {

namespace fs = std::filesystem;

/// Lines between `struct Name ... {` and its end, by name. Of two structs of one name the first in the order of paths.
using Bodies = std::map<std::string, std::vector<std::string>>;

void read_structs(const fs::path& file, Bodies& bodies) {
  static const std::regex begin("^(?:template <[^>]*> )?struct (\\w+)(?: : ([A-Za-z]+)<S>)? \\{$");
  std::ifstream in(file);
  std::vector<std::string>* open = nullptr;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (open == nullptr && std::regex_match(line, match, begin)) {
      const auto [place, is_new] = bodies.try_emplace(match[1]);
      open = is_new ? &place->second : nullptr;
      if (is_new && match[2].matched) place->second = bodies[match[2]];  // a base's members come first
    } else if (line == "};") {
      open = nullptr;
    } else if (open != nullptr) {
      open->push_back(line);
    }
  }
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" /");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}
bool is_comment(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' ');
  return first != std::string::npos && line.compare(first, 2, "//") == 0;
}

/// Of the declaration in line i: behind it and going on below, or above it.
std::string comment_at(const std::vector<std::string>& lines, std::size_t i) {
  const std::size_t slashes = lines[i].find("//");
  std::string text;
  if (slashes != std::string::npos) {
    text = trimmed(lines[i].substr(slashes));
    // A comment that goes on stands where the first line's begins.
    for (std::size_t k = i + 1; k < lines.size() && is_comment(lines[k]) && lines[k].find("//") + 2 >= slashes; ++k) {
      text += " " + trimmed(lines[k]);
    }
    return text;
  }
  std::size_t first = i;
  while (first > 0 && is_comment(lines[first - 1]) && lines[first - 1].find("//") < 4) --first;
  for (std::size_t k = first; k < i; ++k) text += (text.empty() ? "" : " ") + trimmed(lines[k]);
  return text;
}

std::string comment_of(const std::vector<std::string>& lines, const std::string& member) {
  const std::regex declared("^  [A-Za-z][\\w:<>,\\[\\]]*(?: const)?[ \\*&].*\\b" + member + "\\b.*");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string code = lines[i].substr(0, lines[i].find("//"));
    if (code.find('(') < code.find(member) || code.find("visit") != std::string::npos) continue;
    if (code.find("static ") != std::string::npos || code.find("using ") != std::string::npos) continue;
    if (std::regex_match(code, declared)) return comment_at(lines, i);
  }
  return "";
}

void fill(const Bodies& bodies, std::vector<Struct>& structs) {
  for (Struct& described : structs) {
    const std::string name =
        described.cpp_name == "RayCastHit" || described.cpp_name == "ShapeCastHit" ? "QueryHit" : described.cpp_name;
    const auto found = bodies.find(name);
    if (found == bodies.end()) continue;
    for (Member& member : described.members) {
      if (!member.comment.empty() || member.kind == "reserved") continue;
      const bool is_switch = member.name.compare(0, 4, "has_") == 0 && name != "CReplayInfo";
      member.comment = is_switch ? member.name.substr(4) + " counts" : comment_of(found->second, member.name);
    }
  }
}

}  // namespace

void read_comments(const std::string& root, Schema& schema) {
  std::vector<fs::path> files;
  for (const char* folder : {"include/isostep", "src/c/layout"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(root) / folder)) {
      if (entry.path().extension() == ".hpp") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  Bodies bodies;
  for (const fs::path& file : files) read_structs(file, bodies);
  for (Family& family : schema.families) fill(bodies, family.structs);
  fill(bodies, schema.common);
}

}  // namespace isostep::c_header
