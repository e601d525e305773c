// Writes the two tables.
// SPDX-License-Identifier: MIT
#include "calls_text.hpp"

namespace isostep::c_header {
namespace {

std::string table_of(const Struct& described, const std::string& prefix) {
  const std::string name = prefix + described.name;
  std::string text = "ISO_STRUCT(" + name + ", " + (described.is_sized ? "true" : "false") + ")\n";
  for (const Member& member : described.members) {
    if (member.kind == "reserved") continue;
    const std::string of = member.kind == "struct" ? (member.of_family ? prefix : "iso_") + member.of : member.of;
    text += "ISO_MEMBER(" + name + ", " + std::to_string(member.offset) + ", " + std::to_string(member.size) + ", " +
            member.kind + "_, \"" + of + "\")\n";
  }
  return text;
}

/// ISO_P(what it points to, whether that is const, name) or ISO_V(type, name).
std::string drawn(const Argument& argument) {
  const std::size_t star = argument.type.rfind('*');
  if (star == std::string::npos) return "ISO_V(" + argument.type + ", \"" + argument.name + "\")";
  std::string to = argument.type.substr(0, star);
  const bool is_list = to.find('*') != std::string::npos;  // "const iso_blob* const"
  const bool is_const = is_list ? to.size() > 6 && to.substr(to.size() - 6) == " const" : to.substr(0, 6) == "const ";
  return "ISO_P(" + argument.type + ", \"" + (is_const && !is_list ? to.substr(6) : to) + "\", " +
         (is_const ? "true" : "false") + ", \"" + argument.name + "\")";
}
std::string call_of(const Function& function) {
  const bool is_status = function.returns == "iso_status";
  std::string text = std::string(is_status ? "ISO_CALL" : "ISO_ASK") + "(" + function.name + ", ";
  for (std::size_t i = 0; i < function.arguments.size(); ++i) {
    text += (i == 0 ? "" : ", ") + drawn(function.arguments[i]);
  }
  return text + ")\n";
}
std::string init_of(const Struct& described, const std::string& prefix) {
  return described.is_sized ? "ISO_INIT(" + prefix + described.name + ")\n" : "";
}

}  // namespace

std::string calls_text(const Schema& schema, const std::vector<Function>& functions) {
  std::string text = "// Written by isostep_interface for tests/c.\n#if defined(ISO_STRUCT)\n";
  for (const Struct& described : schema.common) text += table_of(described, "iso_");
  for (const Family& family : schema.families) {
    for (const Struct& described : family.structs) text += table_of(described, "iso_" + family.prefix + "_");
  }
  text += "#endif\n#if defined(ISO_INIT)\n";
  for (const Struct& described : schema.common) text += init_of(described, "iso_");
  for (const Family& family : schema.families) {
    for (const Struct& described : family.structs) text += init_of(described, "iso_" + family.prefix + "_");
  }
  text += "#endif\n#if defined(ISO_CALL)\n";
  for (const Function& function : functions) text += call_of(function);
  return text + "#endif\n";
}

}  // namespace isostep::c_header
