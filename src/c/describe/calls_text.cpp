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

std::string call_of(const Function& function) {
  const bool is_status = function.returns == "iso_status";
  std::string text = std::string(is_status ? "ISO_CALL" : "ISO_ASK") + "(" + function.name;
  for (const Argument& argument : function.arguments) {
    text += ", drawer.draw<" + argument.type + ">(\"" + argument.name + "\")";
  }
  return text + ")\n";
}

}  // namespace

std::string calls_text(const Schema& schema, const std::vector<Function>& functions) {
  std::string text = "// Written by isostep_interface for tests/c.\n#if defined(ISO_STRUCT)\n";
  for (const Struct& described : schema.common) text += table_of(described, "iso_");
  for (const Family& family : schema.families) {
    for (const Struct& described : family.structs) text += table_of(described, "iso_" + family.prefix + "_");
  }
  text += "#endif\n#if defined(ISO_CALL)\n";
  for (const Function& function : functions) text += call_of(function);
  return text + "#endif\n";
}

}  // namespace isostep::c_header
