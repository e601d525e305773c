// PairSearch: the reach that springs give, and the search by the grid.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/step/pair_search.hpp"

namespace isostep {

template <class S>
PairSearch<S>::PairSearch(const ParticleState<S>& state, ParticleStep<S>& step) : state_(state), step_(step) {}

template <class S> bool PairSearch<S>::any_collides() const {
  for (const ParticleMaterial<S>& material : state_.materials.all()) {
    if (material.collides) return true;
  }
  return false;
}
/// Returns true if a particle may meet something else than touches and links.
template <class S> bool PairSearch<S>::may_meet() const {
  return any_collides() || !state_.colliders.all().empty() || !state_.cohesions.all().empty();
}
/// Springs may carry their ends in a step so far beside their velocity: k h^2 / m of the extension, and to its other
/// side at most.
template <class S> void PairSearch<S>::begin_step() {
  pulls_.clear();
  if (state_.springs.all().empty() || !may_meet()) return;
  pulls_.assign(state_.material.size(), S(0));
  const Axes<S>& position = state_.position;
  const S rate = S(state_.settings.hz);
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a) continue;
    const Vec3<S> d = position[spring.a.slot] - (spring.b ? position[spring.b.slot] : spring.anchor);
    const S extension = abs(length(d) - spring.rest_length);
    const auto pull = [&](std::uint32_t slot) {
      const S part = saturate_to<S>(product(spring.stiffness, state_.inverse_mass[slot])) / rate / rate;
      pulls_[slot] = saturating_add(pulls_[slot], saturate_to<S>(product(extension, min(part, S(2)))));
    };
    pull(spring.a.slot);
    if (spring.b) pull(spring.b.slot);
  }
}

template <class S> void PairSearch<S>::clear() {
  slots_.clear();
  reaches_.clear();
}
template <class S> void PairSearch<S>::find(std::vector<std::uint64_t>& pairs) {
  if (slots_.size() < 2) return;
  const auto count = static_cast<std::uint32_t>(slots_.size());
  const std::uint32_t most = most_pairs(state_.settings.pairs, count);
  if (!grid_.find_pairs(state_.position, slots_.data(), reaches_.data(), count, pairs, most)) ++step_.report.lost_pairs;
}

}  // namespace isostep
