// Reads the source tree and holds the rules that no compiler holds: floors, banned words, the form of a file.
// SPDX-License-Identifier: MIT
//
// lint floors|words|aggregates|form ROOT: prints one line a finding, exits 1 when there is one.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct File {
  std::string path;                // from the root, with slashes
  std::vector<std::string> lines;  // as they are
  std::vector<std::string> code;   // without comments and texts
};

int findings = 0;
void report(const File& file, std::size_t line, const std::string& what) {
  std::printf("%s:%zu: %s\n", file.path.c_str(), line + 1, what.c_str());
  ++findings;
}

bool starts_with(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }
bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

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

std::vector<File> read_tree(const fs::path& root, const std::vector<std::string>& folders) {
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

// ---- floors

/// "isostep/<folder>/..." or the path of a file -> its folder, "src" for everything there.
std::string folder_of(const std::string& path) {
  static const std::regex pattern("^(?:include/|scalar/include/)?isostep/([a-z]+)/.*");
  std::smatch match;
  if (std::regex_match(path, match, pattern)) return match[1];
  return starts_with(path, "src/") ? "src" : "";
}

void check_floors(const fs::path& root) {
  // From DESIGN: scalar is below core, for it is a target of its own.
  const std::map<std::string, int> floors = {{"scalar", 0},   {"core", 1},      {"math", 2},    {"state", 2},
                                             {"geometry", 3}, {"particles", 3}, {"session", 3}, {"collision", 4},
                                             {"dynamics", 5}, {"world", 6},     {"effects", 6}, {"src", 7}};
  static const std::regex include("^\\s*#include \"((?:isostep/)[^\"]+)\".*");
  std::map<std::string, std::vector<std::string>> graph;
  for (const File& file : read_tree(root, {"scalar/include", "include", "src"})) {
    if (file.path == "include/isostep/isostep.hpp") continue;  // all of it, for users alone: it has no floor
    const std::string from = folder_of(file.path);
    if (floors.count(from) == 0) {
      report(file, 0, "the folder \"" + from + "\" has no floor");
      continue;
    }
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_match(file.lines[i], match, include)) continue;
      const std::string target = match[1];
      const std::string to = folder_of(target);
      graph[file.path.substr(file.path.find("isostep/") == std::string::npos ? 0 : file.path.find("isostep/"))]
          .push_back(target);
      if (floors.count(to) == 0) {
        report(file, i, target + " has no floor");
        continue;
      }
      const bool neighbours = (from == "effects" && to == "world") || (from == "world" && to == "effects");
      if (from != to && !neighbours && floors.at(to) >= floors.at(from)) {
        report(file, i, from + " may not include " + to + ": that floor is not below");
      }
      if (ends_with(file.path, ".hpp") && ends_with(target, ".inl")) {
        report(file, i, "a header includes bodies: users would compile them with their own flags");
      }
    }
  }
  // No cycles: what may include what is an order also inside a folder.
  std::map<std::string, int> state;  // 1 open, 2 done
  std::vector<std::pair<std::string, std::size_t>> stack;
  for (const auto& [start, unused] : graph) {
    if (state[start] != 0) continue;
    state[start] = 1;
    stack.push_back({start, 0});
    while (!stack.empty()) {
      const std::string node = stack.back().first;
      if (stack.back().second == graph[node].size()) {
        state[node] = 2;
        stack.pop_back();
        continue;
      }
      const std::string next = graph[node][stack.back().second++];
      if (state[next] == 1) report({node, {}, {}}, 0, "includes " + next + ", which leads back here");
      if (state[next] == 0) {
        state[next] = 1;
        stack.push_back({next, 0});
      }
    }
  }
}

// ---- words

