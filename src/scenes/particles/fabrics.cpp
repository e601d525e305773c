// Bodies of many particles at their defaults: cloths, a rope, a soft box.
// SPDX-License-Identifier: MIT
#include "isostep/particles/bodies/cloth.hpp"
#include "isostep/particles/bodies/rope.hpp"
#include "isostep/particles/bodies/soft_box.hpp"
#include "particle_scene.hpp"
#include "words.hpp"

namespace isostep::scenes::particle_scripts {
namespace {

template <class S> ParticleMaterialId add_material(ParticleWorld<S>& world, S damping, S radius, S friction) {
  ParticleMaterial<S> material;
  material.damping = damping;
  material.radius = radius;
  material.friction = friction;
  return world.add(material);
}

/// A cloth, held level by two corners, swings down over a bar and onto the ground.
template <class S> void build_cloth(ParticleWorld<S>& world) {
  ClothDefinition<S> d;
  d.down = {S(0), S(0), S(4)};
  d.columns = d.rows = 13;
  d.mass = S(10.5625);  // 1/16 kg each
  d.material = add_material(world, S(0.7), S(0.05), S(0.3));
  build(world, d);
  add_line(world, {S(-3), S(2.75), S(1.5)}, {S(3), S(2.75), S(1.5)}, S(0.1));
  add_ground(world, S(1));
}

template <class S> void build_rope(ParticleWorld<S>& world) {
  RopeDefinition<S> d;
  d.start = {S(-4), S(6), S(0)};
  d.end = {S(4), S(6), S(0)};
  d.particles = 51;
  d.length = S(10);
  d.mass = S(3.1875);  // 1/16 kg each
  d.pin_end = true;
  d.material = add_material(world, S(0.2), S(0), S(0));
  build(world, d);
}

template <class S> void build_soft_box(ParticleWorld<S>& world) {
  SoftBoxDefinition<S> d;
  d.material = add_material(world, S(0.5), S(0.05), S(0.5));
  build(world, d);
  add_ground(world);
}

/// Explicit Euler wants damping that outweighs the stiffness, k h < c, and air for what springs do not damp.
template <class S> void build_small_cloth(ParticleWorld<S>& world) {
  ClothDefinition<S> d;
  d.corner = {S(-1), S(2), S(0)};
  d.across = {S(2), S(0), S(0)};
  d.down = {S(0), S(0), S(2)};
  d.columns = d.rows = 9;
  d.mass = S(5.0625);  // 1/16 kg each
  const Integrator integrator = world.settings().integrator;
  const bool is_explicit = integrator == Integrator::explicit_euler;
  if (is_explicit) d.structural = d.shear = d.bend = {true, S(56), S(0.9375)};  // k h^2/m 1/64, c h/m 1/16
  if (integrator == Integrator::implicit_euler) {                               // k h^2/m 73
    d.structural = d.shear = {true, S(16384), S(4)};
    d.bend = {true, S(2048), S(1)};
  }
  d.material = add_material(world, is_explicit ? S(0.05) : S(0.7), S(0), S(0));
  build(world, d);
}

}  // namespace

template <class S> ParticleScript<S> cloth() { return {{}, build_cloth<S>, nullptr, nullptr}; }
/// Soft links give by what hangs on them, as 1 / substeps^2: with eight the whole rope is 0.3 % too long.
template <class S> ParticleScript<S> rope() {
  ParticleScript<S> script = {{}, build_rope<S>, nullptr, nullptr};
  script.settings.substeps = 8;
  return script;
}
template <class S> ParticleScript<S> soft_box() { return {{}, build_soft_box<S>, nullptr, nullptr}; }
template <class S> ParticleScript<S> small_cloth(Integrator integrator) {
  ParticleScript<S> script = {{}, build_small_cloth<S>, nullptr, nullptr};
  script.settings.integrator = integrator;
  if (integrator == Integrator::implicit_euler) script.settings.substeps = 1;
  return script;
}

#define ISO_INSTANTIATE(S)               \
  template ParticleScript<S> cloth();    \
  template ParticleScript<S> rope();     \
  template ParticleScript<S> soft_box(); \
  template ParticleScript<S> small_cloth(Integrator);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes::particle_scripts
