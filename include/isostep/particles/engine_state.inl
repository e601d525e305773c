// ParticleEngine: hashing, loading, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"
#include "isostep/particles/particle_validator.hpp"
#include "isostep/state/members.hpp"

namespace isostep {

template <class S> std::uint64_t ParticleEngine<S>::hash() const {
  detail::StateHasher root;
  ParticleState<S>::members(root, state_);
  return root.value();
}

template <class S> void ParticleEngine<S>::load(const ParticleState<S>& from) {
  state_ = from;
  journal_.note_load();
  events_.clear();
  report_ = {};
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
