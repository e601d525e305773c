// PairSearch: how far particles may come in a step, and which of those asked for may come within each other's reach.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/grid.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/step/step.hpp"

namespace isostep {

/// Pairs of particles that one search may find [1] where settings name none: 64 a particle, no fewer than 2^21 and no
/// more than kMostParticlePairs. With rows and contacts a pair takes up to 250 bytes. Beyond, a crowd is one point.
inline constexpr std::uint32_t kCrowdPairs = 1u << 21;
ISO_INLINE constexpr std::uint32_t most_pairs(std::uint32_t asked, std::uint32_t particles) {
  if (asked != 0) return asked;
  return particles < kMostParticlePairs / 64 ? max(64 * particles, kCrowdPairs) : kMostParticlePairs;
}

/// One search after the other in a step: clear, add what is searched, find.
template <class S> class PairSearch {
 public:
  PairSearch(const ParticleState<S>& state, ParticleStep<S>& step);

  /// Finds, before the first search of a step, how far springs may carry particles in it.
  void begin_step();
  /// [m] Returns about how far a particle may come in a step. What it meets within that is found now.
  ISO_INLINE S reach_of(std::uint32_t slot) const {
    using V = Velocity<S>;
    const Vec3<V> v = state_.velocity[slot];
    const V most = max(max_abs(v), V(1));  // [m/s] what a force may do within a step
    const S way = convert<S>(most) * (step_.h * Step<S>(0.5)) * S(4 * state_.settings.substeps);
    return pulls_.empty() ? way : min(saturating_add(way, pulls_[slot]), ParticleLimits<S>::position());
  }

  /// Returns true if some material has particles that collide with each other.
  bool any_collides() const;
  void clear();
  /// Adds a particle, in ascending order of slots. `reach` [m] is from its position as the step begins.
  ISO_INLINE void add(std::uint32_t slot, S reach) {
    slots_.push_back(slot);
    reaches_.push_back(reach);
  }
  /// Appends a << 32 | b of each pair a < b, ascending. Pairs beyond the settings' limit are left out and reported.
  void find(std::vector<std::uint64_t>& pairs);

  template <class Visit> void visit_scratch(const Visit& visit);

 private:
  bool may_meet() const;

  const ParticleState<S>& state_;
  ParticleStep<S>& step_;
  ParticleGrid<S> grid_;
  std::vector<S> pulls_;              // [m] by slot, or empty: how far springs may carry it in the step
  std::vector<std::uint32_t> slots_;  // of what is searched
  std::vector<S> reaches_;            // [m] of those
};

#define ISO_PAIR_SEARCH_OF(extern, S) extern template class PairSearch<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PAIR_SEARCH_OF)

}  // namespace isostep
