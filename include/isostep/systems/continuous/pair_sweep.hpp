// PairSweep<S>: one mover is swept against one other body, part by part.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/impact_filter.hpp"
#include "isostep/systems/continuous/step_motion.hpp"

namespace isostep {

/// Input:   how both bodies move, and the rules by which they pass each other.
/// Output:  the end of the mover's motion, if the other body stops it; where they touch or overlap.
/// Keeps:   nothing.
/// Method:  sweeps pieces of both paths. A sweep against a kinematic body takes place in its frame, and a mover that
///          hits it goes on with it to the end of the step. Contacts push out parts that approach each other by no more
///          than half of both inner radii, the way that they came, unless the mover ends deep.
template <class S> class PairSweep {
 public:
  ISO_INLINE PairSweep(const WorldState<S>& state, const BodyMap<S>& map, const StepMotion<S>& motion,
                       const ImpactFilter<S>& filter)
      : state_(state), map_(map), motion_(motion), filter_(filter) {}

  /// Shortens the cut if the body stops the mover sooner.
  void sweep(const Mover<S>& mover, std::uint32_t slot, MotionCut<S>& cut) const;
  /// Returns true if the mover touches the body, which is at rest, at the start. Sets the mover's centre to that point.
  bool find_touch(Mover<S>& mover, std::uint32_t slot) const;
  /// Returns true if an awake body overlaps a fixed one by more than kTooDeep. `box` contains all of the fixed body.
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
