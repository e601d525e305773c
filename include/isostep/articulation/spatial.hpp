// Six-dimensional vectors and inertias of the articulated-body algorithm, about one point, along the world's axes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/mat3.hpp"
#include "isostep/scalar/headroom.hpp"

namespace isostep::detail {

/// A force at a point and the torque about it.
template <class S> struct Wrench { Vec3<S> torque, force; };
/// The accelerations of a body: its angular one, and that of its point at the place of reference.
template <class S> struct PointAcceleration { Vec3<S> angular, linear; };

/// Wrench = inertia * acceleration:  torque = angular a + coupling l,  force = coupling^T a + linear l.
/// Source:  Featherstone 2008, Rigid Body Dynamics Algorithms, eq. 2.63 and 7.4.   Differs: the axes are the world's,
///          so a change of reference is a shift alone; accelerations are those of points, not spatial ones.
template <class S> struct ArticulatedInertia {
  Mat3<S> angular;  // symmetric
  Mat3<S> coupling;
  Mat3<S> linear;  // symmetric
};

template <class S> ISO_INLINE constexpr Mat3<S> zero_matrix() { return Mat3<S>::diagonal(Vec3<S>::zero()); }

/// Returns sums of products, held within half of the format.
template <class A, class S> ISO_INLINE S held_dot(Vec3<A> a, Vec3<S> b) {
  return round_with_headroom<S>(dot_sum(a, b));
}
template <class S> ISO_INLINE S held_dot(Vec3<S> a, Vec3<S> b, Vec3<S> c, Vec3<S> d) {
  return round_with_headroom<S>(dot_sum(a, b) + dot_sum(c, d));
}
template <class S> ISO_INLINE S held_product(S a, S b) { return round_with_headroom<S>(product(a, b)); }
template <class S> ISO_INLINE Vec3<S> held_product(Vec3<S> v, S s) {
  return {held_product(v.x, s), held_product(v.y, s), held_product(v.z, s)};
}
template <class S> ISO_INLINE Vec3<S> held_cross(Vec3<S> a, Vec3<S> b) {
  return {round_with_headroom<S>(product(a.y, b.z) - product(a.z, b.y)),
          round_with_headroom<S>(product(a.z, b.x) - product(a.x, b.z)),
          round_with_headroom<S>(product(a.x, b.y) - product(a.y, b.x))};
}
template <class S> ISO_INLINE Vec3<S> held_times(const Mat3<S>& m, Vec3<S> v) {
  return {held_dot(m.rows[0], v), held_dot(m.rows[1], v), held_dot(m.rows[2], v)};
}
template <class S> ISO_INLINE Vec3<S> held_sum(Vec3<S> a, Vec3<S> b) { return with_headroom(saturating_add(a, b)); }
template <class S> ISO_INLINE Wrench<S> operator+(const Wrench<S>& a, const Wrench<S>& b) {
  return {held_sum(a.torque, b.torque), held_sum(a.force, b.force)};
}
/// Returns the wrench about a point, to which its own is `arm` away.
template <class S> ISO_INLINE Wrench<S> shifted(const Wrench<S>& w, Vec3<S> arm) {
  return {held_sum(w.torque, held_cross(arm, w.force)), w.force};
}

template <class S> ISO_INLINE Vec3<S> torque_of(const ArticulatedInertia<S>& i, const PointAcceleration<S>& a) {
  const auto part = [&](int k) ISO_INLINE_LAMBDA {
    return held_dot(i.angular.rows[k], a.angular, i.coupling.rows[k], a.linear);
  };
  return {part(0), part(1), part(2)};
}
template <class S> ISO_INLINE Wrench<S> operator*(const ArticulatedInertia<S>& i, const PointAcceleration<S>& a) {
  const auto part = [&](int k) ISO_INLINE_LAMBDA {
    return held_dot(i.coupling.column(k), a.angular, i.linear.rows[k], a.linear);
  };
  return {torque_of(i, a), {part(0), part(1), part(2)}};
}

/// Mirrors the upper half of a matrix, so that rounding leaves no asymmetry.
template <class S> ISO_INLINE Mat3<S> mirrored(Mat3<S> m) {
  m.rows[1].x = m.rows[0].y;
  m.rows[2].x = m.rows[0].z;
  m.rows[2].y = m.rows[1].z;
  return m;
}
/// Returns m - a b^T.
template <class S> ISO_INLINE Mat3<S> minus_outer(const Mat3<S>& m, Vec3<S> a, Vec3<S> b) {
  return {{m.rows[0] - b * a.x, m.rows[1] - b * a.y, m.rows[2] - b * a.z}};
}
template <class S> ISO_INLINE Mat3<S> operator-(const Mat3<S>& a, const Mat3<S>& b) {
  return {{a.rows[0] - b.rows[0], a.rows[1] - b.rows[1], a.rows[2] - b.rows[2]}};
}
template <class S> ISO_INLINE Mat3<S> operator*(const Mat3<S>& m, S s) {
  return {{m.rows[0] * s, m.rows[1] * s, m.rows[2] * s}};
}
template <class S> ISO_INLINE S trace(const Mat3<S>& m) { return m.rows[0].x + m.rows[1].y + m.rows[2].z; }
template <class S> ISO_INLINE Mat3<S> plus_diagonal(Mat3<S> m, S d) {
  for (int k = 0; k < 3; ++k) m.rows[k][k] += d;
  return m;
}

/// The inertia about a point from which its own is `arm` away.
/// Source:  Featherstone 2008, table 2.9 (transformation of an inertia) without its rotation.
///          coupling' = coupling + [arm] linear,  angular' = angular + [arm] coupling^T - coupling' [arm].
template <class S> ISO_INLINE ArticulatedInertia<S> shifted(const ArticulatedInertia<S>& i, Vec3<S> arm) {
  const auto crossed = [arm](const Mat3<S>& m) ISO_INLINE_LAMBDA {  // ([arm] m^T)^T
    return Mat3<S>{{cross(arm, m.rows[0]), cross(arm, m.rows[1]), cross(arm, m.rows[2])}};
  };
  ArticulatedInertia<S> r;
  r.coupling = i.coupling + transpose(crossed(i.linear));
  r.angular = mirrored(i.angular + (transpose(crossed(i.coupling)) + crossed(r.coupling)));
  r.linear = i.linear;
  return r;
}
template <class S> ISO_INLINE void add(ArticulatedInertia<S>& to, const ArticulatedInertia<S>& i) {
  to.angular = to.angular + i.angular;
  to.coupling = to.coupling + i.coupling;
  to.linear = to.linear + i.linear;
}

/// Returns the inertia of one body. `inertia` is about its centre of mass, which is `centre` away from the reference.
template <class S> ISO_INLINE ArticulatedInertia<S> inertia_of_body(S m, Vec3<S> centre, const Mat3<S>& inertia) {
  return shifted(ArticulatedInertia<S>{inertia, zero_matrix<S>(), Mat3<S>::diagonal({m, m, m})}, centre);
}

/// A symmetric matrix of three rows by its factors L D L^T.
/// Limits:  a pivot below `least` gives no answer along its row: what nothing resists does not move.
template <class S> struct Symmetric3 {
  Vec3<S> pivots;
  S l10, l20, l21;

  static ISO_INLINE S quotient(S a, S b) { return S(0) < b ? with_headroom(divide_to<S>(a, b)) : S(0); }
  static ISO_INLINE Symmetric3 of(const Mat3<S>& m, S least) {
    const auto kept = [least](S pivot) ISO_INLINE_LAMBDA { return least < pivot ? pivot : S(0); };
    Symmetric3 r;
    r.pivots.x = kept(m.rows[0].x);
    r.l10 = quotient(m.rows[0].y, r.pivots.x);
    r.l20 = quotient(m.rows[0].z, r.pivots.x);
    r.pivots.y = kept(m.rows[1].y - held_product(r.l10, m.rows[0].y));
    r.l21 = quotient(m.rows[1].z - held_product(r.l10, m.rows[0].z), r.pivots.y);
    const S rest = m.rows[2].z - held_product(r.l20, m.rows[0].z);
    r.pivots.z = kept(rest - held_product(r.l21, m.rows[1].z - held_product(r.l10, m.rows[0].z)));
    return r;
  }
  ISO_INLINE Vec3<S> solve(Vec3<S> b) const {
    const auto less = [](S a, S l, S x)
                          ISO_INLINE_LAMBDA { return round_with_headroom<S>(widen<Sum<S>>(a) - product(l, x)); };
    const S y = less(b.y, l10, b.x);
    const S z = quotient(less(less(b.z, l20, b.x), l21, y), pivots.z);
    const S up = less(quotient(y, pivots.y), l21, z);
    return {less(less(quotient(b.x, pivots.x), l20, z), l10, up), up, z};
  }
  ISO_INLINE Mat3<S> solve(const Mat3<S>& m) const {
    return transpose(Mat3<S>{{solve(m.column(0)), solve(m.column(1)), solve(m.column(2))}});
  }
};

}  // namespace isostep::detail
