// StepSolver<S>: the solver that the settings name, and what a step gives it.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/events.hpp"
#include "isostep/systems/contacts/step_tools.hpp"
#include "isostep/systems/forces/body_forces.hpp"
#include "isostep/systems/mechanisms/mechanisms.hpp"
#include "isostep/world/solvers.hpp"

namespace isostep {

/// Input:   the state, the geometry of its contacts, the contacts that rotating bodies carry.
/// Output:  a StepContext for the calls of rigid_solver.hpp, which move the awake bodies and store impulses in contacts
///          and joints; the impulse of each contact over the whole step.
/// Keeps:   nothing from step to step but memory.
template <class S> class StepSolver {
 public:
  StepSolver(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies);

  /// Takes the forces that commands left in the state, and finds the couplings and vehicles that act on bodies.
  ISO_INLINE void take_forces() {
    forces_.begin_step();
    mechanisms_.begin_step();
  }
  /// Reports cut forces and stores the state of mechanisms, after the last sub-step.
  ISO_INLINE void report_forces(StepReport& report) {
    forces_.end_step(report);
    mechanisms_.end_step();
  }
  /// `watched`: an observer or trace reads the state between the stages.
  StepContext<S> context(std::span<const ContactGeometry<S>> geometry, std::span<const Carried<S>> carried,
                         std::span<const ContactResponse<S>> responses, std::span<JointImpulse<S>> joint_impulses,
                         const StepTools<S>& tools, bool watched);
  /// Calls visit(solver) with the solver of the settings.
  template <class Visit> void with_solver(Visit&& visit) {
    isostep::with_solver(solvers_, state_.settings.solver, static_cast<Visit&&>(visit));
  }
  /// One per awake body, or empty: see BodyForces::pulls.
  ISO_INLINE std::span<const Acceleration<S>> pulls() const { return forces_.pulls(); }
  /// [m/s] Parallel to the contacts: the impulse of each over the whole step.
  ISO_INLINE std::span<const Velocity<S>> impulses() const { return impulses_; }
  /// Parallel to the awake bodies: 1 if the solver cut the body's turn to what one integration step allows.
  ISO_INLINE std::span<const std::uint8_t> cut() const { return cut_; }

  template <class Visit> void visit_forces(const Visit& visit) { forces_.visit_scratch(visit); }
  template <class Visit> void visit_impulses(const Visit& visit) { visit("step_impulses", impulses_); }
  template <class Visit>
  void visit_solver(const Visit& visit, SolverStage stage, std::span<const ContactGeometry<S>> geometry) {
    StepContext<S> context = {};
    context.properties = state_.awake.properties;
    context.contacts = state_.contacts;
    context.geometry = geometry;
    with_solver([&](auto& solver) { solver.visit_scratch(visit, stage, context); });
  }

 private:
  void list_axis_drives();
  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Solvers<S> solvers_;
  BodyForces<S> forces_;
  Mechanisms<S> mechanisms_;
  std::vector<JointEnds<S>> joint_ends_;
  std::vector<JointAxisDrive<S>> axis_drives_, sorted_drives_;
  std::vector<Velocity<S>> impulses_;
  std::vector<std::uint8_t> cut_;
};

#define ISO_STEP_SOLVER_OF(extern, S) extern template class StepSolver<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_STEP_SOLVER_OF)

}  // namespace isostep
