// Vec3<T>: three numbers of one format, and the products of two vectors, each rounded once.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/scalar/headroom.hpp"
#include "isostep/scalar/math.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// A vector of lengths [m], velocities [m/s], ... or, as Vec3<Unit<S>>, a direction [1].
template <class T> struct Vec3 {
  T x, y, z;

  static ISO_INLINE constexpr Vec3 zero() { return {T(0), T(0), T(0)}; }

  friend ISO_INLINE constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend ISO_INLINE constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend ISO_INLINE constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  ISO_INLINE constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
  ISO_INLINE constexpr Vec3& operator-=(Vec3 b) { return *this = *this - b; }
  friend ISO_INLINE constexpr bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  friend ISO_INLINE constexpr bool operator!=(Vec3 a, Vec3 b) { return !(a == b); }

  /// Component 0, 1 or 2.
  ISO_INLINE constexpr T operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  ISO_INLINE constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }

  ISO_FIELDS(x, y, z)
};

/// A number of any format: what a vector is multiplied with.
template <class T>
concept Factor = !HasFields<T>;

/// v s and s v, in the coarser of the two formats: length * direction is length.
template <class A, Factor B> ISO_INLINE constexpr auto operator*(Vec3<A> v, B s) -> Vec3<decltype(A{} * B{})> {
  return {v.x * s, v.y * s, v.z * s};
}
template <class A, Factor B> ISO_INLINE constexpr auto operator*(B s, Vec3<A> v) -> Vec3<decltype(B{} * A{})> {
  return {s * v.x, s * v.y, s * v.z};
}
/// Divides each component by s. Fixed point: a quotient that does not fit wraps, as that of numbers does.
template <class A, Factor B> ISO_INLINE constexpr auto operator/(Vec3<A> v, B s) -> Vec3<decltype(A{} / B{})> {
  return {v.x / s, v.y / s, v.z / s};
}

/// a . b as an exact sum, for signs and comparisons without rounding.
template <class A, class B> ISO_INLINE constexpr SumOf<A, B> dot_sum(Vec3<A> a, Vec3<B> b) {
  return product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z);
}
/// a . b in the coarser of the two formats, rounded once.
template <class A, class B> ISO_INLINE constexpr auto dot(Vec3<A> a, Vec3<B> b) -> decltype(A{} * B{}) {
  return round_to<decltype(A{} * B{})>(dot_sum(a, b));
}
/// a x b in the coarser of the two formats, each component rounded once.
template <class A, class B> ISO_INLINE constexpr auto cross(Vec3<A> a, Vec3<B> b) -> Vec3<decltype(A{} * B{})> {
  using R = decltype(A{} * B{});
  return {round_to<R>(product(a.y, b.z) - product(a.z, b.y)), round_to<R>(product(a.z, b.x) - product(a.x, b.z)),
          round_to<R>(product(a.x, b.y) - product(a.y, b.x))};
}
/// Component by component.
template <class A, class B> ISO_INLINE constexpr auto scale(Vec3<A> a, Vec3<B> b) -> Vec3<decltype(A{} * B{})> {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class T> ISO_INLINE constexpr Vec3<T> abs(Vec3<T> a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
template <class T> ISO_INLINE constexpr Vec3<T> min(Vec3<T> a, Vec3<T> b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
template <class T> ISO_INLINE constexpr Vec3<T> max(Vec3<T> a, Vec3<T> b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
/// Clamps each component to [-limit, limit].
template <class T> ISO_INLINE constexpr Vec3<T> held_within(Vec3<T> v, T limit) {
  return {clamp(v.x, -limit, limit), clamp(v.y, -limit, limit), clamp(v.z, -limit, limit)};
}
/// Clamps each component to half of the format: two such vectors can be added.
template <class T> ISO_INLINE constexpr Vec3<T> with_headroom(Vec3<T> v) {
  return {with_headroom(v.x), with_headroom(v.y), with_headroom(v.z)};
}
/// a + b and a - b, held at the ends of the format.
template <class T> ISO_INLINE constexpr Vec3<T> saturating_add(Vec3<T> a, Vec3<T> b) {
  return {saturating_add(a.x, b.x), saturating_add(a.y, b.y), saturating_add(a.z, b.z)};
}
template <class T> ISO_INLINE constexpr Vec3<T> saturating_subtract(Vec3<T> a, Vec3<T> b) {
  return {saturating_subtract(a.x, b.x), saturating_subtract(a.y, b.y), saturating_subtract(a.z, b.z)};
}
/// The largest component's magnitude: a length that needs no square.
template <class T> ISO_INLINE constexpr T max_abs(Vec3<T> a) { return max(abs(a.x), max(abs(a.y), abs(a.z))); }

/// The direction [1] and the length of v, both zero for the zero vector. Errors and ends: direction_of() in
/// scalar/math.hpp.
template <class S> struct Heading {
  Vec3<Unit<S>> direction;
  S length;
};
template <class S> ISO_INLINE constexpr Heading<S> heading_of(Vec3<S> v) {
  const auto d = direction_of(v.x, v.y, v.z);
  return {{d.x, d.y, d.z}, d.length};
}
/// |v|, whatever its magnitude; fixed point: the highest number where it does not fit.
template <class S> ISO_INLINE constexpr S length(Vec3<S> v) { return direction_of(v.x, v.y, v.z).length; }
/// |b - a|, where the difference fits the format.
template <class S> ISO_INLINE constexpr S distance(Vec3<S> a, Vec3<S> b) { return length(b - a); }
/// v / |v|; zero for the zero vector.
template <class S> ISO_INLINE constexpr Vec3<Unit<S>> normalise(Vec3<S> v) { return heading_of(v).direction; }

template <class Out, class T> ISO_INLINE constexpr Vec3<Out> convert(Vec3<T> a) {
  return {convert<Out>(a.x), convert<Out>(a.y), convert<Out>(a.z)};
}
template <class T> ISO_INLINE constexpr bool is_finite(Vec3<T> a) {
  return is_finite(a.x) && is_finite(a.y) && is_finite(a.z);
}

/// Two unit vectors that complete the unit vector n to a right-handed basis (t, u, n).
template <class U> struct Tangents { Vec3<U> t, u; };

/// Source:  Duff et al. 2017, Building an Orthonormal Basis, Revisited, JCGT 6(1), eq. 5: one division, no square root.
/// Differs: x and z trade places, so that the seam lies at n.z = 0 rather than along a floor's normal.
template <class U> ISO_INLINE constexpr Tangents<U> tangents_of(Vec3<U> n) {
  const bool negative = n.z < U(0);
  // Both sides are halved: 1 + n.z may be 2, which U cannot hold.
  const U half_z = n.z * U(0.5);
  const U divisor = negative ? U(-0.5) + half_z : U(0.5) + half_z;
  const U a = -divide_to<U>(U(0.5), divisor);
  const U b = n.x * (n.y * a);
  const U xx = n.x * (n.x * a);
  const U yy = n.y * (n.y * a);
  if (negative) return {{U(1) - xx, -b, n.x}, {b, U(-1) + yy, -n.y}};
  return {{U(1) + xx, b, -n.x}, {b, U(1) + yy, -n.y}};
}

}  // namespace isostep
