// Writes C: enumerations and structs, one member a line, comments in the first family alone.
// SPDX-License-Identifier: MIT
#include "header_text.hpp"

namespace isostep::c_header {
namespace {

constexpr std::size_t kColumns = 120;

std::string c_type(const Member& member, const Family* family) {
  const std::string prefix = family != nullptr ? "iso_" + family->prefix + "_" : "iso_";
  if (member.kind == "number") return family->number;
  if (member.kind == "unit") return family->unit;
  if (member.kind == "bool" || member.kind == "reserved") return "uint8_t";
  if (member.kind == "char") return "char";
  if (member.kind == "enum") return "iso_" + member.of;
  if (member.kind == "id" || member.kind == "pointer") return member.of;
  if (member.kind == "struct") return (member.of_family ? prefix : "iso_") + member.of;
  if (member.kind == "f32") return "float";
  if (member.kind == "f64") return "double";
  return (member.kind[0] == 'i' ? "int" : "uint") + member.kind.substr(1) + "_t";
}

/// A comment behind `line`, on as many lines as it takes.
std::string commented(const std::string& line, const std::string& comment) {
  if (comment.empty()) return line + "\n";
  if (line.size() + comment.size() + 7 <= kColumns) return line + " /* " + comment + " */\n";
  std::string text, row = "  /*";
  for (std::size_t at = 0; at < comment.size();) {
    std::size_t end = comment.find(' ', at);
    if (end == std::string::npos) end = comment.size();
    const std::string word = comment.substr(at, end - at);
    at = end + 1;
    if (row.size() + 1 + word.size() + 3 > kColumns) {
      text += row + "\n";
      row = "    ";
    }
    row += " " + word;
  }
  return text + row + " */\n" + line + "\n";
}

std::string struct_text(const Struct& described, const Family* family, bool with_comments) {
  const std::string name = (family != nullptr ? "iso_" + family->prefix + "_" : "iso_") + described.name;
  std::string text = "typedef struct " + name + " {\n";
  std::string row;
  const auto flush = [&] {
    if (!row.empty()) text += row + "\n";
    row.clear();
  };
  for (const Member& member : described.members) {
    std::string declared = c_type(member, family) + " " + member.name;
    if (member.count != 0) declared += "[" + std::to_string(member.count) + "]";
    declared += ";";
    if (with_comments) {
      text += commented("  " + declared, member.comment);
      continue;
    }
    if (row.size() + declared.size() + 2 > kColumns) flush();
    row += (row.empty() ? "  " : " ") + declared;
  }
  flush();
  return text + "} " + name + ";\n";
}

std::string enum_text(const Enum& described) {
  std::string text = "typedef uint32_t iso_" + described.name + ";\nenum {";
  std::string row;
  for (std::size_t i = 0; i < described.values.size(); ++i) {
    const Enumerator& value = described.values[i];
    const std::string one =
        name_of(value, described) + " = " + std::to_string(value.value) + (i + 1 < described.values.size() ? "," : "");
    if (2 + row.size() + one.size() + 1 > kColumns) {
      text += "\n " + row;
      row.clear();
    }
    row += " " + one;
  }
  return text + "\n " + row + "\n};\n";
}

/// #define NAME(X, P) X(P, first) X(P, second) ..., or without P.
std::string list_text(const std::string& macro, const std::string& comment, const std::vector<std::string>& names) {
  std::string text = "/* " + comment + " */\n#define " + macro + "(X, P)";
  std::string row;
  for (const std::string& name : names) {
    const std::string one = " X(P, " + name + ")";
    if (row.size() + one.size() + 4 > kColumns) {
      text += " \\\n " + row;
      row.clear();
    }
    row += one;
  }
  return text + " \\\n " + row + "\n";
}

std::vector<std::string> names_of(const std::vector<Struct>& structs, bool is_sized) {
  std::vector<std::string> names;
  for (const Struct& described : structs) {
    if (described.is_sized == is_sized) names.push_back(described.name);
  }
  return names;
}

std::string offsets_text(const Struct& described) {
  std::string text;
  int head = described.is_sized ? 2 : 0;
  for (const Member& member : described.members) {
    if (member.kind == "reserved" || head-- > 0) continue;
    text += (text.empty() ? "" : ", ") + ("O(" + member.name + ")");
  }
  return text;
}

/// A call of X on lines of a macro.
std::string check_text(const std::string& what, const Struct& described) {
  const std::string call =
      "X(" + what + ", " + (described.is_sized ? "true" : "false") + ", " + offsets_text(described) + ")";
  std::string text, row = " ";
  for (std::size_t at = 0; at < call.size();) {
    std::size_t end = call.find(' ', at);
    if (end == std::string::npos) end = call.size();
    if (row.size() + end - at + 3 > kColumns) {
      text += row + " \\\n";
      row = "   ";
    }
    row += " " + call.substr(at, end - at);
    at = end + 1;
  }
  return text + row;
}
std::string checks_of(const std::vector<Struct>& structs, bool with_twin) {
  std::string text;
  for (const Struct& described : structs) {
    text += " \\\n" + check_text(described.name + (with_twin ? ", " + described.cpp_name : ""), described);
  }
  return text + "\n";
}

}  // namespace

std::string region_text(const Schema& schema) {
  std::string text;
  for (const Enum& described : schema.enums) text += enum_text(described);
  text += "\n/* Pointers within structs: eight bytes on every target. */\n";
  for (const PointerType& type : pointer_types()) {
    text += std::string("typedef union ") + type.name + " { const " + type.to + "* at; uint64_t bits; } " + type.name +
            ";\n";
  }
  text += "\n";
  for (const Struct& described : schema.common) text += struct_text(described, nullptr, true);
  for (const Family& family : schema.families) {
    const bool first = &family == &schema.families[0];
    text += "\n/* " + upper(family.prefix) + ": " + family.scalar +
            (first ? ". What the members mean is written here, and is the same in the other families. */\n"
                   : ". The members are those of F32. */\n");
    for (const Struct& described : family.structs) text += struct_text(described, &family, first);
  }
  text += "\n";
  text += list_text("ISO_C_FOR_EACH_SIZED", "What begins with its size, of a family.",
                    names_of(schema.families[0].structs, true));
  text +=
      list_text("ISO_C_FOR_EACH_COMMON_SIZED", "The same of structs without numbers.", names_of(schema.common, true));
  text += list_text("ISO_C_FOR_EACH_RECORD", "Records that are registered with a world.", schema.records);
  text += list_text("ISO_C_FOR_EACH_INPUT", "Those of them that have an input.", schema.inputs);
  text += list_text("ISO_C_FOR_EACH_STATE", "Those of them of which a step writes a state.", schema.states);
  text += list_text("ISO_C_FOR_EACH_SHAPE", "Shapes that numbers describe.", schema.shapes);
  text += list_text("ISO_C_FOR_EACH_JOINT", "Joints by name.", schema.joints);
  return text;
}

std::string with_region(const std::string& header, const std::string& region) {
  const std::size_t begin = header.find(kRegionBegin), end = header.find(kRegionEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
  return header.substr(0, begin) + kRegionBegin + region + header.substr(end);
}

std::string checks_text(const Schema& schema) {
  return "// Written by isostep_interface: the members of each C struct.\n// SPDX-License-Identifier: MIT\n"
         "#pragma once\n\n#define ISO_C_CHECKS(X)" +
         checks_of(schema.families[0].structs, false) + "\n#define ISO_C_COMMON_CHECKS(X)" +
         checks_of(schema.common, true);
}

}  // namespace isostep::c_header
