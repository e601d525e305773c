// ParticleEngine: hashing, loading, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"
#include "isostep/particles/particle_validator.hpp"
#include "isostep/state/slots.hpp"

namespace isostep {

/// Root: settings, tick, slots, registries, arrays, in this order.
template <class S> std::uint64_t ParticleEngine<S>::hash() const {
  HashCombiner root;
  root.add(hash_records_by_fields(&state_.settings, 1));
  root.add(state_.tick);
  root.add(detail::hash_slots(state_.particles));
  ParticleState<S>::registries(
      [&](const char*, const auto& registry) {
        root.add(detail::hash_slots(registry.slots()));
        root.add(registry.remembered().get(
            [&] { return hash_records_by_fields(registry.all().data(), registry.all().size()); }));
      },
      state_);
  ParticleState<S>::sections(
      [&](const char*, const auto& array) { root.add(hash_records(array.data(), array.size())); }, state_);
  return root.value();
}

template <class S> void ParticleEngine<S>::load(const ParticleState<S>& from) {
  state_ = from;
  ++loads_;
  events_.clear();
  report_ = {};
  fault_ = Fault::none;
}

template <class S> void ParticleEngine<S>::write_portable(Writer& writer) const {
  writer.write(ScalarTraits<S>::kId | kParticleWorldBit);
  writer.write(state_.settings);
  writer.write(state_.tick);
  detail::write_slots(writer, state_.particles);
  ParticleState<S>::registries(
      [&](const char*, const auto& registry) {
        detail::write_slots(writer, registry.slots());
        writer.write_array(registry.all());
      },
      state_);
  ParticleState<S>::sections([&](const char*, const auto& array) { writer.write_array(array); }, state_);
}

template <class S> Result<void> ParticleEngine<S>::read_portable(Reader& reader) {
  ParticleState<S> next;
  if (reader.read<std::uint32_t>() != (ScalarTraits<S>::kId | kParticleWorldBit) && reader.ok())
    reader.fail(ErrorCode::incompatible, "not written by a particle world of this scalar");
  reader.read(next.settings);
  reader.read(next.tick);
  detail::read_slots(reader, next.particles);
  ParticleState<S>::registries(
      [&](const char*, auto& registry) {
        detail::read_slots(reader, registry.slots());
        reader.read_array(registry.change_all(), detail::kMaxRecords);
      },
      next);
  ParticleState<S>::sections([&](const char*, auto& array) { reader.read_array(array, detail::kMaxRecords); }, next);
  if (reader.ok()) {
    if (const char* rule = ParticleValidator<S>(next).broken_rule()) reader.fail(ErrorCode::corrupt, rule);
  }
  const Result<void> result = reader.result("particle world");
  if (reader.ok()) load(next);
  return result;
}

}  // namespace isostep
