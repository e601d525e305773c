// BodyPath<S>: the way of a body in a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/continuous/core_motion.hpp"

namespace isostep {

/// A piece of a path: its index, and the number of pieces.
struct PathPiece {
  std::uint32_t index, count;
};

/// The motion of a body in a step. Its centre has constant speed; it turns in pieces of less than half a turn each. In
/// the first piece the point `centre` [m] of the body's frame moves straight, later the centre of mass.
template <class S> struct BodyPath {
  static constexpr std::uint32_t kMostPieces = 4;
  std::uint32_t pieces;
  Pose<S> poses[kMostPieces + 1];

  ISO_INLINE const Pose<S>& from() const { return poses[0]; }
  ISO_INLINE const Pose<S>& to() const { return poses[pieces]; }
  /// Returns the pose after a fraction [1] of the path.
  Pose<S> pose_after(Unit<S> fraction, Vec3<S> centre) const;
  /// Returns the motion in one piece. The path has one piece, or as many as piece.count.
  CoreMotion<S> motion_in(PathPiece piece, Vec3<S> centre) const;
};

}  // namespace isostep
