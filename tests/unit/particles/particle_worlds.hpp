// The common part of the tests of particle worlds: short definitions, numbers of a seed, and whether a state obeys its
// rules.
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/particles/particle_validator.hpp"
#include "isostep/particles/particle_world.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Numbers of a seed alone.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : random_(Pcg32::seeded(seed)) {}
  std::uint32_t below(std::uint32_t n) { return random_below(random_, n); }
  bool one_in(std::uint32_t n) { return below(n) == 0; }
  /// A number in whole thousandths.
  double in(double low, double high) { return low + (high - low) * below(1000) / 1000; }
  D3 point(double reach) {
    const double x = in(-reach, reach), y = in(-reach, reach), z = in(-reach, reach);
    return {x, y, z};
  }

 private:
  Pcg32 random_;
};

template <class S> ParticleSettings<S> particle_settings(double gravity = -10, std::int32_t substeps = 4) {
  ParticleSettings<S> s;
  s.substeps = substeps;
  s.gravity = vec<S>(0, gravity, 0);
  return s;
}
template <class S> ParticleDefinition<S> particle_at(D3 position, D3 velocity = {0, 0, 0}, double mass = 1) {
  ParticleDefinition<S> d;
  d.position = vec<S>(position);
  d.velocity = vec<S>(velocity);
  d.mass = num<S>(mass);
  return d;
}
template <class S> ParticleDefinition<S> pinned_at(D3 position, D3 velocity = {0, 0, 0}) {
  ParticleDefinition<S> d = particle_at<S>(position, velocity);
  d.pinned = true;
  return d;
}
/// The material of particles that collide.
template <class S> ParticleMaterial<S> ball_material(double radius, double restitution = 0, double friction = 0) {
  ParticleMaterial<S> m;
  m.radius = num<S>(radius);
  m.restitution = num<S>(restitution);
  m.friction = num<S>(friction);
  m.collides = true;
  return m;
}
template <class S> Spring<S> spring_of(ParticleId a, ParticleId b, double stiffness, double rest = 1) {
  Spring<S> s;
  s.a = a;
  s.b = b;
  s.stiffness = num<S>(stiffness);
  s.rest_length = num<S>(rest);
  return s;
}
template <class S> Link<S> link_of(LinkType type, ParticleId a, ParticleId b, double length) {
  Link<S> link;
  link.type = type;
  link.a = a;
  link.b = b;
  link.length = num<S>(length);
  return link;
}
template <class S> ParticleForce<S> force_of(ForceType type, ParticleId particle) {
  ParticleForce<S> force;
  force.type = type;
  force.particle = particle;
  force.max_depth = S(1);
  return force;
}
/// All below y = height is solid.
template <class S> ColliderId add_plane(ParticleWorld<S>& world, double height = 0) {
  Collider<S> plane;
  plane.offset = num<S>(height);
  return world.add(plane);
}

/// Bit for bit the same state, by the portable form.
template <class S> std::vector<std::uint8_t> bytes_of(const ParticleWorld<S>& world) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  world.write_portable(writer);
  return bytes;
}
/// The first rule that the world's state breaks; empty for none.
template <class S> std::string broken_rule(const ParticleWorld<S>& world) {
  const char* rule = ParticleValidator<S>(world.state()).broken_rule();
  return rule == nullptr ? "" : rule;
}
template <class S> S not_a_number() {
  if constexpr (!kIsFixed<S>) return std::numeric_limits<S>::quiet_NaN();
  return S(0);
}
template <class S> S endless() {
  if constexpr (!kIsFixed<S>) return std::numeric_limits<S>::infinity();
  if constexpr (kIsFixed<S>) return S::highest();
}

}  // namespace isostep::test
