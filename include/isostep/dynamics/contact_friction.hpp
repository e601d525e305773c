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
  ///          get mirrored forces, except for how halves are rounded.
  ISO_INLINE Vec3<Unit<S>> line_of(Vec3<Unit<S>> n, Vec3<Unit<S>> slip) const {
    const Vec3<S> local = convert<S>(transposed_times(frame, cross(n, slip)));
    const Vec3<S>& f = factors;
    const Vec3<S> scaled = {local.x / f.x / f.x, local.y / f.y / f.y, local.z / f.z / f.z};
    return normalise(cross(frame * scaled, convert<S>(n)));
  }
};

/// Returns the lesser factor of two grains, so that the cone is the intersection of two ellipses, and convex. The root
/// of the product would not be: it has dents for a grain of 1 : 6 or more on a plain surface.
template <class S> ISO_INLINE S factor_along(const Grain<S>& a, const Grain<S>& b, Vec3<Unit<S>> d) {
  return min(a.factor_along(d), b.factor_along(d));
}
template <class S>
ISO_INLINE Vec3<Unit<S>> friction_line(const Grain<S>& a, const Grain<S>& b, Vec3<Unit<S>> n, Vec3<Unit<S>> slip) {
  if (!a.is_there()) return b.is_there() ? b.line_of(n, slip) : slip;
  const Vec3<Unit<S>> of_a = a.line_of(n, slip);
  if (!b.is_there()) return of_a;
  const Vec3<Unit<S>> of_b = b.line_of(n, slip);
  const S left_a = a.factor_along(of_a), left_b = b.factor_along(of_b);
  return left_a < left_b ? of_a : left_b < left_a ? of_b : slip;
}

/// The two surfaces of a contact, and their slip.
template <class S> struct SurfaceContact {
  S friction, static_friction;  // [1] of both together
  Grain<S> a, b;
  Vec3<Velocity<S>> slip;        // [m/s] of b against a in the middle of the patch, belts included
  Vec3<Velocity<S>> first_slip;  // [m/s] at its first point: what spins about the middle slides, too
};

/// Chooses g.material.friction. Contacts that did not slide have the static coefficient, sliding ones the dynamic one.
/// With a grain, the solver's circular cone gets the radius of the ellipse along the friction force: in the direction
/// of friction_line while the contact slides, of the last step's friction impulse while it sticks. While it slides,
/// g.line is that direction, and the slip across it is added to the surface velocity: friction does not resist it.
template <class S>
ISO_INLINE void choose_friction(const SurfaceContact<S>& of, Vec3<Velocity<S>> borne, ContactGeometry<S>& g) {
  using V = Velocity<S>;
  const Vec3<V> slip = detail::flattened<S>(of.slip, g.normal);
  const bool leads = detail::kSlidingSpeed<S> < max_abs(slip);
  const bool slides = leads || detail::kSlidingSpeed<S> < max_abs(detail::flattened<S>(of.first_slip, g.normal));
  S friction = slides ? of.friction : of.static_friction;
  if (of.a.is_there() || of.b.is_there()) {
    Vec3<Unit<S>> line = normalise(leads ? slip : detail::flattened<S>(borne, g.normal));
    if (leads) {
      g.line = line = friction_line(of.a, of.b, g.normal, line);
      const V along = round_to<V>(dot_sum(slip, line));
      const Vec3<V> part = {round_to<V>(product(along, line.x)), round_to<V>(product(along, line.y)),
                            round_to<V>(product(along, line.z))};
      g.material.surface_velocity += convert<S>(part - slip);
    }
    friction = friction * factor_along(of.a, of.b, line);
  }
  g.material.friction = friction;
}

}  // namespace isostep
