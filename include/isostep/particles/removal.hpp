// ParticleRemoval: how particles and records leave a world, with all that names them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/particle_events.hpp"
#include "isostep/particles/registry_of.hpp"

namespace isostep {

template <class S> class ParticleRemoval {
 public:
  explicit ParticleRemoval(ParticleState<S>& state);

  /// Removes a particle that the world holds.
  void remove(ParticleId particle);
  /// Removes the particles whose lifetime ended, and adds events.
  void expire(ParticleEvents<S>& events);

  /// Removes a record that the world holds.
  template <class Id> ISO_INLINE void remove_record(Id record) {
    forget(record);
    detail::registry_of(state_, record).remove(record);
  }

 private:
  using V = Velocity<S>;

  void remove_leaving();
  template <class Id, class Registry, class Names> void remove_naming(const Registry& registry, const Names& names);
  /// Removes what the state stores about a record elsewhere.
  template <class Id> ISO_INLINE void forget(Id) {}
  void forget(LinkId link);
  void forget(ColliderId collider);
  void free_slot(std::uint32_t slot);

  ParticleState<S>& state_;
  std::vector<std::uint32_t> leaving_;    // slots of particles that go
  std::vector<std::uint8_t> is_leaving_;  // by slot: 1 while they are being removed
};

#define ISO_PARTICLE_REMOVAL_OF(extern, S) extern template class ParticleRemoval<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_REMOVAL_OF)

}  // namespace isostep
