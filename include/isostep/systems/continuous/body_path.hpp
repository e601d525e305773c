// BodyPath<S>: the way of a body in a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/continuous/core_motion.hpp"

namespace isostep {

/// A part of the step as pieces count it.
struct PathPiece {
  std::uint32_t index, count;
};

/// Its centre goes at constant speed; its turns go in pieces of less than half a turn each. What goes straight in the
/// first piece is `centre` [m], in the body's frame; in the others it is the centre of mass.
template <class S> struct BodyPath {
  static constexpr std::uint32_t kMostPieces = 4;
  std::uint32_t pieces;
  Pose<S> poses[kMostPieces + 1];

  ISO_INLINE const Pose<S>& from() const { return poses[0]; }
  ISO_INLINE const Pose<S>& to() const { return poses[pieces]; }
  /// The pose after a fraction [1] of the path.
  Pose<S> pose_after(Unit<S> fraction, Vec3<S> centre) const;
  /// A piece of the path, which has one piece or as many.
  CoreMotion<S> motion_in(PathPiece piece, Vec3<S> centre) const;
};

}  // namespace isostep
