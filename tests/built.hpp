// The methods that this build holds, for tests that go through all of a list (ISOSTEP_BOOK leaves out the book's).
// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <iterator>
#include <vector>

#include "isostep/collision/broadphase/broad_phase_name.hpp"
#include "isostep/dynamics/solver_name.hpp"

namespace isostep::test {

#define ISO_NAMED(name) SolverName::name,
inline constexpr SolverName kBuiltSolvers[] = {ISO_FOR_EACH_BUILT_SOLVER(ISO_NAMED)};
#undef ISO_NAMED
#define ISO_NAMED(name, Structure) BroadPhaseName::name,
inline constexpr BroadPhaseName kBuiltBroadPhases[] = {ISO_FOR_EACH_BUILT_BROAD_PHASE(ISO_NAMED)};
#undef ISO_NAMED

inline constexpr bool kHasBook = std::size(kBuiltSolvers) == kSolvers;

/// Those of `all` that the build holds.
inline std::vector<SolverName> built(std::initializer_list<SolverName> all) {
  std::vector<SolverName> here;
  for (const SolverName solver : all) {
    if (left_out(solver) == nullptr) here.push_back(solver);
  }
  return here;
}

/// Returns the solvers that the build holds, without `others`.
inline std::vector<SolverName> all_but(std::initializer_list<SolverName> others) {
  std::vector<SolverName> rest;
  for (const SolverName solver : kBuiltSolvers) {
    bool is_other = false;
    for (const SolverName other : others) is_other = is_other || solver == other;
    if (!is_other) rest.push_back(solver);
  }
  return rest;
}

}  // namespace isostep::test

/// It stands first in a test of the book's methods: skips it where they are left out, and says so.
#define ISO_NEEDS_BOOK() \
  if (const char* why = ::isostep::left_out(::isostep::SolverName::worst_first)) GTEST_SKIP() << why
