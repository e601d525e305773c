// The coefficient of friction of a contact in a step: static or dynamic, and along which direction of a grain.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/contact.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

/// Returns true if mix() alone decides the friction of the material's contacts, in every step.
template <class S> ISO_INLINE bool mixes_alone(const Material<S>& m) {
  return m.kind == 0 && !(m.friction < m.static_friction) && m.anisotropy == Vec3<S>{S(1), S(1), S(1)};
}
template <class S> ISO_INLINE S static_friction_of(const Material<S>& m) { return max(m.friction, m.static_friction); }

namespace detail {
/// [m/s] A contact that slips faster slides. A slower one sticks and jitters. A body that gravity pulls loose passes it
/// within a step or a few.
template <class S> inline constexpr Velocity<S> kSlidingSpeed = Velocity<S>(0.05);

/// Returns a velocity without its part along n.
template <class S> ISO_INLINE Vec3<Velocity<S>> flattened(Vec3<Velocity<S>> v, Vec3<Unit<S>> n) {
  const Velocity<S> along = round_to<Velocity<S>>(dot_sum(v, n));
  return v - Vec3<Velocity<S>>{round_to<Velocity<S>>(product(along, n.x)), round_to<Velocity<S>>(product(along, n.y)),
                               round_to<Velocity<S>>(product(along, n.z))};
}
}  // namespace detail

/// The factors of friction along the axes of a body: Material::anisotropy.
template <class S> struct Grain {
  Vec3<S> factors;      // [1] f
  Mat3<Unit<S>> frame;  // body to world

  ISO_INLINE bool is_there() const { return !(factors == Vec3<S>{S(1), S(1), S(1)}); }
  /// Returns the radius of the ellipsoid sum (d_i / f_i)^2 = 1 along d: the factor of friction there. 1 without one.
  ISO_INLINE S factor_along(Vec3<Unit<S>> d) const {
    if (!is_there()) return S(1);
    const Vec3<S> local = convert<S>(transposed_times(frame, d));
    const Vec3<S> scaled = {local.x / factors.x, local.y / factors.y, local.z / factors.z};
    const S squared = dot(scaled, scaled);
    return S(0) < squared ? min(S(1), S(1) / sqrt(squared)) : S(1);
  }
  /// Returns the direction in which friction acts against a slip along `slip`, on a surface with normal n. The forces
  /// that a contact can bear fill an ellipse in its plane. Friction is the force among them that dissipates most power,
  /// at the point where the ellipse is at right angles to the slip. So a body that slides along its runners hardly
  /// slows, and loses speed across them at once. Without a grain: the slip.
  /// Source:  Moreau 1974 (maximal dissipation); Michalowski, Mroz 1978, Arch. Mech. 30(3).
  /// Symbols: A = the ellipse's matrix in the plane, diag(1/f^2) projected on it. The force is along A^-1 slip, and
  ///          A^-1 = -[n]x A [n]x / det A in two dimensions. Even in n and odd in the slip, so bodies that swap places
  ///          get mirrored forces, except for how halves are rounded. `ahead`: (A + ahead)^-1 in place of A^-1.
  ISO_INLINE Vec3<Unit<S>> line_of(Vec3<Unit<S>> n, Vec3<Unit<S>> slip, S ahead = S(0)) const {
    const Vec3<S> local = convert<S>(transposed_times(frame, cross(n, slip)));
    const Vec3<S>& f = factors;
    const Vec3<S> scaled = {local.x / f.x / f.x, local.y / f.y / f.y, local.z / f.z / f.z};
    return normalise(cross(frame * (scaled + local * ahead), convert<S>(n)));
  }
  /// Returns the factor of what spins about n and slips in all directions: the root mean square of the ellipse's half
  /// axes, at most 11 % above the mean of the dissipation over all directions. 1 without a grain.
  /// Symbols: with m = n in the body's frame, half the trace of the inverse of A in the plane, both times the squared
  ///          product of f: sum (1 - m_i^2) (f_j f_k)^2 / 2 over sum (m_i f_i)^2.
  ISO_INLINE S factor_around(Vec3<Unit<S>> n) const {
    if (!is_there()) return S(1);
    const Vec3<S> m = convert<S>(transposed_times(frame, n));
    const S largest = max_abs(factors);
    const Vec3<S> f = {factors.x / largest, factors.y / largest, factors.z / largest};
    const Vec3<S> mf = {m.x * f.x, m.y * f.y, m.z * f.z}, pairs = {f.y * f.z, f.z * f.x, f.x * f.y};
    const auto part = [&](S m_i, S pair) ISO_INLINE_LAMBDA { return (S(1) - m_i * m_i) * (pair * pair); };
    const S axes = (part(m.x, pairs.x) + part(m.y, pairs.y) + part(m.z, pairs.z)) * S(0.5);
    const S area = dot(mf, mf);
    return S(0) < area ? min(S(1), largest * sqrt(axes / area)) : S(1);
  }
};

