// The solvers of whole islands for every shipped scalar, and their systems for the two numbers that those are written
// in.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/island_solver.inl"

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/admm.inl"
#include "isostep/dynamics/solvers/avbd.inl"
#include "isostep/dynamics/solvers/island_system.inl"
#include "isostep/dynamics/solvers/pivoting.inl"

namespace isostep {

#define ISO_INSTANTIATE(N)          \
  template class IslandSystem<N>;   \
  template class PivotingSystem<N>; \
  template class AvbdSystem<N>;     \
  template class AdmmSystem<N>;
using Fixed62 = Fixed<std::int64_t, 62>;
ISO_INSTANTIATE(Exact<double>)
ISO_INSTANTIATE(Fixed62)
#undef ISO_INSTANTIATE

#define ISO_INSTANTIATE(S) template class IslandSolver<S>;
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
