// Structs that C and C++ have alike: taken from a caller of another age, and given to one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "include/isostep.h"

namespace isostep::c {

/// [bytes] The size of the smallest struct, its size and a word; the most by which a newer caller's is longer than this
/// library's.
inline constexpr std::uint32_t kLeastSize = 8, kMostGrowth = 1024;
template <class T> bool is_size(std::size_t size) { return size >= kLeastSize && size <= sizeof(T) + kMostGrowth; }

/// Takes the members of `to` that a caller's struct holds; the rest keeps its defaults. An older caller's is shorter;
/// the part of a newer one that this library does not know must be zero.
template <class T> iso_status take(const T* from, T& to) {
  if (from == nullptr) return ISO_NULL;
  const std::uint32_t size = from->size;
  if (!is_size<T>(size)) return ISO_WRONG_SIZE;
  const auto* const bytes = reinterpret_cast<const unsigned char*>(from);
  for (std::size_t i = sizeof(T); i < size; ++i) {
    if (bytes[i] != 0) return ISO_WRONG_SIZE;
  }
  std::memcpy(&to, from, size < sizeof(T) ? size : sizeof(T));
  to.size = sizeof(T);
  return ISO_OK;
}

/// Checks a struct that is to be filled, whose size the caller has set.
template <class T> iso_status can_give(const T* to) {
  if (to == nullptr) return ISO_NULL;
  return is_size<T>(to->size) ? ISO_OK : ISO_WRONG_SIZE;
}
/// Gives, after can_give, as much as the caller's struct holds, and zeros where it knows more than this library.
template <class T> void give(const T& from, T* to) {
  const std::uint32_t size = to->size;
  std::memset(to, 0, size);
  std::memcpy(to, &from, size < sizeof(T) ? size : sizeof(T));
  to->size = size;
}

/// Writes, for _init, `defaults` into a struct of the caller's that has so many bytes.
template <class T> iso_status start(const T& defaults, T* to, std::size_t size) {
  if (to == nullptr) return ISO_NULL;
  if (!is_size<T>(size)) return ISO_WRONG_SIZE;
  to->size = static_cast<std::uint32_t>(size);
  give(defaults, to);
  return ISO_OK;
}

}  // namespace isostep::c
