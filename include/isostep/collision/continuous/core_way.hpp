// CoreWay<S>: where a core passes in a motion, seen from a shape at rest: its box, and planes that it stays above.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/core_motion.hpp"
#include "isostep/collision/continuous/plane_impact.hpp"
#include "isostep/collision/narrowphase/convex_core.hpp"
#include "isostep/collision/narrowphase/polyhedron_axes.hpp"
#include "isostep/geometry/closest.hpp"

namespace isostep::detail {

/// Input:   a core and its motion, and the frame of a shape at rest, which leads to the world by `t`.
/// Output:  bounds of all that the core passes, in that frame.
/// Symbols: bow = a bound for the distance of any point of the core from its place, at that time, on the line between
///          its places at both ends.
template <class S> class CoreWay {
 public:
  ISO_INLINE CoreWay(const Transform<S>& t, const ConvexCore<S>& core, const CoreMotion<S>& motion)
      : core_(core),
        centre_(motion.centre),
        from_(relative(t, Transform<S>::of(motion.start))),
        is_still_(is_still(motion)),
        to_(is_still_ ? from_ : relative(t, Transform<S>::of(motion.end))) {
    reach_ = longest_of<S>(core.vertices.size(),
                           [&](std::uint32_t i) ISO_INLINE_LAMBDA { return core.vertices[i] - motion.centre; });
    bow_ = is_still_ ? S(0) : bow_of(motion, reach_);
  }

  /// Returns the box around all that the core passes, grown by `margin` [m]: its boxes at both ends and the bow between
  /// them, within the ball in which it turns. The ball of a core far from its body's middle would hold a thousand times
  /// the triangles.
  ISO_INLINE Aabb<S> box(S margin) const {
    if (is_still_) return grown_with_slack<S>(box_of(core_, from_), margin);
    const Aabb<S> ends = grow(merge(box_of(core_, from_), box_of(core_, to_)), bow_);
    const S radius = reach_ + core_.radius;
    const Vec3<S> ball = {radius, radius, radius};
    const Aabb<S> turned =
        merge(Aabb<S>::around(to_world(from_, centre_), ball), Aabb<S>::around(to_world(to_, centre_), ball));
    return grown_with_slack<S>({max(ends.low, turned.low), min(ends.high, turned.high)}, margin);
  }
  /// Returns true if the core stays more than `margin` [m] above a plane: rounding counts as nearer.
  ISO_INLINE bool stays_above(const SolidPlane<S>& plane, S margin) const {
    const S ends = max(max_abs(from_.position - plane.point), max_abs(to_.position - plane.point));
    const S apart = ends + reach_ + max_abs(centre_);
    const S least = core_.radius + bow_ + max(margin, gap_noise(apart) * S(8)) + gap_noise(apart);
    return least < height(from_, plane) && (is_still_ || least < height(to_, plane));
  }

 private:
  /// [m] Returns the height of the lowest vertex above a plane.
  ISO_INLINE S height(const Transform<S>& at, const SolidPlane<S>& plane) const {
    const S lowest = lowest_of(core_.vertices, transposed_times(at.rotation, plane.normal)).height;
    return dot(plane.normal, at.position - plane.point) + lowest;
  }

  const ConvexCore<S>& core_;
  Vec3<S> centre_;  // [m] of turning, in the core's frame
  Transform<S> from_;
  bool is_still_;
  Transform<S> to_;
  S reach_, bow_;  // [m]
};

}  // namespace isostep::detail
