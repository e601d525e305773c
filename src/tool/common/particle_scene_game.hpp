// ParticleSceneGame<S>: a scene of particles as the tool runs, verifies and restores it.
// SPDX-License-Identifier: MIT
#pragma once

#include "game_options.hpp"
#include "isostep/particles/recorder.hpp"
#include "scene_game.hpp"
#include "scenes/particles/particle_game.hpp"
#include "tool.hpp"

namespace isostep::tool {

/// The settings with what the options ask for. Throws ToolError 64 for a solver that particles have not got.
template <class S> ParticleSettings<S> asked_of(ParticleSettings<S> settings, const GameOptions& options) {
  if (options.hz > 0) settings.hz = options.hz;
  if (options.substeps > 0) settings.substeps = options.substeps;
  if (!choose(settings.solver, options.solver, kParticleSolverNames))
    throw ToolError(exit_status::kUsage, "particles have no solver " + options.solver);
  if (!options.projection.empty()) throw ToolError(exit_status::kUsage, "--projection is for rigid bodies");
  choose(settings.integrator, options.integrator, kIntegratorNames);
  choose(settings.stepping, options.stepping, kSteppingNames);
  return settings;
}
/// The world is already as the options ask.
template <class S> bool is_as_asked(const ParticleSettings<S>& own, const GameOptions& options) {
  const ParticleSettings<S> asked = asked_of(own, options);
  return asked.hz == own.hz && asked.substeps == own.substeps && asked.solver == own.solver &&
         asked.integrator == own.integrator && asked.stepping == own.stepping;
}

template <class S> struct ParticleSceneGame : scenes::ParticleGame<S> {
  using World = ParticleWorld<S>;
  using Scene = scenes::ParticleScene;

  explicit ParticleSceneGame(const Scene& scene, const GameOptions& options = {})
      : ParticleSceneGame(scene, options, [](World&) {}) {}
  template <class Begin>
  ParticleSceneGame(const Scene& scene, const GameOptions& options, Begin&& begin)
      : scenes::ParticleGame<S>(scene, settings_of(scene, options), begin) {}

  static ParticleSettings<S> settings_of(const Scene& scene, const GameOptions& options) {
    const ParticleSettings<S> settings = asked_of(scenes::script_of<S>(scene.id).settings, options);
    if (settings.hz * settings.substeps > kMaxParticleRate)
      throw ToolError(exit_status::kUsage, "hz times sub-steps is more than " + std::to_string(kMaxParticleRate));
    return settings;
  }
};

}  // namespace isostep::tool
