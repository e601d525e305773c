// What every function of the C interface does with its caller's structs, and with memory that is not there.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "isostep.h"

namespace isostep::c {

/// Nothing is thrown across the interface; what the library's own code throws is that memory is not there.
template <class F> iso_status guarded(F&& f) {
#if defined(__cpp_exceptions)
  try {
    return f();
  } catch (...) {
    return ISO_NO_MEMORY;
  }
#else
  return f();
#endif
}

/// [bytes] The smallest struct has its size and a word; a newer caller's is not longer than this library's by more.
inline constexpr std::uint32_t kLeastSize = 8, kMostGrowth = 1024;
template <class T> bool is_size(std::uint32_t size) { return size >= kLeastSize && size <= sizeof(T) + kMostGrowth; }

/// What a caller's struct holds of `to`, which keeps its defaults beyond: that of an older caller is shorter; of a newer
/// one the part that this library does not know is zero.
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

/// Is there room for what is filled: a struct whose size the caller has set?
template <class T> iso_status can_give(const T* to) {
  if (to == nullptr) return ISO_NULL;
  return is_size<T>(to->size) ? ISO_OK : ISO_WRONG_SIZE;
}
/// After can_give: as much as the caller's struct holds, and zeros where it knows more than this library.
template <class T> void give(const T& from, T* to) {
  const std::uint32_t size = to->size;
  std::memset(to, 0, size);
  std::memcpy(to, &from, size < sizeof(T) ? size : sizeof(T));
  to->size = size;
}

/// `size`, in: the room, out: the need.
template <class Range> iso_status give_bytes(const Range& from, void* bytes, std::size_t* size) {
  const std::size_t room = bytes == nullptr ? 0 : *size;
  *size = from.size();
  if (room < from.size()) return ISO_SMALL_BUFFER;
  if (from.size() > 0) std::memcpy(bytes, from.data(), from.size());
  return ISO_OK;
}

}  // namespace isostep::c
