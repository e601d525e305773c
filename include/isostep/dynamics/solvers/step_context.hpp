// What every rigid solver is given, and the order in which a step calls it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/task_runner.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/carrying.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/joints/joint.hpp"
#include "isostep/dynamics/joints/tree_kernels.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/dynamics/solvers/solver_name.hpp"
#include "isostep/geometry/limits.hpp"

namespace isostep {

/// Acceleration asked for by forces, for this step alone.
template <class S> struct Acceleration {
  Vec3<S> linear;   // [m/s^2]
  Vec3<S> angular;  // [rad/s^2]

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("linear", self.linear);
    visit("angular", self.angular);
  }
};

/// No body turns by more than a radian about an axis in a step of integration [rad/s]: beyond, a turn is no longer
/// small.
template <class S> ISO_INLINE constexpr Velocity<S> spin_limit(std::int32_t rate) {
  return convert<Velocity<S>>(min(Limits<S>::spin(), S(rate)));
}

/// Awake bodies in order, the contacts between them and their joints in canonical order.
template <class S> struct SolverInput {
  std::span<BodyState<S>> states;
  std::span<const BodyProperties<S>> properties;
  std::span<const Acceleration<S>> accelerations;  // per body, or empty
  std::span<Contact<S>> contacts;
  std::span<const ContactGeometry<S>> geometry;
  std::span<Velocity<S>> step_impulses;  // [m/s] per contact, of the whole step: filled by store_impulses
  std::span<JointConstraint<S>> joints;  // prepared
  Vec3<S> gravity;                       // [m/s^2]
  std::int32_t hz;                       // [1/s] steps
  std::int32_t substeps;                 // as the solver counts them: solver_name.hpp
  TaskRunner runner;                     // changes no bit
  const ContactKernels<S>* contact_kernels;
  const TreeKernels<S>* tree_kernels;
  std::span<const Carried<S>> carried = {};  // ascending by contact
};

// A solver is a class template with these members, called once each a step in this order. Those from `prepare` on may
// put off what they do until `run`, which may be called after each of them or once in the end. A solver keeps nothing
// from step to step but memory: what it has to remember are the impulses of contacts and joints.
//
//   void gather_bodies(const SolverInput<S>&);       masses are needed to prepare joints, which the caller does next
//   SolverBodies<S>& bodies();
//   void colour_constraints(const SolverInput<S>&);  decides in which order everything is solved
//   void prepare(const SolverInput<S>&);
//   void solve_substeps(const SolverInput<S>&);      moves input.states
//   void restitute(const SolverInput<S>&);
//   void store_impulses(const SolverInput<S>&);      into input.contacts, step_impulses, joints, states' velocities
//   void run(const SolverInput<S>&);
//   std::uint32_t unsolved() const;                  islands of this step that it left before they were solved
//   void visit_scratch(const Visit&, SolverStage, const SolverInput<S>&);   what this stage left for the next ones, by
//                                                                           name: state/leaves.hpp

enum class SolverStage : std::uint32_t { colour, prepare, solve, restitute, store };

namespace detail {
template <class S> inline constexpr Velocity<S> kPushSpeed = Velocity<S>(3);  // [m/s] overlap ends no faster
/// [m/s] Slower ones do not bounce. Of a gas at restitution 1 glancing blows below it lose their energy.
template <class S> inline constexpr Velocity<S> kRestitutionSpeed = Velocity<S>(0.25);
}  // namespace detail

}  // namespace isostep
