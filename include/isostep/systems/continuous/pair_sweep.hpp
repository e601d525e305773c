// PairSweep<S>: one mover is swept against one other body, part by part.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/impact_filter.hpp"
#include "isostep/systems/continuous/step_motion.hpp"

namespace isostep {

/// Input:   how both move, and what lets what pass.
/// Output:  where the motion of the mover ends, if the other body stops it; where they touch or overlap.
/// Keeps:   nothing.
/// Method:  in pieces of both paths; against a kinematic body in that one's frame, and what hits it goes on with it to
///          the end of the step. Parts that move against each other by no more than half of the inner radii of both are
///          pushed out the way that they came, unless the mover ends deep.
template <class S> class PairSweep {
 public:
  ISO_INLINE PairSweep(const WorldState<S>& state, const BodyMap<S>& map, const StepMotion<S>& motion,
                       const ImpactFilter<S>& filter)
      : state_(state), map_(map), motion_(motion), filter_(filter) {}

  /// Moves the cut forward to where the body stops the mover, if that is sooner.
  void sweep(const Mover<S>& mover, std::uint32_t slot, MotionCut<S>& cut) const;
  /// Returns true if the mover touches the body, which is at rest, at the start; where is its centre from now on.
  bool find_touch(Mover<S>& mover, std::uint32_t slot) const;
  /// True if an awake body overlaps one that is fixed, all of it inside of `box`, by more than kTooDeep.
  bool is_deep_in(std::uint32_t index, std::uint32_t slot, const Aabb<S>& box) const;

 private:
  void sweep_against_moving(const Mover<S>& mover, std::uint32_t slot, std::size_t index, MotionCut<S>& cut) const;
  void sweep_against_kinematic(const Mover<S>& mover, std::uint32_t slot, std::size_t index, MotionCut<S>& cut) const;
  void sweep_piece(const Mover<S>& mover, PathPiece piece, const CoreMotion<S>& motion, const Obstacle<S>& obstacle,
                   MotionCut<S>& cut) const;
  template <class Visit>
  void visit_parts(std::uint32_t index, const CoreMotion<S>& motion, const Obstacle<S>& obstacle,
                   const Visit& visit) const;
  Obstacle<S> at_rest(std::uint32_t slot, S relative_motion) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const StepMotion<S>& motion_;
  const ImpactFilter<S>& filter_;
};

}  // namespace isostep
