// Revolved<S>: the hull of two discs on one axis, which cylinders and cones are.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep::detail {

/// The support of a solid of revolution along a direction, at each of its discs.
template <class S> struct Reach {
  Vec3<Unit<S>> radial;  // [1] of the direction, across the axis; x where it has none
  Unit<S> across;        // [1] the direction's length across the axis
  S of[2];               // [m] of the lower and the upper disc

  ISO_INLINE int end() const { return of[1] > of[0] ? 1 : 0; }
  ISO_INLINE S most() const { return max(of[0], of[1]); }
};

/// The nearest point of a solid of revolution to a point, in the point's half-plane: x = away from the axis, y.
template <class S> struct NearestInSection {
  S x, y;              // [m] on the surface
  S distance;          // [m] negative inside
  Unit<S> out, along;  // [1] the normal
};

/// The radii [m] of two discs on one axis, the lower one first.
template <class S> struct DiscRadii { S low, high; };
/// Returns the point of the hull of two discs, at y = -half and half, that is furthest along n.
template <class S> ISO_INLINE Vec3<S> support_of_discs(DiscRadii<S> radii, S half, Vec3<Unit<S>> n) {
  const Direction<Unit<S>> d = direction_of(n.x, Unit<S>(0), n.z);
  const S narrower = (radii.low - radii.high) * d.length, rise = half * n.y;
  const bool upper = rise + rise > narrower;
  const S radius = upper ? radii.high : radii.low;
  return {radius * d.x, upper ? half : -half, radius * d.z};
}
/// Finds the face that looks along n: a disc that leans by a sine of at most `flat`, as sixteen points of its rim that
/// turn with the solid; otherwise the line of the side that reaches furthest.
inline constexpr std::uint32_t kLowerEnd = 32, kUpperEnd = 33;  // of that line, which is no line of the solid's own
template <class S>
ISO_INLINE void find_face_of_discs(DiscRadii<S> radii, S half, Vec3<Unit<S>> n, Unit<S> flat, SolidFace<S>& face) {
  using U = Unit<S>;
  const Direction<U> d = direction_of(n.x, U(0), n.z);
  const bool upper = n.y > U(0);
  const S radius = upper ? radii.high : radii.low;
  face.is_disc = d.length <= flat && radius > S(0);
  if (face.is_disc) {
    face.normal = {U(0), upper ? U(1) : U(-1), U(0)};
    face.name = upper ? 1 : 0;
    for (int k = 0; k < 16; ++k) {
      face.add({radius * cosine_of_sixteenths<S>(k), upper ? half : -half, radius * cosine_of_sixteenths<S>(k - 4)},
               face.name << 4 | static_cast<std::uint32_t>(k));
    }
    return;
  }
  const U x = d.length > U(0) ? d.x : U(1), z = d.length > U(0) ? d.z : U(0);
  face.add({radii.low * x, -half, radii.low * z}, kLowerEnd);
  face.add({radii.high * x, half, radii.high * z}, kUpperEnd);
}

