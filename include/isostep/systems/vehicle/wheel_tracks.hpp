// WheelTracks<S>: wheels that roll as one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/vehicle/step_wheels.hpp"

namespace isostep {

/// Input:   the wheels of a step, and the impulses of their tyres.
/// Output:  the leading wheel of each track: its run has what all of it share; the spin of any wheel in a sub-step.
/// Keeps:   nothing.
template <class S> class WheelTracks {
 public:
  using U = Unit<S>;
  using V = Velocity<S>;
  using Run = WheelRun<S>;
  using Group = WheelGroup<S>;

  ISO_INLINE WheelTracks(const WorldState<S>& state, StepWheels<S>& wheels) : state_(state), wheels_(wheels) {}

  /// Joins the wheels of tracks. The first wheel leads: it has the track's spin, and all its inertia, about its axle.
  void join(const Group& group);
  ISO_INLINE bool leads(const Run& run) const { return &wheels_.runs()[run.leader] == &run; }
  /// Returns the spin as the wheel's own tyre finds it: with the impulses of the other tyres of its track.
  detail::WheelSpin<S> spin_of(const Run& run) const;
  /// [m/s] Returns the speed of the rim after the sub-step.
  V end_of(const Run& run) const;

 private:
  void join(Run& leader, Run& run);

  const WorldState<S>& state_;
  StepWheels<S>& wheels_;
};

}  // namespace isostep
