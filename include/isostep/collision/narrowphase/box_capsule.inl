// Bodies of box_capsule.hpp. All of it works in the box's frame, where the core is a segment c + s d, |s| <= L.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_capsule.hpp"
#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/math/segment.hpp"

namespace isostep {
namespace detail {

/// Returns the vector by which p lies outside the box, axis by axis [m]. Zero inside.
template <class S> ISO_INLINE Vec3<S> excess(Vec3<S> half, Vec3<S> p) { return p - max(min(p, half), -half); }

/// Searches the s at which the squared distance to the box, convex in s, has slope zero: 2 excess . d.
template <class S> struct SlopeSearch {
  const Segment<S>& core;
  Vec3<S> half;           // [m] of the box
  S low, high;            // [m] where it falls, where it rises
  S flat_low, flat_high;  // [m] where it is level: empty while flat_high < flat_low

  /// Returns the sign of the slope at s, from an exact sum.
  ISO_INLINE int sign_at(S s) const {
    const auto slope = dot_sum(excess(half, core.at(s)), core.direction);
    const auto level = widen<SumOf<S, Unit<S>>>(S(0));
    return slope < level ? -1 : slope > level ? 1 : 0;
  }
  ISO_INLINE int narrow(S s) {
    const int sign = sign_at(s);
    if (sign < 0) {
      low = max(low, s);
    } else if (sign > 0) {
      high = min(high, s);
    } else {
      flat_low = min(flat_low, s);
      flat_high = max(flat_high, s);
    }
    return sign;
  }
};

/// Returns the s at which the segment is closest to the box. If it runs along or through the box, the middle of that
/// stretch.
template <class S> ISO_INLINE S closest_to_box(const Segment<S>& core, Vec3<S> half) {
  using U = Unit<S>;
  const Vec3<U> d = core.direction;
  SlopeSearch<S> search = {core, half, -core.half, core.half, core.half, -core.half};
  if (search.narrow(-core.half) > 0) return -core.half;
  if (search.narrow(core.half) < 0) return core.half;
  for (int k = 0; k < 3; ++k) {
    const S reach = core.half * abs(d[k]);
    for (int side = 0; side < 2; ++side) {
      const S rise = (side == 0 ? -half[k] : half[k]) - core.centre[k];
      if (abs(rise) >= reach) continue;
      const S s = divide_to<S>(rise, d[k]);
      if (search.low < s && s < search.high) search.narrow(s);
    }
  }
  const S low = search.low, high = search.high, middle = (low + high) * S(0.5);
  if (search.flat_low <= search.flat_high) {
    const bool level_before = search.sign_at((low + search.flat_low) * S(0.5)) == 0;
    const bool level_after = search.sign_at((search.flat_high + high) * S(0.5)) == 0;
    return ((level_before ? low : search.flat_low) + (level_after ? high : search.flat_high)) * S(0.5);
  }
  const Vec3<S> e = excess(half, core.at(low)), m = excess(half, core.at(middle));
  const Vec3<U> active = {m.x == S(0) ? U(0) : d.x, m.y == S(0) ? U(0) : d.y, m.z == S(0) ? U(0) : d.z};
  const Heading<U> heading = heading_of(active);
  if (!(heading.length > U(0))) return middle;
  return low + clamp(divide_to<S>(-dot(e, heading.direction), heading.length), S(0), high - low);
}

/// A region around the box: the side on each axis, 0 between the two faces.
struct Region {
  int side[3];
};

/// Returns true if the region is beside a face, or beside an edge that is nearly parallel: within 3.6 degrees, as
/// between two capsules.
template <class U> ISO_INLINE bool lies_along(Region region, Vec3<U> direction) {
  const int sides = (region.side[0] != 0) + (region.side[1] != 0) + (region.side[2] != 0);
  const int along = region.side[0] == 0 ? 0 : region.side[1] == 0 ? 1 : 2;
  return sides == 1 || (sides == 2 && abs(direction[along]) > U(0.998046875));
}

/// The stretch of the segment between the box's faces, on axes where the region is between them. Empty if high < low.
template <class S> struct Stretch {
  S low, high;  // [m]
};
template <class S> ISO_INLINE Stretch<S> stretch_beside(const Segment<S>& core, Vec3<S> half, Region region) {
  Stretch<S> stretch = {-core.half, core.half};
  for (int k = 0; k < 3; ++k) {
    if (region.side[k] != 0) continue;
    const bool falls = core.direction[k] < Unit<S>(0);
    const Unit<S> d = abs(core.direction[k]);
    const S c = negate_if(falls, core.centre[k]), reach = core.half * d;
    if (abs(c) > half[k] + reach) return {core.half, -core.half};
    // Numerators are within reach, so quotients are within the half length, and there is none where d is zero.
    if (half[k] - c < reach) stretch.high = min(stretch.high, divide_to<S>(half[k] - c, d));
    if (-half[k] - c > -reach) stretch.low = max(stretch.low, divide_to<S>(-half[k] - c, d));
  }
  return stretch;
}

/// Adds the two ends of that stretch against their projections on the face or edge, both with the normal `outward`, box
/// frame. Leaves out points beyond the patch. Adds none if the stretch is short or misses the `deepest` separation by
/// more than 1/512 of the radii, the cost of a tilt of 3.6 degrees.
template <class S>
ISO_INLINE void touch_stretch(const Primitive<S>& box, const Transform<S>& frame, const Segment<S>& core, S radius,
                              Region region, Vec3<Unit<S>> outward, S margin, S deepest, Manifold<S>& out) {
  const Stretch<S> stretch = stretch_beside(core, box.half, region);
  const S radii = box.radius + radius;
  const S sixteenth = radii * S(0.0625);
  if (stretch.high - stretch.low <= sixteenth) return;
  const bool edge = (region.side[0] != 0) + (region.side[1] != 0) + (region.side[2] != 0) == 2;
  const std::uint32_t name =
      1u + 16u * unsigned(region.side[0] + 1 + 3 * (region.side[1] + 1) + 9 * (region.side[2] + 1));
  const S noise = gap_noise(max_abs(core.centre) + core.half);
  bool reaches = false;
  for (int end = 0; end < 2; ++end) {
    const Vec3<S> x = core.at(end == 0 ? stretch.low : stretch.high);
    Vec3<S> q = x;
    for (int k = 0; k < 3; ++k) {
      if (region.side[k] != 0) q[k] = region.side[k] < 0 ? -box.half[k] : box.half[k];
    }
    const S length = dot(x - q, outward);
    if (edge && longer_than(x - q - outward * length, sixteenth)) {  // the edge and the capsule diverge sideways
      out.count = 0;
      return;
    }
    if (length - radii <= deepest + radii * S(0.001953125) + noise) reaches = true;
    if (length - radii > margin + kPatchReach<S>) continue;
    const Vec3<S> local = (x + q + outward * (box.radius - radius)) * S(0.5);
    out.add(to_world(frame, local), length - radii, name + unsigned(end));
  }
  if (!reaches) out.count = 0;
}

/// The way out for a core that pierces the box: the shallowest of three faces and three crosses of an edge with the
/// core, the separating axes of a box and a segment. A face wins unless an edge is better by the tolerance.
template <class S> struct Pierced {
  Vec3<Unit<S>> outward;  // [1]
  S length;               // [m] <= 0
  int axis;               // of the face or the edge
  bool edge;
};
template <class S> ISO_INLINE Pierced<S> pierced(const Segment<S>& core, Vec3<S> half, S tolerance) {
  using U = Unit<S>;
  Pierced<S> best = {Vec3<U>::zero(), S(0), -1, false};
  for (int k = 0; k < 3; ++k) {
    const S length = abs(core.centre[k]) - core.half * abs(core.direction[k]) - half[k];
    if (best.axis >= 0 && !(length > best.length)) continue;
    best = {unit_axis<U>(k, core.centre[k] < S(0)), length, k, false};
  }
  S limit = best.length + tolerance;
  for (int k = 0; k < 3; ++k) {
    const Vec3<U> across = cross(unit_axis<U>(k, false), core.direction);
    if (dot(across, across) < near_parallel<S>()) continue;
    Vec3<U> n = heading_of(across).direction;
    const S offset = dot(core.centre, n);
    const S length = abs(offset) - dot(half, abs(n));
    if (!(length > limit)) continue;
    if (offset < S(0)) n = -n;
    best = {n, length, k, true};
    limit = length;
  }
  return best;
}

/// Returns the edge along `axis` that lies furthest along n.
template <class S> ISO_INLINE Segment<S> edge_towards(Vec3<S> half, int axis, Vec3<Unit<S>> n) {
  Vec3<S> middle = {n.x < Unit<S>(0) ? -half.x : half.x, n.y < Unit<S>(0) ? -half.y : half.y,
                    n.z < Unit<S>(0) ? -half.z : half.z};
  middle[axis] = S(0);
  return {middle, unit_axis<Unit<S>>(axis, false), half[axis]};
}

ISO_INLINE constexpr Region face_region(int axis, bool negative) {
  Region region = {{0, 0, 0}};
  region.side[axis] = negative ? -1 : 1;
  return region;
}
template <class S> ISO_INLINE constexpr int side_of(S excess) { return excess < S(0) ? -1 : excess > S(0) ? 1 : 0; }

/// Collides a core that pierces the box, or touches it at `closest` to within rounding. If the core's deepest end lies
/// beyond the preferred face, the axis that is best without preference replaces it.
template <class S>
ISO_INLINE void touch_pierced(const Primitive<S>& box, const Transform<S>& frame, const Segment<S>& core, S radius,
                              S closest, S margin, Manifold<S>& out) {
  using U = Unit<S>;
  const S radii = box.radius + radius;
  Pierced<S> way = pierced(core, box.half, axis_tolerance(box.half, box.half));
  if (!way.edge) {
    const Region region = face_region(way.axis, way.outward[way.axis] < U(0));
    out.normal = frame.rotation * way.outward;
    touch_stretch(box, frame, core, radius, region, way.outward, margin, way.length - radii, out);
    if (out.count > 0) return;
    way = pierced(core, box.half, S(0));
  }
  S s = closest;
  if (excess(box.half, core.at(closest)) == Vec3<S>::zero()) {
    if (way.edge) {
      s = closest_points(core, edge_towards(box.half, way.axis, way.outward)).s;
    } else {
      const bool negative = way.outward[way.axis] < U(0);
      const Stretch<S> stretch = stretch_beside(core, box.half, face_region(way.axis, negative));
      s = (core.direction[way.axis] < U(0)) == negative ? stretch.low : stretch.high;  // the end further down
    }
  }
  out.normal = frame.rotation * way.outward;
  const Vec3<S> local = core.at(s) - way.outward * ((way.length + radius - box.radius) * S(0.5));
  out.add(to_world(frame, local), way.length - radii, 0);
}

/// Collides a core outside the box. Its point x is closest, by the vector gap.
template <class S>
ISO_INLINE void touch_outside(const Primitive<S>& box, const Transform<S>& frame, const Segment<S>& core, S radius,
                              Vec3<S> x, Vec3<S> gap, S margin, Manifold<S>& out) {
  using U = Unit<S>;
  const S radii = box.radius + radius;
  const Heading<S> heading = heading_of(gap);
  Vec3<U> across = heading.direction;
  Region region = {{side_of(gap.x), side_of(gap.y), side_of(gap.z)}};
  // Two points take a face's normal within 2.5 degrees of it: a capsule that tips over an edge keeps both of them.
  for (int k = 0; k < 3; ++k) {
    if (!(abs(heading.direction[k]) > U(0.9990234375))) continue;
    across = unit_axis<U>(k, gap[k] < S(0));
    for (int j = 0; j < 3; ++j) region.side[j] = j == k ? region.side[j] : 0;
  }
  if (lies_along(region, core.direction)) {
    out.normal = frame.rotation * across;
    touch_stretch(box, frame, core, radius, region, across, margin, heading.length - radii, out);
    if (out.count > 0) return;
  }
  out.normal = frame.rotation * heading.direction;
  const S inwards = (heading.length + radius - box.radius) * S(0.5);
  out.add(to_world(frame, x - heading.direction * inwards), heading.length - radii, 0);
}

}  // namespace detail

template <class S>
void collide_box_capsule(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                         S margin, Manifold<S>& out) {
  out.clear();
  const S reach = a.radius + b.radius + margin;
  const detail::Segment<S> core = {to_local(ta, tb.position), transposed_times(ta.rotation, tb.rotation.column(1)),
                                   b.half.y};
  const Vec3<S> slab = abs(core.centre) - a.half - abs(core.direction) * core.half;
  if (slab.x > reach || slab.y > reach || slab.z > reach) return;
  const S s = detail::closest_to_box(core, a.half);
  const Vec3<S> x = core.at(s);
  const Vec3<S> gap = detail::excess(a.half, x);
  if (detail::longer_than(gap, reach)) return;
  if (detail::longer_than(gap, detail::gap_noise(max_abs(core.centre) + core.half))) {
    detail::touch_outside(a, ta, core, b.radius, x, gap, margin, out);
  } else {
    detail::touch_pierced(a, ta, core, b.radius, s, margin, out);
  }
}

}  // namespace isostep
