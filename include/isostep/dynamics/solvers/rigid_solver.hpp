// The concept of a rigid solver: the calls of one step, in their order.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>

#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// A solver keeps only memory from step to step; the impulses of contacts and joints, which it starts from, are in the
/// state. A step makes each call once, in this order, with one context. A solver may put off the work of a call to a
/// later one, so that threads are woken once, unless the context is watched.
/// `visit_scratch(visit, stage, context)`, for tools only, visits what a stage left for the next ones: fields.hpp.
template <class Solver, class S>
concept RigidSolver = requires(Solver solver, const Solver& solved, const StepContext<S>& context) {
  solver.colour_constraints(context);  // takes bodies and joints over; decides in which order everything is solved
  solver.prepare(context);
  solver.solve_substeps(context);  // moves context.states
  solver.store_impulses(context);  // into contacts, step_impulses, joint_states and the velocities of states
  { solved.unsolved() } -> std::same_as<std::uint32_t>;  // islands of this step that it left before they were solved
};

}  // namespace isostep
