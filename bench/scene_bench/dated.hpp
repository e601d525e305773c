// Figures of engines that this program does not run, from one earlier run of all engines on one machine.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace isostep::bench {

/// The engine that is measured here and was measured then: times of others are scaled by how much slower or faster it
/// is today.
inline constexpr const char* kAnchor = "rapier-simd";

inline constexpr const char* kDatedEngines[] = {"box3d", "jolt-native"};

struct Dated {
  double ms;     // [ms] CPU time of a step, float, one thread; S8: with everybody asleep
  bool lost;     // the scene fell, or fell apart
  double error;  // [m] the scene's error, as the chart shows it; less than 0: not known
};
/// The figures of kDatedEngines and kAnchor; nothing where it was not measured.
std::optional<Dated> dated(std::string_view engine, std::string_view scene);

}  // namespace isostep::bench
