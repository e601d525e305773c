// The named scenes of every kind, for those who list them or run them all.
// SPDX-License-Identifier: MIT
#include "games.hpp"

namespace isostep::tool {

void RigidGames::list(std::vector<SceneRow>& rows) {
  for (const scenes::NamedScene& entry : scenes::named_scenes()) {
    if (entry.left_out != nullptr) continue;
    rows.push_back(row(entry.name, entry.description));
    rows.back().narrow = entry.narrow;
  }
}
SceneRow RigidGames::row(std::string_view name, const char* description) {
  const Scene scene = *find(name);
  return {scene.name, description, scene.frames, {"bodies", "joints"}, {scene.bodies.size(), scene.joints.size()}};
}

std::optional<scenes::ParticleScene> ParticleGames::find(std::string_view name) {
  const Scene* const scene = scenes::find_particle_scene(name);
  return scene != nullptr ? std::optional<Scene>(*scene) : std::nullopt;
}
void ParticleGames::list(std::vector<SceneRow>& rows) {
  for (const Scene& scene : scenes::particle_scenes()) {
    const ParticleCounts counts = ParticleSceneGame<double>(scene).world.counts();
    rows.push_back({scene.name,
                    scene.description,
                    scene.frames,
                    {"particles", "bonds"},
                    {counts.particles, std::size_t{counts.springs} + counts.links}});
  }
}

std::vector<SceneRow> scene_rows() {
  std::vector<SceneRow> rows;
  any_games([&](auto kind) {
    decltype(kind)::list(rows);
    return false;
  });
  return rows;
}

}  // namespace isostep::tool
