// SceneGame<S>: a scene's world with its script; and how it is recorded and named in a replay's header.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "goldens.hpp"
#include "isostep/state/record.hpp"
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
  if (simd == Simd::avx2 && world.use_simd(Simd::sse2)) return;
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

/// Of everything in the settings that a replay's header does not name by itself.
template <class S> std::uint64_t settings_digest(const Settings<S>& settings) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  writer.write(settings.gravity);
  writer.write(settings.allow_sleep);
  return hash_bytes(bytes.data(), bytes.size());
}

inline const char* solver_name(SolverName solver) { return solver == SolverName::soft_step ? "soft_step" : "unknown"; }

template <class S> ReplayIdentity identity_of_world(const Settings<S>& settings, std::string_view scene) {
  ReplayIdentity identity{};
  identity.behaviour = behaviour_version();
  identity.scalar = ScalarTraits<S>::kName;
  identity.scalar_id = ScalarTraits<S>::kId;
  identity.hz = static_cast<std::uint32_t>(settings.hz);
  identity.substeps = static_cast<std::uint32_t>(settings.substeps);
  identity.solver = solver_name(settings.solver);
  identity.settings_digest = settings_digest(settings);
  identity.scene = scene;
  return identity;
}

/// Records a world's commands: `begin`, then for every frame `start_frame`, commands, step, `end_frame`; then `finish`.
template <class S> class WorldRecorder {
 public:
  WorldRecorder(World<S>& world, ReplaySink sink) : world_(world), recorder_(sink) {}
  ~WorldRecorder() { world_.record_to(nullptr); }
  WorldRecorder(const WorldRecorder&) = delete;
  WorldRecorder& operator=(const WorldRecorder&) = delete;

  Result<void> begin(std::string_view scene) {
    const Result<ReplayHeader> header = make_replay_header(identity_of_world(world_.settings(), scene));
    if (!header) return header.error();
    world_.record_to(&tape_);
    return recorder_.begin(world_, header.value());
  }
  void start_frame() { tape_.clear(); }
  Result<void> end_frame(std::uint64_t hash) { return recorder_.frame(tape_, hash); }
  Result<void> finish() { return recorder_.finish(); }

 private:
  World<S>& world_;
  Recorder<World<S>> recorder_;
  std::vector<std::uint8_t> tape_;
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
