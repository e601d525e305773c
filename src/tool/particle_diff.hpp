// All differences of two states of particle worlds, by name.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "isostep/particles/particle_state.hpp"
#include "state_diff.hpp"

namespace isostep::tool {

namespace detail {
/// The n-th array or registry of a kind that `visit_all` walks: two objects' side by side.
template <class WalkA, class WalkB, class Compare>
void diff_side_by_side(const WalkA& walk_a, const WalkB& walk_b, const Compare& compare) {
  std::size_t index = 0;
  walk_a([&](const char* name, const auto& of_a) {
    std::size_t other = 0;
    walk_b([&](const char*, const auto& of_b) {
      if constexpr (std::is_same_v<decltype(of_a), decltype(of_b)>) {
        if (other == index) compare(name, of_a, of_b);
      }
      ++other;
    });
    ++index;
  });
}
}  // namespace detail

/// In the order in which the root hash takes them.
template <class S> void diff_states(const ParticleState<S>& a, const ParticleState<S>& b, DiffReport& report) {
  diff_value("settings", a.settings, b.settings, report);
  diff_value("tick", a.tick, b.tick, report);
  detail::diff_slots("particles", a.particles, b.particles, report);
  const auto registries = [](const ParticleState<S>& state) {
    return [&state](const auto& visit) { ParticleState<S>::registries(visit, state); };
  };
  const auto sections = [](const ParticleState<S>& state) {
    return [&state](const auto& visit) { ParticleState<S>::sections(visit, state); };
  };
  detail::diff_side_by_side(registries(a), registries(b), [&](const char* name, const auto& of_a, const auto& of_b) {
    detail::diff_slots((std::string(name) + "_slots").c_str(), of_a.slots(), of_b.slots(), report);
    detail::diff_array(PathPart{nullptr, name, 0}, of_a.all(), of_b.all(), report);
  });
  detail::diff_side_by_side(sections(a), sections(b), [&](const char* name, const auto& of_a, const auto& of_b) {
    detail::diff_array(PathPart{nullptr, name, 0}, of_a, of_b, report);
  });
}

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
