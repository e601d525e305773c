// The registry of a particle world's state that holds the records of an id's type.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_command.hpp"
#include "isostep/particles/particle_state.hpp"

namespace isostep::detail {

#define ISO_REGISTRY(name, Record, Id, S) \
  template <class State> ISO_INLINE auto& registry_of(State& state, Id) { return state.name##s; }
ISO_FOR_EACH_PARTICLE_COMMAND(ISO_SKIP, ISO_REGISTRY, S)
#undef ISO_REGISTRY

}  // namespace isostep::detail
