// Room in arrays that a step fills anew.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Room for `count` items, and a quarter more where it must grow: to double, as appending does, leaves half unused.
template <class T> ISO_INLINE void make_room(std::vector<T>& items, std::size_t count) {
  if (items.capacity() < count) items.reserve(count + count / 4);
}
template <class T> ISO_INLINE void resize_with_room(std::vector<T>& items, std::size_t count) {
  make_room(items, count);
  items.resize(count);
}

}  // namespace isostep
