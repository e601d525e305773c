// The rigid solvers by name: the closed list that settings, scene files and the tool speak of.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "isostep/core/book.hpp"
#include "isostep/scalar/platform.hpp"

/// Expands ISO_FOR_EACH_SOLVER(X) to X(name): in SolverName, in scene files and on the command line;
/// ISO_FOR_EACH_BUILT_SOLVER(X) for the solvers of this build: the members of Solvers. The meaning of `substeps` in
/// each; h is the length of an integration step:
///   soft_step    that many sub-steps, each with one pass over contacts as springs; joints in trees, solved at once
///   pgs          one step of h = 1 / hz, and that many passes: projected Gauss-Seidel, Baumgarte's term closes errors
///   worst_first  that many sub-steps, each resolves the worst contact first: velocities, then positions (Millington)
///   direct       that many sub-steps, each island solved simultaneously by pivoting
///   avbd         that many sub-steps, each with a few passes body by body: augmented vertex block descent
///   admm         that many sub-steps, each island solved simultaneously by splitting
#define ISO_SOLVERS(X, BOOK) X(soft_step) X(pgs) BOOK(worst_first) X(direct) X(avbd) X(admm)
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

/// Returns what a fault expects instead of a solver that the build leaves out. Null for others: core/book.hpp.
ISO_INLINE constexpr const char* expected_instead_of(SolverName solver) {
  constexpr const char* kExpected[] = {ISO_SOLVERS(ISO_NOT_LEFT_OUT, ISO_LEFT_OUT)};
  const auto index = static_cast<std::uint32_t>(solver);
  return index < kSolvers ? kExpected[index] : nullptr;
}

/// Returns true if the solver makes one problem of each island: it then knows only true masses.
ISO_INLINE constexpr bool solves_islands(SolverName solver) {
  return solver == SolverName::direct || solver == SolverName::avbd || solver == SolverName::admm;
}
/// Returns true if the solver's `substeps` are passes over one integration step.
ISO_INLINE constexpr bool counts_passes(SolverName solver) { return solver == SolverName::pgs; }
/// Returns the integration steps a second, for `substeps` of a world's `hz`.
ISO_INLINE constexpr std::int32_t integration_rate(SolverName solver, std::int32_t hz, std::int32_t substeps) {
  return counts_passes(solver) ? hz : hz * substeps;
}

}  // namespace isostep
