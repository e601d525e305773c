// SuspensionRows<S>: rows of springs, dampers, anti-roll bars and tyres, between a wheel's body and the ground.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/softness.hpp"
#include "isostep/systems/vehicle/step_wheels.hpp"
#include "isostep/systems/vehicle/wheel_tracks.hpp"

namespace isostep {

/// Input:   the wheels of a step and the ground that they stand on, the bodies in every sub-step.
/// Output:  velocities of bodies and their ground; the results of the sub-step in the runs.
/// Keeps:   the softness of the end of travel in the sub-step.
template <class S> class SuspensionRows {
 public:
  using U = Unit<S>;
  using V = Velocity<S>;
  using Run = WheelRun<S>;

  ISO_INLINE SuspensionRows(const WorldState<S>& state, StepWheels<S>& wheels, const WheelTracks<S>& tracks)
      : state_(state), wheels_(wheels), tracks_(tracks) {}

  void begin_substep();
  /// Places the wheel's middle so that the wheel touches the ground's plane, computes the rows there and warm starts
  /// them from the last sub-step. `turn` is the rotation of the body.
  void place(Run& run, const Mat3<U>& turn);
  /// Returns true if that changed its impulses by more than kSettled. Relaxing pushes nothing out of an end of travel.
  bool solve(Run& run, bool relaxes);
  /// Computes spin and slip. A track's leader goes before its other wheels.
  void end(Run& run) const;

 private:
  using Row = detail::WheelRow<S>;
  static constexpr V kSettled = V(0x1p-7);  // [1] of the load: what changes an impulse by less is the last sweep

  void compress(Run& run, S length) const;
  V speed_of(const Run& run, const Row& row, const MotionRow<V>& body) const;
  V without(const Run& run, const Row& row, V impulse, const MotionRow<V>& body) const;
  void move(const Run& run, const Row& row, MotionRow<V>& body, V impulse);
  void press(Run& run, MotionRow<V>& body, bool relaxes);
  void grip(Run& run, MotionRow<V>& body);
  void roll(Run& run) const;
  S slip_of(const Run& run) const;

  const WorldState<S>& state_;
  StepWheels<S>& wheels_;
  const WheelTracks<S>& tracks_;
  Softness<S> stop_softness_ = Softness<S>::rigid();  // of a strut beyond the end of its travel
};

}  // namespace isostep
