// SceneGame<S>: a rigid scene's world with its script; scenes from files; threads for any world.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "game_options.hpp"
#include "isostep/core/simd_choice.hpp"
#include "isostep/replay/recorder.hpp"
#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/script.hpp"
#include "tool.hpp"

namespace isostep::tool {

/// Throws ToolError 64 or 66, SceneError's text included: 64 as well for a name that is neither a scene's nor a file's.
scenes::Scene load_scene_file(const std::string& name_or_file);
/// Throws a ToolError 64 that names the file.
[[noreturn]] void fail_scene(const std::string& name_or_file, const scenes::SceneError& error);

/// Throws ToolError 64 for methods that rigid bodies have not got.
void require_rigid_methods(const GameOptions& options);
/// Throws ToolError 64 for methods that this build leaves out.
void require_built(const scenes::Scene& asked);
/// Throws ToolError 64 where the options choose a projection for a solver that has none.
void require_projection(const scenes::Scene& asked, const GameOptions& options);
/// Some worlds stay on the calling thread: for those a ToolError 64.
template <class W> void use_threads(W& world, const TaskRunner& runner) {
  if constexpr (requires { world.use_threads(runner); }) {
    world.use_threads(runner);
  } else {
    throw ToolError(exit_status::kUsage, "particles are stepped on one thread: --threads is for rigid bodies");
  }
}

/// The place of a name in its list; empty leaves `value` as it is. False for a name that is not there.
template <class Enum> bool choose(Enum& value, std::string_view name, std::span<const char* const> names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name != names[i]) continue;
    value = static_cast<Enum>(i);
    return true;
  }
  return name.empty();
}

/// A scene's settings, or a world's, with what the options ask for.
template <class Methods> void ask(Methods& methods, const GameOptions& options) {
  if (options.hz > 0) methods.hz = options.hz;
  if (options.substeps > 0) methods.substeps = options.substeps;
  choose(methods.solver, options.solver, kSolverNames);
  choose(methods.projection, options.projection, kProjectionNames);
}
/// The world is already as the options ask; methods it has no choice of are refused before.
template <class S> bool is_as_asked(const Settings<S>& own, const GameOptions& options) {
  Settings<S> asked = own;
  ask(asked, options);
  return asked.hz == own.hz && asked.substeps == own.substeps && asked.solver == own.solver &&
         asked.projection == own.projection;
}

/// A game of a scene. Every kind of game has World and Scene; `world`, which its constructor builds from a scene, once
/// `begin(world)` has seen it empty; and `before_step` and `after_step` for any world of that scene, whatever it went
/// through.
template <class S> struct SceneGame {
  using World = isostep::World<S>;
  using Scene = scenes::Scene;

  explicit SceneGame(const Scene& scene, const GameOptions& options = {}) : SceneGame(scene, options, [](World&) {}) {}
  template <class Begin>
  SceneGame(const Scene& scene, const GameOptions& options, Begin&& begin)
      : script(scene.script), world(settings_of(scene, options)) {
    begin(world);
    scenes::build(scene, world);
  }
  static Settings<S> settings_of(const Scene& scene, const GameOptions& options) {
    require_rigid_methods(options);
    Scene asked;  // bodies are not needed
    asked.gravity = scene.gravity;
    asked.allow_sleep = scene.allow_sleep;
    asked.hz = scene.hz;
    asked.substeps = scene.substeps;
    asked.solver = scene.solver;
    asked.projection = scene.projection;
    asked.broad_phase = scene.broad_phase;
    ask(asked, options);
    require_built(asked);
    require_projection(asked, options);
    return scenes::settings_of<S>(asked);
  }
  void before_step(World& any) const { scenes::before_step(script, any); }
  void after_step(World&) const {}
  void advance() {
    before_step(world);
    world.step();
  }

  scenes::Script script;
  World world;
};

/// The hash after each of so many frames; throws when interrupted.
template <class Game> std::vector<std::uint64_t> hashes_of(Game& game, int frames) {
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < frames; ++i) {
    stop_if_interrupted();
    game.advance();
    hashes.push_back(game.world.hash());
  }
  return hashes;
}

}  // namespace isostep::tool
