// ParticleForces: the sum of all forces at the particles' present positions and velocities, as acceleration.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/bitset.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/particles/step/free_flight.hpp"
#include "isostep/particles/step/pair_search.hpp"
#include "isostep/particles/step/springs.hpp"

namespace isostep {

/// Adds forces in the order of kinds and slots, whatever the order of registration: gravity and drag of materials,
/// springs, forces of single particles, cohesions, what the game asked for. Stiff springs are no forces.
template <class S> class ParticleForces {
 public:
  ParticleForces(ParticleState<S>& state, ParticleStep<S>& step, FreeFlight<S>& flight, ParticleSprings<S>& springs);

  /// Reports particles that the game pushed beyond the limits.
  void begin_step();
  /// Finds, once a step, which particles may come within each other's reach in it.
  void find_cohering(PairSearch<S>& search);
  /// Returns true if there are forces besides those of materials.
  bool any() const;
  void accelerate();

 private:
  using U = Unit<S>;

  void add(const ParticleForce<S>& force);
  void add(const Cohesion<S>& cohesion, std::uint32_t i, std::uint32_t k);
  void add_cohesions();
  ISO_INLINE void push(std::uint32_t slot, InverseMass<S> inverse_mass, Vec3<U> direction, S force);
  void note_cut(std::uint32_t slot);

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  FreeFlight<S>& flight_;
  ParticleSprings<S>& springs_;
  std::vector<std::uint64_t> cohering_;     // a << 32 | b, ascending, of one cohesion after the other
  std::vector<std::size_t> cohering_ends_;  // in cohering_, one a cohesion
  Bitset cut_;                              // slots that the report's clamped_force has counted
};

#define ISO_PARTICLE_FORCES_OF(extern, S) extern template class ParticleForces<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_FORCES_OF)

}  // namespace isostep
