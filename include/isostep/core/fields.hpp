// One traversal for every stored struct: writer, reader, differ, describer and hash are visitors of `fields`.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "isostep/core/field_names.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

namespace detail {
struct AnyVisitor {
  template <class T> ISO_INLINE constexpr void operator()(const char*, T&&) const {}
};
}  // namespace detail

/// A struct that names its members in order, by ISO_FIELDS or by a function `fields` of its own.
template <class T>
concept HasFields = requires(T& value) {
  T::fields(detail::AnyVisitor{}, value);
};

/// A number that is stored as it is: an integer, an enumeration, or a scalar (by its bits).
template <class T>
concept FieldValue = std::integral<T> || std::is_enum_v<T> || Scalar<T>;

namespace detail {
template <class T> constexpr std::size_t packed_size();
struct SizeVisitor {
  std::size_t* total;
  template <class T> constexpr void operator()(const char*, const T&) const { *total += packed_size<T>(); }
};
template <class T> constexpr std::size_t packed_size() {
  if constexpr (std::is_bounded_array_v<T>) {
    return std::extent_v<T> * packed_size<std::remove_extent_t<T>>();
  } else if constexpr (HasFields<T>) {
    std::size_t total = 0;
    const T value{};
    T::fields(SizeVisitor{&total}, value);
    return total;
  } else {
    return sizeof(T);
  }
}
}  // namespace detail

/// True if T consists of its fields only, without padding: its bytes on a little-endian machine are its canonical form,
/// and may be hashed, compared and copied whole. Put a static_assert of it behind every stored struct.
template <class T> inline constexpr bool kHasNoPadding = detail::packed_size<T>() == sizeof(T);

}  // namespace isostep
