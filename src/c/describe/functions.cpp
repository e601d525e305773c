// Reads declarations of the form "ISO_FUNCTION type name(type name, ...);".
// SPDX-License-Identifier: MIT
#include "functions.hpp"

#include <map>
#include <regex>

namespace isostep::c_header {
namespace {

constexpr const char* kFamilies[] = {"f32", "f64", "q16", "q32"};

std::string squeezed(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n' || c == '\\' || c == '\t';
    if (!blank) out += c;
    else if (!out.empty() && out.back() != ' ') out += ' ';
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// "const iso_world* world"
Argument argument_of(const std::string& text) {
  const std::size_t at = text.find_last_of(" *") + 1;
  std::string type = text.substr(0, at);
  while (!type.empty() && type.back() == ' ') type.pop_back();
  return {type, text.substr(at)};
}

Function function_of(const std::string& declaration) {
  const std::size_t open = declaration.find('('), close = declaration.rfind(')');
  const Argument named = argument_of(declaration.substr(0, open));
  Function function = {named.name, named.type, "", "", {}};
  for (const char* family : kFamilies) {
    if (named.name.compare(0, 8, std::string("iso_") + family + "_") == 0) function.family = family;
  }
  const std::string list = declaration.substr(open + 1, close - open - 1);
  if (list == "void") return function;
  for (std::size_t at = 0; at < list.size();) {
    std::size_t end = list.find(',', at);
    if (end == std::string::npos) end = list.size();
    function.arguments.push_back(argument_of(squeezed(list.substr(at, end - at))));
    at = end + 1;
    while (at < list.size() && list[at] == ' ') ++at;
  }
  return function;
}

/// By names as the header's macros have them: iso_##P##_body_create, iso_##P##_add_##name.
std::map<std::string, std::string> comments_of(const std::string& header) {
  static const std::regex commented("/\\*((?:[^*]|\\*[^/])*)\\*/[ \\n\\\\]*ISO_API [^;(]*?(iso_[\\w#]+)\\(");
  std::map<std::string, std::string> comments;
  for (std::sregex_iterator at(header.begin(), header.end(), commented), end; at != end; ++at) {
    comments[(*at)[2]] = squeezed((*at)[1]);
  }
  return comments;
}

std::string comment_of(const Function& function, const std::map<std::string, std::string>& comments) {
  std::string name = function.name;
  if (!function.family.empty()) name = "iso_##P##_" + name.substr(8);
  const auto found = comments.find(name);
  if (found == comments.end()) return "";
  return found->second[0] == ' ' ? found->second.substr(1) : found->second;
}

}  // namespace

std::vector<Function> read_functions(const std::string& expanded, const std::string& header) {
  const std::map<std::string, std::string> comments = comments_of(header);
  std::vector<Function> functions;
  const std::string mark = "ISO_FUNCTION ";
  for (std::size_t at = expanded.find(mark); at != std::string::npos; at = expanded.find(mark, at)) {
    at += mark.size();
    functions.push_back(function_of(squeezed(expanded.substr(at, expanded.find(';', at) - at))));
    functions.back().comment = comment_of(functions.back(), comments);
  }
  return functions;
}

}  // namespace isostep::c_header
