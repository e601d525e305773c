// The rigid solvers by name: the closed list that settings, scene files and the tool speak of.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "isostep/core/book.hpp"
#include "isostep/scalar/platform.hpp"

/// ISO_FOR_EACH_SOLVER(X) expands X(name): in SolverName, in scene files and on the command line;
/// ISO_FOR_EACH_BUILT_SOLVER(X) for those that this build holds: of the member of Solvers. What `substeps` means to
/// each; h is the length of what it integrates at once:
///   soft_step    so many sub-steps, in each one pass over contacts as springs; joints in trees, solved at once
///   pgs          one step of h = 1 / hz, and so many passes: projected Gauss-Seidel, errors closed by Baumgarte's term
///   worst_first  so many sub-steps, each resolved the worst contact first: velocities, then positions (Millington)
///   direct       so many sub-steps, each island solved simultaneously by pivoting
#define ISO_SOLVERS(X, BOOK) X(soft_step) X(pgs) BOOK(worst_first) X(direct)
#define ISO_FOR_EACH_SOLVER(X) ISO_SOLVERS(X, X)
#define ISO_FOR_EACH_BUILT_SOLVER(X) ISO_SOLVERS(X, ISO_BUILT_BOOK(X))

namespace isostep {

#define ISO_ENUMERATOR(name) name,
enum class SolverName : std::uint32_t { ISO_FOR_EACH_SOLVER(ISO_ENUMERATOR) };
#undef ISO_ENUMERATOR

#define ISO_NAME(name) #name,
inline constexpr const char* kSolverNames[] = {ISO_FOR_EACH_SOLVER(ISO_NAME)};
#undef ISO_NAME
inline constexpr std::uint32_t kSolvers = sizeof kSolverNames / sizeof kSolverNames[0];

ISO_INLINE std::optional<SolverName> solver_named(std::string_view name) {
  for (std::uint32_t i = 0; i < kSolvers; ++i) {
    if (name == kSolverNames[i]) return static_cast<SolverName>(i);
  }
  return std::nullopt;
}

/// The expectation of a fault, for a solver that the build leaves out; null for any other value: core/book.hpp.
ISO_INLINE constexpr const char* expected_instead_of(SolverName solver) {
  constexpr const char* kExpected[] = {ISO_SOLVERS(ISO_NOT_LEFT_OUT, ISO_LEFT_OUT)};
  const auto index = static_cast<std::uint32_t>(solver);
  return index < kSolvers ? kExpected[index] : nullptr;
}

/// The solver's `substeps` are passes over one step of integration.
ISO_INLINE constexpr bool counts_passes(SolverName solver) { return solver == SolverName::pgs; }
/// Steps of integration a second, for `substeps` of a world's `hz`.
ISO_INLINE constexpr std::int32_t integration_rate(SolverName solver, std::int32_t hz, std::int32_t substeps) {
  return counts_passes(solver) ? hz : hz * substeps;
}

}  // namespace isostep
