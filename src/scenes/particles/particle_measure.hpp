// Measures of a particle world, for reports. All in double, never fed back.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_world.hpp"

namespace isostep::scenes {

/// The energy of particles that are not pinned. Potential: of gravity, zero at the origin; elastic: of springs of every
/// type.
struct ParticleEnergy {
  double kinetic = 0, potential = 0, elastic = 0;  // [J]
  double total() const { return kinetic + potential + elastic; }
};
template <class S> ParticleEnergy measure_energy(const ParticleWorld<S>& world);
/// [m] The length by which a cable is too long or a rod is off, at most.
template <class S> double largest_link_error(const ParticleWorld<S>& world);
/// [m] The largest overlap of particles that collide, with each other and with scenery.
template <class S> double largest_overlap(const ParticleWorld<S>& world);
/// [m/s]
template <class S> double largest_speed(const ParticleWorld<S>& world);

#define ISO_EXTERN(S)                                                        \
  extern template ParticleEnergy measure_energy<S>(const ParticleWorld<S>&); \
  extern template double largest_link_error<S>(const ParticleWorld<S>&);     \
  extern template double largest_overlap<S>(const ParticleWorld<S>&);        \
  extern template double largest_speed<S>(const ParticleWorld<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