/// Discs of radius radii[0] at y = -half and radii[1] <= radii[0] at y = half, and the solid between them.
template <class S> struct Revolved {
  using U = Unit<S>;

  S half;      // [m] > 0
  S radii[2];  // [m] radii[0] > 0, radii[1] >= 0
  U out, up;   // [1] the side's normal: away from the axis and along it; up >= 0
  S slant;     // [m] half the length of the side

  static ISO_INLINE Revolved cylinder(S radius, S half_height) {
    return {half_height, {radius, radius}, U(1), U(0), half_height};
  }
  static ISO_INLINE Revolved cone(S radius, S half_height) {
    const Direction<S> d = direction_of(half_height + half_height, radius, S(0));
    return {half_height, {radius, S(0)}, d.x, d.y, d.length * S(0.5)};
  }

  ISO_INLINE Reach<S> reach(Vec3<U> n) const {
    const Direction<U> d = direction_of(n.x, U(0), n.z);
    const S rise = half * n.y;
    const Vec3<U> radial = d.length > U(0) ? Vec3<U>{d.x, U(0), d.z} : Vec3<U>{U(1), U(0), U(0)};
    return {radial, d.length, {radii[0] * d.length - rise, radii[1] * d.length + rise}};
  }
  /// Returns the point of a disc's rim in a direction across the axis.
  ISO_INLINE Vec3<S> rim(int end, Vec3<U> radial) const {
    return {radial.x * radii[end], end == 0 ? -half : half, radial.z * radii[end]};
  }
  /// Returns the k-th of sixteen points of a rim, which turn with the solid.
  ISO_INLINE Vec3<S> rim_point(int end, int k) const {
    return rim(end, {cosine_of_sixteenths<S>(k), U(0), cosine_of_sixteenths<S>(k - 4)});
  }
  ISO_INLINE Vec3<U> side_normal(Vec3<U> radial) const { return {radial.x * out, up, radial.z * out}; }

  ISO_INLINE Aabb<S> bounds(const Transform<S>& t) const {
    const Mat3<U>& m = t.rotation;
    S low[3], high[3];
    for (int i = 0; i < 3; ++i) {
      const Reach<S> r = reach(m.rows[i]);
      high[i] = r.most();
      const S widths[2] = {(radii[0] + radii[0]) * r.across, (radii[1] + radii[1]) * r.across};
      low[i] = min(r.of[0] - widths[0], r.of[1] - widths[1]);
    }
    return {t.position + Vec3<S>{low[0], low[1], low[2]}, t.position + Vec3<S>{high[0], high[1], high[2]}};
  }

  /// Returns the nearest point of the section to (x, y), x >= 0.
  ISO_INLINE NearestInSection<S> nearest(S x, S y) const {
    const S middle = (radii[0] + radii[1]) * S(0.5), from = x - middle;
    const S beside = round_to<S>(product(from, out) + product(y, up));  // above the side
    const S along = round_to<S>(product(y, out) - product(from, up));
    const S above = y - half, below = -y - half;
    if (above <= S(0) && below <= S(0) && beside <= S(0)) return inside(x, y, beside, above, below);
    if (beside > S(0) && abs(along) <= slant) return on_side(x, y, beside);
    if (above > S(0) && x <= radii[1]) return {x, half, above, U(0), U(1)};
    if (below > S(0) && x <= radii[0]) return {x, -half, below, U(0), U(-1)};
    const int end = beside > S(0) ? (along > S(0) ? 1 : 0) : above > S(0) ? 1 : 0;
    const S at = end == 0 ? -half : half;
    const Direction<S> gap = direction_of(x - radii[end], y - at, S(0));
    // Where a gap is a few digits long, so is its direction.
    if (gap.length <= gap_noise(max(x, abs(y)))) return {radii[end], at, max(max(above, below), beside), out, up};
    return {radii[end], at, gap.length, gap.x, gap.y};
  }
  ISO_INLINE ClosestPoint<S> closest(Vec3<S> q) const {
    const Direction<S> d = direction_of(q.x, S(0), q.z);
    const U cx = d.length > S(0) ? d.x : U(1), cz = d.length > S(0) ? d.z : U(0);
    const NearestInSection<S> n = nearest(d.length, q.y);
    return {{cx * n.x, n.y, cz * n.x}, n.distance, {cx * n.out, n.along, cz * n.out}};
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {
    const ClosestPoint<S> local = closest(to_local(t, query));
    return {to_world(t, local.point), local.distance, t.rotation * local.normal};
  }

  template <class Line> ISO_INLINE void visit_lines(const Line& line) const {
    for (int end = 0; end < 2; ++end) {
      if (radii[end] > S(0)) visit_arc(line, Vec3<S>{S(0), end == 0 ? -half : half, S(0)}, radii[end], 0, 2);
    }
    for (int k = 0; k < 16; k += 4) line(rim_point(0, k), rim_point(1, k));
  }

 private:
  ISO_INLINE NearestInSection<S> on_side(S x, S y, S beside) const {
    return {x - out * beside, y - up * beside, beside, out, up};
  }
  ISO_INLINE NearestInSection<S> inside(S x, S y, S beside, S above, S below) const {
    if (beside >= above && beside >= below) return on_side(x, y, beside);
    if (above >= below && radii[1] > S(0)) return {x, half, above, U(0), U(1)};
    if (below >= beside) return {x, -half, below, U(0), U(-1)};
    return on_side(x, y, beside);
  }
};

/// Finds the distance along a ray at which it enters a solid of revolution through its side: the zero of the height
/// above the side, which is convex along the ray, by Newton steps from outside, which never pass it.
/// Error: a few steps of S; if the ray grazes the side, as far as the height there is rounded.
template <class S>
ISO_INLINE bool enter_side(const Revolved<S>& solid, const LocalRay<S>& ray, S from, S to, S& entry) {
  using U = Unit<S>;
  constexpr int kSteps = 48;  // halving at worst
  const S middle = (solid.radii[0] + solid.radii[1]) * S(0.5);
  S at = from;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3<S> p = ray.origin + ray.direction * at;
    const Direction<S> d = direction_of(p.x, S(0), p.z);
    const S height = round_to<S>(product(d.length - middle, solid.out) + product(p.y, solid.up));
    if (height <= S(0)) break;
    const U fall = -dot(Vec3<U>{d.x * solid.out, solid.up, d.z * solid.out}, ray.direction);
    if (fall <= U(0) || height > fall * (to - at)) return false;
    const S step = divide_to<S>(height, fall);
    at = at + step;
    if (step <= resolution<S>() * S(2)) break;
  }
  entry = at;
  return at <= to;
}

template <class S> ISO_INLINE LocalHit<S> cast_revolved(const LocalRay<S>& ray, const Revolved<S>& solid) {
  using U = Unit<S>;
  const Vec3<S> o = ray.origin;
  const S across = length(Vec3<S>{o.x, S(0), o.z});
  if (solid.nearest(across, o.y).distance <= S(0)) return inside_hit<S>();
  // The stretch between the planes of the discs.
  S entry = S(0), exit = ray.length;
  const U rise = ray.direction.y;
  const bool down = rise < U(0);
  const S to_near = down ? o.y - solid.half : -solid.half - o.y, to_far = down ? o.y + solid.half : solid.half - o.y;
  const U speed = abs(rise);
  if (to_far < S(0) || to_near > ray.length * speed) return no_hit<S>();
  if (speed == U(0) && to_near > S(0)) return no_hit<S>();
  if (to_near > S(0)) entry = divide_to<S>(to_near, speed);
  if (to_far < exit * speed) exit = divide_to<S>(to_far, speed);
  if (to_near > S(0)) {
    const int end = down ? 1 : 0;
    const Vec3<S> p = o + ray.direction * entry;
    if (dot_sum(Vec3<S>{p.x, S(0), p.z}, Vec3<S>{p.x, S(0), p.z}) <= product(solid.radii[end], solid.radii[end]))
      return {LocalHit<S>::entered, entry / ray.length, {U(0), down ? U(1) : U(-1), U(0)}};
  }
  S distance;
  if (!enter_side(solid, ray, entry, exit, distance)) return no_hit<S>();
  const Vec3<S> p = o + ray.direction * distance;
  const Direction<S> d = direction_of(p.x, S(0), p.z);
  const Vec3<U> radial = {d.length > S(0) ? d.x : U(1), U(0), d.z};
  return {LocalHit<S>::entered, distance / ray.length, solid.side_normal(radial)};
}

}  // namespace isostep::detail
