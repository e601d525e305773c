// Schema: the structs and enumerations of the C interface, as the header and the bindings need them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace isostep::c_header {

/// number and unit are the family's S and Unit<S>; i32 and the like what they say; pointer eight bytes; word a pointer,
/// a size_t or a callback, as wide as the target's pointers.
struct Member {
  std::string name;
  std::string kind;  // number unit bool enum id pointer word struct char i16 i32 u8 u16 u32 u64 f32 f64 reserved
  std::string of;    // of enum, id, pointer, word and struct: its name in C; of struct without the family's prefix
  bool of_family = false;  // of struct: the family's
  std::size_t count = 0;   // elements of an array; 0: no array
  std::size_t offset = 0, size = 0;
  std::size_t offset32 = 0;  // in a struct with words: where pointers have four bytes
  std::string comment;
};
struct Struct {
  std::string name;      // without prefixes: "body_definition"
  std::string cpp_name;  // "BodyDefinition"
  bool is_sized = false;
  std::size_t size = 0, align = 0;
  std::size_t size32 = 0;       // of a struct with words: where pointers have four bytes; else 0
  std::vector<Member> members;  // head and padding included
};
struct Family {
  std::string prefix, scalar, number, unit;     // "q32", "q32.32", "int64_t", "int64_t"
  int bits, fraction_bits, unit_fraction_bits;  // of float and double: no fraction
  std::vector<Struct> structs;
};
struct Enumerator {
  std::string name;
  std::uint32_t value;
};
struct Enum {
  std::string name;  // "body_type"
  bool is_flags;
  std::vector<Enumerator> values;
  std::string stem = {};  // of its enumerators in C; empty: ISO_NAME_
};
struct Schema {
  std::vector<Family> families;
  std::vector<Struct> common;
  std::vector<Enum> enums;
  std::vector<std::string> records, inputs, states, shapes, joints;  // names in the order of their lists
};

Schema make_schema();

std::string upper(std::string text);
/// In C: ISO_BODY_TYPE_DYNAMIC.
std::string name_of(const Enumerator& value, const Enum& of);
/// "const iso_body* at" of a pointer's union, by its name in C.
struct PointerType {
  const char* name;
  const char* to;
};
const std::vector<PointerType>& pointer_types();

}  // namespace isostep::c_header
