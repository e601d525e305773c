// ArrayView<T>: the elements of an array that lives elsewhere.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// A span for kernels. The functions of std::span are weak symbols at -O0, which code for one instruction set must not
/// have.
template <class T> struct ArrayView {
  const T* elements = nullptr;
  std::uint32_t count = 0;

  ArrayView() = default;
  ISO_INLINE constexpr ArrayView(const T* from, std::uint32_t many) : elements(from), count(many) {}
  template <std::size_t N> ISO_INLINE constexpr ArrayView(const T (&array)[N]) : ArrayView(array, N) {}
  ISO_INLINE ArrayView(const std::vector<T>& array)
      : ArrayView(array.data(), static_cast<std::uint32_t>(array.size())) {}

  ISO_INLINE constexpr const T& operator[](std::uint32_t i) const { return elements[i]; }
  ISO_INLINE constexpr std::uint32_t size() const { return count; }
  ISO_INLINE constexpr const T* begin() const { return elements; }
  ISO_INLINE constexpr const T* end() const { return elements + count; }
};

}  // namespace isostep
