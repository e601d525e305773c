// CoreMotion<S>: how a solid gets from one pose to another within a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/math/aabb.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/scalar/finer.hpp"

namespace isostep {

/// The motion of a solid. One point moves along a line at constant speed. The orientation is the normalised linear
/// interpolation of both ends, the shorter way. That needs a root but no sine, and turns about one axis: a little
/// faster in the middle than at the ends, by (turn / 2)^2 / 4 of the speed. Turns must be less than half a turn.
template <class S> struct CoreMotion {
  Pose<S> start, end;  // of the solid's frame
  Vec3<S> centre;      // [m] in the solid's frame: the point, as a rule its body's centre of mass
};

namespace detail {

template <class S> ISO_INLINE bool is_still(const CoreMotion<S>& motion) {
  return motion.start.position == motion.end.position && motion.start.orientation == motion.end.orientation;
}

/// Returns `end` or -`end`, which are the same orientation: the one on the shorter way from `start`.
template <class U> ISO_INLINE Quat<U> on_near_side(Quat<U> start, Quat<U> end) {
  const auto cosine =
      product(start.x, end.x) + product(start.y, end.y) + product(start.z, end.z) + product(start.w, end.w);
  return cosine < product(U(0), U(0)) ? Quat<U>{-end.x, -end.y, -end.z, -end.w} : end;
}
/// Returns the interpolated orientation, not normalised. Its length is 0.7 to 1.
template <class U> ISO_INLINE Quat<U> between(Quat<U> start, Quat<U> end, U t) {
  return {start.x + (end.x - start.x) * t, start.y + (end.y - start.y) * t, start.z + (end.z - start.z) * t,
          start.w + (end.w - start.w) * t};
}

/// Returns the length of the longest of some vectors, with one root for all of them.
template <class S, class Vector> ISO_INLINE S longest_of(std::uint32_t count, const Vector& vector) {
  Vec3<S> longest = vector(0u);
  auto squared = dot_sum(longest, longest);
  for (std::uint32_t i = 1; i < count; ++i) {
    const Vec3<S> other = vector(i);
    const auto of_other = dot_sum(other, other);
    if (squared < of_other) squared = of_other, longest = other;
  }
  return length(longest);
}

/// [m] Returns the bow of a way: a bound for the distance of any point within `reach` of the centre from its place, at
/// that time, on the line between its two ends. It is an eighth of the largest acceleration: SweptCore.
template <class S> ISO_INLINE S bow_of(const CoreMotion<S>& motion, S reach) {
  using U = Unit<S>;
  const Quat<U> turn =
      on_near_side(motion.start.orientation, motion.end.orientation) * conjugate(motion.start.orientation);
  const U half_sine = length(Vec3<U>{turn.x, turn.y, turn.z}) * U(0.5);
  const U c = divide_to<U>(half_sine, U(0.5) + turn.w * U(0.5));  // [1] the tangent of a quarter of the turn
  const S squared = reach * (c * c);
  return (squared + squared * c) * S(16.25 / 8);
}
/// [m] Returns a box grown by `margin` and by the rounding of its sides, like SweepTest.
template <class S> ISO_INLINE Aabb<S> grown_with_slack(const Aabb<S>& box, S margin) {
  const S step = resolution<S>() * S(16), farthest = max(max_abs(box.low), max_abs(box.high));
  return grow(box, margin + farthest * step + step);
}

}  // namespace detail

/// Returns the pose after a fraction 0 ... 1 of a motion, exact at both ends.
template <class S> ISO_INLINE Pose<S> pose_at(const CoreMotion<S>& motion, Unit<S> fraction) {
  if (fraction == Unit<S>(0)) return motion.start;
  if (fraction == Unit<S>(1)) return motion.end;
  const Quat<Unit<S>> end = detail::on_near_side(motion.start.orientation, motion.end.orientation);
  const Quat<Unit<S>> turn = normalise(detail::between(motion.start.orientation, end, fraction));
  const Vec3<S> from = rotate(motion.start.orientation, motion.centre);
  const Vec3<S> way = motion.end.position - motion.start.position + rotate(end, motion.centre) - from;
  return {motion.start.position + way * fraction + (from - rotate(turn, motion.centre)), turn};
}

}  // namespace isostep
