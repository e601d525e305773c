// The games that the tool runs by the names of their scenes: the list of their kinds, each over every scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "particle_scene_game.hpp"
#include "scene_game.hpp"
#include "scenes/named.hpp"
#include "tool.hpp"

namespace isostep::tool {

/// A named scene as `isostep scenes` lists it.
struct SceneRow {
  std::string name, description;
  int frames;
  const char* counted[2];  // "bodies", "joints"
  std::size_t counts[2];
  bool narrow = true;  // within the range of Q16.16
};

/// Worlds of rigid bodies. A kind has its Scene, with name and frames; Game<S> as SceneGame is; `find`, nothing for a
/// name that none of its scenes has; and `list`, which appends its scenes in their order.
struct RigidGames {
  using Scene = scenes::Scene;
  template <class S> using Game = SceneGame<S>;
  static std::optional<Scene> find(std::string_view name) { return scenes::find_scene(name); }
  static void list(std::vector<SceneRow>& rows);
  static SceneRow row(std::string_view name, const char* description);
};

/// Worlds of particles.
struct ParticleGames {
  using Scene = scenes::ParticleScene;
  template <class S> using Game = ParticleSceneGame<S>;
  static std::optional<Scene> find(std::string_view name);
  static void list(std::vector<SceneRow>& rows);
};

/// Calls visit(kind) for each kind of games until one call returns true; whether one did.
template <class Visit> bool any_games(Visit&& visit) { return visit(RigidGames{}) || visit(ParticleGames{}); }

/// The named scenes of all kinds; no two have one name.
std::vector<SceneRow> scene_rows();

template <class G> struct GameTag { using Type = G; };

/// visit(GameTag<G>{}, scene) for the named scene in the scalar. Empty, or what this build lacks: "scene" or "scalar".
template <class Visit>
std::string_view with_named_game(std::string_view scene, std::string_view scalar, Visit&& visit) {
  std::string_view missing = "scene";
  any_games([&](auto kind) {
    using Games = decltype(kind);
    const std::optional<typename Games::Scene> found = Games::find(scene);
    if (!found) return false;
    const bool has_scalar = with_scalar(scalar, [&](auto tag) {
      visit(GameTag<typename Games::template Game<typename decltype(tag)::Type>>{}, *found);
    });
    missing = has_scalar ? "" : "scalar";
    return true;
  });
  return missing;
}

/// visit(scalar name, GameTag<G>{}, scene) for the named scene in every scalar in whose range it is.
template <class Visit> void with_every_scalar(const SceneRow& row, Visit&& visit) {
  any_scalar([&](auto scalar) {
    using S = typename decltype(scalar)::Type;
    const char* name = ScalarTraits<S>::kName;
    if (row.narrow || !std::is_same_v<S, Q16_16>)
      with_named_game(row.name, name, [&](auto tag, const auto& scene) { visit(name, tag, scene); });
    return false;
  });
}

/// Does what with_named_game does, for a named scene or the rigid one in a file. Throws ToolError 64 or 66, with the
/// text of a SceneError.
template <class Visit> void with_game(const std::string& name_or_file, const std::string& scalar, Visit&& visit) {
  std::string_view missing = with_named_game(name_or_file, scalar, visit);
  if (missing == "scene") {
    const scenes::Scene scene = load_scene_file(name_or_file);
    const bool found =
        with_scalar(scalar, [&](auto tag) { visit(GameTag<SceneGame<typename decltype(tag)::Type>>{}, scene); });
    missing = found ? "" : "scalar";
  }
  if (!missing.empty()) throw ToolError(exit_status::kUsage, "this build has no scalar " + scalar);
}

}  // namespace isostep::tool
