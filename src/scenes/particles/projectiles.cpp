// Particles that fly and die: the book's rounds and fireworks.
// SPDX-License-Identifier: MIT
#include "isostep/core/random.hpp"
#include "particle_scene.hpp"
#include "words.hpp"

namespace isostep::scenes::particle_scripts {
namespace {

// ---- rounds

/// Source:  Millington, ch. 4.3; numbers of its ballistic demo.
template <class S> struct Round {
  S mass;            // [kg]
  Vec3<S> velocity;  // [m/s]
  S fall;            // [m/s^2] downwards
  S damping;         // [1] a second
};
template <class S>
constexpr Round<S> kRounds[] = {
    {S(2), {S(0), S(0), S(35)}, S(1), S(0.99)},      // pistol
    {S(200), {S(0), S(30), S(40)}, S(20), S(0.99)},  // artillery
    {S(1), {S(0), S(0), S(10)}, S(-0.6), S(0.9)},    // fireball
    {S(0.1), {S(0), S(0), S(100)}, S(0), S(0.99)},   // laser
};
constexpr std::uint32_t kRoundKinds = 4;
constexpr std::size_t kPool = 16;            // rounds in the air
constexpr std::uint64_t kBetweenShots = 16;  // [steps]

/// Material 1 + n is that of round n.
template <class S> void load_guns(ParticleWorld<S>& world) {
  for (const Round<S>& round : kRounds<S>) {
    ParticleMaterial<S> material;
    material.gravity_scale = round.fall;  // of a gravity of 1
    material.damping = round.damping;
    world.add(material);
  }
}
template <class S> void shoot(ParticleWorld<S>& world) {
  if (world.tick() % kBetweenShots != 0 || world.counts().particles >= kPool) return;
  const auto kind = static_cast<std::uint32_t>(world.tick() / kBetweenShots % kRoundKinds);
  ParticleDefinition<S> d;
  d.position = {S(0), S(1.5), S(0)};
  d.velocity = kRounds<S>[kind].velocity;
  d.mass = kRounds<S>[kind].mass;
  d.material = material_at(world, kind + 1);
  d.lifetime = steps_of(world, 5);
  world.create(d);
}
template <class S> void bury(ParticleWorld<S>& world) {
  for (const ParticleId particle : world.particles()) {
    const Vec3<S> at = world.position(particle);
    if (at.y < S(0) || S(200) < at.z) world.destroy(particle);
  }
}

// ---- fireworks

/// Source:  Millington, ch. 4.4; numbers of its fireworks demo.
template <class S> struct Firework {
  std::int32_t least_age, most_age;  // [s/100]
  Vec3<S> least, most;               // [m/s] added to what bursts into it
  S damping;                         // [1] a second
  struct {
    std::uint32_t kind, count;
  } payload[2];
};
template <class S>
constexpr Firework<S> kFireworks[] = {
    {0, 0, {S(0), S(0), S(0)}, {S(0), S(0), S(0)}, S(1), {{0, 0}, {0, 0}}},  // they are numbered from 1
    {50, 140, {S(-5), S(25), S(-5)}, {S(5), S(28), S(5)}, S(0.1), {{3, 5}, {5, 5}}},
    {50, 100, {S(-5), S(10), S(-5)}, {S(5), S(20), S(5)}, S(0.8), {{4, 2}, {0, 0}}},
    {50, 150, {S(-5), S(-5), S(-5)}, {S(5), S(5), S(5)}, S(0.1), {{0, 0}, {0, 0}}},
    {25, 50, {S(-20), S(5), S(-5)}, {S(20), S(5), S(5)}, S(0.2), {{0, 0}, {0, 0}}},
    {50, 100, {S(-20), S(2), S(-5)}, {S(20), S(18), S(5)}, S(0.01), {{3, 5}, {0, 0}}},
    {300, 500, {S(-5), S(5), S(-5)}, {S(5), S(10), S(5)}, S(0.95), {{0, 0}, {0, 0}}},
    {400, 500, {S(-5), S(50), S(-5)}, {S(5), S(60), S(5)}, S(0.01), {{8, 10}, {0, 0}}},
    {25, 50, {S(-1), S(-1), S(-1)}, {S(1), S(1), S(1)}, S(0.01), {{0, 0}, {0, 0}}},
    {300, 500, {S(-15), S(10), S(-5)}, {S(15), S(15), S(5)}, S(0.95), {{0, 0}, {0, 0}}},
};
constexpr std::uint32_t kFireworkKinds = 9;
constexpr std::uint64_t kBetweenLaunches = 8;  // [steps]

/// Material n is that of firework n.
template <class S> void pack_fireworks(ParticleWorld<S>& world) {
  for (std::uint32_t kind = 1; kind <= kFireworkKinds; ++kind) {
    ParticleMaterial<S> material;
    material.damping = kFireworks<S>[kind].damping;
    world.add(material);
  }
}
template <class S>
void light(ParticleWorld<S>& world, std::uint32_t kind, Vec3<S> position, Vec3<S> velocity, Pcg32& random) {
  const Firework<S>& firework = kFireworks<S>[kind];
  const std::int32_t hz = world.settings().hz;
  ParticleDefinition<S> d;
  d.lifetime =
      static_cast<std::uint32_t>(random_between(random, firework.least_age * hz / 100, firework.most_age * hz / 100));
  const S x = uniform(random, firework.least.x, firework.most.x);
  const S y = uniform(random, firework.least.y, firework.most.y);
  d.position = position;
  d.velocity = velocity + Vec3<S>{x, y, uniform(random, firework.least.z, firework.most.z)};
  d.material = material_at(world, kind);
  world.create(d);
}
/// Draws depend on when and where in the world's arrays, so that nothing has to be remembered between frames.
template <class S>
void burst(ParticleWorld<S>& world, ParticleId particle, ParticleMaterialId material, Vec3<S> position,
           Vec3<S> velocity) {
  Pcg32 random = Pcg32::seeded(world.tick(), particle.slot);
  for (const auto& payload : kFireworks<S>[material.slot].payload) {
    for (std::uint32_t i = 0; i < payload.count; ++i) light(world, payload.kind, position, velocity, random);
  }
}

template <class S> void launch(ParticleWorld<S>& world) {
  const std::uint64_t kind = world.tick() / kBetweenLaunches + 1;
  if (world.tick() % kBetweenLaunches != 0 || kind > kFireworkKinds) return;
  Pcg32 random = Pcg32::seeded(world.tick(), kNoParticle);
  const S x = S(5 * random_between(random, -1, 1));
  light(world, static_cast<std::uint32_t>(kind), {x, S(0), S(0)}, {S(0), S(0), S(0)}, random);
}
/// Bursts what expired, and what fell to the ground as well; the sparks of a burst wait for the next step.
template <class S> void burst_all(ParticleWorld<S>& world) {
  const std::vector<ParticleId> particles = world.particles();
  for (const ParticleExpired<S>& e : world.events().expired) {
    burst(world, e.particle, e.material, e.position, e.velocity);
  }
  for (const ParticleId particle : particles) {
    const Vec3<S> position = world.position(particle), velocity = world.velocity(particle);
    if (!(position.y < S(0))) continue;
    const ParticleMaterialId material = world.material(particle);
    world.destroy(particle);
    burst(world, particle, material, position, velocity);
  }
}

}  // namespace

template <class S> ParticleScript<S> ballistic() {
  ParticleScript<S> script = {{}, load_guns<S>, shoot<S>, bury<S>};
  script.settings.gravity = {S(0), S(-1), S(0)};
  return script;
}
template <class S> ParticleScript<S> fireworks() {
  ParticleScript<S> script = {{}, pack_fireworks<S>, launch<S>, burst_all<S>};
  script.settings.gravity = {S(0), S(-9.81), S(0)};
  return script;
}

#define ISO_INSTANTIATE(S)                \
  template ParticleScript<S> ballistic(); \
  template ParticleScript<S> fireworks();
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes::particle_scripts
