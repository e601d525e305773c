// BodyForces<S>: the accelerations that forces give the awake bodies, in every sub-step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/bitset.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/world/body_map.hpp"
#include "isostep/world/events.hpp"
#include "isostep/world/force_bounds.hpp"

namespace isostep {

/// Input:   what commands asked for since the last step, the force records, bodies as a sub-step finds them.
/// Output:  an acceleration for each awake body; the report's clamped_force.
/// Keeps:   nothing from step to step but memory.
/// Order:   what commands asked for, then the records kind by kind (force_list.hpp), each kind ascending by slot.
template <class S> class BodyForces {
 public:
  ISO_INLINE BodyForces(WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  /// Takes what commands left in the state.
  void begin_step();
  /// Bodies of which forces were cut, in any sub-step.
  void end_step(StepReport& report);
  /// By awake body, or empty.
  ISO_INLINE std::span<const Acceleration<S>> accelerations() const { return accelerations_; }
  SubstepForces<S> substeps();

  template <class Visit> void visit_scratch(const Visit& visit) { visit("accelerations", accelerations_); }

 private:
  using U = Unit<S>;
  /// A point of a body, or of the world, as a sub-step finds it.
  struct End {
    std::uint32_t row;  // of SolverBodies; 0: does not move
    Vec3<S> at;         // [m] world
    Vec3<S> arm;        // [m] from the centre of mass
    Vec3<S> velocity;   // [m/s]
  };

  void renew(const SolverBodies<S>& bodies, std::int32_t rate);
  void act(const ForceZone<S>& zone);
  void act(const Attractor<S>& attractor);
  void act(const BodySpring<S>& spring);
  void act(const Thruster<S>& thruster);
  void act(const BuoyancyPoint<S>& buoyancy);
  void act(const BodyDrag<S>& drag);
  void act(const AeroSurface<S>& surface);

  End end_at(BodyId body, Vec3<S> local) const;
  Vec3<S> wind_at(Vec3<S> point) const;
  void accelerate(std::uint32_t row, Vec3<S> acceleration);
  void push(std::uint32_t row, Vec3<S> force, Vec3<S> arm);
  void push(const End& end, Vec3<S> force) { push(end.row, force, end.arm); }
  void note_cut(std::uint32_t row, bool cut);
  bool is_pushed(std::uint32_t row, std::uint32_t mask) const;
  Vec3<S> next_velocity(std::uint32_t row) const;
  Vec3<S> next_angular_velocity(std::uint32_t row) const;
  Mat3<S> give_of(const End& end, const Mat3<U>& axes) const;
  Vec3<S> settled(const End& end, const Mat3<U>& axes, const Mat3<S>& tensor, Vec3<S> velocity) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<Acceleration<S>> asked_, accelerations_;  // by commands; of all
  Bitset cut_;                                          // awake bodies
  std::uint32_t cut_count_ = 0;
  const SolverBodies<S>* bodies_ = nullptr;  // of the sub-step
  std::int32_t rate_ = 1;                    // [1/s] of sub-steps
  Step<S> h_ = {};                           // [s] it takes
};

#define ISO_EXTERN(S) extern template class BodyForces<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
