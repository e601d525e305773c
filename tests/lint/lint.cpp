// Reads the source tree and holds the rules that no compiler holds: floors, banned words, the form of a file.
// SPDX-License-Identifier: MIT
//
// lint floors|words|macros|pinned|aggregates|form ROOT: prints one line a finding, exits 1 when there is one.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "floors.hpp"
#include "source_tree.hpp"

namespace {

namespace fs = std::filesystem;
using namespace isostep_lint;

// ---- words

struct Ban {
  const char* signs;  // texts, one of which every match holds: a line without them is not searched
  const char* pattern;
  const char* why;
  bool above_scalar;           // only in include/
  const char* only = nullptr;  // in files whose path begins so
};
const Ban kBans[] = {
    {"std::",
     "std::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma|"
     "fmod|"
     "remainder|fmin|fmax|round|rint|nearbyint|lround|ldexp|frexp)\\b",
     "the C library's answer differs between machines", false},
    {"std::", "std::(sort|partial_sort|nth_element|make_heap|push_heap|pop_heap)\\b",
     "order of equals is unspecified: use stable_sort.hpp", false},
    {"std::", "std::(unordered_|hash\\b)", "iteration order and hash values differ between libraries", false},
    {"std::", "std::(function|any|bind|regex|thread|mutex|async)\\b", "not in the engine", false},
    {"std::", "std::(random_device|mt19937|minstd|.*_distribution|shuffle)",
     "differs between libraries: use core/random.hpp", false},
    {"std::|clock_gettime|__rdtsc", "std::(chrono|clock|time)\\b|\\bclock_gettime\\b|\\b__rdtsc\\b",
     "a step knows no clock", false},
    {"std::|printf", "std::(cout|cerr|clog|printf|fprintf|puts|fopen|ofstream|ifstream)\\b|\\bprintf\\s*\\(",
     "the library does not print", false},
    {"exit|abort|terminate", "std::(exit|abort|terminate)\\b|\\b(exit|abort|terminate)\\s*\\(",
     "the library does not end programs", false},
    {"rand|time|clock|alloc", "(^|[^_:.>a-z])(rand|srand|time|clock|malloc|realloc)\\s*\\(",
     "not reproducible, or not ours to call", false},
    {"throw|try|catch|dynamic_cast|typeid", "\\b(throw|try|catch|dynamic_cast|typeid)\\b",
     "built without exceptions and RTTI as well", false},
    {"virtual", "\\bvirtual\\b", "closed sets are tables, not objects behind pointers", false},
    {"long", "\\blong\\b", "its width differs between platforms", false},
    {"goto", "\\bgoto\\b", "no", false},
    {"double_t|float_t|long double", "\\bdouble_t\\b|\\bfloat_t\\b|\\blong double\\b",
     "its width differs between platforms", false},
    {"assert", "\\bassert\\s*\\(", "ISO_ASSERT", false},
    {"#include",
     "#include "
     "<(cmath|math\\.h|random|functional|unordered_map|unordered_set|chrono|ctime|thread|mutex|iostream|cstdio|regex|"
     "algorithm|numeric)>",
     "see the words that it brings", false},
    {"f|F", "[0-9]\\.?[0-9]*(e[-+]?[0-9]+|p[-+]?[0-9]+)?[fF]\\b(?!\\.)",
     "constants enter as S(0.5), which is every scalar's own", true},
    {"kIsFixed|floating_point|kExact", "\\b(kIsFixed|floating_point|is_floating_point(_v)?|kExact)\\b",
     "what tells float from fixed lives in scalar/", true},
    {"same_as|is_same_v", "\\b(same_as|is_same_v)<S, (float|double)>", "what tells float from fixed lives in scalar/",
     true},
    {"float|double", "\\b(float|double)\\b",
     "sessions count in integers, so their inline functions need not be ISO_INLINE", true, "include/isostep/session/"},
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
    {"systems/motion/render_poses.inl", "1.0f", "the interpolation for drawing, which is in float for every scalar"},
    {"peer/session_core.hpp", "virtual", "a session is never copied, hashed or rolled back"},
    {"peer/controls.hpp", "virtual", "likewise"},
    {"peer/peer_role.hpp", "virtual", "a session is never copied, hashed or rolled back"},
    {"draw/debug_draw.hpp", "virtual", "what draws is outside of worlds: never copied, hashed or rolled back"},
    {".cpp", "<algorithm>", "min, max and all_of leave no order open; those that do are banned by name"},
    {"_text.cpp", "<cstdio>", "snprintf, into memory of its own"},
    {"instantiate/engine.inl", "kIsFixed", "floating formats are not added by users: a message, not a case"},
};

bool is_excepted(const File& file, const std::string& line) {
  return std::any_of(std::begin(kExceptions), std::end(kExceptions), [&](const Exception& exception) {
    return ends_with(file.path, exception.path) && line.find(exception.word) != std::string::npos;
  });
}

/// The line has one of the texts, which '|' parts.
bool has_sign(const std::string& line, std::string_view signs) {
  while (!signs.empty()) {
    const std::size_t end = std::min(signs.find('|'), signs.size());
    if (line.find(signs.substr(0, end)) != std::string::npos) return true;
    signs.remove_prefix(std::min(end + 1, signs.size()));
  }
  return false;
}

void check_words(const fs::path& root) {
  std::vector<std::regex> patterns;
  for (const Ban& ban : kBans) {
    patterns.emplace_back(ban.pattern, std::regex::ECMAScript | std::regex::optimize);
  }
  for (const File& file : read_tree(root, {"scalar", "include", "src/isostep"})) {
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      const std::string& line = file.code[i];
      if (line.find_first_not_of(" \t}{;") == std::string::npos) continue;
      for (std::size_t b = 0; b < patterns.size(); ++b) {
        if (kBans[b].above_scalar && starts_with(file.path, "scalar/")) continue;
        if (kBans[b].only != nullptr && !starts_with(file.path, kBans[b].only)) continue;
        if (!has_sign(line, kBans[b].signs)) continue;
        std::smatch match;
        if (!std::regex_search(line, match, patterns[b]) || is_excepted(file, file.lines[i])) continue;
        report(file, i, "\"" + match.str() + "\": " + kBans[b].why);
      }
    }
  }
}

