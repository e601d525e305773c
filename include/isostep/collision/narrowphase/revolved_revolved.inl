// Bodies of revolved_revolved.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/revolved_revolved.hpp"
#include "isostep/collision/narrowphase/revolved_touch.hpp"

namespace isostep {
namespace detail {

/// A disc as what another solid lies on, in that one's frame: t leads there. Its sixteen sides are around the rim, so
/// that what turns in place on a disc of its size is not cut.
template <class S>
ISO_INLINE FaceOfOther<S> disc_as_face(const Revolved<S>& solid, int end, const Transform<S>& t, std::uint32_t name) {
  using U = Unit<S>;
  FaceOfOther<S> face;
  face.normal = t.rotation * unit_axis<U>(1, end == 0);
  face.offset = dot(face.normal, t.position) + solid.half;
  face.own = name | static_cast<std::uint32_t>(end) << 16;
  face.cut = face.own | 1u << 30;
  for (std::uint32_t k = 0; k < 16; ++k) {
    const int i = static_cast<int>(k);
    const Vec3<U> outward = t.rotation * Vec3<U>{cosine_of_sixteenths<S>(i), U(0), cosine_of_sixteenths<S>(i - 4)};
    face.sides.sides[k] = {outward, dot(outward, t.position) + solid.radii[end], kSideName + k, false};
  }
  face.sides.count = 16;
  return face;
}

template <class S> class RevolvedPair {
  using U = Unit<S>;

 public:
  enum Kind : std::uint32_t { disc_a, disc_b, sides, rim_of_a, rim_of_b };
  struct Best {
    Kind kind;
    S separation;    // [m]
    Vec3<U> normal;  // [1] from a to b, a's frame
    int end;         // of a disc
  };

  ISO_INLINE RevolvedPair(const Revolved<S>& a, const Transform<S>& ta, const Revolved<S>& b, const Transform<S>& tb)
      : a_(a), b_(b), b_in_a_(relative(ta, tb)), a_in_b_(relative(tb, ta)) {
    const S size_a = min(a.half, a.radii[0]), size_b = min(b.half, b.radii[0]);
    tolerance_ = axis_tolerance(size_a, size_b, b_in_a_.position);
  }
  ISO_INLINE S tolerance() const { return tolerance_; }

  /// False: they are further apart than `margin`.
  ISO_INLINE bool find(S margin, Best& best) const {
    best = {sides, -highest<S>(), Vec3<U>::zero(), 0};
    find_discs(best);
    if (best.separation > margin) return false;
    Vec3<U> normals[6];
    const int count = side_normals(normals);
    Best round = {sides, best.separation, best.normal, 0};
    for (int i = 0; i < count; ++i) offer(sides, normals[i], 0, S(0), round);
    if (round.separation > margin) return false;
    for (int end = 0; end < 2; ++end) {
      if (b_.radii[end] > S(0)) look_at_rim(rim_of_b, {a_, b_, b_in_a_, end}, round);
      if (a_.radii[end] > S(0)) look_at_rim(rim_of_a, {b_, a_, a_in_b_, end}, round);
      if (round.separation > margin) return false;
    }
    if (round.separation > best.separation + tolerance_) best = round;
    return best.separation <= margin;
  }

  ISO_INLINE void touch(const Best& best, const Transform<S>& ta, const Transform<S>& tb, S margin,
                        Manifold<S>& out) const {
    const RevolvedTouch<S> of_a(a_, ta, margin, tolerance_ * S(0.125), out);
    if (best.kind == disc_a) {
      const RevolvedTouch<S> of_b(b_, tb, margin, tolerance_ * S(0.125), out);
      of_b.over_face(disc_as_face(a_, best.end, a_in_b_, 1u << 31 | 1u << 29));
      out.normal = -out.normal;
    } else if (best.kind == disc_b) {
      of_a.over_face(disc_as_face(b_, best.end, b_in_a_, 1u << 31));
    } else {
      touch_lines(best, of_a);
      return;
    }
    if (out.count == 0 && best.separation <= S(0)) touch_lines(best, of_a);
  }

 private:
  static constexpr int kHalvings = 12;  // of an eighth of a turn: 2e-4 rad

  ISO_INLINE S lowest_of_b(Vec3<U> n) const {
    return dot(n, b_in_a_.position) - b_.reach(-transposed_times(b_in_a_.rotation, n)).most();
  }
  ISO_INLINE void offer(Kind kind, Vec3<U> n, int end, S lead, Best& best) const {
    const S separation = lowest_of_b(n) - a_.reach(n).most();
    if (separation > best.separation + lead) best = {kind, separation, n, end};
  }
  /// Where the discs of both are as good, the larger is what the other lies on.
  ISO_INLINE void find_discs(Best& best) const {
    const bool b_first = b_.radii[0] > a_.radii[0];
    for (int i = 0; i < 2; ++i) {
      const bool of_b = (i == 0) == b_first;
      const Revolved<S>& solid = of_b ? b_ : a_;
      for (int end = 0; end < 2; ++end) {
        if (!(solid.radii[end] > S(0))) continue;
        const Vec3<U> up = unit_axis<U>(1, end == 0);
        const bool first = (best.kind == disc_a) == !of_b;
        offer(of_b ? disc_b : disc_a, of_b ? -(b_in_a_.rotation * up) : up, end, i == 0 || first ? S(0) : tolerance_,
              best);
      }
    }
  }
  /// Normals of both sides at once; of one, towards the other's middle and apex.
  ISO_INLINE int side_normals(Vec3<U> (&normals)[6]) const {
    int count = 0;
    const Mat3<U>& turn = b_in_a_.rotation;
    const Vec3<U> axis = turn.column(1);
    normals[count++] = side_towards(a_, b_in_a_.position);
    normals[count++] = -(turn * side_towards(b_, a_in_b_.position));
    if (b_.radii[1] == S(0)) normals[count++] = side_towards(a_, to_world(b_in_a_, {S(0), b_.half, S(0)}));
    if (a_.radii[1] == S(0)) normals[count++] = -(turn * side_towards(b_, to_world(a_in_b_, {S(0), a_.half, S(0)})));
    const Direction<U> level = direction_of(axis.x, U(0), axis.z);
    const U lean = b_.up + a_.up * axis.y;  // n . axis of a = up, n . axis of b = -up
    if (level.length < U(0.001) || abs(lean) > level.length) return count;
    const U along = -divide_to<U>(lean, level.length);
    const U rest = round_to<U>(product(a_.out, a_.out) - product(along, along));
    if (rest < U(0)) return count;
    const U aside = sqrt(rest);
    for (int k = 0; k < 2; ++k) {
      const U w = k == 0 ? aside : -aside;
      normals[count++] = {level.x * along + level.z * w, a_.up, level.z * along - level.x * w};
    }
    return count;
  }

  /// A rim of `other` beside `solid`, in whose frame lines and normals are.
  struct Rim {
    const Revolved<S>& solid;
    const Revolved<S>& other;
    const Transform<S>& place;  // to the solid's frame
    int end;

    ISO_INLINE LineOfOther<S> tangent(Vec3<U> radial) const {
      const Vec3<U> along = place.rotation * Vec3<U>{-radial.z, U(0), radial.x};
      const Vec3<U> up_side = place.rotation * side_line(other, radial).direction;
      return {
          to_world(place, other.rim(end, radial)), along, {-(place.rotation * radial), end == 0 ? up_side : -up_side}};
    }
  };
  /// From the tangent that is best of eight, halves the arc between its neighbours: a tangent's point that is ahead of
  /// what is nearest to it has passed the best one.
  ISO_INLINE void look_at_rim(Kind kind, const Rim& rim, Best& best) const {
    S most = -highest<S>();
    int at = 0;
    for (int k = 0; k < 16; k += 2) {
      const S separation = nearest_across(kind, rim, sixteenth(k), best).separation;
      if (separation > most) most = separation, at = k;
    }
    // Too far below the best already, even for what eight tangents may miss.
    const S slack = rim.other.radii[rim.end] * S(0.25) + (rim.solid.radii[0] + rim.solid.half) * S(0.125);
    if (most + slack < best.separation) return;
    Vec3<U> low = sixteenth(at - 2), high = sixteenth(at + 2), middle = sixteenth(at);
    for (int i = 0; i < kHalvings; ++i) {
      if (nearest_across(kind, rim, middle, best).is_ahead) high = middle;
      else low = middle;
      middle = normalise(low * U(0.5) + high * U(0.5));
    }
  }
  static ISO_INLINE Vec3<U> sixteenth(int k) {
    return {cosine_of_sixteenths<S>(k), U(0), cosine_of_sixteenths<S>(k - 4)};
  }
  struct Tangent {
    S separation;   // [m]
    bool is_ahead;  // of the point of the solid that is nearest to it
  };
  /// Offers the best normal across a tangent, and those of the other's side there: beyond it the rim is not what
  /// touches.
  ISO_INLINE Tangent nearest_across(Kind kind, const Rim& rim, Vec3<U> radial, Best& best) const {
    const Revolved<S>& solid = rim.solid;
    const LineOfOther<S> line = rim.tangent(radial);
    Tangent tangent = {-highest<S>(), false};
    const auto take = [&](Vec3<U> n, bool on_side) ISO_INLINE_LAMBDA {
      const Reach<S> reach = solid.reach(n);
      const S separation = dot(n, line.point) - reach.most();
      if (!(separation > tangent.separation)) return;
      Vec3<S> nearest = solid.rim(reach.end(), reach.radial);
      if (on_side) {
        const Segment<S> side = side_line(solid, reach.radial);
        nearest = side.at(side.nearest(line.point));
      }
      tangent = {separation, dot(line.along, line.point - nearest) > S(0)};
      if (separation > best.separation) offer(kind, kind == rim_of_b ? n : -(b_in_a_.rotation * n), 0, S(0), best);
    };
    take(-(rim.place.rotation * rim.other.side_normal(radial)), false);
    const NormalsAcross<S> normals(solid, line);
    if (normals.is_parallel()) return tangent;
    normals.visit_side([&](Vec3<U> n) ISO_INLINE_LAMBDA { take(n, true); });
    for (int end = 0; end < 2; ++end) {
      if (solid.radii[end] > S(0)) normals.visit_rim(end, [&](Vec3<U> n) ISO_INLINE_LAMBDA { take(n, false); });
    }
    return tangent;
  }

  /// Lines of the sides along each other, or one point.
  ISO_INLINE void touch_lines(const Best& best, const RevolvedTouch<S>& of_a) const {
    const Reach<S> reach = b_.reach(-transposed_times(b_in_a_.rotation, best.normal));
    const Segment<S> side_b = seen_by(b_in_a_, side_line(b_, reach.radial));
    const std::uint32_t name = 1u << 28;
    if (best.kind == sides && of_a.beside(side_b.at(-side_b.half), side_b.direction, side_b.half + side_b.half,
                                          best.normal, name | 1u << 27)) {
      return;
    }
    const Reach<S> own = a_.reach(best.normal);
    const Lowest of_own = lowest_part(a_, own), of_other = lowest_part(b_, reach);
    const Vec3<S> half_gap = best.normal * (best.separation * S(0.5));
    const Segment<S> side_a = side_line(a_, own.radial);
    Vec3<S> middle;
    if (of_own == Lowest::line && of_other == Lowest::line) {
      const ClosestPair<S> closest = closest_points(side_a, side_b);
      middle = (side_a.at(closest.s) + side_b.at(closest.t)) * S(0.5);
    } else if (of_own == Lowest::line && of_other == Lowest::disc) {
      middle = side_a.at(side_a.nearest(to_world(b_in_a_, centre_of(b_, reach)))) + half_gap;
    } else if (of_own == Lowest::disc && of_other == Lowest::line) {
      middle = side_b.at(side_b.nearest(centre_of(a_, own))) - half_gap;
    } else if (of_own < of_other) {
      middle = a_.rim(own.end(), own.radial) + half_gap;
    } else {
      middle = to_world(b_in_a_, b_.rim(reach.end(), reach.radial)) - half_gap;
    }
    of_a.at(middle, best.separation, best.normal, name);
  }
  static ISO_INLINE Vec3<S> centre_of(const Revolved<S>& solid, const Reach<S>& reach) {
    return {S(0), reach.end() == 0 ? -solid.half : solid.half, S(0)};
  }
  /// Of two that touch the position is that of the smaller.
  enum class Lowest { point, line, disc };
  ISO_INLINE Lowest lowest_part(const Revolved<S>& solid, const Reach<S>& reach) const {
    if (reach.across <= U(kFlatDisc) && solid.radii[reach.end()] > S(0)) return Lowest::disc;
    return abs(reach.of[0] - reach.of[1]) <= tolerance_ * S(0.125) ? Lowest::line : Lowest::point;
  }

  const Revolved<S>& a_;
  const Revolved<S>& b_;
  const Transform<S> b_in_a_, a_in_b_;
  S tolerance_;  // [m]
};

}  // namespace detail

template <class S>
void collide_revolved_revolved(const detail::Revolved<S>& a, const Transform<S>& ta, const detail::Revolved<S>& b,
                               const Transform<S>& tb, S margin, Manifold<S>& out) {
  out.clear();
  const detail::RevolvedPair<S> pair(a, ta, b, tb);
  typename detail::RevolvedPair<S>::Best best;
  if (pair.find(margin, best)) pair.touch(best, ta, tb, margin, out);
}

}  // namespace isostep
