// The canonical bytes of a value: its fields in order, little-endian, as wide as declared, without gaps. And the short
// form of a command: the same with LEB128 for whole numbers.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "isostep/core/bytes.hpp"
#include "isostep/core/fields.hpp"

namespace isostep {

/// [bytes] The length of T's canonical form.
template <class T> inline constexpr std::size_t kPackedSize = detail::packed_size<T>();

/// The unsigned integer that holds a field's bits.
template <std::size_t Size> struct UnsignedOfSize;
template <> struct UnsignedOfSize<1> { using Type = std::uint8_t; };
template <> struct UnsignedOfSize<2> { using Type = std::uint16_t; };
template <> struct UnsignedOfSize<4> { using Type = std::uint32_t; };
template <> struct UnsignedOfSize<8> { using Type = std::uint64_t; };
template <class T> using FieldBits = typename UnsignedOfSize<sizeof(T)>::Type;

template <FieldValue T> ISO_INLINE constexpr FieldBits<T> field_bits(T value) {
  if constexpr (std::is_enum_v<T>) {
    return static_cast<FieldBits<T>>(static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<FieldBits<T>>(value);
  } else {
    return to_bits(value);
  }
}
/// Any bits are a value, except for bool: the caller has made sure of 0 or 1.
template <FieldValue T> ISO_INLINE constexpr T field_from_bits(FieldBits<T> bits) {
  if constexpr (std::is_same_v<T, bool>) {
    return bits != 0;
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(static_cast<std::underlying_type_t<T>>(bits));
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(bits);
  } else {
    return from_bits<T>(bits);
  }
}

template <class T> ISO_INLINE constexpr std::uint8_t* pack(std::uint8_t* at, const T& value);

namespace detail {
struct PackVisitor {
  std::uint8_t** at;
  template <class T> ISO_INLINE constexpr void operator()(const char*, const T& value) const { *at = pack(*at, value); }
};
}  // namespace detail

/// Writes kPackedSize<T> bytes and returns where they end.
template <class T> ISO_INLINE constexpr std::uint8_t* pack(std::uint8_t* at, const T& value) {
  if constexpr (std::is_bounded_array_v<T>) {
    for (const auto& element : value) at = pack(at, element);
  } else if constexpr (HasFields<T>) {
    T::fields(detail::PackVisitor{&at}, value);
  } else {
    static_assert(FieldValue<T>, "a stored member is a number, a struct with fields or an array of them");
    store_le(at, field_bits(value));
    at += sizeof(T);
  }
  return at;
}

/// The numbers whose short form is LEB128: ids, kinds, masks, counts, ticks. Scalars, bools and signed numbers keep
/// their width.
template <class T> inline constexpr bool kIsLeb128 = sizeof(T) > 1 && (std::is_enum_v<T> || std::is_unsigned_v<T>);
/// [bytes] An upper bound for the short form of T: LEB128 makes three bytes of two, five of four, ten of eight.
template <class T> inline constexpr std::size_t kMostShort = kPackedSize<T> + kPackedSize<T> / 2;

template <class T> ISO_INLINE constexpr std::uint8_t* pack_short(std::uint8_t* at, const T& value);

namespace detail {
struct ShortPackVisitor {
  std::uint8_t** at;
  template <class T> ISO_INLINE constexpr void operator()(const char*, const T& value) const {
    *at = pack_short(*at, value);
  }
};
}  // namespace detail

/// Writes the short form, at most kMostShort<T> bytes, and returns where it ends.
template <class T> ISO_INLINE constexpr std::uint8_t* pack_short(std::uint8_t* at, const T& value) {
  if constexpr (std::is_bounded_array_v<T>) {
    for (const auto& element : value) at = pack_short(at, element);
  } else if constexpr (HasFields<T>) {
    T::fields(detail::ShortPackVisitor{&at}, value);
  } else if constexpr (kIsLeb128<T>) {
    at = store_leb128(at, field_bits(value));
  } else {
    at = pack(at, value);
  }
  return at;
}

/// Returns true if the value's bytes in memory, on a little-endian machine, are canonical. kHasNoPadding cannot see
/// `fields` out of order or named twice; a test checks this for every stored struct, with all members different.
template <class T> ISO_INLINE bool memory_is_canonical(const T& value) {
  std::uint8_t bytes[kPackedSize<T> + 1];
  pack(bytes, value);
  return kHasNoPadding<T> && std::memcmp(bytes, &value, sizeof(T)) == 0;
}

}  // namespace isostep
