// FirstImpacts<S>: where a mover first meets what would stop it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/systems/continuous/fast_bodies.hpp"

namespace isostep {

/// Input:   a mover; the broad phase and FastBodies, which know what is in its way.
/// Output:  the end of its motion: the earliest of all impacts. Ties go to the lowest slot, then part.
/// Keeps:   nothing but memory.
/// Touch:   a body that touches an obstacle at the start is swept as a smaller one, deeper inside it: an impact at time
///          0 must not let the rest of the body pass. Contacts less deep than the first one are not cut. A body that
///          slips deeper where it was stopped goes on: see free_way().
template <class S> class FirstImpacts {
 public:
  ISO_INLINE FirstImpacts(const BodyMap<S>& map, const Proxies<S>& proxies, const StepMotion<S>& motion,
                          const ImpactFilter<S>& filter, const PairSweep<S>& pairs, const FastBodies<S>& fast)
      : map_(map), proxies_(proxies), motion_(motion), filter_(filter), pairs_(pairs), fast_(fast) {}

  /// `moving`: finds impacts with dynamic bodies except bullets, otherwise with static and kinematic bodies.
  MotionCut<S> find(Mover<S>& mover, bool moving);

 private:
  void find_obstacles(const Mover<S>& mover, bool moving);
  MotionCut<S> sweep(const Mover<S>& mover) const;
  bool find_touch(Mover<S>& mover) const;

  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  const StepMotion<S>& motion_;
  const ImpactFilter<S>& filter_;
  const PairSweep<S>& pairs_;
  const FastBodies<S>& fast_;
  std::vector<std::uint32_t> obstacles_, sort_scratch_;  // slots, ascending
};

}  // namespace isostep
