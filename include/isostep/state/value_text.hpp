// Any field as text for people: decimal, hexadecimal bits, and how far two of one type are apart.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "isostep/state/pack.hpp"

namespace isostep {

enum class FieldKind : std::uint32_t { truth, signed_integer, unsigned_integer, scalar };

/// The facts about a field's type that are needed to read its bits.
struct FieldFormat {
  FieldKind kind;
  std::uint32_t size;       // [bytes]
  std::uint32_t scalar_id;  // ScalarTraits::kId, or 0
};

template <FieldValue T> constexpr FieldFormat field_format_of() {
  if constexpr (std::is_same_v<T, bool>) {
    return {FieldKind::truth, 1, 0};
  } else if constexpr (std::is_enum_v<T>) {
    return field_format_of<std::underlying_type_t<T>>();
  } else if constexpr (std::is_integral_v<T>) {
    return {std::is_signed_v<T> ? FieldKind::signed_integer : FieldKind::unsigned_integer, sizeof(T), 0};
  } else {
    return {FieldKind::scalar, sizeof(T), ScalarTraits<T>::kId};
  }
}
template <FieldValue T> inline constexpr FieldFormat kFieldFormat = field_format_of<T>();

/// Returns decimal text; for scalars the shortest that reads back to the same bits.
std::string value_text(FieldFormat format, std::uint64_t bits);
template <FieldValue T> ISO_INLINE std::string value_text(T value) {
  return value_text(kFieldFormat<T>, field_bits(value));
}

/// Returns "0x" and two digits per byte.
std::string bits_text(FieldFormat format, std::uint64_t bits);

/// Returns the representable steps from one to the other: units in the last place for float and double (-0 and +0 are
/// one step apart), least significant bits for fixed point, the difference for integers.
std::uint64_t steps_between(FieldFormat format, std::uint64_t a, std::uint64_t b);

}  // namespace isostep
