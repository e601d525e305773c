// The common part of the tests of particles among bodies: both worlds, a frame of them, and short definitions.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "isostep/effects/particle_coupling.hpp"
#include "isostep/particles/particle_state.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

template <class S> struct Coupled {
  World<S> bodies;
  ParticleWorld<S> particles;
  ParticleCoupling<S> coupling;

  explicit Coupled(double gravity = -10, const CouplingSettings<S>& how = {})
      : bodies(settings<S>(gravity)), particles(ParticleSettings<S>{.gravity = vec<S>(0, gravity, 0)}), coupling(how) {}

  void step() {
    EXPECT_TRUE(coupling.before_step(bodies, particles));
    EXPECT_TRUE(particles.step().clean());
    EXPECT_TRUE(coupling.after_step(bodies, particles));
    EXPECT_TRUE(bodies.step().clean());
    EXPECT_EQ(coupling.report().refused, 0u);
  }
  void run(int frames) {
    for (int i = 0; i < frames; ++i) step();
  }
  std::uint64_t hash() const { return bodies.hash() * 31 + particles.hash(); }

  ParticleMaterialId grain(double radius, double friction = 0, double restitution = 0, bool collides = false) {
    ParticleMaterial<S> material;
    material.radius = num<S>(radius);
    material.friction = num<S>(friction);
    material.restitution = num<S>(restitution);
    material.collides = collides;
    return particles.add(material);
  }
  ParticleId drop(ParticleMaterialId material, D3 position, double mass = 1, D3 velocity = {0, 0, 0},
                  bool pinned = false) {
    ParticleDefinition<S> definition;
    definition.position = vec<S>(position);
    definition.velocity = vec<S>(velocity);
    definition.mass = num<S>(mass);
    definition.pinned = pinned;
    definition.material = material;
    return particles.create(definition);
  }
  BodyId box(D3 half, D3 position, double mass, double friction = 0.6, double restitution = 0) {
    BodyDefinition<S> d = moving<S>(add_box(bodies, half.x, half.y, half.z), position);
    d.mass = num<S>(mass);
    d.material.friction = num<S>(friction);
    d.material.restitution = num<S>(restitution);
    return bodies.create(d);
  }
  BodyId kinematic_box(D3 half, D3 position, D3 velocity) {
    BodyDefinition<S> d = moving<S>(add_box(bodies, half.x, half.y, half.z), position, velocity);
    d.type = BodyType::kinematic;
    return bodies.create(d);
  }

  D3 at(ParticleId id) const { return real(particles.position(id)); }
  D3 at(BodyId id) const { return real(bodies.center_of_mass(id)); }
  D3 speed(ParticleId id) const { return real(particles.velocity(id)); }
  D3 speed(BodyId id) const { return real(bodies.velocity(id)); }

  /// [m] The greatest depth at which the surface of a particle lies inside a box of these half extents.
  double deepest_in(BodyId body, D3 half, double radius) const {
    const Transform<S> place = Transform<S>::of(bodies.pose(body));
    double deepest = 0;
    for (const ParticleId id : particles.particles()) {
      const D3 p = real(to_local(place, particles.position(id)));
      const D3 out = {std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z};
      const D3 off = {std::max(out.x, 0.0), std::max(out.y, 0.0), std::max(out.z, 0.0)};
      const double distance = length(off) > 0 ? length(off) : std::max({out.x, out.y, out.z});
      deepest = std::max(deepest, radius - distance);
    }
    return deepest;
  }
  double fastest_particle() const {
    double most = 0;
    for (const ParticleId id : particles.particles()) most = std::max(most, length(speed(id)));
    return most;
  }
  D3 momentum() const {
    D3 sum = {0, 0, 0};
    for (const BodyId id : bodies.bodies()) sum = sum + speed(id) * to_double(bodies.mass(id));
    for (const ParticleId id : particles.particles()) sum = sum + speed(id) * to_double(particles.mass(id));
    return sum;
  }
};

/// A square of particles at height y, held along its edge, with springs along and across its meshes.
template <class S>
std::vector<ParticleId> hang_cloth(Coupled<S>& game, int side, double pitch, double y, double mass, double stiffness,
                                   double damping) {
  ParticleMaterial<S> material;
  material.radius = num<S>(0.05);
  material.friction = num<S>(0.5);
  material.damping = num<S>(0.5);
  const ParticleMaterialId cloth = game.particles.add(material);
  std::vector<ParticleId> ids;
  const double middle = (side - 1) / 2.0;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const bool edge = i == 0 || j == 0 || i == side - 1 || j == side - 1;
      ids.push_back(game.drop(cloth, {(i - middle) * pitch, y, (j - middle) * pitch}, mass, {0, 0, 0}, edge));
    }
  }
  const auto tie = [&](int i, int j, int k, int l) {
    if (k >= side || l < 0 || l >= side) return;
    Spring<S> spring;
    spring.a = ids[static_cast<std::size_t>(i * side + j)];
    spring.b = ids[static_cast<std::size_t>(k * side + l)];
    spring.stiffness = num<S>(stiffness);
    spring.damping = num<S>(damping);
    spring.rest_length = num<S>(pitch * std::sqrt((k - i) * (k - i) + (l - j) * (l - j)));
    game.particles.add(spring);
  };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (const auto& [k, l] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{1, -1}})
        tie(i, j, i + k, j + l);
    }
  }
  return ids;
}

}  // namespace isostep::test
