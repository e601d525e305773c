// A header is read as a list of declarations, each with the comment before it or behind it on its line.
// SPDX-License-Identifier: MIT
#include "header_reader.hpp"

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <regex>

namespace isostep::csharp {
namespace {

/// The text on one line, without blanks at its ends.
std::string squeezed(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) result += c;
    else if (!result.empty() && result.back() != ' ') result += ' ';
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

/// Items that end with `end`, outside of all brackets; the comment before an item, or behind it on its line, is that
/// item's.
struct Item {
  std::string text, comment;
};
std::vector<Item> items_of(const std::string& text, char end) {
  std::vector<Item> items;
  Item item;
  bool just_ended = false;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "/*") == 0) {
      const std::size_t close = text.find("*/", i);
      const std::string comment = squeezed(text.substr(i + 2, close - i - 2));
      (just_ended ? items.back() : item).comment = comment;
      i = close + 1;
    } else if (text[i] == end && depth == 0) {
      item.text = squeezed(item.text);
      items.push_back(item);
      item = {};
      just_ended = true;
    } else {
      if (text[i] == '\n') just_ended = false;
      if (text[i] == '{' || text[i] == '(') ++depth;
      if (text[i] == '}' || text[i] == ')') --depth;
      item.text += text[i];
    }
  }
  item.text = squeezed(item.text);
  if (!item.text.empty()) items.push_back(item);
  return items;
}

const std::map<std::string, std::string>& plain_kinds() {
  static const std::map<std::string, std::string> kinds = {
      {"uint8_t", "u8"}, {"uint16_t", "u16"}, {"uint32_t", "u32"}, {"uint64_t", "u64"}, {"int32_t", "i32"},
      {"double", "f64"}, {"float", "f32"},    {"char", "char"},    {"size_t", "handle"}};
  return kinds;
}
bool is_enum(const Schema& schema, const std::string& type) {
  for (const Enum& each : schema.enums) {
    if (each.name == type) return true;
  }
  return false;
}

Member member_of(const Item& item, const Schema& schema) {
  static const std::regex callback("^[^(]*\\(\\*(\\w+)\\).*"),
      plain("^(?:const )?(\\w+) ?(\\*?) ?(\\w+)(?:\\[(\\d+)\\])?$");
  Member member;
  member.comment = item.comment;
  std::smatch match;
  if (std::regex_match(item.text, match, callback)) {
    member.name = match[1];
    member.kind = "handle";
    return member;
  }
  if (!std::regex_match(item.text, match, plain)) {
    std::fprintf(stderr, "a member that is not understood: %s\n", item.text.c_str());
    std::exit(1);
  }
  const std::string type = match[1];
  member.name = match[3];
  if (match[4].matched) member.count = std::stoi(match[4]);
  const auto kind = plain_kinds().find(type);
  if (match[2].length() != 0) member.kind = "handle";
  else if (kind != plain_kinds().end()) member.kind = kind->second;
  else {
    member.kind = is_enum(schema, type) ? "enum" : "struct";
    member.of = type;
  }
  if (member.name.compare(0, 8, "reserved") == 0 && member.count != 0) member.kind = "reserved";
  return member;
}

/// Places members at the offsets that C has on 64 bits.
void place(Struct& made) {
  static const std::map<std::string, int> sizes = {{"u8", 1},  {"char", 1}, {"reserved", 1}, {"bool", 1}, {"u16", 2},
                                                   {"u32", 4}, {"i32", 4},  {"enum", 4},     {"f32", 4},  {"u64", 8},
                                                   {"f64", 8}, {"id", 8},   {"handle", 8}};
  int end = 0, widest = 1;
  for (Member& member : made.members) {
    const int size = sizes.at(member.kind);
    member.offset = (end + size - 1) / size * size;
    end = member.offset + size * (member.count == 0 ? 1 : member.count);
    widest = size > widest ? size : widest;
  }
  made.size = (end + widest - 1) / widest * widest;
}

/// Reads a struct. Returns false when interface.json has it.
bool read_struct(const Item& item, Schema& schema) {
  static const std::regex form("^typedef struct (\\w+) \\{(.*)\\} (\\w+)$");
  std::smatch match;
  if (!std::regex_match(item.text, match, form) || schema.find(match[3]) != nullptr) return false;
  Struct made;
  made.name = match[3];
  made.base = made.name.substr(4);
  schema.structs.push_back(made);
  return true;
}

void read_enumerators(const std::string& body, const std::string& name, Schema& schema) {
  Enum made;
  made.name = name;
  long long next = 0;
  for (const Item& item : items_of(body, ',')) {
    const std::size_t equals = item.text.find(" = ");
    if (equals != std::string::npos) next = std::strtoll(item.text.c_str() + equals + 3, nullptr, 0);
    made.values.push_back({item.text.substr(0, equals), item.comment, next++});
  }
  if (!name.empty() && !is_enum(schema, name)) schema.enums.push_back(made);
  const bool statuses = made.values.back().value < 0;
  if (name.empty()) {
    for (const Enumerator& value : made.values) (statuses ? schema.statuses : schema.constants).push_back(value);
  }
}

void read_function(const Item& item, Schema& schema) {
  Function function;
  const std::string text = item.text.substr(item.text.find("API ") + 4);
  const std::size_t open = text.find('(');
  const std::size_t name = text.find_last_of(" *", open) + 1;
  function.name = text.substr(name, open - name);
  function.returns = squeezed(text.substr(0, name));
  function.comment = item.comment;
  for (const Item& argument : items_of(text.substr(open + 1, text.rfind(')') - open - 1), ',')) {
    if (argument.text == "void") continue;
    const std::size_t at = argument.text.find_last_of(" *") + 1;
    function.arguments.push_back({argument.text.substr(at), squeezed(argument.text.substr(0, at))});
  }
  for (const Function& known : schema.functions) {
    if (known.name == function.name) return;
  }
  schema.functions.push_back(function);
}

}  // namespace

void read_header(const std::string& text, Schema& schema) {
  std::string pending;  // the name of the enumeration that follows
  static const std::regex enum_name("^typedef u?int32_t (\\w+)$"), opaque("^typedef struct (\\w+) (\\w+)$");
  std::size_t at = 0;
  for (const Item& item : items_of(text, ';')) {
    std::smatch match;
    if (std::regex_match(item.text, match, enum_name)) {
      pending = match[1];
    } else if (std::regex_match(item.text, match, opaque)) {
      schema.handles.push_back(match[2]);
    } else if (item.text.compare(0, 6, "enum {") == 0) {
      at = text.find("enum {", at) + 6;
      read_enumerators(text.substr(at, text.find('}', at) - at), pending == "iso_status" ? "" : pending, schema);
      pending.clear();
    } else if (item.text.compare(0, 15, "typedef struct ") == 0) {
      if (!read_struct(item, schema)) continue;
      Struct& made = schema.structs.back();
      at = text.find("typedef struct " + made.name + " {", at);
      at = text.find('{', at) + 1;
      for (const Item& member : items_of(text.substr(at, text.find("} " + made.name, at) - at), ';')) {
        made.members.push_back(member_of(member, schema));
      }
      made.sized = made.members.front().name == "size" && made.members.front().kind == "u32";
      place(made);
    } else if (item.text.compare(0, 4, "ISO_") == 0 && item.text.find("API ") != std::string::npos) {
      read_function(item, schema);
    }
  }
}

}  // namespace isostep::csharp
