// The settings that a world is made with.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/projection.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// Sub-steps a second that every scalar can count and divide by: Q16.16 ends at 32767, and solvers multiply the rate by
/// angles below two.
inline constexpr std::int32_t kMaxRate = 16384;

/// Budgets of pairs that a world takes: the most needs some 20 GB in float.
inline constexpr std::int32_t kLeastPairs = 64, kMostPairs = 1 << 24;

/// Rates are whole numbers, so that the time step is exact and the same everywhere.
template <class S> struct Settings {
  std::int32_t hz = 60;                    // [1/s] steps, 10..1000
  std::int32_t substeps = 8;               // per step, 1..64, hz * substeps <= kMaxRate; of pgs: passes
  Vec3<S> gravity = {S(0), S(-10), S(0)};  // [m/s^2]
  bool allow_sleep = true;
  SolverName solver = SolverName::soft_step;
  std::uint32_t id_space = 0;  // 0..255, in every id: worlds of one game with spaces of their own refuse each other's
  /// [1] kLeastPairs..kMostPairs: pairs of bodies whose boxes meet that a step looks at. Each takes up to 2 kB and some
  /// microseconds; a heap of equal bodies has eight a body, so the default is met by 65 000 of them awake at once, more
  /// than a core steps in real time. Beyond it a step leaves out pairs, those last that hold bodies up, and reports
  /// StepReport::crowded (crowd.hpp). Twice as many pairs of compounds' parts are collided, StepReport::cut_compounds.
  std::int32_t most_pairs = 1 << 19;
  Projection projection = Projection::nonlinear;  // of worst_first; other solvers take any and use none
  /// [m/s] 0..Limits::speed(): bodies that meet more slowly do not bounce. Rest is a rain of small bounces without it;
  /// bodies that nothing presses together bounce above a sixteenth of it.
  S restitution_threshold = S(0.25);

  friend bool operator==(const Settings&, const Settings&) = default;
  ISO_FIELDS(hz, substeps, gravity, allow_sleep, solver, id_space, most_pairs, projection, restitution_threshold)
};

/// [1/s] The rate of sub-steps, or of passes of pgs: the frequencies of springs are measured by it.
template <class S> ISO_INLINE constexpr std::int32_t substep_rate(const Settings<S>& settings) {
  return settings.hz * settings.substeps;
}

}  // namespace isostep
