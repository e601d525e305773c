// The C interface as the C# files need it: from interface.json, and sessions from their header.
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace isostep::csharp {

/// A member of a struct. `kind`: number unit bool enum id pointer struct char i16 i32 u8 u16 u32 u64 f32 f64 reserved,
/// as in interface.json; handle: a pointer or size of the machine's width.
struct Member {
  std::string name, kind, of, comment;
  int count = 0;  // elements of an array; 0: no array
  int offset = 0;
};
struct Struct {
  std::string name, base, family;  // "iso_q32_vec3", "vec3", "q32"; no family: ""
  bool sized = false;
  int size = 0;
  std::vector<Member> members;
  bool has_handles() const;
};
struct Enumerator {
  std::string name, comment;
  long long value = 0;
};
struct Enum {
  std::string name;
  bool flags = false;
  std::vector<Enumerator> values;
};
struct Argument {
  std::string name, type;
};
struct Function {
  std::string name, returns, family, comment;
  std::vector<Argument> arguments;
};
struct Schema {
  std::vector<Enum> enums;
  std::vector<Enumerator> statuses, constants;
  std::vector<Struct> structs;
  std::vector<Function> functions;
  std::vector<std::string> handles;  // "iso_world": what only the library looks into
  const Struct* find(const std::string& name) const;
};

/// Reads the interface. `source` is the repository.
Schema read_schema(const std::filesystem::path& source);

}  // namespace isostep::csharp
