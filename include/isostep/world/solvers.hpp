// The rigid solvers of a world: one of each, of which it uses the one that its settings name.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solver_name.hpp"
#include "isostep/dynamics/solvers/island_solver.hpp"
#include "isostep/dynamics/solvers/rigid_solver.hpp"
#include "isostep/dynamics/solvers/sequential.hpp"
#if !defined(ISOSTEP_NO_BOOK)
#include "isostep/book/worst_first.hpp"
#endif

namespace isostep {

/// Holds one solver for each name of this build. A solver that is never used holds no memory.
template <class S> struct Solvers {
  Sequential<S> soft_step = Sequential<S>(soft_step_schedule<S>);
  Sequential<S> pgs = Sequential<S>(pgs_schedule<S>);
  ISO_IF_BOOK(WorstFirstResolver<S> worst_first;)
  IslandSolver<S> direct = IslandSolver<S>(IslandMethod::pivoting);
  IslandSolver<S> avbd = IslandSolver<S>(IslandMethod::descent);
  IslandSolver<S> admm = IslandSolver<S>(IslandMethod::splitting);
};
#define ISO_HAS(name) all.name;
template <class All>
concept HasEachSolver = requires(All all) {
  ISO_FOR_EACH_BUILT_SOLVER(ISO_HAS)
};
#undef ISO_HAS
static_assert(HasEachSolver<Solvers<float>>, "a solver has no member in Solvers");
#define ISO_IS_SOLVER(name) \
  static_assert(RigidSolver<decltype(Solvers<float>::name), float>, "a solver lacks a call of rigid_solver.hpp");
ISO_FOR_EACH_BUILT_SOLVER(ISO_IS_SOLVER)
#undef ISO_IS_SOLVER

/// Calls visit with the solver of that name.
template <class S, class Visit> void with_solver(Solvers<S>& solvers, SolverName name, Visit&& visit) {
  switch (name) {
#define ISO_CASE(name) \
  case SolverName::name: return visit(solvers.name);
    ISO_FOR_EACH_BUILT_SOLVER(ISO_CASE)
#undef ISO_CASE
    default: break;  // left out: no world has it
  }
}

}  // namespace isostep
