// The ellipse of friction forces that a contact with a grain can bear, and the force in it that is nearest to another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/part_traits.hpp"
#include "isostep/math/mat3.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/finer.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

/// The factors of friction along the axes of a body: Material::anisotropy.
template <class S> struct Grain {
  Vec3<S> factors;      // [1] f
  Mat3<Unit<S>> frame;  // body to world

  ISO_INLINE bool is_there() const { return !(factors == Vec3<S>{S(1), S(1), S(1)}); }
};

/// Holds what a contact's grain leaves of its friction. Half axes: `wide` along `axis`, `wide ratio` across it.
template <class S> struct FrictionEllipse {
  Vec3<Unit<S>> axis;  // [1] in the plane of the contact. Zero for a circle
  Unit<S> wide, ratio;
};

namespace detail {

/// A symmetric matrix in the plane of a contact, over its tangents t and u: B, whose eigenvalues are the squares of an
/// ellipse's half axes.
template <class U> struct PlaneMatrix { U tt, tu, uu; };

/// Cuts the ellipsoid sum (d_i / f_i)^2 = 1 by the plane of a contact.
/// Symbols: A = diag(1 / f^2), P = [t u]. B = (P^T A P)^-1 = adj(P^T D P) / sum (n_i f_i)^2 with D = diag((f_j f_k)^2):
///          no number exceeds one.
template <class S>
ISO_INLINE PlaneMatrix<Unit<S>> section_of(const Grain<S>& grain, Vec3<Unit<S>> n, const Tangents<Unit<S>>& basis) {
  using U = Unit<S>;
  const S largest = max_abs(grain.factors);
  const auto part = [largest](S x) ISO_INLINE_LAMBDA { return divide_to<U>(x, largest); };
  const auto scaled = [](Vec3<U> v, Vec3<U> by) ISO_INLINE_LAMBDA -> Vec3<U> {
    return {v.x * by.x, v.y * by.y, v.z * by.z};
  };
  const Vec3<U> f = {part(grain.factors.x), part(grain.factors.y), part(grain.factors.z)};
  const Vec3<U> pairs = {f.y * f.z, f.z * f.x, f.x * f.y};
  const Vec3<U> t = scaled(transposed_times(grain.frame, basis.t), pairs);
  const Vec3<U> u = scaled(transposed_times(grain.frame, basis.u), pairs);
  const Vec3<U> m = scaled(transposed_times(grain.frame, n), f);
  const U area = dot(m, m), size = convert<U>(largest) * convert<U>(largest);
  const auto entry = [&](U x) ISO_INLINE_LAMBDA { return divide_to<U>(x, area) * size; };
  return {entry(dot(u, u)), -entry(dot(t, u)), entry(dot(t, t))};
}

/// Returns the largest ellipse in the common part of two: under the linear map that makes circles of one and lays the
/// axes of the other along the tangents, it has the lesser half axis of both along each. So two equal grains are that
/// grain, and a plain surface takes nothing from another.
/// Symbols: b e = mu a e has two solutions, mu = (h -+ root) / |a|, h = tr(adj(a) b) / 2, root^2 = h^2 - |a| |b|. Along
///          the e of the lesser one b is the narrower: a - (1 - mu) (a e) (a e)^T / (e a e).
template <class U> ISO_INLINE PlaneMatrix<U> common_part(const PlaneMatrix<U>& a, const PlaneMatrix<U>& b) {
  const auto determinant = [](const PlaneMatrix<U>& m) ISO_INLINE_LAMBDA { return m.tt * m.uu - m.tu * m.tu; };
  const U of_a = determinant(a), of_b = determinant(b), half = U(0.5);
  const U h = half * (a.tt * b.uu) + half * (a.uu * b.tt) - a.tu * b.tu;
  const U most = h + sqrt(max(h * h - of_a * of_b, U(0)));
  if (!(of_a < most)) return b;
  if (!(of_b < most)) return a;
  const U mu = divide_to<U>(of_b, most);
  const PlaneMatrix<U> rest = {b.tt - mu * a.tt, b.tu - mu * a.tu, b.uu - mu * a.uu};  // rest e = 0
  const bool upright = rest.uu < rest.tt;
  const auto e = direction_of(upright ? -rest.tu : rest.uu, upright ? rest.tt : -rest.tu, U(0));
  const U t = a.tt * e.x + a.tu * e.y, u = a.tu * e.x + a.uu * e.y, size = sqrt(e.x * t + e.y * u);
  if (!(U(0) < size)) return a;
  const U along_t = divide_to<U>(t, size), along_u = divide_to<U>(u, size), less = U(1) - mu;
  return {a.tt - less * (along_t * along_t), a.tu - less * (along_t * along_u), a.uu - less * (along_u * along_u)};
}
/// Computes it in 64 bits, as determinants of the narrowest ellipses are 2^-24.
template <class U> ISO_INLINE PlaneMatrix<U> common_section(const PlaneMatrix<U>& a, const PlaneMatrix<U>& b) {
  using Wide = Unit<Finer<U>>;
  const auto widened = [](const PlaneMatrix<U>& m) ISO_INLINE_LAMBDA -> PlaneMatrix<Wide> {
    return {finer<Wide>(m.tt), finer<Wide>(m.tu), finer<Wide>(m.uu)};
  };
  const PlaneMatrix<Wide> both = common_part(widened(a), widened(b));
  return {coarser<U>(both.tt), coarser<U>(both.tu), coarser<U>(both.uu)};
}

}  // namespace detail

