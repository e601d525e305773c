// SceneGame<S>: a rigid scene's world with its script; scenes from files; lanes and threads for any world.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "game_options.hpp"
#include "isostep/world/recorder.hpp"
#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/script.hpp"
#include "tool.hpp"

namespace isostep::tool {

/// Throws ToolError 64 or 66, SceneError's text included: 64 as well for a name that is neither a scene's nor a file's.
scenes::Scene load_scene_file(const std::string& name_or_file);
/// As a ToolError 64 that names the file.
[[noreturn]] void fail_scene(const std::string& name_or_file, const scenes::SceneError& error);

Simd simd_named(const std::string& name);
/// Throws ToolError 64 for methods that rigid bodies have not got.
void require_rigid_methods(const GameOptions& options);
/// These lanes, or the widest narrower ones that processor, build and scalar have. Some worlds have no choice.
template <class W> void use_lanes(W& world, Simd simd) {
  if constexpr (requires { world.use_simd(simd); }) {
    if (world.use_simd(simd)) return;
    if (simd == Simd::avx512 && world.use_simd(Simd::avx2)) return;
    for (const Simd narrow : {Simd::sse2, Simd::neon, Simd::wasm}) {
      if (world.use_simd(narrow)) return;
    }
    world.use_simd(Simd::scalar);
  }
}

/// Some worlds stay on the calling thread: for those a ToolError 64.
template <class W> void use_threads(W& world, const TaskRunner& runner) {
  if constexpr (requires { world.use_threads(runner); }) {
    world.use_threads(runner);
  } else {
    throw ToolError(exit_status::kUsage, "particles are stepped on one thread: --threads is for rigid bodies");
  }
}

/// Whether a world is already as the options ask; methods it has no choice of are refused before.
template <class S> bool is_as_asked(const Settings<S>& own, const GameOptions& options) {
  return (options.hz <= 0 || options.hz == own.hz) && (options.substeps <= 0 || options.substeps == own.substeps);
}

/// What every kind of game has: World, Scene; `world`, which its constructor builds from a scene; and `before_step` and
/// `after_step` for any world of that scene, whatever it went through.
template <class S> struct SceneGame {
  using World = isostep::World<S>;
  using Scene = scenes::Scene;

  explicit SceneGame(const Scene& scene, const GameOptions& options = {})
      : script(scene.script), world(settings_of(scene, options)) {
    scenes::build(scene, world);
  }
  static Settings<S> settings_of(const Scene& scene, const GameOptions& options) {
    require_rigid_methods(options);
    const Settings<S> own;
    return scenes::settings_of<S>(scene, options.hz > 0 ? options.hz : own.hz,
                                  options.substeps > 0 ? options.substeps : own.substeps);
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
