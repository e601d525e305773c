// ParticleGame: a particle scene as a game without players: its world, and a frame of its script.
// SPDX-License-Identifier: MIT
#pragma once

#include "particle_scene.hpp"

namespace isostep::scenes {

/// All that it remembers is in `world`: saving and loading that between frames is enough.
template <class S> struct ParticleGame {
  explicit ParticleGame(const ParticleScene& scene)
      : ParticleGame(scene, script_of<S>(scene.id).settings, [](ParticleWorld<S>&) {}) {}
  /// Builds with another rate or method than the scene's. `begin(world)` sees the world while it is empty.
  template <class Begin>
  ParticleGame(const ParticleScene& scene, const ParticleSettings<S>& settings, Begin&& begin)
      : script(script_of<S>(scene.id)), world(settings) {
    begin(world);
    script.build(world);
  }

  ParticleReport advance() {
    before_step(world);
    const ParticleReport report = world.step();
    after_step(world);
    return report;
  }
  /// These take any world of this scene.
  void before_step(ParticleWorld<S>& any) const {
    if (script.before_step != nullptr) script.before_step(any);
  }
  void after_step(ParticleWorld<S>& any) const {
    if (script.after_step != nullptr) script.after_step(any);
  }

  ParticleScript<S> script;
  ParticleWorld<S> world;
};

}  // namespace isostep::scenes
