// VehicleRows<S>: rows of the wheels of vehicles, between their bodies and the ground, which solvers solve.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/systems/vehicle/drive_train.hpp"
#include "isostep/systems/vehicle/step_wheels.hpp"
#include "isostep/systems/vehicle/suspension_rows.hpp"
#include "isostep/systems/vehicle/wheel_ground.hpp"
#include "isostep/systems/vehicle/wheel_tracks.hpp"

namespace isostep {

/// Input:   wheels and vehicles, the bodies in every sub-step; the broad phase, for the ground below each wheel: once a
///          step, and in every sub-step if it is not one plane as far as the wheel gets in the step.
/// Output:  velocities of awake bodies and their ground; the states of wheels and vehicles.
/// Keeps:   nothing from step to step but memory: the states hold the impulses of rows.
/// Order:   that of StepWheels. Each sweep solves every wheel once, so that bodies which stand on one another converge
///          too: the first wheels of all bodies, then the second, and so on. Wheels of one body wait for each other's
///          results, those of two bodies do not.
template <class S> class VehicleRows {
 public:
  ISO_INLINE VehicleRows(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
      : state_(state),
        wheels_(state, map),
        ground_(state, map, proxies, wheels_),
        tracks_(state, wheels_),
        train_(state, wheels_, tracks_),
        suspension_(state, wheels_, tracks_) {}
  VehicleRows(const VehicleRows&) = delete;  // its parts know each other
  VehicleRows& operator=(const VehicleRows&) = delete;

  /// Lists wheels and finds their ground.
  void begin_step();
  /// Returns true if begin_step() found wheels of awake bodies.
  ISO_INLINE bool any() const { return !wheels_.runs().empty(); }
  /// Calls visit(row) for bodies with wheels, and for the bodies they stand on.
  template <class Visit> ISO_INLINE void for_each_row(const Visit& visit) const {
    for (const Run& run : wheels_.runs()) {
      visit(run.row);
      visit(run.ground);
    }
  }
  // As MechanismCalls has them.
  void place(SolverBodies<S>& bodies, std::int32_t rate);
  void solve(int sweeps);
  void relax();
  void end();
  /// Writes the states of the records.
  void end_step();

 private:
  using V = Velocity<S>;
  using Run = WheelRun<S>;
  using Group = WheelGroup<S>;

  bool closes_errors(const Group& group);
  void sweep(bool relaxes);
  void write(const Run& run);

  WorldState<S>& state_;
  StepWheels<S> wheels_;
  WheelGround<S> ground_;
  WheelTracks<S> tracks_;
  DriveTrain<S> train_;
  SuspensionRows<S> suspension_;
};

#define ISO_VEHICLE_ROWS_OF(extern, S) extern template class VehicleRows<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_VEHICLE_ROWS_OF)

}  // namespace isostep
