// Reads "typedef uint32_t iso_NAME; enum {...};" and "typedef struct iso_NAME {...} iso_NAME;".
// SPDX-License-Identifier: MIT
#include "section_text.hpp"

#include <map>
#include <regex>

namespace isostep::c_header {
namespace {

constexpr const char* kBegin = "/* Sessions */";
constexpr const char* kEnd = "/* End of sessions */";
using Lines = std::sregex_iterator;

std::string lower(std::string text) {
  for (char& c : text) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}
/// One line, no blanks at its ends.
std::string squeezed(const std::string& text) {
  static const std::regex blanks("[ \\n]+"), ends("^ | $");
  return std::regex_replace(std::regex_replace(text, blanks, " "), ends, "");
}

std::string without_comments(const std::string& text) {
  static const std::regex comment("/\\*[^*]*\\*/");
  return std::regex_replace(text, comment, "");
}

Enum enum_of(const std::string& name, const std::string& body) {
  static const std::regex enumerator("ISO_(\\w+)(?: = (\\d+))?");
  Enum described{name, false, {}, "ISO_"};
  std::uint32_t next = 0;
  const std::string bare = without_comments(body);
  for (Lines at(bare.begin(), bare.end(), enumerator), end; at != end; ++at) {
    if ((*at)[2].matched) next = static_cast<std::uint32_t>(std::stoul((*at)[2]));
    described.values.push_back({lower((*at)[1]), next++});
  }
  return described;
}

/// Of one element; an empty kind: unknown.
Member member_of(const std::string& type, const std::vector<Enum>& enums) {
  static const std::map<std::string, std::pair<const char*, std::size_t>> kNumbers = {
      {"uint8_t", {"u8", 1}},   {"uint16_t", {"u16", 2}}, {"int32_t", {"i32", 4}},
      {"uint32_t", {"u32", 4}}, {"uint64_t", {"u64", 8}}, {"char", {"char", 1}}};
  Member member;
  if (const auto number = kNumbers.find(type); number != kNumbers.end()) {
    member.kind = number->second.first;
    member.size = number->second.second;
  }
  if (type == "callback" || type == "size_t" || type.back() == '*') {
    member.kind = "word";
    member.of = type;
    member.size = 8;
  }
  for (const Enum& described : enums) {
    if (type != "iso_" + described.name) continue;
    member.kind = "enum";
    member.of = described.name;
    member.size = 4;
  }
  return member;
}

/// Natural alignment, and no holes, whatever the width of pointers: what -Wpadded holds the header to.
bool place(Struct& described, Member member) {
  const std::size_t size32 = member.kind == "word" ? 4 : member.size;
  if (member.kind.empty() || described.size % member.size != 0 || described.size32 % size32 != 0) return false;
  if (member.size > described.align) described.align = member.size;
  if (member.name.compare(0, 8, "reserved") == 0) member.kind = "reserved";
  member.offset = described.size;
  member.offset32 = described.size32;
  const std::size_t times = member.count != 0 ? member.count : 1;
  member.size *= times;
  described.size += member.size;
  described.size32 += size32 * times;
  described.members.push_back(member);
  return true;
}

/// An empty `problem` stays so where all of it can be described.
Struct struct_of(const std::string& name, const std::string& body, const Schema& schema, std::string& problem) {
  // The comment above it; type and name, or a callback's name; how many; the comment behind it.
  static const std::regex line(
      "\\n(?:  /\\*([^*]*)\\*/\\n)?  (?:(\\w+\\*?) (\\w+)|\\w+ \\(\\*(\\w+)\\)\\([^;]*\\))(?:\\[(\\d+)\\])?;"
      "(?: +/\\*([^*]*)\\*/)?(?=\\n)");
  Struct described;
  described.name = name;
  std::size_t lines = 0, members = 0;
  for (Lines at(body.begin(), body.end(), line), end; at != end; ++at, ++lines) {
    const bool is_callback = (*at)[4].matched;
    Member member = member_of(is_callback ? "callback" : std::string((*at)[2]), schema.enums);
    member.name = (*at)[is_callback ? 4 : 3];
    if ((*at)[5].matched) member.count = std::stoul((*at)[5]);
    member.comment = squeezed((*at)[6].matched ? (*at)[6] : (*at)[1]);
    if (!place(described, member)) problem = name + "." + member.name;
  }
  for (const char c : without_comments(body)) members += c == ';' ? 1 : 0;
  if (lines < members || described.align == 0 || described.size % described.align != 0) problem = name;
  if (described.size32 == described.size) described.size32 = 0;
  if (described.members.empty()) return described;
  const Member& first = described.members[0];
  described.is_sized = first.name == "size" && first.kind == "u32";  // an iso_input's is the input's
  return described;
}

}  // namespace

std::string add_section(const std::string& header, Schema& schema) {
  const std::size_t begin = header.find(kBegin), end = header.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos) return "no marks";
  const std::string text = header.substr(begin, end - begin);
  static const std::regex enums("typedef uint32_t iso_(\\w+);\\nenum \\{([^}]*)\\};");
  static const std::regex structs("typedef struct iso_(\\w+) \\{([^}]*)\\} iso_\\1;");
  std::string problem;
  for (Lines at(text.begin(), text.end(), enums), last; at != last; ++at) {
    schema.enums.push_back(enum_of((*at)[1], (*at)[2]));
  }
  for (Lines at(text.begin(), text.end(), structs), last; at != last; ++at) {
    const std::string body = (*at)[2];
    schema.common.push_back(struct_of((*at)[1], body, schema, problem));
  }
  return problem;
}

}  // namespace isostep::c_header
