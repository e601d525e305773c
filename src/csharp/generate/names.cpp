// Prefixes go, words are capitalised; what would be ambiguous beside other libraries has a name of its own.
// SPDX-License-Identifier: MIT
#include "names.hpp"

#include <cctype>
#include <map>
#include <set>

namespace isostep::csharp {

const std::vector<Family>& families() {
  static const std::vector<Family> all = {{"f32", "F32", "float", "float"},
                                          {"f64", "F64", "double", "double"},
                                          {"q16", "Fixed16", "Q16", "Q16Unit"},
                                          {"q32", "Fixed32", "Q32", "Q32Unit"}};
  return all;
}
const Family* find_family(const std::string& prefix) {
  for (const Family& each : families()) {
    if (each.prefix == prefix) return &each;
  }
  return nullptr;
}

std::string pascal(const std::string& name) {
  std::string result;
  bool first = true;
  for (const char c : name) {
    if (c == '_') {
      first = true;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    result += static_cast<char>(first ? std::toupper(byte) : std::tolower(byte));
    first = false;
  }
  return result;
}
std::string camel(const std::string& name) {
  static const std::set<std::string> keywords = {"ref",  "in",    "out",  "object", "event",
                                                 "base", "fixed", "lock", "params"};
  std::string result = pascal(name);
  result[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(result[0])));
  return keywords.count(result) != 0 ? "@" + result : result;
}

std::string type_name(const std::string& c_name) {
  static const std::map<std::string, std::string> own = {{"iso_input", "SessionInput"},
                                                         {"iso_game", "SessionGame"},
                                                         {"iso_request", "SessionRequest"},
                                                         {"iso_phase", "SessionPhase"},
                                                         {"iso_event_kind", "SessionEventKind"},
                                                         {"iso_recording", "RecordingKind"},
                                                         {"iso_network", "SimulatedNetwork"},
                                                         {"iso_udp", "UdpTransport"},
                                                         {"iso_body", "BodyId"},
                                                         {"iso_shape", "ShapeId"},
                                                         {"iso_joint", "JointId"},
                                                         {"iso_record", "RecordId"}};
  const auto found = own.find(c_name);
  if (found != own.end()) return found->second;
  std::string name = c_name.substr(4);
  for (const Family& family : families()) {
    if (name.compare(0, family.prefix.size() + 1, family.prefix + "_") == 0)
      name = name.substr(family.prefix.size() + 1);
  }
  return pascal(name);
}

namespace {
/// The longest common beginning, in whole words, of all values' names.
std::string common_prefix(const Enum& of) {
  std::string prefix = of.values.front().name;
  for (const Enumerator& value : of.values) {
    while (value.name.compare(0, prefix.size(), prefix) != 0) prefix.pop_back();
  }
  const std::size_t last = prefix.rfind('_');
  return last == std::string::npos ? "" : prefix.substr(0, last + 1);
}
}  // namespace

std::string enumerator_name(const Enum& of, const std::string& value) {
  std::string name = value.substr(of.values.size() > 1 ? common_prefix(of).size() : 4);
  std::string own;
  for (const char c : of.name.substr(4) + "_") own += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (name.compare(0, own.size(), own) == 0) name = name.substr(own.size());
  return pascal(name);
}

std::string summary(const std::string& comment, const std::string& indent) {
  if (comment.empty()) return "";
  std::string escaped;
  for (const char c : comment)
    escaped += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  std::string result, line = indent + "/// <summary>";
  std::size_t at = 0;
  escaped = std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(escaped[0])))) + escaped.substr(1);
  while (at < escaped.size()) {
    std::size_t end = escaped.find(' ', at);
    if (end == std::string::npos) end = escaped.size();
    const std::string word = escaped.substr(at, end - at);
    const bool last = end == escaped.size();
    if (line.size() + word.size() + (last ? 11 : 1) > 120) {
      while (line.back() == ' ') line.pop_back();
      result += line + "\n";
      line = indent + "/// ";
    }
    line += word;
    if (!last) line += ' ';
    at = end + 1;
  }
  return result + line + "</summary>\n";
}

}  // namespace isostep::csharp