// ---- macros

struct Foreign {
  const char* words;
  const char* header;
};
const Foreign kForeign[] = {
    {"near|far|small|hyper|boolean|pascal|cdecl|interface|IN|OUT|OPTIONAL|ERROR|NO_ERROR|DELETE|STRICT|ABSOLUTE|"
     "RELATIVE|"
     "DIFFERENCE|TRANSPARENT|OPAQUE|INFINITE|IGNORE|CONST|VOID|PURE|THIS|rad[1-9]|grp[1-9]|psh[1-9]",
     "<windows.h>"},
    {"slots|signals|emit|foreach|forever", "Qt"},
    {"check|verify|ensure|unimplemented|TEXT|PI|INDEX_NONE", "Unreal's Core"},
    {"check|verify|require|nil|Nil|YES|NO", "<AssertMacros.h> of macOS"},
    {"None|Bool|Status|Success|Always|Above|Below|True|False|Unsorted|CursorShape|FocusIn|FocusOut|KeyPress|KeyRelease|"
     "Expose|DestroyAll|GrayScale|Nonlinear|Ancestor|Inferior",
     "<X11/X.h>"},
    {"major|minor|makedev", "<sys/sysmacros.h>"},
};
/// The header that may define a word as a macro, or nothing.
const char* definer_of(const std::string& word) {
  static const std::vector<std::regex> patterns = [] {
    std::vector<std::regex> all;
    for (const Foreign& foreign : kForeign) all.emplace_back(foreign.words);
    return all;
  }();
  static std::map<std::string, const char*> known;  // a word is written many times
  const auto [at, fresh] = known.insert({word, nullptr});
  for (std::size_t f = 0; fresh && at->second == nullptr && f < patterns.size(); ++f) {
    if (std::regex_match(word, patterns[f])) at->second = kForeign[f].header;
  }
  return at->second;
}

/// A game includes its other headers first: what they define as macros is no name of ours.
void check_macros(const fs::path& root) {
  constexpr const char* kWordLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  for (const File& file : read_tree(root, {"scalar/include", "include"})) {
    if (ends_with(file.path, "/eigen_fixed.hpp")) continue;  // its class has the names that Eigen's have
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      const std::string& line = file.code[i];
      if (starts_with(line, "#include")) continue;
      for (std::size_t at = line.find_first_of(kWordLetters); at != std::string::npos;) {
        const std::size_t end = std::min(line.find_first_not_of(kWordLetters, at), line.size());
        const std::string word = line.substr(at, end - at);
        if (const char* header = definer_of(word)) report(file, i, "\"" + word + "\": a macro of " + header);
        at = line.find_first_of(kWordLetters, end);
      }
    }
  }
}

// ---- pinned

/// Functions for games that the library compiles compute in a pinned float environment: each body in math/ is a call of
/// pin_floats, so that a new one cannot forget it. What is ISO_INLINE follows its caller. A guard in a scope pins
/// nothing for sure, since compilers move arithmetic out of it.
void check_pinned(const fs::path& root) {
  for (const File& file : read_tree(root, {"include", "src"})) {
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      if (file.code[i].find("FloatEnvironment") != std::string::npos)
        report(file, i, "arithmetic leaves the scope of a FloatEnvironment: call pin_floats");
    }
  }
  const std::regex function("^template <[^>]*>+ (?!struct|class|using)[^=;]*\\(.*");
  for (const File& file : read_tree(root, {"include/isostep/math"})) {
    if (!ends_with(file.path, ".inl")) continue;
    bool ours = false;  // in a namespace of the engine's own
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      const std::string& line = file.code[i];
      if (starts_with(line, "namespace detail")) ours = true;
      if (starts_with(file.lines[i], "}  // namespace detail")) ours = false;
      if (ours || line.find("ISO_INLINE") != std::string::npos || !std::regex_match(line, function)) continue;
      std::string body;
      for (std::size_t j = i; j < file.code.size() && j < i + 4; ++j) body += file.code[j];
      if (body.find("{  return pin_floats(") == std::string::npos)
        report(file, i, "a function that the library compiles begins with return pin_floats(");
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
      if (line == "namespace {" && ends_with(file.path, "_test.cpp"))
        report(file, i, "one unit holds several tests: their names stand in a namespace of the file's name");
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
  else if (rule == "macros") check_macros(arguments[2]);
  else if (rule == "pinned") check_pinned(arguments[2]);
  else if (rule == "aggregates") check_aggregates(arguments[2]);
  else if (rule == "form") check_form(arguments[2]);
  else return std::fprintf(stderr, "lint floors|words|macros|pinned|aggregates|form ROOT\n"), 64;
  return findings() == 0 ? 0 : 1;
}
