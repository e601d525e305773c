// DriveTrain<S>: engine, clutch, gears, differential and brakes: what turns wheels but the ground.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/vehicle/step_wheels.hpp"
#include "isostep/systems/vehicle/wheel_tracks.hpp"

namespace isostep {

/// Input:   the records and inputs of vehicles, the wheels of a step, joined to tracks.
/// Output:  spins and brakes of wheels that lead, in every sub-step; the states of vehicles.
/// Keeps:   nothing: an engine in a step is of its group.
template <class S> class DriveTrain {
 public:
  using V = Velocity<S>;
  using Run = WheelRun<S>;
  using Group = WheelGroup<S>;

  ISO_INLINE DriveTrain(WorldState<S>& state, StepWheels<S>& wheels, const WheelTracks<S>& tracks)
      : state_(state), wheels_(wheels), tracks_(tracks) {}

  /// How many turns of the engine's shaft each wheel's and track's is.
  void gear_up(Group& group);
  /// Torque on the driven wheels or on the engine, and brakes: once in a sub-step.
  void drive(Group& group);
  /// Takes of the differences in speed of driven wheels and tracks; the torque that does it acts between them, and what
  /// steering does not gear otherwise keeps what it turns with together.
  void lock(const Group& group);
  /// The torque that ends the clutch's slip, or the most that it bears against that.
  void engage(Group& group);
  /// Writes what engines do.
  void end_step();

 private:
  using Engine = ClutchedEngine<S>;
  /// What the wheels turn: the shaft of the engine, or the clutch's disc.
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