/// Returns the lesser factor of two grains, so that the cone is the intersection of two ellipses, and convex. The root
/// of the product would not be: it has dents for a grain of 1 : 6 or more on a plain surface.
template <class S> ISO_INLINE S factor_along(const Grain<S>& a, const Grain<S>& b, Vec3<Unit<S>> d) {
  return min(a.factor_along(d), b.factor_along(d));
}
template <class S>
ISO_INLINE Vec3<Unit<S>> friction_line(const Grain<S>& a, const Grain<S>& b, Vec3<Unit<S>> n, Vec3<Unit<S>> slip,
                                       S ahead = S(0)) {
  if (!a.is_there()) return b.is_there() ? b.line_of(n, slip, ahead) : slip;
  const Vec3<Unit<S>> of_a = a.line_of(n, slip, ahead);
  if (!b.is_there()) return of_a;
  const Vec3<Unit<S>> of_b = b.line_of(n, slip, ahead);
  const S left_a = a.factor_along(of_a), left_b = b.factor_along(of_b);
  return left_a < left_b ? of_a : left_b < left_a ? of_b : slip;
}

/// The two surfaces of a contact, and their slip.
template <class S> struct SurfaceContact {
  S friction, static_friction;  // [1] of both together
  Grain<S> a, b;
  Vec3<Velocity<S>> slip;        // [m/s] of b against a in the middle of the patch, belts included
  Vec3<Velocity<S>> first_slip;  // [m/s] at its first point: what spins about the middle slides, too
  Velocity<S> load;              // [m/s] the normal impulse that it bore in the last step
};

namespace detail {
/// Returns the direction in which friction acts over a step against a slip [m/s]: that at the start, while the slip is
/// fast. A slow slip would be thrown from one side of the runners to the other in each step, for ever, and hardly slow
/// along them. Friction opposes the slip that it leaves there, as far as is needed not to overshoot.
/// Symbols: v = slip, p = the impulse, on the ellipse p A p = L^2. It opposes the slip at the end if v - p = A p / c,
///          so p lies along (A + c)^-1 v. The impulse for the slip at the start changes by up to L / |A^-1/2 v| of a
///          change of the slip. It does not overshoot with c = L / |A^-1/2 v| - 1, where that is above 0. |A^-1/2 v| is
///          v along the direction at the start, times the factor there.
template <class S>
ISO_INLINE Vec3<Unit<S>> friction_line_over_step(const SurfaceContact<S>& of, Vec3<Unit<S>> n, Vec3<Velocity<S>> slip) {
  using V = Velocity<S>;
  constexpr S kMost = S(4096);  // [1] of c: friction against the slip itself, whatever the grain
  const Vec3<Unit<S>> along = normalise(slip);
  const Vec3<Unit<S>> start = friction_line(of.a, of.b, n, along);
  const V most = saturate_to<V>(product(of.friction, of.load));
  const V yields = round_to<V>(product(factor_along(of.a, of.b, start), round_to<V>(dot_sum(slip, start))));
  if (!(yields < most)) return start;
  const S ahead = yields < round_to<V>(product(S(1) / kMost, most)) ? kMost : divide_to<S>(most, yields) - S(1);
  return friction_line(of.a, of.b, n, along, ahead);
}
}  // namespace detail

/// Chooses g.material.friction. Contacts that did not slide have the static coefficient, sliding ones the dynamic one.
/// With a grain, the solver's circular cone gets the radius of the ellipse along the friction force: in the direction
/// of friction_line_over_step while the contact slides, of the last step's friction impulse while it sticks, in all
/// directions alike while it spins about its middle. While it slides, g.line is that direction, and the slip across it
/// is added to the surface velocity: friction does not resist it.
template <class S>
ISO_INLINE void choose_friction(const SurfaceContact<S>& of, Vec3<Velocity<S>> borne, ContactGeometry<S>& g) {
  using V = Velocity<S>;
  const Vec3<V> slip = detail::flattened<S>(of.slip, g.normal);
  const bool leads = detail::kSlidingSpeed<S> < max_abs(slip);
  const bool slides = leads || detail::kSlidingSpeed<S> < max_abs(detail::flattened<S>(of.first_slip, g.normal));
  S friction = slides ? of.friction : of.static_friction;
  if (of.a.is_there() || of.b.is_there()) {
    if (leads) {
      const Vec3<Unit<S>> line = detail::friction_line_over_step(of, g.normal, slip);
      g.line = line;
      g.material.surface_velocity += convert<S>(-detail::flattened<S>(slip, line));
      friction = friction * factor_along(of.a, of.b, line);
    } else if (slides) {
      friction = friction * min(of.a.factor_around(g.normal), of.b.factor_around(g.normal));
    } else {
      friction = friction * factor_along(of.a, of.b, normalise(detail::flattened<S>(borne, g.normal)));
    }
  }
  g.material.friction = friction;
}

}  // namespace isostep
