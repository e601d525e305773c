// Columns: many vectors with their x, y and z apart, as lanes load them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/math/mat3.hpp"
#include "isostep/scalar/lanes.hpp"

namespace isostep {

/// At most kMost vectors. What lanes read beyond the last repeats it.
template <class T, int kMost> struct Columns {
  static_assert(kMost % 32 == 0, "blocks of lanes of any width fill it");
  alignas(64) T x[kMost];
  alignas(64) T y[kMost];
  alignas(64) T z[kMost];

  ISO_INLINE Vec3<T> at(std::uint32_t i) const { return {x[i], y[i], z[i]}; }
  ISO_INLINE void set(std::uint32_t i, Vec3<T> v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  /// Repeats the last of `count` vectors up to a whole block of W.
  template <int W> ISO_INLINE void pad(std::uint32_t count) {
    for (std::uint32_t i = count; i % W != 0; ++i) set(i, at(count - 1));
  }
  template <class L> ISO_INLINE Vec3<L> load(std::uint32_t first) const {
    return {L::load(x + first), L::load(y + first), L::load(z + first)};
  }
  template <class L> ISO_INLINE void store(std::uint32_t first, Vec3<L> v) {
    v.x.store(x + first);
    v.y.store(y + first);
    v.z.store(z + first);
  }
};

template <class L, class T> ISO_INLINE Vec3<L> broadcast(Vec3<T> v) {
  return {L::broadcast(v.x), L::broadcast(v.y), L::broadcast(v.z)};
}
template <class L, class T> ISO_INLINE Mat3<L> broadcast(const Mat3<T>& m) {
  return {{broadcast<L>(m.rows[0]), broadcast<L>(m.rows[1]), broadcast<L>(m.rows[2])}};
}

}  // namespace isostep
