// WheelTracks<S>: wheels that roll as one.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/vehicle/step_wheels.hpp"

namespace isostep {

/// Input:   the wheels of a step, and what their tyres push.
/// Output:  which wheel leads a track: its run has what all of it share; the spin of any wheel in a sub-step.
/// Keeps:   nothing.
template <class S> class WheelTracks {
 public:
  using U = Unit<S>;
  using V = Velocity<S>;
  using Run = WheelRun<S>;
  using Group = WheelGroup<S>;

  ISO_INLINE WheelTracks(const WorldState<S>& state, StepWheels<S>& wheels) : state_(state), wheels_(wheels) {}

  /// The first wheel of each track leads: its spin is that of the track, with the inertia of all as its axle feels it.
  void join(const Group& group);
  ISO_INLINE bool leads(const Run& run) const { return &wheels_.runs()[run.leader] == &run; }
  /// As the wheel's own tyre finds it: with what the other tyres of its track do.
  detail::WheelSpin<S> spin_of(const Run& run) const;
  /// [m/s] Of the rim after the sub-step.
  V end_of(const Run& run) const;

 private:
  void join(Run& leader, Run& run);

  const WorldState<S>& state_;
  StepWheels<S>& wheels_;
};

}  // namespace isostep
