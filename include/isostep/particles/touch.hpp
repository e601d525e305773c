// A contact that somebody outside found for the coming step: how rigid bodies meet particles that know no bodies.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/particles/particle.hpp"

namespace isostep {

template <class S> struct ParticleTouch {
  ParticleId particle;
  Vec3<Unit<S>> normal = Vec3<Unit<S>>::zero();  // [1] from the particle into what it touches
  S separation = S(0);  // [m] gap between the particle's surface and the other's; below 0 they overlap
  Vec3<Velocity<S>> surface_velocity = Vec3<Velocity<S>>::zero();  // [m/s] of the other at the point
  Vec3<S> surface_acceleration = Vec3<S>::zero();   // [m/s^2] with which that changes within the step by itself
  InverseMass<S> inverse_mass = InverseMass<S>(0);  // [1/kg] with which the other reacts there; 0: it does not
  S friction = S(0);                                // [1]
  S restitution = S(0);                             // [1]

  ISO_FIELDS(particle, normal, separation, surface_velocity, surface_acceleration, inverse_mass, friction, restitution)
};
static_assert(kHasNoPadding<ParticleTouch<float>> && kHasNoPadding<ParticleTouch<double>>);

}  // namespace isostep
