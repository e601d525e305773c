// SolidTouch<S>: the contact points of two solids along an axis: the faces that look at each other, clipped.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/solid_gap.inl"
#include "isostep/collision/narrowphase/solid_over_plane.hpp"
#include "isostep/math/segment.hpp"

namespace isostep::detail {

/// Names of contacts. On faces: bit 31, bit 30 if b's face bears the other solid, bit 29 if a side cuts, and the face.
/// Else bit 27, and bit 26 for two points along lines.
namespace solid_feature {
inline constexpr std::uint32_t kFace = 1u << 31, kOfB = 1u << 30, kPoint = 1u << 27, kLines = kPoint | 1u << 26;
}  // namespace solid_feature

/// Returns the line of a face that reaches furthest along n: its own, or the edge whose nearer end reaches furthest.
template <class S> ISO_INLINE Segment<S> line_of(const SolidFace<S>& face, Vec3<Unit<S>> n) {
  int best = 0, after = face.count - 1;
  S most = -highest<S>();
  for (int k = 0; k < face.count && face.is_flat(); ++k) {
    const int next = k + 1 < face.count ? k + 1 : 0;
    const S reach = min(dot(n, face.points[k]), dot(n, face.points[next]));
    if (reach > most) most = reach, best = k, after = next;
  }
  const Vec3<S> from = face.points[best], half = (face.points[after] - from) * S(0.5);
  const Heading<S> heading = heading_of(half);
  return {from + half, heading.direction, heading.length};
}

/// Finds the point of a solid nearest to a line in its frame. The distance is convex along the line, inside too, and
/// rises by the slope that the normal tells.
template <class S> ISO_INLINE ClosestPoint<S> nearest_of_line(const SolidView<S>& solid, const Segment<S>& line) {
  using U = Unit<S>;
  constexpr int kSteps = 24;
  constexpr double kLevel = 0x1p-18;  // [1] of the slope, 4e-6 rad
  S low = -line.half, high = line.half;
  const ClosestPoint<S> at_low = solid.closest(line.at(low));
  U slope_low = dot(at_low.normal, line.direction);
  if (slope_low >= U(0)) return at_low;
  const ClosestPoint<S> at_high = solid.closest(line.at(high));
  U slope_high = dot(at_high.normal, line.direction);
  if (slope_high <= U(0)) return at_high;
  ClosestPoint<S> found = at_low;
  for (int i = 0; i < kSteps && high - low > resolution<S>(); ++i) {
    const U half = U(0.5), share = divide_to<U>(slope_low * half, slope_low * half - slope_high * half);
    const S at = low + (high - low) * (i % 3 == 2 ? half : share);
    found = solid.closest(line.at(at));
    const U slope = dot(found.normal, line.direction);
    if (abs(slope) <= U(kLevel)) break;
    if (slope > U(0)) high = at, slope_high = slope;
    else low = at, slope_low = slope;
  }
  return found;
}

template <class S> class SolidTouch {
  using F = Finer<S>;
  using U = Unit<S>;

 public:
  /// `margin` [m] of the cores. `tolerance` [m] by which an axis must be better than a preferred one.
  ISO_INLINE SolidTouch(const SolidView<S>& a, const Transform<S>& ta, const SolidView<S>& b, const Transform<S>& tb,
                        S margin, S tolerance, Manifold<S>& out)
      : a_(a),
        b_(b),
        ta_(ta),
        tb_(tb),
        b_in_a_(relative(ta, tb)),
        a_in_b_(relative(tb, ta)),
        margin_(margin),
        tolerance_(tolerance),
        out_(out) {}

  /// Takes better axes across lines of both, and from one solid to where a line of the other is nearest to it, until
  /// there are none. Along another axis, the lines of round parts and the edges are others.
  ISO_INLINE void look_at_lines(SolidGap<S>& gap) const {
    for (int round = 0; round < kMostLines; ++round) {
      const bool crossed = look_across_lines(gap), by_a = look_at_line_of_a(gap), by_b = look_at_line_of_b(gap);
      if (!crossed && !by_a && !by_b) return;
    }
  }

  /// Writes the contact points along the axis so far to `out`: on a flat face that reaches as far, within the
  /// tolerance; along two lines; or in the one point where the cores meet. Returns false if that point is not known.
  ISO_INLINE bool touch(const SolidGap<S>& gap) {
    return touch(gap, [](Vec3<U>) ISO_INLINE_LAMBDA { return true; });
  }
  /// Does so for a triangle b, with faces of a that `allows(normal)`. The triangle's own face is handled elsewhere.
  template <class Allows> ISO_INLINE bool touch(const SolidGap<S>& gap, const Allows& allows) {
    out_.clear();
    const SolidAxis<S>& axis = gap.best();
    const Vec3<U> n = coarser_of<U>(axis.normal);
    SolidFace<S> of_a, of_b;
    a_.find_face(n, U(kNearDisc), of_a);
    b_.find_face(transposed_times(b_in_a_.rotation, -n), U(kNearDisc), of_b);
    const F least = axis.separation - finer<F>(tolerance_);
    const F along_a = of_a.is_flat() && allows(of_a.normal) ? gap.along(finer_of<Unit<F>>(of_a.normal)) : least - F(1);
    const F along_b = of_b.is_flat() ? gap.along(finer_of<Unit<F>>(b_in_a_.rotation * -of_b.normal)) : least - F(1);
    const bool is_a = along_a >= least, is_b = along_b >= least, b_first = is_b && (!is_a || is_b_wider(of_a, of_b));
    for (int i = 0; i < 2; ++i) {
      const bool on_b = (i == 0) == b_first;
      if (!(on_b ? is_b : is_a)) continue;
      if (on_face(on_b ? of_b : of_a, on_b, coarser<S>(on_b ? along_b : along_a))) return true;
    }
    const S separation = coarser<S>(axis.separation);
    return along_lines(n, separation) || (axis.is_met && at_point(axis, n, separation));
  }

  /// Adds one point between the support points of the cores, if nothing else is known.
  ISO_INLINE void touch_anyway(SolidGap<S>& gap) {
    gap.meet_at_supports();
    out_.clear();
    at_point(gap.best(), coarser_of<U>(gap.best().normal), coarser<S>(gap.best().separation));
  }

  /// Returns true if no axis is better than the manifold's by more than the tolerance, or by what a point may miss: no
  /// axis separates the cores by more than the distance of a point of one core from the other.
  ISO_INLINE bool is_best() const {
    const S least = least_of();
    for (int i = 0; i < out_.count; ++i) {
      const ManifoldPoint<S>& p = out_.points[i];
      const bool of_face = (p.feature & solid_feature::kFace) != 0;
      const bool on_a = of_face && (p.feature & solid_feature::kOfB) != 0;  // what lies on b's face
      const S limit = least + (of_face ? tolerance_ : tolerance_ * S(kSharp));
      const Vec3<S> half = out_.normal * (p.separation * S(0.5));
      if (!on_a && a_.closest(to_local(ta_, p.position + half)).distance <= limit) return true;
      if ((on_a || !of_face) && b_.closest(to_local(tb_, p.position - half)).distance <= limit) return true;
    }
    return false;
  }

 private:
  static constexpr double kNearDisc = 0.25;     // sine within which a disc may be what is best
  static constexpr double kAlongLine = 0.0625;  // sine within which lines are along each other
  static constexpr double kSharp = 1.0 / 32;  // [1] of the tolerance: no normal at a point is preferred to a better one

  static constexpr int kMostLines = 4;

  ISO_INLINE bool look_across_lines(SolidGap<S>& gap) const {
    const Vec3<U> n = coarser_of<U>(gap.best().normal);
    const Segment<S> of_a = line_of_a(n), of_b = line_of_b(n);
    if (!(of_a.half > S(0)) || !(of_b.half > S(0))) return false;
    const Heading<U> across = heading_of(cross(of_a.direction, of_b.direction));
    if (across.length < U(kAlongLine)) return false;
    const Vec3<U> way = negate_if(dot(across.direction, n) < U(0), across.direction);
    if (!gap.look(finer_of<Unit<F>>(way))) return false;
    const Segment<S> there_a = line_of_a(way), there_b = line_of_b(way);
    const ClosestPair<S> closest = closest_points(there_a, there_b);
    gap.meet(finer_of<F>(there_a.at(closest.s)), finer_of<F>(there_b.at(closest.t)));
    return true;
  }
  ISO_INLINE bool look_at_line_of_a(SolidGap<S>& gap) const {
    const Segment<S> line = line_of_a(coarser_of<U>(gap.best().normal));
    const ClosestPoint<S> found = nearest_of_line(b_, seen_by(a_in_b_, line));
    if (!gap.look(-(gap.b_in_a().rotation * finer_of<Unit<F>>(found.normal)))) return false;
    gap.meet(finer_of<F>(to_world(b_in_a_, found.point + found.normal * found.distance)),
             finer_of<F>(to_world(b_in_a_, found.point)));
    return true;
  }
  ISO_INLINE bool look_at_line_of_b(SolidGap<S>& gap) const {
    const ClosestPoint<S> found = nearest_of_line(a_, line_of_b(coarser_of<U>(gap.best().normal)));
    if (!gap.look(finer_of<Unit<F>>(found.normal))) return false;
    gap.meet(finer_of<F>(found.point), finer_of<F>(found.point + found.normal * found.distance));
    return true;
  }

  ISO_INLINE Segment<S> line_of_a(Vec3<U> n) const {
    SolidFace<S> face;
    a_.find_face(n, U(0), face);
    return line_of(face, n);
  }
  ISO_INLINE Segment<S> line_of_b(Vec3<U> n) const {
    SolidFace<S> face;
    const Vec3<U> back = transposed_times(b_in_a_.rotation, -n);
    b_.find_face(back, U(0), face);
    return seen_by(b_in_a_, line_of(face, back));
  }
  /// Returns true if b's face is preferred: polygons go before discs, and the wider of two discs bears the other.
  static ISO_INLINE bool is_b_wider(const SolidFace<S>& of_a, const SolidFace<S>& of_b) {
    if (!of_a.is_disc) return false;
    return !of_b.is_disc || width(of_b) > width(of_a);
  }
  static ISO_INLINE S width(const SolidFace<S>& disc) { return length(disc.points[0] - disc.points[disc.count / 2]); }

  ISO_INLINE S least_of() const {
    S least = out_.points[0].separation;
    for (int i = 1; i < out_.count; ++i) least = min(least, out_.points[i].separation);
    return least;
  }
  /// Returns true if the points show the axis' gap.
  ISO_INLINE bool tells(S separation) {
    if (out_.count > 0 && abs(least_of() - separation) <= tolerance_) return true;
    out_.clear();
    return false;
  }
  ISO_INLINE bool on_face(const SolidFace<S>& face, bool of_b, S separation) {
    RestPlane<S> plane;
    plane_of(face, of_b ? b_in_a_ : a_in_b_, solid_feature::kFace | (of_b ? solid_feature::kOfB : 0), plane);
    const S tie = depth_tie(tolerance_, S(0));
    if (of_b) SolidOverPlane<S>(a_, ta_, margin_, tie, out_).touch(plane);
    else SolidOverPlane<S>(b_, tb_, margin_, tie, out_).touch(plane);
    if (!of_b) out_.normal = -out_.normal;
    return tells(separation);
  }
  /// Adds both ends of the stretch along which two lines are beside each other, if they are nearly parallel.
  ISO_INLINE bool along_lines(Vec3<U> n, S separation) {
    const Segment<S> of_a = line_of_a(n), of_b = line_of_b(n);
    const Vec3<U> across = cross(of_a.direction, of_b.direction);
    if (dot(across, across) > U(kAlongLine * kAlongLine)) return false;
    const S middle = dot(of_b.centre - of_a.centre, of_a.direction);
    const S reach = of_b.half * abs(dot(of_a.direction, of_b.direction));
    const S low = max(-of_a.half, middle - reach), high = min(of_a.half, middle + reach);
    if (!(low < high)) return false;
    out_.normal = ta_.rotation * n;
    for (std::uint32_t k = 0; k < 2; ++k) {
      const Vec3<S> p = of_a.at(k == 0 ? low : high), q = of_b.at(of_b.nearest(p));
      const S gap = dot(n, q - p);
      if (gap <= margin_) out_.add(to_world(ta_, (p + q) * S(0.5)), gap, solid_feature::kLines | k);
    }
    return tells(separation);
  }
  ISO_INLINE bool at_point(const SolidAxis<S>& axis, Vec3<U> n, S separation) {
    out_.normal = ta_.rotation * n;
    const Vec3<S> middle = coarser_of<S>((axis.on_a + axis.on_b) * F(0.5));
    if (separation <= margin_) out_.add(to_world(ta_, middle), separation, solid_feature::kPoint);
    return out_.count > 0;
  }

  const SolidView<S>& a_;
  const SolidView<S>& b_;
  const Transform<S>&ta_, &tb_;
  const Transform<S> b_in_a_, a_in_b_;
  const S margin_, tolerance_;  // [m]
  Manifold<S>& out_;
};

}  // namespace isostep::detail
