// ParticleEngine: making, hashing and loading it, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"
#include "isostep/particles/particle_validator.hpp"
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
    desk_.faults.refuse_call("ParticleWorld", {Fault::out_of_range});
  }
  state_.materials.add(ParticleMaterial<S>{});
}

template <class S> std::uint64_t ParticleEngine<S>::hash() const {
  detail::StateHasher hasher;
  ParticleState<S>::members(hasher, state_);
  return hasher.value();
}

template <class S> void ParticleEngine<S>::load(const ParticleState<S>& from) {
  state_ = from;
  desk_.note_load();
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
