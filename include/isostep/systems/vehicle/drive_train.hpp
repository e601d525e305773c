// DriveTrain<S>: engine, clutch, gears, differential and brakes: what turns wheels but the ground.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/vehicle/step_wheels.hpp"
#include "isostep/systems/vehicle/wheel_tracks.hpp"

namespace isostep {

/// Input:   the records and inputs of vehicles, the wheels of a step, joined to tracks.
/// Output:  rim speeds and brakes of leading wheels, in every sub-step; the states of vehicles.
/// Keeps:   nothing: the group holds the engine of a step.
template <class S> class DriveTrain {
 public:
  using V = Velocity<S>;
  using Run = WheelRun<S>;
  using Group = WheelGroup<S>;

  ISO_INLINE DriveTrain(WorldState<S>& state, StepWheels<S>& wheels, const WheelTracks<S>& tracks)
      : state_(state), wheels_(wheels), tracks_(tracks) {}

  /// Sets the gear ratio from the engine's shaft to each wheel and track.
  void gear_up(Group& group);
  /// Applies engine torque to the driven wheels, or to an engine with inertia, and sets brakes. Once a sub-step.
  void drive(Group& group);
  /// Locks the differential: removes a part of the speed differences of driven wheels and tracks. The torque acts
  /// between them, so they keep their common angular momentum, except for what steering gears otherwise.
  void lock(const Group& group);
  /// Applies the torque that ends the clutch's slip, or the most that the clutch bears.
  void engage(Group& group);
  /// Writes the states of engines.
  void end_step();

 private:
  using Engine = ClutchedEngine<S>;
  /// The shaft that the wheels turn: that of the engine, or the clutch's disc.
  struct Shaft {
    S speed;  // [rad/s]
    S give;   // [1/(kg m^2)] its change by a unit of angular impulse
  };

  S side_of(const Run& run, const Group& group) const;
  void begin_engine(Group& group) const;
  void turn(const Run& run, V& rim, S torque) const;
  void set_brakes(const Group& group);
  template <class Rim> Shaft shaft_of(const Group& group, const Rim& rim_of) const;
  S engine_torque(const Group& group, const Shaft& shaft) const;
  void push_shaft(const Group& group, S torque);
  // Of an engine with inertia.
  S spun(const Engine& engine, S speed, S torque) const;
  void turn_engine(Group& group);
  void bear(Group& group, S torque);

  WorldState<S>& state_;
  StepWheels<S>& wheels_;
  const WheelTracks<S>& tracks_;
};

}  // namespace isostep
