// FirstImpacts<S>: where a mover first meets what would stop it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/systems/continuous/fast_bodies.hpp"

namespace isostep {

/// Input:   a mover; the broad phase and the FastBodies, who tell what is in its way.
/// Output:  the end of its motion: the earliest of all impacts; ties go to the lowest slot, then part.
/// Keeps:   nothing but memory.
/// Touch:   a body that touches at the start is swept as a smaller one, deeper inside of it: an impact at time 0 is no
///          reason to let the rest of it pass. Touching less deep than that of the first of them is not cut. What slips
///          deeper where it was stopped goes on: see free_way().
template <class S> class FirstImpacts {
 public:
  ISO_INLINE FirstImpacts(const BodyMap<S>& map, const Proxies<S>& proxies, const StepMotion<S>& motion,
                          const ImpactFilter<S>& filter, const PairSweep<S>& pairs, const FastBodies<S>& fast)
      : map_(map), proxies_(proxies), motion_(motion), filter_(filter), pairs_(pairs), fast_(fast) {}

  /// `moving`: by dynamic bodies that are no bullets; else by static and kinematic ones.
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
