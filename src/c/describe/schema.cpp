// Walks the C++ side of the interface and writes down what it finds.
// SPDX-License-Identifier: MIT
#include "schema.hpp"

#include <map>
#include <typeindex>

#include "../layout/structs.hpp"

namespace isostep::c_header {
namespace {

using namespace isostep::c;
using Typed = Q16_16;  // tells S, Unit<S> and all other types apart

struct NestedName {
  const char* name;
  bool of_family;
};
const std::map<std::type_index, NestedName>& nested_names() {
  static const std::map<std::type_index, NestedName> names = {
#define ISO_NAME(name, Type, S) {typeid(Type), {#name, true}},
#define ISO_COMMON_NAME(name, Type) {typeid(Type), {#name, false}},
      ISO_C_PLAIN(ISO_NAME, Typed) ISO_C_COMMON_PLAIN(ISO_COMMON_NAME)
#undef ISO_NAME
#undef ISO_COMMON_NAME
  };
  return names;
}

template <class T> struct PointeeOf;
template <class T> struct PointeeOf<Pointer<T>> { using Type = T; };

template <class T> Member kind_of() {
  Member member;
  if constexpr (std::is_bounded_array_v<T>) {
    member = kind_of<std::remove_extent_t<T>>();
    member.count = std::extent_v<T>;
  } else if constexpr (std::is_same_v<T, Typed>) {
    member.kind = "number";
  } else if constexpr (std::is_same_v<T, Unit<Typed>>) {
    member.kind = "unit";
  } else if constexpr (std::is_same_v<T, bool>) {
    member.kind = "bool";
  } else if constexpr (std::is_same_v<T, char>) {
    member.kind = "char";
  } else if constexpr (kIsId<T>) {
    member.kind = "id";
    member.of = std::is_same_v<T, BodyId>    ? "iso_body"
                : std::is_same_v<T, ShapeId> ? "iso_shape"
                : std::is_same_v<T, JointId> ? "iso_joint"
                                             : "iso_record";
  } else if constexpr (kIsPointer<T>) {
    using To = typename PointeeOf<T>::Type;
    member.kind = "pointer";
    member.of = std::is_same_v<To, char>            ? "iso_text"
                : std::is_same_v<To, std::uint64_t> ? "iso_body_list"
                : std::is_same_v<To, std::uint32_t> ? "iso_number_list"
                : std::is_same_v<To, std::int16_t>  ? "iso_height_list"
                : std::is_same_v<To, std::uint8_t>  ? "iso_byte_list"
                                                    : "iso_double_list";
  } else if constexpr (CStruct<T>) {
    const NestedName& nested = nested_names().at(typeid(T));
    member.kind = "struct";
    member.of = nested.name;
    member.of_family = nested.of_family;
  } else if constexpr (std::is_enum_v<T>) {
    member.kind = "enum";
    member.of = Enumerators<T>::kName;
  } else if constexpr (std::is_floating_point_v<T>) {
    member.kind = sizeof(T) == 4 ? "f32" : "f64";
  } else {
    member.kind = (std::is_signed_v<T> ? "i" : "u") + std::to_string(8 * sizeof(T));
  }
  return member;
}

/// The members' names and kinds, which are those of all families.
struct KindVisitor {
  std::vector<Member>* members;
  template <class T> void operator()(const char* name, const T&) const {
    if constexpr (kIsOptional<T>) {
      add<bool>(std::string("has_") + name);
      add<typename T::value_type>(name);
    } else {
      add<T>(name);
    }
  }
  template <class T> void add(const std::string& name) const {
    Member member = kind_of<T>();
    member.name = name;
    members->push_back(member);
  }
};
/// Their sizes in one family.
struct SizeVisitor {
  std::vector<std::size_t>* sizes;
  template <class T> void operator()(const char*, const T&) const {
    if constexpr (kIsOptional<T>) {
      sizes->push_back(extent_of<bool>().size);
      sizes->push_back(extent_of<typename T::value_type>().size);
    } else {
      sizes->push_back(extent_of<T>().size);
    }
  }
};

Member reserved(int number, std::size_t offset, std::size_t size) {
  Member member;
  member.name = "reserved" + std::to_string(number);
  member.kind = "reserved";
  member.count = size;
  member.offset = offset;
  member.size = size;
  return member;
}

/// `T` in one family, `Kinds` the same struct over Typed.
template <class T, class Kinds, bool kSized> Struct describe_struct(const char* name, std::string cpp_name) {
  Struct made;
  made.name = name;
  made.cpp_name = cpp_name.substr(0, cpp_name.find('<'));
  made.is_sized = kSized;
  made.size = kSized ? sized_size<T>() : extent_of<T>().size;
  made.align = kSized ? 8 : extent_of<T>().align;
  std::vector<Member> members;
  CFields<Kinds>::fields(KindVisitor{&members}, Kinds{});
  std::vector<std::size_t> sizes;
  CFields<T>::fields(SizeVisitor{&sizes}, T{});
  constexpr auto kOffsets = offsets_of<T, kSized>();
  std::size_t end = 0;
  int padding = 0;
  if constexpr (kSized) {
    Member size, rest;
    size.name = "size";
    rest.name = "reserved0";
    size.kind = rest.kind = "u32";
    size.size = rest.size = rest.offset = 4;
    size.comment = "[bytes] of this struct, as _init sets it";
    made.members = {size, rest};
    end = kHeadSize;
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    members[i].offset = kOffsets[i];
    members[i].size = sizes[i];
    if (end < kOffsets[i]) made.members.push_back(reserved(++padding, end, kOffsets[i] - end));
    made.members.push_back(members[i]);
    end = kOffsets[i] + sizes[i];
  }
  if (end < made.size) made.members.push_back(reserved(++padding, end, made.size - end));
  return made;
}

template <class S> Family describe_family(const char* prefix) {
  Family family;
  family.prefix = prefix;
  family.scalar = ScalarTraits<S>::kName;
  family.number = std::is_same_v<S, float> ? "float" : std::is_same_v<S, double> ? "double" : "";
  family.bits = 8 * static_cast<int>(sizeof(S));
  family.fraction_bits = family.unit_fraction_bits = 0;
  if constexpr (kIsFixed<S>) {
    family.number = sizeof(S) == 4 ? "int32_t" : "int64_t";
    family.fraction_bits = S::kFracBits;
    family.unit_fraction_bits = Unit<S>::kFracBits;
  }
  family.unit = family.number;
  auto& structs = family.structs;
#define ISO_PLAIN(name, Type, X) \
  structs.push_back(describe_struct<twin::name<S>, twin::name<Typed>, false>(#name, #Type));
#define ISO_SIZED(name, Type, X) \
  structs.push_back(describe_struct<twin::name<S>, twin::name<Typed>, true>(#name, #Type));
#define ISO_RECORD(name, Type, Id, X) ISO_SIZED(name, Type, X)
#define ISO_INPUT(name, Type, Id, X) ISO_SIZED(name##_input, Type, X)
#define ISO_STATE(name, Type, Id, X) ISO_SIZED(name##_state, Type, X)
  ISO_C_PLAIN(ISO_PLAIN, S)
  ISO_C_SIZED(ISO_SIZED, S)
  ISO_FOR_EACH_RECORD(ISO_RECORD, S)
  ISO_FOR_EACH_INPUT(ISO_INPUT, S)
  ISO_FOR_EACH_RECORD_STATE(ISO_STATE, S)
#undef ISO_PLAIN
#undef ISO_SIZED
#undef ISO_RECORD
#undef ISO_INPUT
#undef ISO_STATE
  return family;
}

template <class E> Enum describe_enum() {
  Enum made = {Enumerators<E>::kName, false, {}};
  for (std::uint32_t i = 0; i < Enumerators<E>::kCount; ++i) made.values.push_back({Enumerators<E>::kNames[i], i});
  return made;
}

}  // namespace

Schema make_schema() {
  Schema schema;
#define ISO_FAMILY(P, S) schema.families.push_back(describe_family<S>(#P));
  ISO_C_FAMILIES(ISO_FAMILY)
#undef ISO_FAMILY
#define ISO_PLAIN(name, Type) schema.common.push_back(describe_struct<Type, Type, false>(#name, #Type));
#define ISO_SIZED(name, Type) schema.common.push_back(describe_struct<Type, Type, true>(#name, #Type));
  ISO_C_COMMON_PLAIN(ISO_PLAIN)
  ISO_C_COMMON_SIZED(ISO_SIZED)
#undef ISO_PLAIN
#undef ISO_SIZED
#define ISO_ENUM(E) schema.enums.push_back(describe_enum<E>());
  ISO_C_ENUMS(ISO_ENUM)
#undef ISO_ENUM
  for (const FlagSet& set : kFlagSets) {
    Enum flags = {set.name, true, {}};
    for (const Flag& flag : set.flags) flags.values.push_back({flag.name, flag.bits});
    schema.enums.push_back(flags);
  }
#define ISO_RECORD(name, Type, Id, S) schema.records.push_back(#name);
#define ISO_INPUT(name, Type, Id, S) schema.inputs.push_back(#name);
#define ISO_STATE(name, Type, Id, S) schema.states.push_back(#name);
#define ISO_SHAPE(name, Type, S) schema.shapes.push_back(#name);
#define ISO_JOINT(name, Type, S) schema.joints.push_back(#name);
  ISO_FOR_EACH_RECORD(ISO_RECORD, float)
  ISO_FOR_EACH_INPUT(ISO_INPUT, float)
  ISO_FOR_EACH_RECORD_STATE(ISO_STATE, float)
  ISO_C_SHAPES(ISO_SHAPE, float)
  ISO_C_JOINTS(ISO_JOINT, float)
#undef ISO_RECORD
#undef ISO_INPUT
#undef ISO_STATE
#undef ISO_SHAPE
#undef ISO_JOINT
  return schema;
}

std::string upper(std::string text) {
  for (char& c : text) {
    if ('a' <= c && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string name_of(const Enumerator& value, const Enum& of) {
  return (of.stem.empty() ? "ISO_" + upper(of.name) + "_" : of.stem) + upper(value.name);
}

const std::vector<PointerType>& pointer_types() {
  static const std::vector<PointerType> types = {
      {"iso_text", "char"},           {"iso_body_list", "iso_body"}, {"iso_number_list", "uint32_t"},
      {"iso_height_list", "int16_t"}, {"iso_byte_list", "uint8_t"},  {"iso_double_list", "double"}};
  return types;
}

}  // namespace isostep::c_header
