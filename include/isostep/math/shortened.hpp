// Vectors held within a length.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/vec3.hpp"

namespace isostep::detail {

/// Returns true if x is within -limit..limit. Both sides are compared: the lowest fixed-point number has no magnitude.
template <class S> ISO_INLINE bool within(S x, S limit) { return -limit <= x && x <= limit; }
template <class S> ISO_INLINE bool within(Vec3<S> v, S limit) {
  return within(v.x, limit) && within(v.y, limit) && within(v.z, limit);
}

/// Returns true if v is longer than `limit`. Most vectors are not half as long along any axis: no square root.
template <class V> ISO_INLINE bool is_longer(Vec3<V> v, V limit) {
  return !within(v, limit * V(0.5)) && limit < length(v);
}
/// Shortens v to `limit`, or to 2^-12 less where rounding leads beyond.
template <class V> ISO_INLINE Vec3<V> shortened(Vec3<V> v, V limit) {
  if (!is_longer(v, limit)) return v;
  const auto way = direction_of(v.x, v.y, v.z);
  const auto along = [&](V length) ISO_INLINE_LAMBDA {
    const auto part = [&](auto x) ISO_INLINE_LAMBDA { return round_to<V>(product(length, x)); };
    return Vec3<V>{part(way.x), part(way.y), part(way.z)};
  };
  const Vec3<V> cut = along(limit);
  return is_longer(cut, limit) ? along(limit - limit * V(0x1p-12)) : cut;
}

}  // namespace isostep::detail
