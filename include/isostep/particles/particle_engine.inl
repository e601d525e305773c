// ParticleEngine: one step, stage by stage; hashing, loading, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/commands.inl"
#include "isostep/particles/particle_engine.hpp"
#include "isostep/particles/particle_validator.hpp"
#include "isostep/particles/removal.inl"
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
#include "isostep/state/members.hpp"

namespace isostep {

/// Settings out of range are brought to the nearest that is in range, and that is a fault.
template <class S> ParticleEngine<S>::ParticleEngine(const ParticleSettings<S>& settings) {
  state_.settings = settings;
  ParticleSettings<S>& s = state_.settings;
  s.hz = clamp(s.hz, 10, 1000);
  s.substeps = clamp(s.substeps, 1, min(64, kMaxParticleRate / s.hz));
  const S limit = ParticleLimits<S>::speed();
  for (int axis = 0; axis < 3; ++axis) {
    const S g = s.gravity[axis];
    s.gravity[axis] = is_finite(g) ? clamp(g, -limit, limit) : S(0);
  }
  if (static_cast<std::uint32_t>(s.integrator) >= kIntegrators) s.integrator = Integrator::semi_implicit_euler;
  if (static_cast<std::uint32_t>(s.solver) >= kParticleSolvers) s.solver = ParticleSolver::soft_step;
  if (static_cast<std::uint32_t>(s.stepping) >= kSteppings) s.stepping = Stepping::fixed;
  s.pairs = min(s.pairs, kMostParticlePairs);
  if (s.hz != settings.hz || s.substeps != settings.substeps || !(s.gravity == settings.gravity) ||
      s.integrator != settings.integrator || s.solver != settings.solver || s.stepping != settings.stepping ||
      s.pairs != settings.pairs) {
    journal_.refuse_call("ParticleWorld", {Fault::out_of_range});
  }
  state_.materials.add(ParticleMaterial<S>{});
}

template <class S> ParticleReport ParticleEngine<S>::step(const ParticleStageObserver& observer) {
  const auto after = [&](ParticleStage stage) {
    if (observer.after != nullptr) observer.after(observer.user, stage, view(static_cast<std::uint32_t>(stage)));
    journal_.trace(*this);
  };
  journal_.trace(*this);
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

template <class S> StageView ParticleEngine<S>::view(std::uint32_t stage) {
  const auto hash = [](const void* engine) { return static_cast<const ParticleEngine*>(engine)->hash(); };
  return {{this, hash, &ParticleEngine::walk_fields}, stage};
}

// ---- the state

template <class S> std::uint64_t ParticleEngine<S>::hash() const {
  detail::StateHasher hasher;
  ParticleState<S>::members(hasher, state_);
  return hasher.value();
}

template <class S> void ParticleEngine<S>::load(const ParticleState<S>& from) {
  state_ = from;
  journal_.note_load();
  step_.forget_results();
}

template <class S> void ParticleEngine<S>::write_portable(Writer& writer) const {
  writer.write(ScalarTraits<S>::kId | kParticleWorldBit);
  ParticleState<S>::members(detail::StateWriter(writer), state_);
}

template <class S> Result<void> ParticleEngine<S>::read_portable(Reader& reader) {
  ParticleState<S> next;
  if (reader.read<std::uint32_t>() != (ScalarTraits<S>::kId | kParticleWorldBit) && reader.ok())
    reader.fail(ErrorCode::incompatible, "not written by a particle world of this scalar");
  ParticleState<S>::members(detail::StateReader(reader), next);
  if (reader.ok()) {
    if (const char* rule = ParticleValidator<S>(next).broken_rule()) reader.fail(ErrorCode::corrupt, rule);
  }
  const Result<void> result = reader.result("particle world");
  if (reader.ok()) load(next);
  return result;
}

}  // namespace isostep
