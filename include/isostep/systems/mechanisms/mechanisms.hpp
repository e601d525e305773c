// Mechanisms<S>: wheels and couplings as one set of rows, which a solver solves beside joints and contacts.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/systems/mechanisms/coupling_rows.hpp"
#include "isostep/systems/vehicle/vehicle_rows.hpp"

namespace isostep {

/// Input:   the records of wheels, vehicles and couplings, the bodies in every sub-step; the broad phase, for the
///          ground below wheels.
/// Output:  the rows of a StepContext; the states of those records.
/// Keeps:   nothing from step to step but memory.
/// Order:   wheels, couplings.
template <class S> class Mechanisms {
 public:
  ISO_INLINE Mechanisms(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
      : state_(state), map_(map), wheels_(state, map, proxies), couplings_(state, map) {}
  Mechanisms(const Mechanisms&) = delete;  // solvers hold its address
  Mechanisms& operator=(const Mechanisms&) = delete;

  void begin_step();
  /// Returns the rows of the step. Empty if no awake body has wheels or a coupling.
  MechanismRows<S> rows();
  /// Writes the states of the records.
  void end_step();

 private:
  static ISO_INLINE Mechanisms& of(void* mechanisms) { return *static_cast<Mechanisms*>(mechanisms); }
  static void place(void* mechanisms, SolverBodies<S>& bodies, std::int32_t rate);
  static void solve(void* mechanisms, SolverBodies<S>& bodies, int sweeps);
  static void close(void* mechanisms, SolverBodies<S>& bodies);
  static void relax(void* mechanisms, SolverBodies<S>& bodies);
  static void end(void* mechanisms);

  void list_bodies();
  void keep_in_range(SolverBodies<S>& bodies) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  VehicleRows<S> wheels_;
  CouplingRows<S> couplings_;
  std::vector<std::uint8_t> listed_;   // by row
  std::vector<std::uint32_t> bodies_;  // rows that they may push
  std::vector<Velocity<S>> fastest_;   // [rad/s] of those
};

#define ISO_MECHANISMS_OF(extern, S) extern template class Mechanisms<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_MECHANISMS_OF)

}  // namespace isostep
