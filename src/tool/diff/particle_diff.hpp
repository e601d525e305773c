// Whom the fields of a particle world belong to.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "isostep/particles/particle_state.hpp"
#include "path_item.hpp"

namespace isostep::tool {

/// Whom an index belongs to: arrays of particles are by slot; empty for paths that say so themselves.
template <class S> std::string owner_of(const ParticleState<S>& state, std::string_view path) {
  const auto [name, index] = first_item(path);
  for (const char* of_particles : {"position.x", "position.y", "position.z", "velocity.x", "velocity.y", "velocity.z",
                                   "inverse_mass", "material"}) {
    if (name == of_particles) return "particle slot " + std::to_string(index);
  }
  if (name == "contacts" && index < state.contacts.size())
    return "particle slot " + std::to_string(state.contacts[index].a);
  return {};
}

}  // namespace isostep::tool
