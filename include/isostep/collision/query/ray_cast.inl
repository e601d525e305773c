// Bodies of ray_cast.hpp. Distances along the ray are lengths [m] and become a fraction by one last division.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/ray_cast.hpp"

namespace isostep {
namespace detail {

/// A ray in a primitive's frame.
template <class S> struct LocalRay {
  Vec3<S> origin;           // [m]
  Vec3<S> translation;      // [m]
  Vec3<Unit<S>> direction;  // [1]
  S length;                 // [m]
};

/// What one primitive answers; `local` is the normal in its frame.
template <class S> struct LocalHit {
  enum Kind { missed, inside, entered } kind;
  S fraction;
  Vec3<Unit<S>> local;
};
template <class S> ISO_INLINE LocalHit<S> no_hit() { return {LocalHit<S>::missed, S(0), Vec3<Unit<S>>::zero()}; }
template <class S> ISO_INLINE LocalHit<S> inside_hit() { return {LocalHit<S>::inside, S(0), Vec3<Unit<S>>::zero()}; }

template <class S> ISO_INLINE Vec3<Unit<S>> unit_of(Vec3<S> v) {
  const Direction<S> d = direction_of(v.x, v.y, v.z);
  return {d.x, d.y, d.z};
}

/// Distance to the sphere |p| = r from m outside it along u, if the ray comes nearer at all.
/// Symbols: b = distance to the point closest to the centre, p = that point. r^2 - p^2 is taken as (r - |p|) (r + |p|),
///          since squares of small radii have no digits left in Q16.16.
template <class S> ISO_INLINE bool enter_sphere(Vec3<S> m, Vec3<Unit<S>> u, S r, S& distance) {
  const S b = -dot(m, u);
  if (b < S(0)) return false;
  const Vec3<S> p = m + u * b;
  if (dot_sum(p, p) > product(r, r)) return false;
  const S miss = min(direction_of(p.x, p.y, p.z).length, r);
  distance = max(b - sqrt(r - miss) * sqrt(r + miss), S(0));
  return true;
}

template <class S> ISO_INLINE LocalHit<S> cast_sphere(const LocalRay<S>& ray, Vec3<S> centre, S r) {
  const Vec3<S> m = ray.origin - centre;
  if (dot_sum(m, m) <= product(r, r)) return inside_hit<S>();
  S distance;
  if (!enter_sphere(m, ray.direction, r, distance) || distance > ray.length) return no_hit<S>();
  return {LocalHit<S>::entered, distance / ray.length, unit_of(m + ray.direction * distance)};
}

/// Slabs, each mirrored so that the ray runs towards plus. The near face passed last is the one hit; ties go to the
/// lowest axis.
template <class S> ISO_INLINE LocalHit<S> cast_box(const LocalRay<S>& ray, Vec3<S> half) {
  const Vec3<S> o = abs(ray.origin);
  if (o.x <= half.x && o.y <= half.y && o.z <= half.z) return inside_hit<S>();
  S entry = S(0);
  S exit = ray.length;
  int face = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Unit<S> u = abs(ray.direction[axis]);
    if (u == Unit<S>(0)) {
      if (o[axis] > half[axis]) return no_hit<S>();
      continue;
    }
    const S at = ray.direction[axis] < Unit<S>(0) ? -ray.origin[axis] : ray.origin[axis];
    const S near = divide_to<S>(-half[axis] - at, u);
    exit = min(exit, divide_to<S>(half[axis] - at, u));
    if (near > entry) {
      entry = near;
      face = axis;
    }
  }
  if (entry > exit) return no_hit<S>();
  Vec3<Unit<S>> normal = Vec3<Unit<S>>::zero();
  normal.set(face, ray.direction[face] < Unit<S>(0) ? Unit<S>(1) : Unit<S>(-1));
  return {LocalHit<S>::entered, entry / ray.length, normal};
}

/// In the plane across the axis the capsule is a disc. Where the ray enters the endless cylinder decides: between the
/// ends it is the side that is hit, beyond an end only that end's sphere can be.
template <class S> ISO_INLINE LocalHit<S> cast_capsule(const LocalRay<S>& ray, S h, S r) {
  using U = Unit<S>;
  const Vec3<S> o = ray.origin;
  const Vec3<S> from_core = {o.x, o.y - clamp(o.y, -h, h), o.z};
  if (dot_sum(from_core, from_core) <= product(r, r)) return inside_hit<S>();
  const Vec3<S> flat = {o.x, S(0), o.z};
  S y = o.y;
  if (dot_sum(flat, flat) > product(r, r)) {
    const Direction<S> across = direction_of(ray.translation.x, S(0), ray.translation.z);
    const Vec3<U> w = {across.x, U(0), across.z};
    S distance;
    if (!enter_sphere(flat, w, r, distance) || distance > across.length) return no_hit<S>();
    y = o.y + ray.translation.y * divide_to<U>(distance, across.length);
    if (abs(y) <= h) return {LocalHit<S>::entered, distance / across.length, unit_of(flat + w * distance)};
  }
  return cast_sphere(ray, Vec3<S>{S(0), y > S(0) ? h : -h, S(0)}, r);
}

/// In the world frame: nothing is gained by rotating the ray first.
template <class S>
ISO_INLINE LocalHit<S> cast_half_space(const Primitive<S>& p, const Transform<S>& t, Vec3<S> origin,
                                       Vec3<S> translation) {
  const Vec3<Unit<S>> n = t.rotation * p.normal;
  const auto height = dot_sum(n, origin - t.position) - widen<SumOf<Unit<S>, S>>(p.offset);
  if (height <= product(Unit<S>(0), S(0))) return inside_hit<S>();
  const S fall = -dot(n, translation);
  const S start = round_to<S>(height);
  if (!(fall > S(0)) || start > fall) return no_hit<S>();
  return {LocalHit<S>::entered, start / fall, p.normal};
}

template <class S>
ISO_INLINE LocalHit<S> cast(const Primitive<S>& p, const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) {
  if (p.type == ShapeType::half_space) return cast_half_space(p, t, origin, translation);
  const Vec3<S> local = transposed_times(t.rotation, translation);
  const Direction<S> d = direction_of(local.x, local.y, local.z);
  const LocalRay<S> ray = {to_local(t, origin), local, {d.x, d.y, d.z}, d.length};
  if (p.type == ShapeType::sphere) return cast_sphere(ray, Vec3<S>::zero(), p.radius);
  if (p.type == ShapeType::capsule) return cast_capsule(ray, p.half.y, p.radius);
  return cast_box(ray, p.half);
}

}  // namespace detail

template <class S>
bool ray_cast(const Primitive<S>& primitive, const Transform<S>& transform, Vec3<S> origin, Vec3<S> translation,
              S max_fraction, RayHit<S>& hit) {
  const detail::LocalHit<S> found = detail::cast(primitive, transform, origin, translation);
  if (found.kind == detail::LocalHit<S>::missed || found.fraction > max_fraction) return false;
  hit.fraction = found.fraction;
  hit.normal =
      found.kind == detail::LocalHit<S>::inside ? -detail::unit_of(translation) : transform.rotation * found.local;
  return true;
}

}  // namespace isostep
