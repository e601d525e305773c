// The rigid solvers as a world has them: one of each, of which it uses the one that its settings name.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/direct.hpp"
#include "isostep/dynamics/solvers/sequential.hpp"
#include "isostep/dynamics/solvers/solver_name.hpp"
#include "isostep/dynamics/solvers/worst_first.hpp"

namespace isostep {

/// Those that are never used hold no memory.
template <class S> struct Solvers {
  Sequential<S> soft_step = Sequential<S>(soft_step_schedule<S>);
  Sequential<S> pgs = Sequential<S>(pgs_schedule<S>);
  WorstFirstResolver<S> worst_first;
  DirectSolver<S> direct;
};

/// visit(the solver of that name)
template <class S, class Visit> void with_solver(Solvers<S>& solvers, SolverName name, Visit&& visit) {
  switch (name) {
    case SolverName::soft_step: return visit(solvers.soft_step);
    case SolverName::pgs: return visit(solvers.pgs);
    case SolverName::worst_first: return visit(solvers.worst_first);
    case SolverName::direct: return visit(solvers.direct);
  }
}

}  // namespace isostep
