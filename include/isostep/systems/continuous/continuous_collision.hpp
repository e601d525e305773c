// ContinuousCollision<S>: fast bodies do not pass what a step would carry them through.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/instantiate.hpp"
#include "isostep/systems/continuous/stopped_mechanisms.hpp"

namespace isostep {

/// Input:   the state after the solver, with fat boxes; the centres' poses as the step began; the pairs of bodies that
///          joints keep from colliding.
/// Output:  poses of fast bodies that would have tunnelled, put back to their first touch, with their fat boxes and
///          proxies. Velocities stay: the next step finds the contact.
/// Keeps:   nothing but memory.
/// Method:  1. Dynamic bodies that move by more than half of the inner radii of their part and of the other one (which
///             counts as 1 m at most) are swept against static and kinematic bodies, with rotation. So are bodies in
///             the way of a fast kinematic body. Contacts push slower bodies out the way that they came: those are
///             swept only if they end deeper than kTooDeep inside a fixed body.
///          2. Bullets are swept against the resulting motions of other dynamic bodies except bullets, if they move
///             against each other by more than half the bullet's inner radius. A stopped bullet goes on with its
///             stopper to the end of the step, up to fixed bodies. No sweep reads what others write: any order will do.
///          3. Mechanisms with a stopped body stop as a whole (StoppedMechanisms).
/// Parts:   StepMotion measures motions, ImpactFilter knows what passes a body, PairSweep sweeps one against another,
///          FastBodies finds movers, FirstImpacts where one ends, StoppedBodies puts it there. Each knows those before.
/// Limits:  two bodies may squeeze a third.
template <class S> class ContinuousCollision {
 public:
  ISO_INLINE ContinuousCollision(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies)
      : motion_(state, map),
        filter_(state, map),
        pairs_(state, map, motion_, filter_),
        fast_(state, map, proxies, motion_, pairs_),
        impacts_(map, proxies, motion_, filter_, pairs_, fast_),
        bodies_(state, map, proxies),
        mechanisms_(state, map, motion_, fast_, impacts_, bodies_) {}
  ContinuousCollision(const ContinuousCollision&) = delete;  // its parts know each other
  ContinuousCollision& operator=(const ContinuousCollision&) = delete;

  void update(std::span<const Pose<S>> start, std::span<const std::uint64_t> joined, const ImpactRules<S>& rules = {});

 private:
  void cut(Mover<S>& mover, bool moving);
  void cut_bullet(Mover<S>& mover);
  void stop_at_what_is_fixed(std::uint32_t index, const Pose<S>& from);

  StepMotion<S> motion_;
  ImpactFilter<S> filter_;
  PairSweep<S> pairs_;
  FastBodies<S> fast_;
  FirstImpacts<S> impacts_;
  StoppedBodies<S> bodies_;
  StoppedMechanisms<S> mechanisms_;
};

#define ISO_CONTINUOUS_COLLISION_OF(extern, S) extern template class ContinuousCollision<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CONTINUOUS_COLLISION_OF)

}  // namespace isostep
