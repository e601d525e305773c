// Bodies of sphere_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/collision/narrowphase/sphere_pairs.hpp"
#include "isostep/math/segment.hpp"

namespace isostep {
namespace detail {

/// Adds one point between the core points p of a and p + gap of b, with `radius_a` and `radius_b` around them.
/// `fallback` is the normal if the two coincide.
template <class S>
ISO_INLINE void touch_points(Vec3<S> p, Vec3<S> gap, S radius_a, S radius_b, Vec3<Unit<S>> fallback, Manifold<S>& out) {
  const Heading<S> heading = heading_of(gap);
  const bool apart = heading.length > S(0);
  out.normal = apart ? heading.direction : fallback;
  const S length = apart ? heading.length : S(0);
  out.add(p + out.normal * ((length + radius_a - radius_b) * S(0.5)), length - radius_a - radius_b, 0);
}

}  // namespace detail

template <class S>
void collide_sphere_sphere(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                           S margin, Manifold<S>& out) {
  out.clear();
  const Vec3<S> gap = tb.position - ta.position;
  if (detail::longer_than(gap, a.radius + b.radius + margin)) return;
  detail::touch_points(ta.position, gap, a.radius, b.radius, detail::unit_axis<Unit<S>>(1, false), out);
}

template <class S>
void collide_sphere_capsule(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                            const Transform<S>& tb, S margin, Manifold<S>& out) {
  out.clear();
  const detail::Segment<S> core = {tb.position, tb.rotation.column(1), b.half.y};
  const Vec3<S> gap = core.at(core.nearest(ta.position)) - ta.position;
  if (detail::longer_than(gap, a.radius + b.radius + margin)) return;
  detail::touch_points(ta.position, gap, a.radius, b.radius, tb.rotation.column(0), out);
}

template <class S>
void collide_sphere_box(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                        S margin, Manifold<S>& out) {
  using U = Unit<S>;
  out.clear();
  const Vec3<S> centre = to_local(tb, ta.position);
  const Vec3<S> surface = max(min(centre, b.half), -b.half);
  const Vec3<S> gap = centre - surface;
  const S radii = a.radius + b.radius;
  if (detail::longer_than(gap, radii + margin)) return;
  Vec3<U> outward;  // from the box, in its frame
  S length;         // [m] of the cores' gap, negative inside
  if (!detail::longer_than(gap, detail::gap_noise(max_abs(centre)))) {
    const Vec3<S> depth = b.half - abs(centre);
    const int k = depth.x <= depth.y && depth.x <= depth.z ? 0 : depth.y <= depth.z ? 1 : 2;
    outward = detail::unit_axis<U>(k, centre[k] < S(0));
    length = -depth[k];
  } else {
    const Heading<S> heading = heading_of(gap);
    outward = heading.direction;
    length = heading.length;
  }
  out.normal = -(tb.rotation * outward);
  out.add(ta.position + out.normal * ((length + a.radius - b.radius) * S(0.5)), length - radii, 0);
}

}  // namespace isostep
