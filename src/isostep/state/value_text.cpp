// Fields as text. For tools: nothing here is read back into a simulation.
// SPDX-License-Identifier: MIT
#include "isostep/state/value_text.hpp"

#include <cinttypes>
#include <cstdio>

#include "isostep/scalar/text.hpp"

namespace isostep {
namespace {

std::int64_t sign_extended(FieldFormat format, std::uint64_t bits) {
  const unsigned shift = 64 - 8 * format.size;
  return static_cast<std::int64_t>(bits << shift) >> shift;
}

bool is_floating(FieldFormat format) { return format.kind == FieldKind::scalar && format.scalar_id >> 16 == 1; }

std::string scalar_text(FieldFormat format, std::uint64_t bits) {
  if (format.scalar_id == ScalarTraits<float>::kId) return to_text(from_bits<float>(static_cast<std::uint32_t>(bits)));
  if (format.scalar_id == ScalarTraits<double>::kId) return to_text(from_bits<double>(bits));
  // Any other is fixed point, a user's own format included: its fraction bits are all that must be known.
  const std::int64_t raw = sign_extended(format, bits);
  return detail::text_of_fixed(detail::magnitude(raw), raw < 0, static_cast<int>(format.scalar_id & 0xffu));
}

/// Bits of a float or double as an integer that counts in the order of the values.
std::uint64_t ordered(FieldFormat format, std::uint64_t bits) {
  const std::uint64_t sign = std::uint64_t{1} << (8 * format.size - 1);
  return (bits & sign) != 0 ? sign - 1 - (bits - sign) : bits + sign;
}

}  // namespace

std::string value_text(FieldFormat format, std::uint64_t bits) {
  switch (format.kind) {
    case FieldKind::truth: return bits != 0 ? "true" : "false";
    case FieldKind::signed_integer: return std::to_string(sign_extended(format, bits));
    case FieldKind::unsigned_integer: return std::to_string(bits);
    case FieldKind::scalar: break;
  }
  return scalar_text(format, bits);
}

std::string bits_text(FieldFormat format, std::uint64_t bits) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%0*" PRIx64, static_cast<int>(2 * format.size), bits);
  return text;
}

std::uint64_t steps_between(FieldFormat format, std::uint64_t a, std::uint64_t b) {
  if (is_floating(format)) {
    a = ordered(format, a);
    b = ordered(format, b);
    return a < b ? b - a : a - b;
  }
  if (format.kind == FieldKind::truth || format.kind == FieldKind::unsigned_integer) return a < b ? b - a : a - b;
  const std::int64_t signed_a = sign_extended(format, a);
  const std::int64_t signed_b = sign_extended(format, b);
  const auto wide_a = static_cast<std::uint64_t>(signed_a);
  const auto wide_b = static_cast<std::uint64_t>(signed_b);
  return signed_a < signed_b ? wide_b - wide_a : wide_a - wide_b;
}

}  // namespace isostep
