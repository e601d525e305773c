// WorstFirstStep: the book's two ways. Worst-first resolution between the velocities and the positions of a sub-step,
// and time division, which ends a sub-step's first part where the next contact comes about.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/solvers/worst_first.hpp"
#include "isostep/particles/step/integration.hpp"
#include "isostep/particles/step/rows.hpp"

namespace isostep {

/// Looks at rows that one step may take [1] where settings name none: a fifth of a second, and 2048 a particle, of
/// which a pile takes 1200 in four sub-steps.
ISO_INLINE constexpr std::uint64_t iteration_budget(std::uint32_t asked, std::uint64_t particles) {
  return asked != 0 ? asked : (std::uint64_t{1} << 22) + 2048 * particles;
}

/// Contacts that one sub-step is divided by, at most: two particles between two walls that close in on them meet
/// without end.
inline constexpr std::uint32_t kMostDivisions = 64;

/// Source:  Millington 2007, ch. 7 (WorstFirst), 7.4.2 (time division).
/// Differs: between contacts particles move in straight lines, the sub-step's way. What touches already is resolved as
///          the sub-step begins; cables and rods are, whenever anything is.
template <class S> class WorstFirstStep {
 public:
  using V = Velocity<S>;
  using U = Unit<S>;
  using Row = ParticleConstraint<S>;

  WorstFirstStep(ParticleState<S>& state, ParticleStep<S>& step, ParticleRows<S>& rows,
                 ParticleIntegration<S>& integration);

  void begin_step();
  /// Integrates, and holds the rows.
  void solve_substep();

 private:
  void integrate_velocities();
  void note_gained();
  void resolve();
  void place_rows();
  void resolve_rows();
  void pay_for_ways();
  ISO_INLINE bool is_touching(const Row& row) const;
  void spend(std::uint64_t looks);

  // Time division.
  void divide_way();
  void turn_ways(U left);
  U time_to(const Row& row) const;
  bool find_next_contact(U& when);
  void travel(U share);

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  ParticleRows<S>& rows_;
  ParticleIntegration<S>& integration_;
  WorstFirst<S> resolver_;
  std::uint64_t looks_left_ = 0;  // of the step's
  Axes<V> start_;                 // [m] displacement where the sub-step began
  Axes<V> before_;                // [m/s] velocity before constraints
  Axes<V> gained_;                // [m/s] speed that forces added in the sub-step
  Axes<V> way_;                   // [m] of the sub-step, if nothing is met
};

#define ISO_WORST_FIRST_STEP_OF(extern, S) extern template class WorstFirstStep<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_WORST_FIRST_STEP_OF)

}  // namespace isostep
