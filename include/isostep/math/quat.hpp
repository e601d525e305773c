// Quat<U>: a rotation as a unit quaternion over the unit format of a scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

/// (x, y, z) = axis sin(angle / 2), w = cos(angle / 2): rotates from local to world frame.
template <class U> struct Quat {
  U x, y, z, w;

  static ISO_INLINE constexpr Quat identity() { return {U(0), U(0), U(0), U(1)}; }
  friend ISO_INLINE constexpr bool operator==(Quat a, Quat b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
  }

  ISO_FIELDS(x, y, z, w)
};

template <class U> ISO_INLINE constexpr Quat<U> conjugate(Quat<U> q) { return {-q.x, -q.y, -q.z, q.w}; }

/// Hamilton product: first b, then a. Each component is rounded once.
template <class U> ISO_INLINE constexpr Quat<U> operator*(Quat<U> a, Quat<U> b) {
  return {round_to<U>(product(a.w, b.x) + product(a.x, b.w) + product(a.y, b.z) - product(a.z, b.y)),
          round_to<U>(product(a.w, b.y) - product(a.x, b.z) + product(a.y, b.w) + product(a.z, b.x)),
          round_to<U>(product(a.w, b.z) + product(a.x, b.y) - product(a.y, b.x) + product(a.z, b.w)),
          round_to<U>(product(a.w, b.w) - product(a.x, b.x) - product(a.y, b.y) - product(a.z, b.z))};
}

template <class U> ISO_INLINE Quat<U> normalise(Quat<U> q) {
  normalise4(q.x, q.y, q.z, q.w);
  return q;
}

/// q turned by the small rotation vector `turn` [rad], world frame: first order, then normalised.
/// Angle turned is 2 atan(|turn| / 2): short by |turn|^2 / 12 of itself. |turn| < 2 [rad], so the norm stays below 2.
/// `half` is one half in each lane, of numbers U(0.5).
template <class U> ISO_INLINE Quat<U> integrate(Quat<U> q, Vec3<U> turn, U half) {
  const Vec3<U> d = turn * half;
  const Quat<U> turned = {q.x + round_to<U>(product(d.x, q.w) + product(d.y, q.z) - product(d.z, q.y)),
                          q.y + round_to<U>(product(d.y, q.w) - product(d.x, q.z) + product(d.z, q.x)),
                          q.z + round_to<U>(product(d.z, q.w) + product(d.x, q.y) - product(d.y, q.x)),
                          q.w - round_to<U>(product(d.x, q.x) + product(d.y, q.y) + product(d.z, q.z))};
  return normalise(turned);
}

template <class U> ISO_INLINE Quat<U> integrate(Quat<U> q, Vec3<U> turn) { return integrate(q, turn, U(0.5)); }

/// The rotation by `angle` [rad] about the unit vector `axis`.
template <class S> ISO_INLINE Quat<Unit<S>> rotation(Vec3<Unit<S>> axis, S angle) {
  using U = Unit<S>;
  const SinCos<U> half = sin_cos_to<U>(S(0.5) * angle);
  const Vec3<U> v = axis * half.sin;
  return normalise(Quat<U>{v.x, v.y, v.z, half.cos});
}

}  // namespace isostep