/// Returns what two grains leave of a contact's friction, one of which is there. n: normal of the contact.
template <class S>
ISO_INLINE FrictionEllipse<S> friction_ellipse(const Grain<S>& a, const Grain<S>& b, Vec3<Unit<S>> n) {
  using U = Unit<S>;
  const Tangents<U> basis = tangents_of(n);
  const detail::PlaneMatrix<U> m =
      !b.is_there()   ? detail::section_of(a, n, basis)
      : !a.is_there() ? detail::section_of(b, n, basis)
                      : detail::common_section(detail::section_of(a, n, basis), detail::section_of(b, n, basis));
  const U half = U(0.5), middle = half * m.tt + half * m.uu, apart = half * m.tt - half * m.uu;
  const U radius = sqrt(apart * apart + m.tu * m.tu), wide = middle + radius;
  FrictionEllipse<S> ellipse = {Vec3<U>::zero(), sqrt(max(wide, U(0))), U(1)};
  const bool upright = apart < U(0);
  const auto way = direction_of(upright ? m.tu : apart + radius, upright ? radius - apart : m.tu, U(0));
  if (!(U(0) < way.length)) return ellipse;
  ellipse.axis = normalise(basis.t * way.x + basis.u * way.y);
  ellipse.ratio = clamp(sqrt(divide_to<U>(max(middle - radius, U(0)), wide)), U(kLeastGrain), U(1));
  return ellipse;
}

/// [1] Returns the factor of what spins about n and slips in all directions, over that along the longer half axis: the
/// root mean square of the half axes, at most 11 % above the mean of the dissipation over all directions.
template <class U> ISO_INLINE U spinning_factor(U ratio) { return sqrt(U(0.5) + U(0.5) * (ratio * ratio)); }

/// Brings a force (x, y) back into an ellipse with half axes limit and limit ratio, to its nearest point. Returns true
/// if it was outside. Repeated with x and y less what slips times one step for both, this finds the force of the
/// ellipse that dissipates most power: a body that slides along its runners hardly slows, and loses speed across them
/// at once.
/// `Numbers` divides two forces or two ratios, |a| < 2 |b|, and multiplies as IslandNumber does. No ratio reaches two.
/// Source:  Moreau 1974 (maximal dissipation); Michalowski, Mroz 1978, Arch. Mech. 30(3).
/// Symbols: the nearest point is x / (1 + g), y ratio^2 / (ratio^2 + g) with the g for which it lies on the ellipse.
///          Forces are scaled by ratio / (2 max(|x|, |y|)): reach = the limit, excess = reach g. Newton's iteration for
///          1 / |(a, b)| = 1 begins below its end and does not pass it (More, Sorensen 1983).
/// Errors:  after kTurns below 1e-6 of the limit for ratios from 1/16 on, below 6e-4 at 1/64.
template <class Numbers, class T, class U> ISO_INLINE bool hold_in_ellipse(U ratio, T limit, T& x, T& y) {
  constexpr int kTurns = 6;
  const T most = max(abs(x), abs(y));
  if (!(T(0) < most)) return false;
  const U half = U(0.5), none = U(0);
  U reach;
  if (limit < most) {
    reach = ratio * (half * Numbers::quotient(limit, most));
  } else {
    const U part = Numbers::quotient(most, limit);
    if (!(ratio < part + half * part)) return false;
    reach = Numbers::quotient(half * ratio, part);
  }
  const U along = ratio * (half * Numbers::quotient(x, most)), across = half * Numbers::quotient(y, most);
  if (!(reach * reach < along * along + across * across)) return false;
  const U square = ratio * ratio;
  U excess = max(none, max(abs(along) - reach, square * (abs(across) - reach)));
  U a, b, length;  // of the force over the limit: halves
  for (int turn = 0;; ++turn) {
    const U to_x = reach + excess, to_y = square * reach + excess;
    a = half * Numbers::quotient(along, to_x);
    b = half * Numbers::quotient(square * across, to_y);
    const U of_a = a * a, of_b = b * b, both = of_a + of_b;
    length = Numbers::root(both);
    if (turn == kTurns) break;
    const U step = to_x < to_y ? Numbers::quotient(both * to_x, of_a + of_b * Numbers::quotient(to_x, to_y))
                               : Numbers::quotient(both * to_y, of_a * Numbers::quotient(to_y, to_x) + of_b);
    excess = excess + (length + length - U(1)) * step;
  }
  x = Numbers::rounded(Numbers::times(limit, Numbers::quotient(a, length)));
  y = Numbers::rounded(Numbers::times(limit, ratio * Numbers::quotient(b, length)));
  return true;
}

namespace detail {
/// Impulses, and ratios of them.
template <class S> struct EllipseNumbers {
  using U = Unit<S>;
  template <class T> static ISO_INLINE U quotient(T a, T b) { return divide_to<U>(a, b); }
  static ISO_INLINE U root(U a) { return sqrt(a); }
  static ISO_INLINE auto times(Velocity<S> a, U b) { return product(a, b); }
  template <class Sum> static ISO_INLINE Velocity<S> rounded(Sum a) { return round_to<Velocity<S>>(a); }
};
}  // namespace detail

/// hold_in_ellipse() for impulses [m/s].
template <class S>
ISO_INLINE bool hold_impulse_in_ellipse(Unit<S> ratio, Velocity<S> limit, Velocity<S>& x, Velocity<S>& y) {
  return hold_in_ellipse<detail::EllipseNumbers<S>>(ratio, limit, x, y);
}

}  // namespace isostep
