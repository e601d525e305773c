// The settings that a world is made with.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/projection.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// [1/s] The fewest and the most steps a second.
inline constexpr std::int32_t kLeastHz = 10, kMostHz = 10000;
/// The most sub-steps a second. Every scalar can count them and divide by them: Q16.16 ends at 32767, and solvers
/// multiply the rate by angles below two.
inline constexpr std::int32_t kMaxRate = 16384;

/// The least and the largest budget of pairs. The largest needs some 20 GB in float.
inline constexpr std::int32_t kLeastPairs = 64, kMostPairs = 1 << 24;

/// The settings of a world. Rates are whole numbers, so the time step is exact and equal on every machine.
template <class S> struct Settings {
  std::int32_t hz = 60;                    // [1/s] steps, 10..10000
  std::int32_t substeps = 8;               // per step, 1..64, hz * substeps <= kMaxRate; of pgs: passes
  Vec3<S> gravity = {S(0), S(-10), S(0)};  // [m/s^2]
  bool allow_sleep = true;
  SolverName solver = SolverName::soft_step;
  std::uint32_t id_space = 0;  // 0..255, in every id: worlds of one game with spaces of their own refuse each other's
  /// [1] kLeastPairs..kMostPairs: the most pairs of bodies with overlapping boxes that a step handles. Each takes up to
  /// 2 kB and some microseconds. A heap of equal bodies has eight a body: the default suffices for 65 000 awake bodies,
  /// more than a core steps in real time. Beyond it a step leaves out pairs, last those that hold bodies up, and
  /// reports StepReport::crowded (crowd.hpp). Of compounds' parts twice as many collide: StepReport::cut_compounds.
  std::int32_t most_pairs = 1 << 19;
  Projection projection = Projection::nonlinear;  // of worst_first; other solvers take any and use none
  /// [m/s] 0..Limits::speed(): bodies that meet more slowly do not bounce. Without it, rest is a rain of small bounces.
  /// Bodies that nothing presses together bounce above a sixteenth of it.
  S restitution_threshold = S(0.25);

  friend bool operator==(const Settings&, const Settings&) = default;
  ISO_FIELDS(hz, substeps, gravity, allow_sleep, solver, id_space, most_pairs, projection, restitution_threshold)
};

/// [1/s] Returns the rate of sub-steps, or of passes of pgs, which limits the frequencies of springs.
template <class S> ISO_INLINE constexpr std::int32_t substep_rate(const Settings<S>& settings) {
  return settings.hz * settings.substeps;
}

}  // namespace isostep
