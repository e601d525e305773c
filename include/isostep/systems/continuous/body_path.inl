// Bodies of body_path.hpp, and what tells how far poses are apart.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/body_path.hpp"

namespace isostep {

namespace detail {
/// Returns pose b in the frame of a.
template <class S> Pose<S> pose_from(const Pose<S>& a, const Pose<S>& b) {
  return {transposed_times(to_matrix(a.orientation), b.position - a.position),
          normalise(conjugate(a.orientation) * b.orientation)};
}
/// [1] Returns the sine of half the angle between the orientations of two poses.
template <class S> Unit<S> half_turn(const Pose<S>& from, const Pose<S>& to) {
  const Quat<Unit<S>> turn = to.orientation * conjugate(from.orientation);
  return length(Vec3<Unit<S>>{turn.x, turn.y, turn.z});
}
/// [m] An upper bound of the straight distance that a point within `reach` of the frame's origin moves.
template <class S> S most_motion(const CoreMotion<S>& motion, S reach) {
  const S chord = reach * half_turn(motion.start, motion.end);
  return length(motion.end.position - motion.start.position) + chord + chord;
}
/// Returns a / b for 0 <= a <= b, b a power of two.
template <class S> ISO_INLINE Unit<S> share_of(std::uint32_t a, std::uint32_t b) {
  return divide_to<Unit<S>>(S(static_cast<std::int32_t>(a)), S(static_cast<std::int32_t>(b)));
}
}  // namespace detail

template <class S> Pose<S> BodyPath<S>::pose_after(Unit<S> fraction, Vec3<S> centre) const {
  std::uint32_t piece = 0;
  while (piece + 1 < pieces && detail::share_of<S>(piece + 1, pieces) < fraction) ++piece;
  Unit<S> of_piece = fraction - detail::share_of<S>(piece, pieces);
  for (std::uint32_t parts = 1; parts < pieces; parts += parts) of_piece = of_piece + of_piece;
  return pose_at<S>({poses[piece], poses[piece + 1], piece == 0 ? centre : Vec3<S>::zero()}, of_piece);
}
template <class S> CoreMotion<S> BodyPath<S>::motion_in(PathPiece piece, Vec3<S> centre) const {
  const Vec3<S> turning = piece.index == 0 || pieces == 1 ? centre : Vec3<S>::zero();
  if (pieces == piece.count) return {poses[piece.index], poses[piece.index + 1], turning};
  const CoreMotion<S> whole = {poses[0], poses[1], turning};
  return {pose_at(whole, detail::share_of<S>(piece.index, piece.count)),
          pose_at(whole, detail::share_of<S>(piece.index + 1, piece.count)), turning};
}

}  // namespace isostep
