// Whom the leaves of a particle world belong to.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "isostep/particles/particle_state.hpp"

namespace isostep::tool {

/// Whom an index belongs to: arrays of particles are by slot; empty for paths that say so themselves.
template <class S> std::string owner_of(const ParticleState<S>& state, std::string_view path) {
  const std::size_t open = path.find('['), close = path.find(']');
  if (open == std::string_view::npos || close == std::string_view::npos) return {};
  const std::string_view name = path.substr(0, open);
  const std::string index(path.substr(open + 1, close - open - 1));
  for (const char* of_particles : {"position.x", "position.y", "position.z", "velocity.x", "velocity.y", "velocity.z",
                                   "inverse_mass", "material"}) {
    if (name == of_particles) return "particle slot " + index;
  }
  if (name == "contacts") {
    const auto i = static_cast<std::size_t>(std::stoul(index));
    if (i < state.contacts.size()) return "particle slot " + std::to_string(state.contacts[i].a);
  }
  return {};
}

}  // namespace isostep::tool
