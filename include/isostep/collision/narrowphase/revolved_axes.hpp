// Axes that separate a solid of revolution from what has edges and vertices, and the best of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/geometry/shapes/revolved.hpp"
#include "isostep/math/segment.hpp"

namespace isostep::detail {

/// An edge of the other, or a line along its rim, in the solid's frame.
template <class S> struct LineOfOther {
  Vec3<S> point;            // [m] of it
  Vec3<Unit<S>> along;      // [1]
  Vec3<Unit<S>> inward[2];  // [1] across it, in the planes beside it: a direction out of the solid looks into both
};

template <class S> struct RevolvedAxis {
  enum Kind : std::uint32_t { face, cap, side_vertex, side_edge, rim } kind;
  S separation;           // [m]
  Vec3<Unit<S>> normal;   // [1] out of the solid
  std::uint32_t feature;  // the other's face, vertex or edge
  std::uint32_t end;      // of a cap or a rim: 1 the upper one

  /// Whatever is better by `lead`.
  ISO_INLINE void offer(Kind of, S at, Vec3<Unit<S>> n, std::uint32_t other, int disc, S lead) {
    if (!(at > separation + lead)) return;
    *this = {of, at, n, other, static_cast<std::uint32_t>(disc)};
  }
};

/// Normals n across a line e for which the line is what is nearest along n; seen along the line, the solid is an
/// outline of two half ellipses, and the line a point beside it.
/// Symbols: u, v = across e, u across the solid's axis y too; k = v.y = sine of the angle of e and y; q = the line's
///          point, on the side of u. Normals of the side have n.y = up; a rim's lie beyond. Of an ellipse's quarter the
///          nearest normal is the only one in q's own quarter (Eberly, Distance from a point to an ellipse, 2).
/// Error:   of a rim's normal 2e-5 rad, of the separation its square times the distance to the disc's centre.
template <class S> class NormalsAcross {
  using U = Unit<S>;

 public:
  ISO_INLINE NormalsAcross(const Revolved<S>& solid, const LineOfOther<S>& line) : solid_(solid), line_(line) {
    const Direction<U> d = direction_of(line.along.z, U(0), -line.along.x);
    k_ = d.length;
    if (k_ < U(kParallel)) return;
    u_ = {d.x, U(0), d.z};
    v_ = cross(line.along, u_);
    const bool other_way = dot(u_, line.point) < S(0);
    if (other_way) u_ = -u_;
    forward_ = other_way ? -line.along : line.along;  // turns u towards v
    has_side_ = k_ > solid.up;
    if (!has_side_) return;
    const U rise = divide_to<U>(solid.up, k_);
    const Vec3<U> aside = u_ * sqrt(round_to<U>(product(U(1), U(1)) - product(rise, rise)));
    side_ = v_ * rise + aside;
    far_side_ = v_ * rise - aside;
  }

  ISO_INLINE bool is_parallel() const { return k_ < U(kParallel); }
  /// found(normal) for the side's; a line that is deep in the solid may be beyond the axis.
  template <class Found> ISO_INLINE void visit_side(const Found& found) const {
    if (has_side_ && is_allowed(side_)) found(side_);
    if (has_side_ && is_allowed(far_side_)) found(far_side_);
  }
  /// Of a line along the axis of a cone: from the axis to where the line is level with the base.
  template <class Found> ISO_INLINE void visit_parallel(const Found& found) const {
    const S rise = line_.along.y < U(0) ? solid_.half + line_.point.y : -solid_.half - line_.point.y;
    const Vec3<S> p = line_.point + line_.along * rise;
    const Direction<S> d = direction_of(p.x, S(0), p.z);
    if (!(d.length > S(0))) return;
    const Vec3<U> radial = {d.x, U(0), d.z};
    const Vec3<U> n = normalise(radial - line_.along * dot(line_.along, radial));
    if (is_allowed(n)) found(n);
  }
  template <class Found> ISO_INLINE void visit_rim(int end, const Found& found) const {
    const S beyond = dot(v_, line_.point) - (end == 0 ? -solid_.half : solid_.half) * k_;
    const bool up = beyond > S(0);
    if (end == 1) {
      if (up && has_side_) search(end, side_, v_, forward_, found);
    } else if (!up) {
      search(end, u_, -v_, -forward_, found);
    } else if (solid_.up > U(0)) {
      search(end, u_, has_side_ ? side_ : v_, forward_, found);
    }
  }

 private:
  static constexpr double kParallel = 0.001;  // sine
  static constexpr int kHalvings = 9;         // then one step by proportion

  ISO_INLINE bool is_allowed(Vec3<U> n) const {
    return dot(n, line_.inward[0]) >= U(0) && dot(n, line_.inward[1]) >= U(0);
  }
  /// By how much the line is ahead of the rim's lowest point along n, in the sense in which `turn` turns n [m].
  ISO_INLINE S ahead(int end, Vec3<U> n, Vec3<U> turn) const {
    const Direction<U> d = direction_of(n.x, U(0), n.z);
    return dot(cross(turn, n), line_.point - solid_.rim(end, {d.x, U(0), d.z}));
  }
  /// Cuts off normals that do not look into a plane; false: none is left.
  static ISO_INLINE bool cut(Vec3<U>& from, Vec3<U>& to, Vec3<U> inward) {
    const U half = U(0.5), at_from = dot(from, inward) * half, at_to = dot(to, inward) * half;
    if (at_from < U(0) && at_to < U(0)) return false;
    if (at_from < U(0)) from = normalise(from * at_to - to * at_from);
    else if (at_to < U(0)) to = normalise(to * at_from - from * at_to);
    return true;
  }
  template <class Found>
  ISO_INLINE void search(int end, Vec3<U> from, Vec3<U> to, Vec3<U> turn, const Found& found) const {
    if (!cut(from, to, line_.inward[0]) || !cut(from, to, line_.inward[1])) return;
    S at_from = ahead(end, from, turn), at_to = ahead(end, to, turn);
    if (!(at_from > S(0)) || !(at_to < S(0))) return;
    const U half = U(0.5);
    for (int i = 0; i < kHalvings; ++i) {
      const Vec3<U> middle = normalise(from * half + to * half);
      const S at = ahead(end, middle, turn);
      if (at > S(0)) from = middle, at_from = at;
      else to = middle, at_to = at;
    }
    const U t = divide_to<U>(at_from, at_from - at_to);
    found(normalise(from * (half - half * t) + to * (half * t)));
  }

  const Revolved<S>& solid_;
  const LineOfOther<S>& line_;
  U k_;
  bool has_side_ = false;
  Vec3<U> u_, v_, forward_, side_, far_side_;
};

/// Offers the normals across a line, for which the solid's support is exact, and the direction from the axis to a line
/// along it. `feature` names the line.
template <class S>
ISO_INLINE void look_at_line(const Revolved<S>& solid, const LineOfOther<S>& line, std::uint32_t feature, S tolerance,
                             RevolvedAxis<S>& best) {
  using Axis = RevolvedAxis<S>;
  const auto offer = [&](typename Axis::Kind kind, Vec3<Unit<S>> n, int end) ISO_INLINE_LAMBDA {
    const S lead = best.kind >= Axis::side_vertex ? S(0) : tolerance;
    best.offer(kind, dot(n, line.point) - solid.reach(n).most(), n, feature, end, lead);
  };
  const NormalsAcross<S> normals(solid, line);
  if (normals.is_parallel()) {
    if (solid.up > Unit<S>(0))
      normals.visit_parallel([&](Vec3<Unit<S>> n) ISO_INLINE_LAMBDA { offer(Axis::rim, n, 0); });
    return;
  }
  normals.visit_side([&](Vec3<Unit<S>> n) ISO_INLINE_LAMBDA { offer(Axis::side_edge, n, 0); });
  for (int end = 0; end < 2; ++end) {
    if (solid.radii[end] > S(0))
      normals.visit_rim(end, [&](Vec3<Unit<S>> n) ISO_INLINE_LAMBDA { offer(Axis::rim, n, end); });
  }
}

/// The normal of the side towards a point.
template <class S> ISO_INLINE Vec3<Unit<S>> side_towards(const Revolved<S>& solid, Vec3<S> p) {
  const Direction<S> d = direction_of(p.x, S(0), p.z);
  return solid.side_normal(d.length > S(0) ? Vec3<Unit<S>>{d.x, Unit<S>(0), d.z}
                                           : Vec3<Unit<S>>{Unit<S>(1), Unit<S>(0), Unit<S>(0)});
}

/// The lowest line of the side, from the lower disc to the upper.
template <class S> ISO_INLINE Segment<S> side_line(const Revolved<S>& solid, Vec3<Unit<S>> radial) {
  const Vec3<S> foot = solid.rim(0, radial), top = solid.rim(1, radial);
  const Vec3<Unit<S>> along = {-(radial.x * solid.up), solid.out, -(radial.z * solid.up)};
  return {foot + (top - foot) * S(0.5), along, solid.slant};
}

}  // namespace isostep::detail
