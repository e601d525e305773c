// ParticleSoftStep: the default solver, damped springs on velocities over sub-steps, then once more without push.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/math/softness.hpp"
#include "isostep/particles/step/integration.hpp"
#include "isostep/particles/step/rows.hpp"

namespace isostep {

/// Source:  Catto 2024, Solver2D: Soft Step; the rigid world's method for what does not turn.
/// Differs: what pushes overlaps of contacts apart is a velocity of its own, which moves particles and is forgotten
///          (split impulses, as in Bullet): in a crowd one pass does not take back what another gave, and overlap would
///          turn into motion.
template <class S> class ParticleSoftStep {
 public:
  using V = Velocity<S>;
  using U = Unit<S>;
  using Row = ParticleConstraint<S>;

  ParticleSoftStep(ParticleState<S>& state, ParticleStep<S>& step, ParticleRows<S>& rows,
                   ParticleIntegration<S>& integration);

  void begin_step();
  /// Integrates, and holds the rows.
  void solve_substep();
  /// Gives back the speed at which contacts and cables met, by their restitution. Called once after the step.
  void apply_restitution();

  template <class Visit> void visit_scratch(const Visit& visit);

 private:
  void warm_start();
  void solve(bool biased);
  ISO_INLINE void solve_normal(Row& row, const Softness<S>& softness, bool biased);
  ISO_INLINE void solve_friction(Row& row);
  ISO_INLINE void push_apart(Row& row);
  ISO_INLINE void note_work(Row& row, V before, V after);
  ISO_INLINE V most_bounce(const Row& row, V speed, V wanted) const;
  void note_meetings();
  ISO_INLINE V meeting_speed(const Row& row, V there) const;

  /// Returns true if a row moves by the shift velocity. A touch does not: other code moves its other side, by velocity.
  static ISO_INLINE bool is_shifted(const Row& row) {
    return row.kind == ConstraintKind::contact && (row.b != kNoParticle || row.other != kNoParticle);
  }

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  ParticleRows<S>& rows_;
  ParticleIntegration<S>& integration_;
  Softness<S> contact_softness_ = Softness<S>::rigid(), link_softness_ = contact_softness_;
  static constexpr Softness<S> rigid_softness_ = Softness<S>::rigid();
  Axes<V> came_;    // [m/s] velocity before forces
  Axes<V> before_;  // [m/s] velocity before constraints
  Axes<V> shift_;   // [m/s] with which overlaps are pushed apart; no velocity that lasts
};

#define ISO_PARTICLE_SOFT_STEP_OF(extern, S) extern template class ParticleSoftStep<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_SOFT_STEP_OF)

}  // namespace isostep
