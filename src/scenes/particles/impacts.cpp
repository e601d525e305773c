// Particles that strike each other and scenery: a cradle, a pit full, and bullets.
// SPDX-License-Identifier: MIT
#include "isostep/core/random.hpp"
#include "particle_scene.hpp"
#include "words.hpp"

namespace isostep::scenes::particle_scripts {
namespace {

template <class S> ParticleMaterialId ball(ParticleWorld<S>& world, S radius, S friction, S restitution) {
  ParticleMaterial<S> material;
  material.radius = radius;
  material.friction = friction;
  material.restitution = restitution;
  material.collides = true;
  return world.add(material);
}
template <class S>
ParticleId add_ball(ParticleWorld<S>& world, ParticleMaterialId material, Vec3<S> position, Vec3<S> velocity) {
  ParticleDefinition<S> d;
  d.material = material;
  d.position = position;
  d.velocity = velocity;
  return world.create(d);
}

/// Five in a row on cables of 5 m; the first is held 3 m aside, 1 m higher, so that it strikes at sqrt(20) m/s.
template <class S> void build_cradle(ParticleWorld<S>& world) {
  const ParticleMaterialId steel = ball(world, S(0.25), S(0), S(1));
  for (int i = 0; i < 5; ++i) {
    const S x = S(i) * S(0.5);
    const Vec3<S> at = i == 0 ? Vec3<S>{S(-3), S(1), S(0)} : Vec3<S>{x, S(0), S(0)};
    Link<S> cable;
    cable.a = add_ball(world, steel, at, {S(0), S(0), S(0)});
    cable.anchor = {x, S(5), S(0)};
    cable.length = S(5);
    world.add(cable);
  }
}

constexpr std::uint64_t kBilliardsSeed = 11;

/// 5 x 8 x 5 into a pit of 3 m by 3 m, every second layer above the gaps of the one below.
template <class S> void build_billiards(ParticleWorld<S>& world) {
  const ParticleMaterialId ivory = ball(world, S(0.2), S(0.4), S(0.3));
  Pcg32 random = Pcg32::seeded(kBilliardsSeed);
  for (int i = 0; i < 200; ++i) {
    const S x = uniform(random, S(-0.04), S(0.04)), z = uniform(random, S(-0.04), S(0.04));
    const S aside = i / 25 % 2 == 0 ? S(-0.1) : S(0.1);
    const Vec3<S> cell = {S(i % 5 - 2), S(i / 25 + 1), S(i / 5 % 5 - 2)};
    add_ball(world, ivory, cell * S(0.5) + Vec3<S>{x + aside, S(0), z + aside}, {S(0), S(0), S(0)});
  }
  add_ground(world);
  for (const int axis : {0, 2}) {
    add_plane(world, axis, 1, S(-1.5));
    add_plane(world, axis, -1, S(-1.5));
  }
}

/// Eight at leaning bars of 4 cm, each in its alley, up to 1.25 m a sub-step; then two at each other. What bounces
/// meets the end walls.
template <class S> void build_bullets(ParticleWorld<S>& world) {
  const ParticleMaterialId lead = ball(world, S(0.02), S(0.2), S(0.5));
  for (int i = 0; i < 8; ++i) {
    const S x = S(8 + i % 3), y = S(4) + S(i) * S(0.5), z = S(i) * S(-0.25);
    add_ball(world, lead, {S(-8), y, z}, {S(300 - 30 * i), S(0), S(0)});
    add_line(world, {x - S(0.25), y - S(1), z}, {x + S(0.25), y + S(1), z}, S(0.02));
  }
  add_ball(world, lead, {S(-8), S(2), S(3)}, {S(200), S(0), S(0)});
  add_ball(world, lead, {S(8), S(2), S(3)}, {S(-200), S(0), S(0)});
  add_ground(world);
  add_plane(world, 0, 1, S(-10));
  add_plane(world, 0, -1, S(-12));
}

}  // namespace

/// The book's resolver hands a blow on from pair to pair; soft steps share it out.
template <class S> ParticleScript<S> cradle() {
  ParticleScript<S> script = {{}, build_cradle<S>, nullptr, nullptr};
  script.settings.solver = ParticleSolver::worst_first;
  return script;
}
template <class S> ParticleScript<S> billiards() { return {{}, build_billiards<S>, nullptr, nullptr}; }
template <class S> ParticleScript<S> bullets() {
  ParticleScript<S> script = {{}, build_bullets<S>, nullptr, nullptr};
  script.settings.stepping = Stepping::time_division;
  return script;
}

#define ISO_INSTANTIATE(S)                \
  template ParticleScript<S> cradle();    \
  template ParticleScript<S> billiards(); \
  template ParticleScript<S> bullets();
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes::particle_scripts
