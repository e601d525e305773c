// The printing of differences of two states.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include "state_diff.hpp"

namespace isostep::tool {

inline constexpr std::size_t kShown = 8;  // differences printed

/// `a`: the first of the two states, for the owners' slots.
template <class State> void print(const DiffReport& report, const State& a) {
  for (const Difference& difference : report.kept()) {
    const std::string owner = owner_of(a, difference.path.view());
    std::printf("  %s%s\n", describe(difference).c_str(), owner.empty() ? "" : (" [" + owner + "]").c_str());
  }
  if (report.count() > report.kept().size()) {
    std::printf("  and %llu more\n", static_cast<unsigned long long>(report.count() - report.kept().size()));
  }
}

/// Prints the differences of two whole states. Returns whether there are any.
template <class State> bool print_differences(const State& a, const State& b) {
  DiffReport report(kShown);
  diff_states(a, b, report);
  print(report, a);
  return report.any();
}
}  // namespace isostep::tool
