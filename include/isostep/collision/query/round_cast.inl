// A ball or capsule that is cast against a ball, capsule or box: nearest points in closed form instead of by GJK.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_capsule.inl"
#include "isostep/collision/query/core_cast.hpp"
#include "isostep/math/segment.hpp"

namespace isostep::detail {

/// Returns a core of one or two vertices as a segment.
template <class F> ISO_INLINE Segment<F> segment_of(ArrayView<Vec3<F>> vertices) {
  if (vertices.size() == 1) return {vertices[0], {Unit<F>(0), Unit<F>(1), Unit<F>(0)}, F(0)};
  const Vec3<F> half = (vertices[1] - vertices[0]) * F(0.5);
  const Heading<F> way = heading_of(half);
  return {vertices[0] + half, way.direction, way.length};
}

/// A search for CoreCast, in b's rotation. a's core is a segment. `Still` is b's core about its own position:
///   nearest(segment)  its point nearest to a segment, and the segment's nearest point
///   reach(direction)  [m] how far it reaches from its centre, and `centre`
///   way_out(segment)  of a segment that passes through it, as in CoreSearch; nothing: it cannot tell
template <class F, class Still> struct SegmentSearch {
  Segment<F> moving;
  Still still;
  Vec3<F> seen_at = Vec3<F>::zero();  // [m] of b, where `nearest` was asked last

  /// Computes the separation by the two cores' reach along the shortest way: the plane across it is proved, not
  /// assumed.
  template <class Enough> ISO_INLINE GjkDistance<F> nearest(Vec3<F> at, const Enough&) {
    seen_at = at;
    const Segment<F> seen = {moving.centre - at, moving.direction, moving.half};
    const auto [on_a, on_b] = still.nearest(seen);
    const Heading<F> gap = heading_of(on_b - on_a);
    const F reaches = moving.half * abs(dot(moving.direction, gap.direction)) + still.reach(gap.direction);
    const F separation = dot(gap.direction, still.centre() - seen.centre) - reaches;
    return {gap.length, gap.direction, at + on_a, at + on_b, 1, separation};
  }
  ISO_INLINE std::optional<CoreWayOut<F>> way_out(F) const {
    std::optional<CoreWayOut<F>> out = still.way_out({moving.centre - seen_at, moving.direction, moving.half});
    if (out) out->on_b += seen_at;
    return out;
  }
};
template <class F> struct PointPair {
  Vec3<F> on_a, on_b;  // [m]
};
template <class F> struct StillBox {
  Vec3<F> half;  // [m]

  ISO_INLINE Vec3<F> centre() const { return Vec3<F>::zero(); }
  ISO_INLINE F reach(Vec3<Unit<F>> along) const { return dot(half, abs(along)); }
  ISO_INLINE PointPair<F> nearest(const Segment<F>& segment) const {
    const Vec3<F> on_a = segment.at(closest_to_box(segment, half));
    return {on_a, max(min(on_a, half), -half)};
  }
  /// Returns the way out by a face, at the point below the deepest end, or the way across an edge.
  ISO_INLINE std::optional<CoreWayOut<F>> way_out(const Segment<F>& segment) const {
    const Pierced<F> way = pierced(segment, half, F(0));
    const bool first = dot(segment.direction, way.outward) < Unit<F>(0);
    const F s = way.edge ? closest_points(segment, edge_towards(half, way.axis, way.outward)).s
                : first  ? segment.half
                         : -segment.half;
    return CoreWayOut<F>{-way.length, -way.outward, max(min(segment.at(s) - way.outward * way.length, half), -half)};
  }
};
template <class F> struct StillSegment {
  Segment<F> core;

  ISO_INLINE Vec3<F> centre() const { return core.centre; }
  ISO_INLINE F reach(Vec3<Unit<F>> along) const { return core.half * abs(dot(core.direction, along)); }
  ISO_INLINE PointPair<F> nearest(const Segment<F>& segment) const {
    const ClosestPair<F> pair = closest_points(segment, core);
    return {segment.at(pair.s), core.at(pair.t)};
  }
  ISO_INLINE std::optional<CoreWayOut<F>> way_out(const Segment<F>&) const { return {}; }
};

enum class RoundCast { hit, miss, undecided };

/// cast_convex() of a core of one or two vertices against `still`, in the frame at `tb`. Undecided: cores that may
/// overlap at the start.
template <class S, class Still>
ISO_INLINE RoundCast cast_round_at(const ConvexCore<S>& a, const Transform<S>& ta, const Still& still,
                                   CoreSize<Finer<S>> size, const Transform<S>& tb, const CastMotion<S>& motion,
                                   CastHit<S>& hit) {
  using F = Finer<S>;
  const FineCore<S> fine_a(a);
  const Mat3<Unit<F>> turn = finer_of(tb).rotation, own = finer_of(ta).rotation;
  const CoreCast<S> cast({fine_a.radius, fine_a.extent}, ta.position, size, tb.position, turn, motion);
  const Segment<F> core = segment_of<F>(fine_a.vertices);
  const Segment<F> moving = {transposed_times(turn, own * core.centre), transposed_times(turn, own * core.direction),
                             core.half};
  SegmentSearch<F, Still> search = {moving, still};
  const CoreHit<F> found = cast.run(search);
  if (found.is_open) return RoundCast::undecided;
  return cast.tell(found, hit) ? RoundCast::hit : RoundCast::miss;
}
/// Casts against a box.
template <class S>
ISO_INLINE RoundCast cast_round(const ConvexCore<S>& a, const Transform<S>& ta, Vec3<S> half, const Transform<S>& tb,
                                const CastMotion<S>& motion, CastHit<S>& hit) {
  using F = Finer<S>;
  const Vec3<F> fine = finer_of<F>(half);
  return cast_round_at(a, ta, StillBox<F>{fine}, {F(0), max_abs(fine)}, tb, motion, hit);
}
/// Casts against another core of one or two vertices.
template <class S>
ISO_INLINE RoundCast cast_round(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b,
                                const Transform<S>& tb, const CastMotion<S>& motion, CastHit<S>& hit) {
  using F = Finer<S>;
  const FineCore<S> fine(b);
  return cast_round_at(a, ta, StillSegment<F>{segment_of<F>(fine.vertices)}, {fine.radius, fine.extent}, tb, motion,
                       hit);
}

}  // namespace isostep::detail
