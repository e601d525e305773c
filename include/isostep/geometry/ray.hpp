// A ray in a shape's frame. Distances along it are lengths [m]; one last division makes a fraction of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/math/transform.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::detail {

/// The point where a ray first meets a shape; `normal` is outward, in the shape's frame.
template <class S> struct LocalHit {
  enum Kind { missed, inside, entered } kind;
  S fraction;  // [1] of the translation
  Vec3<Unit<S>> normal;
  std::uint32_t triangle = 0;  // of a surface
  std::uint8_t material = 0;   // that triangle's
};
template <class S> ISO_INLINE LocalHit<S> no_hit() { return {LocalHit<S>::missed, S(0), Vec3<Unit<S>>::zero()}; }
template <class S> ISO_INLINE LocalHit<S> inside_hit() { return {LocalHit<S>::inside, S(0), Vec3<Unit<S>>::zero()}; }

/// A ray in a shape's frame.
template <class S> struct LocalRay {
  Vec3<S> origin;           // [m]
  Vec3<S> translation;      // [m]
  Vec3<Unit<S>> direction;  // [1]
  S length;                 // [m]

  static ISO_INLINE LocalRay of(const Transform<S>& shape, Vec3<S> origin, Vec3<S> translation) {
    const Vec3<S> local = transposed_times(shape.rotation, translation);
    const Heading<S> heading = heading_of(local);
    return {to_local(shape, origin), local, heading.direction, heading.length};
  }
};

/// Finds the distance to the sphere |p| = r from m outside it along u, if the ray comes nearer at all.
/// Symbols: b = distance to the point closest to the centre, p = that point. r^2 - p^2 is taken as (r - |p|) (r + |p|),
///          since squares of small radii have no digits left in Q16.16.
template <class S> ISO_INLINE bool enter_sphere(Vec3<S> m, Vec3<Unit<S>> u, S r, S& distance) {
  const S b = -dot(m, u);
  if (b < S(0)) return false;
  const Vec3<S> p = m + u * b;
  if (dot_sum(p, p) > product(r, r)) return false;
  const S miss = min(length(p), r);
  distance = max(b - sqrt(r - miss) * sqrt(r + miss), S(0));
  return true;
}

template <class S> ISO_INLINE LocalHit<S> cast_sphere(const LocalRay<S>& ray, Vec3<S> centre, S r) {
  const Vec3<S> m = ray.origin - centre;
  if (dot_sum(m, m) <= product(r, r)) return inside_hit<S>();
  S distance;
  if (!enter_sphere(m, ray.direction, r, distance) || distance > ray.length) return no_hit<S>();
  return {LocalHit<S>::entered, distance / ray.length, normalise(m + ray.direction * distance)};
}

}  // namespace isostep::detail
