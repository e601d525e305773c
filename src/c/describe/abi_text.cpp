// Writes the facts in the order of the schema.
// SPDX-License-Identifier: MIT
#include "abi_text.hpp"

namespace isostep::c_header {
namespace {

std::string facts_of(const Struct& described, const std::string& prefix) {
  const std::string name = prefix + described.name;
  std::string text = (described.is_sized ? "sized " : "plain ") + name + " " + std::to_string(described.size) + "\n";
  for (const Member& member : described.members) {
    if (member.kind == "reserved") continue;
    text += "member " + name + "." + member.name + " " + std::to_string(member.offset) + " " +
            std::to_string(member.size) + " " + member.kind + (member.of.empty() ? "" : ":" + member.of) + "\n";
  }
  return text;
}

}  // namespace

std::string abi_text(const Schema& schema, const std::vector<Function>& functions) {
  std::string text;
  for (const Enum& described : schema.enums) {
    for (const Enumerator& value : described.values) {
      text += "enumerator " + name_of(value, described) + " " + std::to_string(value.value) + "\n";
    }
  }
  for (const Struct& described : schema.common) text += facts_of(described, "iso_");
  for (const Family& family : schema.families) {
    for (const Struct& described : family.structs) text += facts_of(described, "iso_" + family.prefix + "_");
  }
  for (const Function& function : functions) {
    text += "function " + function.name + " " + function.returns + "(";
    for (std::size_t i = 0; i < function.arguments.size(); ++i) {
      text += (i == 0 ? "" : ", ") + function.arguments[i].type;
    }
    text += ")\n";
  }
  return text;
}

}  // namespace isostep::c_header