struct Ban {
  const char* pattern;
  const char* why;
  bool above_scalar;           // only in include/
  const char* only = nullptr;  // in files whose path begins so
};
const Ban kBans[] = {
    {"std::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma|"
     "fmod|"
     "remainder|fmin|fmax|round|rint|nearbyint|lround|ldexp|frexp)\\b",
     "the C library's answer differs between machines", false},
    {"std::(sort|partial_sort|nth_element|make_heap|push_heap|pop_heap)\\b",
     "order of equals is unspecified: use stable_sort.hpp", false},
    {"std::(unordered_|hash\\b)", "iteration order and hash values differ between libraries", false},
    {"std::(function|any|bind|regex|thread|mutex|async)\\b", "not in the engine", false},
    {"std::(random_device|mt19937|minstd|.*_distribution|shuffle)", "differs between libraries: use core/random.hpp",
     false},
    {"std::(chrono|clock|time)\\b|\\bclock_gettime\\b|\\b__rdtsc\\b", "a step knows no clock", false},
    {"std::(cout|cerr|clog|printf|fprintf|puts|fopen|ofstream|ifstream)\\b|\\bprintf\\s*\\(",
     "the library does not print", false},
    {"std::(exit|abort|terminate)\\b|\\b(exit|abort|terminate)\\s*\\(", "the library does not end programs", false},
    {"(^|[^_:.>a-z])(rand|srand|time|clock|malloc|realloc)\\s*\\(", "not reproducible, or not ours to call", false},
    {"\\b(throw|try|catch|dynamic_cast|typeid)\\b", "built without exceptions and RTTI as well", false},
    {"\\bvirtual\\b", "closed sets are tables, not objects behind pointers", false},
    {"\\blong\\b", "its width differs between platforms", false},
    {"\\bgoto\\b", "no", false},
    {"\\bdouble_t\\b|\\bfloat_t\\b|\\blong double\\b", "its width differs between platforms", false},
    {"\\bassert\\s*\\(", "ISO_ASSERT", false},
    {"#include "
     "<(cmath|math\\.h|random|functional|unordered_map|unordered_set|chrono|ctime|thread|mutex|iostream|cstdio|regex|"
     "algorithm|numeric)>",
     "see the words that it brings", false},
    {"[0-9]\\.?[0-9]*(e[-+]?[0-9]+|p[-+]?[0-9]+)?[fF]\\b(?!\\.)",
     "constants enter as S(0.5), which is every scalar's own", true},
    {"\\b(kIsFixed|floating_point|is_floating_point(_v)?|kExact)\\b", "what tells float from fixed lives in scalar/",
     true},
    {"\\b(same_as|is_same_v)<S, (float|double)>", "what tells float from fixed lives in scalar/", true},
    {"\\b(float|double)\\b", "sessions count in integers, so their inline functions need not be ISO_INLINE", true,
     "include/isostep/session/"},
};

struct Exception {
  const char* path;
  const char* word;  // part of the line
  const char* why;
};
const Exception kExceptions[] = {
    {"geometry/limits.hpp", "0x1p", "the published limits of float itself"},
    {"particles/limits.hpp", "0x1p", "likewise"},
    {"math/eigen.hpp", "floating_point", "Eigen knows float and double by their own names"},
    {"world/engine_queries.inl", "1.0f", "the interpolation for drawing, which is in float for every scalar"},
    {"session/core.hpp", "virtual", "a session is never copied, hashed or rolled back"},
    {"session/peer_core.hpp", "virtual", "a session is never copied, hashed or rolled back"},
    {"world/debug_draw.hpp", "virtual", "what draws is outside of worlds: never copied, hashed or rolled back"},
    {"world/instantiate.inl", "kIsFixed", "floating formats are not added by users: a message, not a case"},
};

bool is_excepted(const File& file, const std::string& line) {
  return std::any_of(std::begin(kExceptions), std::end(kExceptions), [&](const Exception& exception) {
    return ends_with(file.path, exception.path) && line.find(exception.word) != std::string::npos;
  });
}

