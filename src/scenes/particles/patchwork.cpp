// `patchwork`: the fewest particles that meet springs, cables, rods, scenery and each other; what self-checks replay.
// SPDX-License-Identifier: MIT
#include "isostep/particles/bodies/cloth.hpp"
#include "particle_scene.hpp"
#include "words.hpp"

namespace isostep::scenes::particle_scripts {
namespace {

constexpr std::uint32_t kSide = 3;  // particles of the cloth along an edge

/// One corner of the cloth from a point 1 m above it.
template <class S> void hang(ParticleWorld<S>& world, std::uint32_t slot, LinkType type) {
  Link<S> link;
  link.type = type;
  link.a = particle_at(world, slot);
  link.anchor = world.position(link.a) + Vec3<S>{S(0), S(1), S(0)};
  link.length = S(1);
  link.restitution = S(0.25);
  world.add(link);
}
/// Adds a cloth that hangs on cables by two corners and on rods by the others, soft enough for every integrator.
template <class S> void add_cloth(ParticleWorld<S>& world, ParticleMaterialId material) {
  ClothDefinition<S> d;
  d.corner = {S(-0.5), S(2.5), S(-0.5)};
  d.across = {S(1), S(0), S(0)};
  d.down = {S(0), S(0), S(1)};
  d.columns = d.rows = kSide;
  d.mass = S(0.5625);  // 1/16 kg each
  d.pins = ClothPins::none;
  d.structural = d.shear = {true, S(64), S(0.125)};
  d.bend = {true, S(16), S(0.0625)};
  d.material = material;
  build(world, d);
  hang(world, 0, LinkType::cable);
  hang(world, kSide - 1, LinkType::rod);
  hang(world, kSide * (kSide - 1), LinkType::rod);
  hang(world, kSide * kSide - 1, LinkType::cable);
}
template <class S>
ParticleId add_light_ball(ParticleWorld<S>& world, ParticleMaterialId material, Vec3<S> at, Vec3<S> v) {
  ParticleDefinition<S> d;
  d.material = material;
  d.position = at;
  d.velocity = v;
  d.mass = S(0.25);
  return world.create(d);
}

template <class S> void build_patchwork(ParticleWorld<S>& world) {
  ParticleMaterial<S> wool;
  wool.damping = S(0.8);
  wool.radius = S(0.125);
  wool.friction = S(0.4);
  wool.restitution = S(0.3);
  wool.collides = true;
  const ParticleMaterialId material = world.add(wool);
  add_cloth(world, material);
  add_light_ball(world, material, {S(0.25), S(3.5), S(0.25)}, {S(0), S(-1), S(0)});
  add_light_ball(world, material, {S(-0.125), S(3), S(-0.0625)}, {S(0), S(0), S(0)});
  add_light_ball(world, material, {S(2), S(1.5), S(0)}, {S(-1), S(0), S(0.25)});
  Link<S> tether;  // to the ball that strikes the bar
  tether.a = add_light_ball(world, material, {S(1.5), S(2), S(0.0625)}, {S(0), S(0), S(0)});
  tether.b = particle_at(world, kSide * kSide + 2);
  tether.length = S(0.75);
  world.add(tether);
  add_ground(world);
  add_line(world, {S(1.5), S(0.75), S(-1)}, {S(1.5), S(0.75), S(1)}, S(0.125));
}
/// A kick every half second, so that nothing comes to rest.
template <class S> void kick(ParticleWorld<S>& world) {
  if (world.tick() % 30 == 29) world.apply_impulse(particle_at(world, 5), {S(0.125), S(0.25), S(-0.0625)});
}

}  // namespace

/// Iterations for the worst moment by `worst_first`, so that it never ends with constraints left.
template <class S> ParticleScript<S> patchwork() {
  ParticleScript<S> script = {{}, build_patchwork<S>, kick<S>, nullptr};
  script.settings.iterations = 256;
  return script;
}

#define ISO_INSTANTIATE(S) template ParticleScript<S> patchwork();
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes::particle_scripts
