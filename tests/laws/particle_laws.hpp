// The common part of the laws of particles: worlds at a rate, particles in one line, references in a wider format.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/particle_world.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// The format in which references are computed.
using Wide = long double;

/// 64 steps of one sub-step each: h = 2^-6 s is a number of every format.
template <class S> ParticleSettings<S> at_rate(double gravity, std::int32_t hz = 64, std::int32_t substeps = 1) {
  ParticleSettings<S> s;
  s.hz = hz;
  s.substeps = substeps;
  s.gravity = vec<S>(0, gravity, 0);
  return s;
}
template <class S>
ParticleDefinition<S> point(D3 position, D3 velocity = {0, 0, 0}, double mass = 1, ParticleMaterialId material = {}) {
  ParticleDefinition<S> d;
  d.position = vec<S>(position);
  d.velocity = vec<S>(velocity);
  d.mass = num<S>(mass);
  d.material = material;
  return d;
}
template <class S> ParticleDefinition<S> fixed_point(D3 position, ParticleMaterialId material = {}) {
  ParticleDefinition<S> d = point<S>(position, {0, 0, 0}, 1, material);
  d.pinned = true;
  return d;
}
/// Collides with scenery, and with its like where `collides`.
template <class S> ParticleMaterial<S> grain_of(double radius, double restitution, double friction, bool collides) {
  ParticleMaterial<S> m;
  m.radius = num<S>(radius);
  m.restitution = num<S>(restitution);
  m.friction = num<S>(friction);
  m.collides = collides;
  return m;
}
template <class S> Collider<S> plane(D3 normal, double offset) {
  using U = Unit<S>;
  Collider<S> c;
  c.normal = {num<U>(normal.x), num<U>(normal.y), num<U>(normal.z)};
  c.offset = num<S>(offset);
  return c;
}
template <class S> void run(ParticleWorld<S>& world, int steps) {
  for (int i = 0; i < steps; ++i) ASSERT_TRUE(world.step().clean()) << "step " << i;
}
/// The number as S holds it: references begin with the same.
template <class S> double held(double value) { return to_double(num<S>(value)); }

}  // namespace isostep::test
