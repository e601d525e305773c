// FieldType: what a value consists of, as a constant table, for cold code that reads any value by its bytes.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "isostep/state/value_text.hpp"

namespace isostep {

struct FieldType;

/// A member of a struct.
struct FieldRow {
  const char* name;
  const FieldType* type;
  std::uint32_t offset;  // [bytes] in the canonical form of the struct
};

/// A number, an array of `count` elements, or a struct of `count` members.
struct FieldType {
  std::uint32_t size = 0;              // [bytes] of the canonical form
  FieldFormat format = {};             // of a number; else its size is 0
  const FieldType* element = nullptr;  // of an array; else null
  const FieldRow* rows = nullptr;      // of a struct
  std::uint32_t count = 0;
};

namespace detail {
template <class T> constexpr FieldType field_type_of();
}  // namespace detail

/// The table of T, made from its `fields`.
template <class T> inline constexpr FieldType kFieldType = detail::field_type_of<T>();

namespace detail {
struct RowCounter {
  std::size_t* count;
  template <class T> constexpr void operator()(const char*, const T&) const { ++*count; }
};
template <class T> constexpr std::size_t count_rows() {
  std::size_t count = 0;
  T::fields(RowCounter{&count}, T{});
  return count;
}

struct RowWriter {
  FieldRow** row;
  std::uint32_t* offset;
  template <class T> constexpr void operator()(const char* name, const T&) const {
    *(*row)++ = {name, &kFieldType<T>, *offset};
    *offset += static_cast<std::uint32_t>(packed_size<T>());
  }
};
template <class T> constexpr auto rows_of() {
  std::array<FieldRow, count_rows<T>()> rows{};
  FieldRow* row = rows.data();
  std::uint32_t offset = 0;
  T::fields(RowWriter{&row, &offset}, T{});
  return rows;
}
template <class T> inline constexpr auto kFieldRows = rows_of<T>();

template <class T> constexpr FieldType field_type_of() {
  const auto size = static_cast<std::uint32_t>(packed_size<T>());
  if constexpr (std::is_bounded_array_v<T>) {
    return {size, {}, &kFieldType<std::remove_extent_t<T>>, nullptr, static_cast<std::uint32_t>(std::extent_v<T>)};
  } else if constexpr (HasFields<T>) {
    return {size, {}, nullptr, kFieldRows<T>.data(), static_cast<std::uint32_t>(kFieldRows<T>.size())};
  } else {
    return {size, kFieldFormat<T>, nullptr, nullptr, 0};
  }
}
}  // namespace detail

/// A name, or an index, and what it is a part of. The chain lies on the stack and becomes text only where it is needed.
struct PathPart {
  const PathPart* outer;  // null at the root
  const char* name;       // null for an index
  std::size_t index;
};

/// "bodies[17].velocity.x"
std::string path_text(const PathPart& path);

/// Called with a number's path, its format, and the offset of its bytes in the canonical form of the whole value.
struct NumberSink {
  void (*number)(void* user, const PathPart& path, FieldFormat format, std::uint32_t offset);
  void* user;
};

/// Calls the sink for every number of a value of this type, in the order of its fields. The element of an array of one
/// has the array's path.
void each_number(const PathPart& path, const FieldType& type, const NumberSink& sink);

/// Returns the bits of a number of `size` bytes: 1, 2, 4 or 8.
std::uint64_t load_number(const std::uint8_t* at, std::uint32_t size);

}  // namespace isostep
