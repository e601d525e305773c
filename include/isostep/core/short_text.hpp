// ShortText<N>: up to N characters inside the object, for messages and names that must need no heap.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// It is copied as plain bytes. Text beyond the capacity is cut off: it is text for people, or its length was checked
/// before.
template <std::size_t Capacity> class ShortText {
 public:
  static constexpr std::size_t kCapacity = Capacity;

  ISO_INLINE constexpr ShortText() : chars_{}, size_(0) {}
  ISO_INLINE constexpr ShortText(std::string_view text) : chars_{}, size_(0) { append(text); }
  ISO_INLINE constexpr ShortText(const char* text) : chars_{}, size_(0) { append(std::string_view(text)); }

  ISO_INLINE constexpr ShortText& append(std::string_view text) {
    for (std::size_t i = 0; i < text.size() && size_ < Capacity; ++i) chars_[size_++] = text[i];
    return *this;
  }
  ISO_INLINE constexpr ShortText& append_number(std::uint64_t number) {
    char digits[20] = {};
    std::size_t count = 0;
    do {
      digits[count++] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number != 0);
    while (count > 0 && size_ < Capacity) chars_[size_++] = digits[--count];
    return *this;
  }
  /// Appends always 16 digits, so that hashes line up and compare as text.
  ISO_INLINE constexpr ShortText& append_hex(std::uint64_t number) {
    for (int shift = 60; shift >= 0 && size_ < Capacity; shift -= 4) {
      chars_[size_++] = "0123456789abcdef"[(number >> shift) & 15u];
    }
    return *this;
  }

  ISO_INLINE constexpr std::string_view view() const { return std::string_view(chars_, size_); }
  ISO_INLINE constexpr bool empty() const { return size_ == 0; }
  friend ISO_INLINE constexpr bool operator==(const ShortText& a, const ShortText& b) { return a.view() == b.view(); }

 private:
  char chars_[Capacity];
  std::uint32_t size_;
};

}  // namespace isostep
