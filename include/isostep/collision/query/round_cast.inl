// A ball or capsule that is cast against a ball, capsule or box: nearest points in closed form instead of by GJK.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_capsule.inl"
#include "isostep/collision/query/core_cast.hpp"
#include "isostep/math/segment.hpp"

namespace isostep::detail {

/// A core of one or two vertices.
template <class F> ISO_INLINE Segment<F> segment_of(ArrayView<Vec3<F>> vertices) {
  if (vertices.size() == 1) return {vertices[0], {Unit<F>(0), Unit<F>(1), Unit<F>(0)}, F(0)};
  const Vec3<F> half = (vertices[1] - vertices[0]) * F(0.5);
  const Heading<F> way = heading_of(half);
  return {vertices[0] + half, way.direction, way.length};
}

/// For CoreCast, in b's rotation: a's core is a segment. `Still` is b's about its own position:
///   nearest(segment)  its point nearest to a segment, and the segment's
///   reach(direction)  [m] how far it goes from its centre, and `centre`
template <class F, class Still> struct SegmentSearch {
  Segment<F> moving;
  Still still;

  /// The plane across the shortest way parts them as far as the two reach along it: it is proved, not assumed.
  template <class Enough> ISO_INLINE GjkDistance<F> nearest(Vec3<F> at, const Enough&) const {
    const Segment<F> seen = {moving.centre - at, moving.direction, moving.half};
    const auto [on_a, on_b] = still.nearest(seen);
    const Heading<F> gap = heading_of(on_b - on_a);
    const F reaches = moving.half * abs(dot(moving.direction, gap.direction)) + still.reach(gap.direction);
    const F separation = dot(gap.direction, still.centre() - seen.centre) - reaches;
    return {gap.length, gap.direction, at + on_a, at + on_b, 1, separation};
  }
  ISO_INLINE std::optional<CoreWayOut<F>> way_out(F) const { return {}; }
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
};
template <class F> struct StillSegment {
  Segment<F> core;

  ISO_INLINE Vec3<F> centre() const { return core.centre; }
  ISO_INLINE F reach(Vec3<Unit<F>> along) const { return core.half * abs(dot(core.direction, along)); }
  ISO_INLINE PointPair<F> nearest(const Segment<F>& segment) const {
    const ClosestPair<F> pair = closest_points(segment, core);
    return {segment.at(pair.s), core.at(pair.t)};
  }
};

enum class RoundCast { hit, miss, undecided };

/// cast_convex() of a core of one or two vertices against one of as many, or against a box, whose half extents `half`
/// are then.
/// Undecided: cores that may overlap at the start.
template <class S>
ISO_INLINE RoundCast cast_round(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b,
                                const Transform<S>& tb, const Vec3<S>* half, const CastMotion<S>& motion,
                                CastHit<S>& hit) {
  using F = Finer<S>;
  const FineCore<S> fine_a(a), fine_b(b);
  const Mat3<Unit<F>> turn = finer_of(tb).rotation;
  const CoreCast<S> cast(fine_a, ta.position, fine_b, tb.position, turn, motion);
  const Transform<F> a_in_b = {Vec3<F>::zero(), transpose(turn) * finer_of(ta).rotation};
  const Segment<F> moving = seen_by(a_in_b, segment_of<F>(fine_a.vertices));
  CoreHit<F> found;
  if (half != nullptr) {
    SegmentSearch<F, StillBox<F>> search = {moving, {finer_of<F>(*half)}};
    found = cast.run(search);
  } else {
    SegmentSearch<F, StillSegment<F>> search = {moving, {segment_of<F>(fine_b.vertices)}};
    found = cast.run(search);
  }
  if (found.is_open) return RoundCast::undecided;
  return cast.tell(found, hit) ? RoundCast::hit : RoundCast::miss;
}

}  // namespace isostep::detail
