// Writes JSON, a struct, enumeration or function a line or a few.
// SPDX-License-Identifier: MIT
#include "json_text.hpp"

#include "../layout/abi.hpp"
#include "isostep/core/version.hpp"

namespace isostep::c_header {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}
std::string pair(const char* key, const std::string& text) { return quoted(key) + ": " + quoted(text); }
std::string pair(const char* key, std::size_t number) { return quoted(key) + ": " + std::to_string(number); }

/// "[\n" and one row a line.
std::string rows(const std::vector<std::string>& all, const char* indent) {
  std::string text = "[";
  for (std::size_t i = 0; i < all.size(); ++i) text += (i == 0 ? "\n" : ",\n") + std::string(indent) + all[i];
  return text + "]";
}

std::string member_text(const Member& member, const Family* family, bool has_words) {
  std::string text = "{" + pair("name", member.name) + ", " + pair("kind", member.kind);
  if (!member.of.empty()) {
    const std::string prefix = member.of_family && family != nullptr              ? "iso_" + family->prefix + "_"
                               : member.kind == "struct" || member.kind == "enum" ? "iso_"
                                                                                  : "";
    text += ", " + pair("of", prefix + member.of);
  }
  if (member.count != 0) text += ", " + pair("count", member.count);
  text += ", " + pair("offset", member.offset);
  if (has_words) text += ", " + pair("offset32", member.offset32);
  text += ", " + pair("size", member.size);
  if (!member.comment.empty()) text += ", " + pair("comment", member.comment);
  return text + "}";
}

std::string struct_text(const Struct& described, const Family* family) {
  const std::string prefix = family != nullptr ? "iso_" + family->prefix + "_" : "iso_";
  const bool has_words = described.size32 != 0;
  std::vector<std::string> members;
  for (const Member& member : described.members) members.push_back(member_text(member, family, has_words));
  return "{" + pair("name", prefix + described.name) + ", " + pair("base", described.name) + ", " +
         pair("family", family != nullptr ? family->prefix : "") +
         ", \"sized\": " + (described.is_sized ? "true" : "false") + ", " + pair("size", described.size) + ", " +
         (has_words ? pair("size32", described.size32) + ", " : "") + pair("align", described.align) +
         ", \"members\": " + rows(members, "      ") + "}";
}

std::string enum_json(const Enum& described) {
  std::vector<std::string> values;
  for (const Enumerator& value : described.values) {
    values.push_back("{" + pair("name", name_of(value, described)) + ", " + pair("base", value.name) + ", " +
                     pair("value", value.value) + "}");
  }
  return "{" + pair("name", "iso_" + described.name) + ", \"flags\": " + (described.is_flags ? "true" : "false") +
         ", \"values\": " + rows(values, "      ") + "}";
}

std::string function_text(const Function& function) {
  std::string arguments;
  for (const Argument& argument : function.arguments) {
    arguments += (arguments.empty() ? "" : ", ") + ("{" + pair("name", argument.name) + ", ") +
                 pair("type", argument.type) + "}";
  }
  return "{" + pair("name", function.name) + ", " + pair("returns", function.returns) + ", " +
         pair("family", function.family) + ", \"arguments\": [" + arguments + "]" +
         (function.comment.empty() ? "" : ", " + pair("comment", function.comment)) + "}";
}

std::string family_text(const Family& family) {
  return "{" + pair("prefix", family.prefix) + ", " + pair("scalar", family.scalar) + ", " +
         pair("number", family.number) + ", " + pair("unit", family.unit) + ", " +
         pair("bits", static_cast<std::size_t>(family.bits)) + ", " +
         pair("fraction_bits", static_cast<std::size_t>(family.fraction_bits)) + ", " +
         pair("unit_fraction_bits", static_cast<std::size_t>(family.unit_fraction_bits)) + "}";
}

}  // namespace

std::string json_text(const Schema& schema, const std::vector<Function>& functions) {
  std::vector<std::string> families, enums, pointers, structs, declared;
  for (const Family& family : schema.families) families.push_back(family_text(family));
  for (const Enum& described : schema.enums) enums.push_back(enum_json(described));
  for (const PointerType& type : pointer_types()) {
    pointers.push_back("{" + pair("name", type.name) + ", " + pair("to", type.to) + "}");
  }
  for (const Struct& described : schema.common) structs.push_back(struct_text(described, nullptr));
  for (const Family& family : schema.families) {
    for (const Struct& described : family.structs) structs.push_back(struct_text(described, &family));
  }
  for (const Function& function : functions) declared.push_back(function_text(function));
  return "{\n" + pair("version", kVersionText) + ",\n" + pair("abi", c::kAbiVersion) +
         ",\n\"families\": " + rows(families, "  ") + ",\n\"enums\": " + rows(enums, "  ") +
         ",\n\"pointers\": " + rows(pointers, "  ") + ",\n\"structs\": " + rows(structs, "  ") +
         ",\n\"functions\": " + rows(declared, "  ") + "\n}\n";
}

}  // namespace isostep::c_header
