// The list of named particle scenes.
// SPDX-License-Identifier: MIT
#include "particle_scene.hpp"

#include "scenes/scene.hpp"

namespace isostep::scenes {
namespace {

using Id = ParticleSceneId;

constexpr ParticleScene kParticleScenes[] = {
    {Id::ballistic, "ballistic", "four kinds of rounds from a pool of 16", 300},
    {Id::fireworks, "fireworks", "nine kinds of fireworks that burst into each other", 400},
    {Id::bridge, "bridge", "a load walks over a rope bridge", 1200},
    {Id::blob, "blob", "a blob is steered down ten platforms", 1200},
    {Id::platform, "platform", "a platform of rods is tipped by its load", 900},
    {Id::cloth, "cloth", "169 particles of cloth fall over a bar above the ground", 300},
    {Id::rope, "rope", "50 cables between two points", 300},
    {Id::soft_box, "soft_box", "a lattice of springs falls on a plane", 300},
    {Id::springs, "springs", "every force and every spring, changed and removed on the way", 300},
    {Id::cradle, "cradle", "Newton's cradle of five particles on cables", 300},
    {Id::billiards, "billiards", "200 particles dropped into a pit, with friction", 300},
    {Id::worst_first, "worst_first", "the bridge by the book's resolver", 300},
    {Id::time_division, "time_division", "bullets at thin walls, stepped from contact to contact", 120},
    {Id::explicit_euler, "explicit_euler", "a small cloth by the book's integrator", 300},
    {Id::velocity_verlet, "velocity_verlet", "a small cloth by velocity Verlet", 300},
    {Id::rk4, "rk4", "a small cloth by Runge and Kutta", 300},
    {Id::implicit_euler, "implicit_euler", "a small cloth too stiff for the others", 120},
    {Id::patchwork, "patchwork", "the fewest particles that meet springs, links, scenery and each other", 120},
};

}  // namespace

std::span<const ParticleScene> particle_scenes() { return kParticleScenes; }

const ParticleScene* find_particle_scene(std::string_view name) {
  for (const ParticleScene& scene : kParticleScenes) {
    if (name == scene.name) return &scene;
  }
  return nullptr;
}

template <class S> ParticleScript<S> script_of(ParticleSceneId id) {
  switch (id) {
    case Id::ballistic: return particle_scripts::ballistic<S>();
    case Id::fireworks: return particle_scripts::fireworks<S>();
    case Id::bridge: return particle_scripts::bridge<S>(ParticleSolver::soft_step);
    case Id::blob: return particle_scripts::blob<S>();
    case Id::platform: return particle_scripts::platform<S>();
    case Id::cloth: return particle_scripts::cloth<S>();
    case Id::rope: return particle_scripts::rope<S>();
    case Id::soft_box: return particle_scripts::soft_box<S>();
    case Id::springs: return particle_scripts::springs<S>();
    case Id::cradle: return particle_scripts::cradle<S>();
    case Id::billiards: return particle_scripts::billiards<S>();
    case Id::worst_first: return particle_scripts::bridge<S>(ParticleSolver::worst_first);
    case Id::time_division: return particle_scripts::bullets<S>();
    case Id::explicit_euler: return particle_scripts::small_cloth<S>(Integrator::explicit_euler);
    case Id::velocity_verlet: return particle_scripts::small_cloth<S>(Integrator::velocity_verlet);
    case Id::rk4: return particle_scripts::small_cloth<S>(Integrator::rk4);
    case Id::implicit_euler: return particle_scripts::small_cloth<S>(Integrator::implicit_euler);
    case Id::patchwork: return particle_scripts::patchwork<S>();
  }
  throw SceneError("", "no such particle scene");
}

#define ISO_INSTANTIATE(S) template ParticleScript<S> script_of<S>(ParticleSceneId);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
