// What the files of shapes are made of.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/closest.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/mass_terms.hpp"
#include "isostep/geometry/primitive.hpp"
#include "isostep/geometry/ray.hpp"
#include "isostep/geometry/shape_fault.hpp"
#include "isostep/geometry/shapes/solid_face.hpp"
#include "isostep/math/aabb.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/scalar/literal.hpp"

namespace isostep::detail {

inline constexpr double kPi = 3.141592653589793;

template <class S> ISO_INLINE constexpr ShapeFault fault_of_size(S size) {
  if (!(size > S(0))) return ShapeFault::size_not_positive;
  if (size < Limits<S>::minimum_size()) return ShapeFault::size_too_small;
  if (size > Limits<S>::extent()) return ShapeFault::size_too_large;
  return ShapeFault::none;
}

/// Returns c^2. A component beyond 9/8 counts as 9/8: enough to be refused, and four squares fit the sum.
template <class U> ISO_INLINE Sum<U> bounded_square(U c) {
  const U bounded = clamp(c, U(-1.125), U(1.125));
  return product(bounded, bounded);
}
template <class U> ISO_INLINE Sum<U> squared_norm(U x, U y, U z, U w) {
  return bounded_square(x) + bounded_square(y) + bounded_square(z) + bounded_square(w);
}
template <class U> ISO_INLINE bool nearly_unit(U x, U y, U z, U w) {
  const Sum<U> norm = squared_norm(x, y, z, w);
  return norm > product(U(1), U(1 - 1.0 / 64)) && norm < product(U(1), U(1 + 1.0 / 64));
}
/// Returns true if the length is one, as close as the format can say.
template <class U> ISO_INLINE bool is_unit(U x, U y, U z, U w) { return round_to<U>(squared_norm(x, y, z, w)) == U(1); }

// ---- debug drawing

struct NoLine {
  template <class V> ISO_INLINE void operator()(V, V) const {}
};
struct NoPoint {
  template <class V> ISO_INLINE void operator()(V) const {}
};
struct NoTriangle {
  template <class V> ISO_INLINE void operator()(V, V, V) const {}
};

/// Returns cos(k pi / 8), for circles of sixteen lines.
template <class S> ISO_INLINE constexpr Unit<S> cosine_of_sixteenths(int k) {
  constexpr Unit<S> kQuarter[5] = {Unit<S>(1), Unit<S>(0.9238795325112867), Unit<S>(0.7071067811865476),
                                   Unit<S>(0.3826834323650898), Unit<S>(0)};
  k = (k + 16) % 16;
  if (k > 8) k = 16 - k;
  return k <= 4 ? kQuarter[k] : -kQuarter[8 - k];
}
/// Part of a circle: from the axis `across` towards the axis `up`, begin and end in sixteenths of a turn.
template <class S, class Line>
ISO_INLINE void visit_arc(const Line& line, Vec3<S> centre, S radius, int across, int up, int begin = 0, int end = 16) {
  const auto at = [&](int k) ISO_INLINE_LAMBDA {
    Vec3<S> p = centre;
    p[across] += radius * cosine_of_sixteenths<S>(k);
    p[up] += radius * cosine_of_sixteenths<S>(k - 4);
    return p;
  };
  for (int k = begin; k < end; ++k) line(at(k), at(k + 1));
}

}  // namespace isostep::detail
