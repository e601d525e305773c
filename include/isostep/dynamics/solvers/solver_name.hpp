// The rigid solvers by name: the closed list that settings, scene files and the tool speak of.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// What `substeps` means to each is said beside it; h is the length of what it integrates at once.
enum class SolverName : std::uint32_t {
  soft_step,    // so many sub-steps, in each one pass over contacts as springs; joints in trees, solved at once
  pgs,          // one step of h = 1 / hz, and so many passes: projected Gauss-Seidel, errors closed by Baumgarte's term
  worst_first,  // so many sub-steps, each resolved the worst contact first: velocities, then positions (Millington)
  direct        // so many sub-steps, each island solved simultaneously by pivoting
};
inline constexpr std::uint32_t kSolvers = 4;
inline constexpr const char* kSolverNames[kSolvers] = {"soft_step", "pgs", "worst_first", "direct"};

/// Steps of integration a second, for `substeps` of a world's `hz`.
ISO_INLINE constexpr std::int32_t integration_rate(SolverName solver, std::int32_t hz, std::int32_t substeps) {
  return solver == SolverName::pgs ? hz : hz * substeps;
}

}  // namespace isostep
