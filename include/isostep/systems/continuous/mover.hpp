// Mover<S>, a body that is swept; Obstacle<S>, the body that it is swept against; MotionCut<S>, where it stops.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/aabb.hpp"
#include "isostep/systems/continuous/body_path.hpp"

namespace isostep {

template <class S> struct Mover : BodyPath<S> {
  std::uint32_t index;  // among the awake ones
  S inner;              // [m] least inner radius of its parts
  S reach;              // [m] no point of it is further from its centre of mass
  S motion;             // [m] no point of it has moved further
  Aabb<S> around;       // [m] from its centre, all of it wherever it is on its way
  Unit<S> fraction;     // [1] what it was cut to
  Vec3<S> centre;       // [m] in its frame: what goes straight in the first piece, where it touches at the start
  bool closely;         // swept at what is thin however little it moves
  bool deep;            // ends deep in something fixed: swept at that, however thick both are
  Pose<S> stopped;      // where it is at that fraction, if something stopped it, with what stopped it

  ISO_INLINE CoreMotion<S> motion_of(std::uint32_t piece) const {
    return {this->poses[piece], this->poses[piece + 1], piece == 0 ? centre : Vec3<S>::zero()};
  }
  ISO_INLINE Aabb<S> swept() const {
    const Vec3<S>&from = this->from().position, &to = this->to().position;
    return {min(from, to) + around.low, max(from, to) + around.high};
  }
  /// The pose after a fraction of the step.
  ISO_INLINE Pose<S> way(Unit<S> of_step) const { return this->pose_after(of_step, centre); }
};

/// A body, in the frame of the world or of a kinematic body.
template <class S> struct Obstacle {
  std::uint32_t slot;
  CoreMotion<S> motion;  // of the piece; its start is its end: at rest
  S moved;               // [m] no point of it moves further, in the frame
  S relative_motion;     // [m] no two points of the body and of it move further against each other
  const Pose<S>* end;    // at the end of the step, in the world: what it stops goes on with it; null: it stays
};

/// The end of a mover's motion.
template <class S> struct MotionCut {
  Unit<S> fraction;  // [1]
  Pose<S> pose;      // of the centre of mass
  // The end of a part's middle, which is stopped alone.
  Unit<S> fraction_of_middle;  // [1]
  Vec3<S> middle, place;       // [m] in the body's frame, and in the world where it is stopped
  Vec3<Unit<S>> normal;        // [1] where it may not go on; zero: where a kinematic body stops it

  ISO_INLINE bool stops_middle() const { return fraction_of_middle < fraction; }
  ISO_INLINE bool is_before(Unit<S> other) const { return fraction < other || fraction_of_middle < other; }
};

}  // namespace isostep
