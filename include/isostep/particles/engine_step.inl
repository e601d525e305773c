// ParticleEngine: one step, stage by stage.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"
#include "isostep/particles/removal.hpp"
#include "isostep/particles/solvers/soft_step.inl"
#include "isostep/particles/solvers/worst_first_step.inl"
#include "isostep/particles/step/contacts.inl"
#include "isostep/particles/step/finish.inl"
#include "isostep/particles/step/forces.inl"
#include "isostep/particles/step/free_flight.inl"
#include "isostep/particles/step/integration.inl"
#include "isostep/particles/step/pair_search.inl"
#include "isostep/particles/step/rows.inl"
#include "isostep/particles/step/springs.inl"
#include "isostep/particles/step/stiff_springs.inl"

namespace isostep {

template <class S> ParticleReport ParticleEngine<S>::step(const ParticleStageObserver& observer) {
  const auto after = [&](ParticleStage stage) {
    if (observer.after != nullptr) observer.after(observer.user, stage, view(static_cast<std::uint32_t>(stage)));
    desk_.note_hash(*this);
  };
  desk_.note_hash(*this);
  begin_step();
  contacts_.find();
  after(ParticleStage::find_contacts);
  solve_substeps();
  after(ParticleStage::solve_substeps);
  if (is_soft()) soft_step_.apply_restitution();
  after(ParticleStage::restitution);
  contacts_.store(is_soft());
  after(ParticleStage::store_impulses);
  finish_.finalise();
  after(ParticleStage::finalise_particles);
  springs_.yield();
  after(ParticleStage::yield_springs);
  ++state_.tick;
  removal_.expire(step_.events);
  after(ParticleStage::expire_particles);
  return step_.report;
}

template <class S> void ParticleEngine<S>::begin_step() {
  step_.begin(state_.settings, state_.material.size());
  forces_.begin_step();
  flight_.prepare();
  soft_step_.begin_step();
  worst_first_.begin_step();
}

template <class S> void ParticleEngine<S>::solve_substeps() {
  springs_.prepare();
  stiff_springs_.prepare(rows_.all());
  const bool joined = forces_.any() || !rows_.empty();
  const Integrator integrator = state_.settings.integrator;
  const bool plain = integrator == Integrator::semi_implicit_euler || integrator == Integrator::explicit_euler;
  // The book's resolver stands between velocities and positions, which rounds once more: then everywhere, so that what
  // flies alone does not know whether others touch.
  const bool resolves = !is_soft() && state_.settings.stepping == Stepping::fixed;
  if (!joined && plain && !resolves) return flight_.fly();
  step_.now = state_.position;
  forces_.find_cohering(search_);
  for (std::int32_t i = 0; i < state_.settings.substeps; ++i) {
    rows_.accelerate_surfaces();
    if (rows_.empty() && !resolves) integration_.fly();
    else if (is_soft()) soft_step_.solve_substep();
    else worst_first_.solve_substep();
    rows_.move_surfaces();
    flight_.place();
  }
}

}  // namespace isostep

/// The step and the systems that it calls.
#define ISO_INSTANTIATE_PARTICLE_STEP(S) \
  ISO_FREE_FLIGHT_OF(, S)                \
  ISO_PAIR_SEARCH_OF(, S)                \
  ISO_PARTICLE_ROWS_OF(, S)              \
  ISO_PARTICLE_CONTACTS_OF(, S)          \
  ISO_PARTICLE_SPRINGS_OF(, S)           \
  ISO_STIFF_SPRINGS_OF(, S)              \
  ISO_PARTICLE_FORCES_OF(, S)            \
  ISO_PARTICLE_INTEGRATION_OF(, S)       \
  ISO_PARTICLE_SOFT_STEP_OF(, S)         \
  ISO_WORST_FIRST_STEP_OF(, S)           \
  ISO_PARTICLE_FINISH_OF(, S)            \
  ISO_PARTICLE_ENGINE_OF(, S)
