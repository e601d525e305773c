// Moments of inertia of solids, shells and rods in closed form, for a user's own masses and joints.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/mat3.hpp"
#include "isostep/scalar/finer.hpp"

namespace isostep {

// Principal moments [kg m^2] about the centre of mass, unless a name says otherwise, of a mass [kg] spread evenly. Axes
// and sizes are those of shapes: a solid with an axis has it along local y, and half heights, half lengths and radii
// [m] are given. mass_properties() gives kappa of shapes by their density: the mass over these.
// Source:  Millington 2007, Game Physics Engine Development, appendix A (p. 431-433), in full sizes there.
// Error:   one rounding to S, beside a few of Finer<S>: 1e-6 (float), 1e-12 (double), 1e-3 (Q16.16) and 1e-8 (Q32.32)
//          of the largest moment, for 0.5 m to 3 m and 1 kg to 20 kg. Measured in tests/unit/geometry/inertia_test.cpp.
// Limits:  fixed point: mass size^2 has to fit S.

namespace detail {
/// m (a x^2 + b y^2) in Finer<S>, rounded once.
template <class S> ISO_INLINE S moment(S mass, Finer<S> a, S x, Finer<S> b, S y) {
  using F = Finer<S>;
  const F fx = finer<F>(x), fy = finer<F>(y);
  return coarser<S>(finer<F>(mass) * (a * (fx * fx) + b * (fy * fy)));
}
}  // namespace detail

template <class S> ISO_INLINE Vec3<S> inertia_of_sphere(S mass, S radius) {
  const S i = detail::moment<S>(mass, Finer<S>(0.4), radius, Finer<S>(0), S(0));
  return {i, i, i};
}
/// A shell with all of the mass at the radius.
template <class S> ISO_INLINE Vec3<S> inertia_of_spherical_shell(S mass, S radius) {
  const S i = detail::moment<S>(mass, Finer<S>(2.0 / 3), radius, Finer<S>(0), S(0));
  return {i, i, i};
}
/// A solid ellipsoid; `half` are its semi-axes.
template <class S> ISO_INLINE Vec3<S> inertia_of_ellipsoid(S mass, Vec3<S> half) {
  const Finer<S> fifth = Finer<S>(0.2);
  return {detail::moment<S>(mass, fifth, half.y, fifth, half.z), detail::moment<S>(mass, fifth, half.z, fifth, half.x),
          detail::moment<S>(mass, fifth, half.x, fifth, half.y)};
}
template <class S> ISO_INLINE Vec3<S> inertia_of_box(S mass, Vec3<S> half) {
  const Finer<S> third = Finer<S>(1.0 / 3);
  return {detail::moment<S>(mass, third, half.y, third, half.z), detail::moment<S>(mass, third, half.z, third, half.x),
          detail::moment<S>(mass, third, half.x, third, half.y)};
}
/// A line of no thickness along y.
template <class S> ISO_INLINE Vec3<S> inertia_of_rod(S mass, S half_length) {
  const S across = detail::moment<S>(mass, Finer<S>(1.0 / 3), half_length, Finer<S>(0), S(0));
  return {across, S(0), across};
}
/// The moments about the rod's end.
template <class S> ISO_INLINE Vec3<S> inertia_of_rod_at_end(S mass, S half_length) {
  const S across = detail::moment<S>(mass, Finer<S>(4.0 / 3), half_length, Finer<S>(0), S(0));
  return {across, S(0), across};
}
/// A cylinder; half_height 0 makes a disc.
template <class S> ISO_INLINE Vec3<S> inertia_of_cylinder(S mass, S radius, S half_height) {
  const S across = detail::moment<S>(mass, Finer<S>(0.25), radius, Finer<S>(1.0 / 3), half_height);
  return {across, detail::moment<S>(mass, Finer<S>(0.5), radius, Finer<S>(0), S(0)), across};
}
/// A cylinder with a hole along its axis. Equal radii make a thin pipe, and with half_height 0 a hoop.
template <class S> ISO_INLINE Vec3<S> inertia_of_tube(S mass, S inner_radius, S outer_radius, S half_height) {
  using F = Finer<S>;
  const F i = finer<F>(inner_radius), o = finer<F>(outer_radius), h = finer<F>(half_height), m = finer<F>(mass);
  const F squares = i * i + o * o;
  const S across = coarser<S>(m * (squares * F(0.25) + (h * h) * F(1.0 / 3)));
  return {across, coarser<S>(m * (squares * F(0.5))), across};
}
/// The moments about the centre of mass, which is half of half_height below the middle of the height: base below, apex
/// above.
template <class S> ISO_INLINE Vec3<S> inertia_of_cone(S mass, S radius, S half_height) {
  const S across = detail::moment<S>(mass, Finer<S>(0.15), radius, Finer<S>(0.15), half_height);
  return {across, detail::moment<S>(mass, Finer<S>(0.3), radius, Finer<S>(0), S(0)), across};
}
template <class S> ISO_INLINE Vec3<S> inertia_of_cone_at_apex(S mass, S radius, S half_height) {
  const S across = detail::moment<S>(mass, Finer<S>(0.15), radius, Finer<S>(2.4), half_height);
  return {across, detail::moment<S>(mass, Finer<S>(0.3), radius, Finer<S>(0), S(0)), across};
}
/// A cylinder between two half balls. Shares by volume: half_height to 2/3 radius.
template <class S> ISO_INLINE Vec3<S> inertia_of_capsule(S mass, S radius, S half_height) {
  using F = Finer<S>;
  const F m = finer<F>(mass), r = finer<F>(radius), h = finer<F>(half_height), ends = r * F(2.0 / 3);
  const F share = h / (h + ends), rr = r * r, hh = h * h;
  const F middle = rr * F(0.25) + hh * F(1.0 / 3), caps = rr * F(0.4) + hh + (h * r) * F(0.75);
  const F along = rr * (share * F(0.5) + (F(1) - share) * F(0.4));
  const S across = coarser<S>(m * (middle * share + caps * (F(1) - share)));
  return {across, coarser<S>(m * along), across};
}

}  // namespace isostep
