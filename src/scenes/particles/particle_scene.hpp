// The named particle scenes: the book's demonstrations, one scene for each method of the engine, and their list.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "isostep/particles/particle_world.hpp"

namespace isostep::scenes {

/// A scene for a scalar: world commands and nothing remembered, so that a world that was loaded goes on alike.
template <class S> struct ParticleScript {
  ParticleSettings<S> settings;
  void (*build)(ParticleWorld<S>&) = nullptr;        // into a world that is empty
  void (*before_step)(ParticleWorld<S>&) = nullptr;  // null: nothing happens between steps
  void (*after_step)(ParticleWorld<S>&) = nullptr;   // acts on the events of the step just taken; null: on none
};

enum class ParticleSceneId : std::uint32_t {
  ballistic,
  fireworks,
  bridge,
  blob,
  platform,
  cloth,
  rope,
  soft_box,
  springs,
  cradle,
  billiards,
  worst_first,
  time_division,
  explicit_euler,
  velocity_verlet,
  rk4,
  implicit_euler,
  patchwork
};

struct ParticleScene {
  ParticleSceneId id;
  const char* name;
  const char* description;
  int frames;  // of a run that asks for no other count
};

std::span<const ParticleScene> particle_scenes();
/// Returns null for a name that no scene has.
const ParticleScene* find_particle_scene(std::string_view name);
template <class S> ParticleScript<S> script_of(ParticleSceneId id);

// Scripts, one file a family.
namespace particle_scripts {
template <class S> ParticleScript<S> ballistic();
template <class S> ParticleScript<S> fireworks();
template <class S> ParticleScript<S> bridge(ParticleSolver solver);
template <class S> ParticleScript<S> platform();
template <class S> ParticleScript<S> blob();
template <class S> ParticleScript<S> rope();
template <class S> ParticleScript<S> cloth();
template <class S> ParticleScript<S> soft_box();
template <class S> ParticleScript<S> small_cloth(Integrator integrator);
template <class S> ParticleScript<S> springs();
template <class S> ParticleScript<S> cradle();
template <class S> ParticleScript<S> billiards();
template <class S> ParticleScript<S> bullets();
template <class S> ParticleScript<S> patchwork();
}  // namespace particle_scripts

#define ISO_EXTERN(S) extern template ParticleScript<S> script_of<S>(ParticleSceneId);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
