// The systems that a solver of rows draws on, on a state made by hand.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/step/integration.hpp"
#include "isostep/particles/step/rows.hpp"
#include "unit/particles/step_scene.hpp"

namespace isostep {
inline namespace solver_scene {

/// Rows are made by hand; `Solver` is the system under test.
template <class S, template <class> class Solver> struct SolverScene : StepScene<S> {
  FreeFlight<S> flight{this->state, this->step};
  ParticleSprings<S> springs{this->state, this->step};
  StiffSprings<S> stiff_springs{this->state, this->step};
  ParticleForces<S> forces{this->state, this->step, flight, springs};
  ParticleIntegration<S> integration{this->state, this->step, flight, forces, stiff_springs};
  ParticleRows<S> rows{this->state, this->step};
  Solver<S> solver{this->state, this->step, rows, integration};

  /// Adds a contact between two particles, or with collider 0 where `b` is null.
  void add_contact(ParticleId a, ParticleId b, double radius, double restitution, double share_a) {
    ParticleConstraint<S> row = {};
    row.kind = ConstraintKind::contact;
    row.a = a.slot;
    row.b = b ? b.slot : kNoParticle;
    row.other = b ? kNoParticle : 0;
    row.radius = from_double<S>(radius);
    row.restitution = from_double<S>(restitution);
    row.share_a = from_double<Unit<S>>(share_a);
    row.share_b = b ? from_double<Unit<S>>(1 - share_a) : Unit<S>(0);
    rows.add(row);
  }
  void solve_step() {
    this->begin();
    flight.prepare();
    springs.prepare();
    stiff_springs.prepare(rows.all());
    solver.begin_step();
    for (int i = 0; i < this->state.settings.substeps; ++i) {
      solver.solve_substep();
      integration.place();
    }
  }
};

}  // namespace solver_scene
}  // namespace isostep
