// Bodies of capsule_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/collision/narrowphase/capsule_pairs.hpp"
#include "isostep/math/segment.hpp"

namespace isostep {
namespace detail {

/// Returns the normal of two cores that touch: across both, towards b's centre. If they coincide, `aside`, across a.
template <class S>
ISO_INLINE Vec3<Unit<S>> crossing_normal(const Segment<S>& a, const Segment<S>& b, Vec3<Unit<S>> aside) {
  using U = Unit<S>;
  const Heading<U> across = heading_of(cross(a.direction, b.direction));
  const Vec3<U> n = across.length > U(0) ? across.direction : aside;
  return dot(b.centre - a.centre, n) < S(0) ? -n : n;
}

/// Adds two points at the ends of the stretch where nearly parallel capsules run side by side. Adds none if that
/// stretch is short, or if the axes diverge sideways by more than a sixteenth of the radii. Within that bound the
/// surfaces are further apart than the separation along the normal says, by up to 1/512 of the radii. Each end belongs
/// to the capsule that ends there, so that swapping a and b gives the same points.
template <class S>
ISO_INLINE void touch_alongside(const Segment<S>& a, S radius_a, const Segment<S>& b, S radius_b, S margin,
                                Manifold<S>& out) {
  using U = Unit<S>;
  const S radii = radius_a + radius_b;
  const S sixteenth = radii * S(0.0625);
  const bool opposed = dot(a.direction, b.direction) < U(0);
  const S b_first = opposed ? b.half : -b.half;  // b's end towards a's negative one
  const S b_low = dot(b.at(b_first) - a.centre, a.direction), b_high = dot(b.at(-b_first) - a.centre, a.direction);
  if (min(a.half, b_high) - max(-a.half, b_low) <= sixteenth) return;
  for (int end = 0; end < 2; ++end) {
    const bool of_a = end == 0 ? b_low <= -a.half : b_high >= a.half;
    const S b_end = end == 0 ? b_first : -b_first;
    const Vec3<S> p = of_a ? a.at(end == 0 ? -a.half : a.half) : a.at(a.nearest(b.at(b_end)));
    const Vec3<S> q = of_a ? b.at(b.nearest(p)) : b.at(b_end);
    const S length = dot(q - p, out.normal);
    if (longer_than(q - p - out.normal * length, sixteenth)) {
      out.count = 0;
      return;
    }
    if (length - radii > margin + kPatchReach<S>) continue;
    const std::uint32_t feature = of_a ? 1u + unsigned(end) : b_end < S(0) ? 3u : 4u;
    out.add((p + q + out.normal * (radius_a - radius_b)) * S(0.5), length - radii, feature);
  }
}

}  // namespace detail

template <class S>
void collide_capsule_capsule(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b,
                             const Transform<S>& tb, S margin, Manifold<S>& out) {
  using U = Unit<S>;
  out.clear();
  const detail::Segment<S> core_a = {ta.position, ta.rotation.column(1), a.half.y};
  const detail::Segment<S> core_b = {tb.position, tb.rotation.column(1), b.half.y};
  const detail::ClosestPair<S> closest = detail::closest_points(core_a, core_b);
  const Vec3<S> p = core_a.at(closest.s);
  const Vec3<S> gap = core_b.at(closest.t) - p;
  const S radii = a.radius + b.radius;
  if (detail::longer_than(gap, radii + margin)) return;
  const Heading<S> heading = heading_of(gap);
  const bool apart = heading.length > detail::gap_noise(max_abs(core_b.centre - core_a.centre));
  out.normal = apart ? heading.direction : detail::crossing_normal(core_a, core_b, ta.rotation.column(0));
  // A sine below 1/16, 3.6 degrees, is nearly parallel.
  if (closest.sine2 < U(0.00390625)) detail::touch_alongside(core_a, a.radius, core_b, b.radius, margin, out);
  if (out.count > 0) return;
  out.add(p + out.normal * ((heading.length + a.radius - b.radius) * S(0.5)), heading.length - radii, 0);
}

}  // namespace isostep
