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
/// Output:  poses of fast bodies that would have passed something, put back to where they first touch it, with their
///          fat boxes; the broad phase knows of them. Velocities stay: the next step finds the contact.
/// Keeps:   nothing but memory.
/// Method:  1. Dynamic bodies that move by more than half of the inner radii of their part and of the other one (which
///             counts as 1 m at most) are swept against static and kinematic bodies, turns included; so is what
///             a fast kinematic body meets. Who moves less is pushed out the way that it came, so it is swept only if
///             it ends deep inside of what is fixed: by more than kTooDeep.
///          2. Bullets are swept against the motions that all this left of other dynamic bodies but bullets, if they
///             move against each other by more than half the bullet's inner radius. What one stops goes on with it to
///             the end of the step, up to what is fixed. Nobody reads what another writes, so the order is free.
///          3. Mechanisms of which a body was stopped stop as a whole (StoppedMechanisms).
/// Parts:   StepMotion measures ways, ImpactFilter knows what lets bodies pass, PairSweep sweeps one against another,
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
