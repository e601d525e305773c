// Segments and the closest points of two of them: the cores of capsules and the edges of boxes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/transform.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::detail {

template <class S> struct Segment {
  Vec3<S> centre;           // [m]
  Vec3<Unit<S>> direction;  // [1]
  S half;                   // [m]

  ISO_INLINE constexpr Vec3<S> at(S along) const { return centre + direction * along; }
  /// Returns the place on the segment that is nearest to p, as a distance along it from the centre [m].
  ISO_INLINE constexpr S nearest(Vec3<S> p) const { return clamp(dot(p - centre, direction), -half, half); }
};

/// Returns a segment in the frame that `t` leads to.
template <class S> ISO_INLINE Segment<S> seen_by(const Transform<S>& t, const Segment<S>& s) {
  return {to_world(t, s.centre), t.rotation * s.direction, s.half};
}

/// The closest points of two segments are a.at(s) and b.at(t); sine2 is the squared sine of the angle between them.
template <class S> struct ClosestPair {
  S s, t;         // [m]
  Unit<S> sine2;  // [1]
};

/// Source:  Ericson 2005, Real-Time Collision Detection, sec. 5.1.9.
/// Differs: with unit directions only lengths are divided, never squares: t = -(r . w) / |w|, where w is b's direction
///          without its part along a's. The root's error is epsilon / sine, its effect on the distance epsilon.
/// Limits:  below a sine of 2 sqrt(resolution) the segments count as parallel: the middle of their overlap is taken,
///          which errs by that sine times the overlap.
template <class S> ISO_INLINE ClosestPair<S> closest_points(const Segment<S>& a, const Segment<S>& b) {
  using U = Unit<S>;
  const Vec3<S> r = b.centre - a.centre;
  const U cosine = dot(a.direction, b.direction);
  const Vec3<U> w = b.direction - a.direction * cosine;
  const U sine2 = dot(w, w);
  S s, t;
  if (sine2 > resolution<U>() + resolution<U>() + resolution<U>() + resolution<U>()) {
    const Heading<U> across = heading_of(w);
    t = clamp(divide_to<S>(-dot(r, across.direction), across.length), -b.half, b.half);
  } else {
    const S middle = dot(r, a.direction), reach = b.half * abs(cosine);
    const S low = clamp(middle - reach, -a.half, a.half), high = clamp(middle + reach, -a.half, a.half);
    t = b.nearest(a.at((low + high) * S(0.5)));
  }
  const S free = dot(r + b.direction * t, a.direction);
  s = clamp(free, -a.half, a.half);
  if (s != free) t = b.nearest(a.at(s));
  return {s, t, sine2};
}

}  // namespace isostep::detail
