// interface.json, and the parts of the headers beside it.
// SPDX-License-Identifier: MIT
#include "schema.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "header_reader.hpp"
#include "output.hpp"

namespace isostep::csharp {
namespace {

using nlohmann::json;

std::string text_of(const json& from, const char* key) { return from.value(key, std::string()); }

void read_json(const json& from, Schema& schema) {
  for (const json& each : from.at("enums")) {
    Enum made{each.at("name"), each.at("flags"), {}};
    for (const json& value : each.at("values")) made.values.push_back({value.at("name"), "", value.at("value")});
    schema.enums.push_back(made);
  }
  for (const json& each : from.at("structs")) {
    Struct made{each.at("name"), each.at("base"), each.at("family"), each.at("sized"), each.at("size"), {}};
    for (const json& m : each.at("members")) {
      const std::string kind = m.at("kind") == "word" ? "handle" : m.at("kind");
      const int count = m.value("count", kind == "reserved" ? int(m.at("size")) : 0);
      made.members.push_back({m.at("name"), kind, text_of(m, "of"), text_of(m, "comment"), count, m.at("offset")});
    }
    schema.structs.push_back(made);
  }
  std::set<std::string> declared;  // a header may declare a function twice
  for (const json& each : from.at("functions")) {
    if (!declared.insert(each.at("name")).second) continue;
    Function made{each.at("name"), each.at("returns"), each.at("family"), text_of(each, "comment"), {}};
    for (const json& a : each.at("arguments")) made.arguments.push_back({a.at("name"), a.at("type")});
    schema.functions.push_back(made);
  }
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return "";
  return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

}  // namespace

bool Struct::has_handles() const {
  for (const Member& member : members) {
    if (member.kind == "handle") return true;
  }
  return false;
}
const Struct* Schema::find(const std::string& name) const {
  for (const Struct& each : structs) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

Schema read_schema(const std::filesystem::path& source) {
  Schema schema;
  read_json(json::parse(read_file(source / "src/c/interface.json")), schema);
  const std::string header = read_file(source / "src/c/include/isostep.h");
  read_header("typedef int32_t iso_status;" + between(header, "typedef int32_t iso_status;", "typedef uint64_t"),
              schema);
  read_header(between(header, "/* Sessions */", "/* End of sessions */"), schema);
  const std::string udp = read_file(source / "src/c/include/isostep_udp.h");
  read_header(between(udp, "extern \"C\" {\n#endif\n", "#ifdef __cplusplus"), schema);
  return schema;
}

}  // namespace isostep::csharp
