// SceneGame<S>: a scene's world with its script; and how it is recorded and named in a replay's header.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "goldens.hpp"
#include "isostep/world/recorder.hpp"
#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/script.hpp"
#include "tool.hpp"

namespace isostep::tool {

inline constexpr int kDefaultHz = Settings<double>{}.hz, kDefaultSubsteps = Settings<double>{}.substeps;

/// A named scene, or the file of that path. Throws ToolError 64 or 66, SceneError's text included.
scenes::Scene load_scene(const std::string& name_or_file);
/// As a ToolError 64 that names the file.
[[noreturn]] void fail_scene(const std::string& name_or_file, const scenes::SceneError& error);

Simd simd_named(const std::string& name);
/// These lanes, or the widest narrower ones that processor, build and scalar have.
template <class S> void use_lanes(World<S>& world, Simd simd) {
  if (world.use_simd(simd)) return;
  if (simd == Simd::avx512 && world.use_simd(Simd::avx2)) return;
  for (const Simd narrow : {Simd::sse2, Simd::neon, Simd::wasm}) {
    if (world.use_simd(narrow)) return;
  }
  world.use_simd(Simd::scalar);
}

template <class S> struct SceneGame {
  explicit SceneGame(const scenes::Scene& scene, int hz = kDefaultHz, int substeps = kDefaultSubsteps)
      : script(scene.script), world(scenes::settings_of<S>(scene, hz, substeps)) {
    scenes::build(scene, world);
  }
  void advance() {
    scenes::before_step(script, world);
    world.step();
  }

  scenes::Script script;
  World<S> world;
};

/// The hash after each of so many frames; throws when interrupted.
template <class S> std::vector<std::uint64_t> hashes_of(SceneGame<S>& game, int frames) {
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < frames; ++i) {
    stop_if_interrupted();
    game.advance();
    hashes.push_back(game.world.hash());
  }
  return hashes;
}

}  // namespace isostep::tool