void check_words(const fs::path& root) {
  std::vector<std::regex> patterns;
  for (const Ban& ban : kBans) {
    patterns.emplace_back(ban.pattern, std::regex::ECMAScript | std::regex::optimize);
  }
  for (const File& file : read_tree(root, {"scalar/include", "include"})) {
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      const std::string& line = file.code[i];
      if (line.find_first_not_of(" \t}{;") == std::string::npos) continue;
      for (std::size_t b = 0; b < patterns.size(); ++b) {
        if (kBans[b].above_scalar && starts_with(file.path, "scalar/")) continue;
        if (kBans[b].only != nullptr && !starts_with(file.path, kBans[b].only)) continue;
        std::smatch match;
        if (!std::regex_search(line, match, patterns[b]) || is_excepted(file, file.lines[i])) continue;
        report(file, i, "\"" + match.str() + "\": " + kBans[b].why);
      }
    }
  }
}

// ---- aggregates

/// Vec3<S>(1, 2, 3) is C++20 that clang before 16 does not know: an aggregate takes braces. So do other names of one.
void check_aggregates(const fs::path& root) {
  const std::string ours =
      "(?:Vec3|Quat|Mat3|Aabb|Transform|Pose|Sphere|Box|Capsule|HalfSpace|Child)<[\\w:]+(?:<[\\w:]+>)?>";
  const std::regex alias("^\\s*using (\\w+) = (?:\\w+::)*" + ours + ";.*");
  const std::vector<File> files = read_tree(root, {"src", "tests", "bench"});
  std::set<std::string> aliases;
  std::smatch match;
  for (const File& file : files) {
    for (const std::string& line : file.code) {
      if (std::regex_match(line, match, alias)) aliases.insert(match[1]);
    }
  }
  std::string names = ours;
  for (const std::string& name : aliases) names += "|\\b" + name;
  const std::regex parenthesised("(?:" + names + ")\\([^()]*,", std::regex::ECMAScript | std::regex::optimize);
  for (const File& file : files) {
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      if (!std::regex_search(file.code[i], match, parenthesised)) continue;
      report(file, i, "\"" + match.str() + "\": an aggregate takes braces: clang before 16 knows no others");
    }
  }
}

// ---- form

std::size_t columns(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

void check_form(const fs::path& root) {
  constexpr std::size_t kColumns = 120;
  const std::string licence = "// SPDX-License-Identifier: MIT";
  const std::regex unfinished("\\b(TODO|FIXME|XXX|HACK)\\b");
  const fs::path self = fs::path(__FILE__).filename();
  for (const File& file : read_tree(root, {"scalar", "include", "src", "tests", "bench"})) {
    std::size_t spdx = 0;
    while (spdx < file.lines.size() && starts_with(file.lines[spdx], "//") && file.lines[spdx] != licence) ++spdx;
    if (spdx == file.lines.size() || file.lines[spdx] != licence) {
      report(file, 0, "begins with a comment that ends in \"" + licence + "\"");
      continue;
    }
    if (spdx == 0 || (!ends_with(file.lines[spdx - 1], ".") && !ends_with(file.lines[spdx - 1], "?")))
      report(file, 0, "first says in a sentence what it is for");
    if (!ends_with(file.path, ".cpp")) {
      const auto first =
          std::find_if(file.code.begin(), file.code.end(), [](const std::string& line) { return !line.empty(); });
      if (first == file.code.end() || *first != "#pragma once")
        report(file, spdx, "#pragma once comes before everything else");
    }
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string& line = file.lines[i];
      if (columns(line) > kColumns) report(file, i, std::to_string(columns(line)) + " columns, more than 120");
      if (line.find('\t') != std::string::npos || line.find('\r') != std::string::npos)
        report(file, i, "tab or carriage return");
      if (ends_with(line, " ")) report(file, i, "blank at the end");
      if (fs::path(file.path).filename() != self && std::regex_search(line, unfinished))
        report(file, i, "unfinished work");
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  const std::string rule = count == 3 ? arguments[1] : "";
  if (rule == "floors") check_floors(arguments[2]);
  else if (rule == "words") check_words(arguments[2]);
  else if (rule == "aggregates") check_aggregates(arguments[2]);
  else if (rule == "form") check_form(arguments[2]);
  else return std::fprintf(stderr, "lint floors|words|aggregates|form ROOT\n"), 64;
  return findings == 0 ? 0 : 1;
}
