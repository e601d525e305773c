// BoundingSphere<S>, and what a hierarchy asks of a volume, for spheres and for boxes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/geometry/limits.hpp"
#include "isostep/math/aabb.hpp"

namespace isostep {

/// Holds whatever it was made around, rounding included.
/// Source:  Millington 2007, ch. 12, p. 233-234: overlap, union, growth by the squared radius.
/// Error:   radii are computed from rounded centres, so that only the length's own rounding counts: below 4 units of
///          the last place (float, double) or one resolution step (fixed point), also where a sum is compared. Each
///          radius gets 16 more of both than was computed, which outlasts them.
/// Range:   boxes within 4 position limits. Distances of such points fit every format; a radius that does not is the
///          format's highest number, which is more than any of these distances.
template <class S> struct BoundingSphere {
  Vec3<S> centre;  // [m]
  S radius;        // [m]

  static ISO_INLINE BoundingSphere around(const Aabb<S>& box) {
    const Vec3<S> centre = box.low + (box.high - box.low) * S(0.5);
    return {centre, padded(length(max(box.high - centre, centre - box.low)))};
  }
  static ISO_INLINE S padded(S radius) {
    const S step = resolution<S>() * S(16);
    return saturating_add(radius, radius * step + step);
  }
  friend ISO_INLINE bool operator==(const BoundingSphere& a, const BoundingSphere& b) {
    return a.centre == b.centre && a.radius == b.radius;
  }
};

template <class S> ISO_INLINE bool overlap(const BoundingSphere<S>& a, const BoundingSphere<S>& b) {
  const Vec3<S> way = b.centre - a.centre;
  const S reach = saturating_add(a.radius, b.radius);
  return dot_sum(way, way) <= product(reach, reach);
}
template <class S> ISO_INLINE bool overlap(const BoundingSphere<S>& a, const Aabb<S>& box) {
  const Vec3<S> way = max(max(box.low - a.centre, a.centre - box.high), Vec3<S>::zero());
  return dot_sum(way, way) <= product(a.radius, a.radius);
}
template <class S> ISO_INLINE bool contains(const BoundingSphere<S>& outer, const BoundingSphere<S>& inner) {
  const S apart = distance(outer.centre, inner.centre);
  if (apart == S(0)) return inner.radius <= outer.radius;  // exact: of equal spheres each holds the other
  return saturating_add(BoundingSphere<S>::padded(apart), inner.radius) <= outer.radius;
}
/// Returns one of the two if it holds the other; otherwise the smallest sphere around both, up to rounding.
template <class S> ISO_INLINE BoundingSphere<S> merge(const BoundingSphere<S>& a, const BoundingSphere<S>& b) {
  if (contains(a, b)) return a;
  if (contains(b, a)) return b;
  const Vec3<S> way = b.centre - a.centre;
  const S apart = length(way);
  const S half = S(0.5);
  const S from_a = apart * half + (b.radius * half - a.radius * half);  // [m] from a's centre towards b's
  const S share = from_a <= S(0) ? S(0) : from_a < apart ? from_a / apart : S(1);
  const Vec3<S> centre = a.centre + way * share;
  const S to_a = saturating_add(distance(centre, a.centre), a.radius);
  const S to_b = saturating_add(distance(centre, b.centre), b.radius);
  return {centre, BoundingSphere<S>::padded(max(to_a, to_b))};
}

namespace detail {

template <class S> ISO_INLINE std::uint32_t overlap_flag(const BoundingSphere<S>& a, const BoundingSphere<S>& b) {
  return overlap(a, b) ? 1u : 0u;
}

/// Returns the surface up to a constant factor [m^2], which hierarchies keep small.
template <class S> ISO_INLINE Sum<S> surface(const BoundingSphere<S>& a) { return product(a.radius, a.radius); }
template <class S> ISO_INLINE Sum<S> surface(const Aabb<S>& a) { return half_area(a); }

/// [m] Returns twice the centre.
template <class S> ISO_INLINE Vec3<S> twice_centre(const BoundingSphere<S>& a) { return a.centre + a.centre; }
template <class S> ISO_INLINE Vec3<S> twice_centre(const Aabb<S>& a) { return a.low + a.high; }

/// Returns a box around the volume's part of the world, for sweeps.
template <class S> ISO_INLINE Aabb<S> box_around(const BoundingSphere<S>& a) {
  const S edge = Limits<S>::position() * S(4);
  const Vec3<S> half = {a.radius, a.radius, a.radius};
  return {held_within(saturating_subtract(a.centre, half), edge), held_within(saturating_add(a.centre, half), edge)};
}
template <class S> ISO_INLINE const Aabb<S>& box_around(const Aabb<S>& a) { return a; }

}  // namespace detail

}  // namespace isostep
