// The friction of a contact in a step: its coefficient, static or dynamic, and the ellipse that a grain leaves of it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/friction_ellipse.hpp"

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

/// The two surfaces of a contact, and their slip.
template <class S> struct SurfaceContact {
  S friction, static_friction;  // [1] of both together
  Grain<S> a, b;
  Vec3<Velocity<S>> slip;        // [m/s] of b against a in the middle of the patch, belts included
  Vec3<Velocity<S>> first_slip;  // [m/s] at its first point: what spins about the middle slides, too
};

/// Chooses g.material.friction and the ellipse that a grain makes of its circle. Contacts that did not slide have the
/// static coefficient, sliding ones the dynamic one.
template <class S> ISO_INLINE void choose_friction(const SurfaceContact<S>& of, ContactGeometry<S>& g) {
  const auto slides = [&](Vec3<Velocity<S>> slip) ISO_INLINE_LAMBDA {
    return detail::kSlidingSpeed<S> < max_abs(detail::flattened<S>(slip, g.normal));
  };
  g.material.friction = slides(of.slip) || slides(of.first_slip) ? of.friction : of.static_friction;
  if (!of.a.is_there() && !of.b.is_there()) return;
  const FrictionEllipse<S> ellipse = friction_ellipse(of.a, of.b, g.normal);
  g.axis = ellipse.axis;
  g.ratio = ellipse.ratio;
  g.material.friction = round_to<S>(product(g.material.friction, ellipse.wide));
}

}  // namespace isostep
