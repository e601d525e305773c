// Exact decimal text of a scalar and back: integer arithmetic only, so no locale, rounding mode or library changes it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

#include "isostep/scalar/scalar.hpp"

namespace isostep {

enum class TextError : std::uint8_t {
  none,
  not_a_number,  // not one number of the JSON grammar, whole and alone
  out_of_range,  // a number whose nearest value does not exist in the scalar
};

ISO_INLINE constexpr const char* describe(TextError error) {
  return error == TextError::none ? "no error" : error == TextError::not_a_number ? "not a number" : "out of range";
}

namespace detail {
/// The layout of an IEEE format, for reading and writing: bits of the significand with the hidden one, exponent of the
/// smallest subnormal, exponent of the last place of the largest number.
struct FloatLayout {
  int significand;
  int lowest_exponent;
  int highest_exponent;
};
template <std::floating_point S> ISO_INLINE constexpr FloatLayout float_layout() {
  using Limits = std::numeric_limits<S>;
  return {Limits::digits, Limits::min_exponent - Limits::digits, Limits::max_exponent - Limits::digits};
}

std::string text_of_fixed(std::uint64_t magnitude, bool negative, int frac_bits);
std::string text_of_float(std::uint64_t bits, FloatLayout format);
TextError read_fixed(std::string_view text, int bits, int frac_bits, std::int64_t& raw);
TextError read_float(std::string_view text, FloatLayout format, std::uint64_t& bits);
/// Writes to a stream and obeys its width and fill. It is apart, so that this header needs no <ostream>.
void write_text(std::ostream& out, std::string_view text);
}  // namespace detail

/// Returns the shortest decimal that `from_text` reads back as `value`, bit for bit; of equal ones the nearest. It is
/// JSON, except "inf", "-inf" and "nan", which `from_text` refuses. Fixed point has no exponent; float and double have
/// none from 1e-6 up to 1e21.
template <class S> ISO_INLINE std::string to_text(S value) {
  if constexpr (kIsFixed<S>) {
    return detail::text_of_fixed(detail::magnitude(value.raw()), value.raw() < 0, S::kFracBits);
  } else {
    return detail::text_of_float(to_bits(value), detail::float_layout<S>());
  }
}

/// Reads the scalar nearest to a JSON number: any count of digits, any exponent, one rounding of the exact decimal.
/// Ties: fixed point away from zero, as literals; float and double to even, as IEEE 754. What lies below half the
/// smallest number is zero, no error. On an error `out` keeps its value.
template <class S> ISO_INLINE bool from_text(std::string_view text, S& out, TextError& error) {
  if constexpr (kIsFixed<S>) {
    std::int64_t raw = 0;
    error = detail::read_fixed(text, S::kBits, S::kFracBits, raw);
    if (error == TextError::none) out = S::from_raw(static_cast<typename S::Raw>(raw));
  } else {
    std::uint64_t bits = 0;
    error = detail::read_float(text, detail::float_layout<S>(), bits);
    if (error == TextError::none) out = from_bits<S>(static_cast<RawBits<S>>(bits));
  }
  return error == TextError::none;
}

template <class Rep, int F, Overflow P> ISO_INLINE std::ostream& operator<<(std::ostream& out, Fixed<Rep, F, P> value) {
  detail::write_text(out, to_text(value));
  return out;
}

}  // namespace isostep
